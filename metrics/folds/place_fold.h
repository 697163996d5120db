// Light on the kerb, on boards at standard places and on edge markings, by distance ahead, over a drive; from the lamps' tables in double.
// Boards and markings have the materials that pictures have (scenarios/roads/mesh/mesh_materials.cpp): sheeting of class RA2, white paint
// of 150 mcd/(m2 lx), and their fall-off with the angle of observation.
// Where across a road's section sensors and observers stand.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/readings/readings.h"
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
    glm::dvec3 eye_m_{0.0};
    std::vector<Figure> figures_;
};

/// Offset from the own lane's centre, left positive. nullopt: there is no such lane here. Edges are those of all driving lanes.
std::optional<double> offset_across_m(const CrossSection& section, Across across);

/// "right edge of the lanes".
std::string place_name(Across across);

} // namespace fernlicht
