// Light on the kerb, on boards at standard places and on edge markings over a drive, by distance ahead: from the lamps' tables, in double.
// Boards and markings have the materials that pictures have (scenarios/roads/mesh/mesh_materials.cpp): sheeting of class RA2, white paint
// of 150 mcd/(m2 lx), and their fall-off with the angle of observation.
// Illuminance at fixed places beside the road while the car drives up to them, from the lamps' tables in double. Facing the lamps: sum of
// I / d^2. A crest of the road between lamp and sensor hides the lamp; nothing else does.
// Where across a road's section sensors and observers stand.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/readings/readings.h"
#include "metrics/road/lit_line.h"
#include "scenarios/drives/drive.h"
#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

class PlaceFold {
  public:
    /// The drive must ask for places. Drive and route must outlive the fold.
    PlaceFold(const Drive& drive, const Route& route);

    void add(const Moment& moment);
    /// kerb_at_50m_lx, kerb_target_at_50m_lx, board_right_at_50m_lx, board_right_at_50m_cdm2, marking_right_at_50m_cdm2 ..., medians.
    Readings readings() const;

  private:
    struct Figure {
        ReadingKey key;
        std::string where;
        std::vector<double> values;
        std::string missing;
    };

    const Drive& drive_;
    const Route& route_;
    Material board_, marking_;
    std::vector<Figure> figures_;
};

class SensorFold {
  public:
    /// The drive must ask for sensors. Drive and route must outlive the fold.
    SensorFold(const Drive& drive, const Route& route);

    void add(const Moment& moment);
    /// For each sensor NAME: sensor_NAME_reach_5lx_m for each limit (how far before it the bumper is when the sensor first has so much,
    /// seen from near: the farthest such place), sensor_NAME_at_50m_lx for each distance, sensor_NAME_max_lx.
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    struct Followed {
        std::optional<glm::dvec3> point_m; ///< nullopt: there is no such lane at this place
        Approach approach;
        std::vector<int> ticks;
        std::string unknown; ///< why some moment has no light by way of the road
        bool near_field = false;
        bool passed = false; ///< some moment is beyond it
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Followed> followed_;
};

/// Offset from the own lane's centre, left positive. nullopt: there is no such lane here. Edges are those of all driving lanes.
std::optional<double> offset_across_m(const CrossSection& section, Across across);

/// There on the surface, 0 to the route's length along it; nullopt where the road has no such lane.
std::optional<Pose> place_on_road(const Route& route, Across across, double along_m);

/// How high a target over the kerb stands.
inline constexpr double kerb_target_m = 0.25;

/// "right edge of the lanes".
std::string place_name(Across across);

/// The first perspective view's, in the car's frame; without one where a driver usually sits.
glm::dvec3 driver_eye_m(const Drive& drive);

/// Of road_materials(); throws std::logic_error for another name.
Material material_named(const std::string& name, const RoadSurface& surface = {});

} // namespace fernlicht
