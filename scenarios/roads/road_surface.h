// What a drive's roads are paved with, and what its markings are: classes whose values are in mesh_materials.cpp.
#pragma once

namespace fernlicht {

/// standard: dry asphalt without gloss. The others mirror at grazing angles as the r-tables R3, R4 and R1 of CIE 144 do.
enum class Pavement { standard, asphalt_worn, asphalt_new, concrete };
/// Types of EN 1436: II keeps retroreflecting when it is wet.
enum class MarkingType { standard, type_1, type_2 };

struct Markings {
    MarkingType type = MarkingType::standard;
    /// Classes of EN 1436, by their number; of white paint of a type.
    int r_class = 3;  ///< dry, 1 to 5: R_L 80, 100, 150, 200, 300 mcd/(m2 lx)
    int rw_class = 2; ///< wet, 1 to 6, of type II: 25, 35, 50, 75, 100, 150
    int q_class = 3;  ///< Qd, 1 to 5: 80, 100, 130, 160, 200

    bool operator==(const Markings&) const = default;
};

struct RoadSurface {
    Pavement pavement = Pavement::standard;
    bool wheel_tracks = false; ///< two to a driving lane, polished by tyres
    Markings markings;

    bool operator==(const RoadSurface&) const = default;
};

} // namespace fernlicht
