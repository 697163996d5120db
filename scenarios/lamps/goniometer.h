// From other systems of angles to the UN goniometer's H = atan2(x, z), V = asin(y), by resampling with a bounded error.
#pragma once

#include "scenarios/lamps/candela_table.h"
#include "scenarios/lamps/measured_grid.h"

#include <functional>
#include <string>

namespace fernlicht {

struct TwoAngles {
    double h_deg = 0.0, v_deg = 0.0;
};

/// Another system's two angles, its polar axis elsewhere. Each function is the inverse of the other where both are defined.
struct AngleSystem {
    std::string name;                                   ///< for notes: "type B"
    std::function<TwoAngles(double, double)> to_native; ///< from UN H, V to the system's own two angles
    std::function<TwoAngles(double, double)> to_un;
};

/// IES type B, horizontal polar axis: h = asin(x), v = atan2(y, z).
AngleSystem type_b();
/// Angles as read off a flat screen square to the axis: h = atan(x / z), v = atan(y / z).
AngleSystem flat_screen();
/// C planes about a beam that points along the luminaire's gamma = 0, here forward: h = -C, v = gamma - 90, C 0 to the right, C 90 up,
/// as a plan view of the luminaire is read.
AngleSystem beam_along_nadir();

/// The table `native` over the angles of `system`, brought onto H and V. The axes hold the native angles, the peak's direction, and as
/// many more as bring the difference between the two tables below 0.1 % of the peak, up to half a million samples. Of the cells in which
/// the native data end, at most 0.1 degrees wide where the samples suffice, as many are data as hold the light of those parts that have
/// data: the flux stays, and the border runs to the cell. The others are gaps. Adds a note with the size and the worst difference found by
/// probing.
CandelaTable on_un_goniometer(const CandelaTable& native, const AngleSystem& system, Notes& notes);

} // namespace fernlicht
