// Illuminance at named points ahead of the car, from the drawn lux image and from the twin.
#pragma once

#include "runner/play/play.h"

namespace fernlicht {

/// A map of 3 x 3 pixels of a centimetre each, the point in the middle one.
View map_around(const glm::dvec3& point_m, const Moment& moment);

class ProbeFold {
  public:
    ProbeFold(const Drive& drive, const Route& route) : drive_(drive), route_(route), found_(drive.probes.size()) {}

    void add(const Moment& moment, const Draw& draw);
    /// For each probe NAME: probe_NAME_lx (drawn) and probe_NAME_twin_lx, medians over the drive; probe_NAME_min_lx and _max_lx (drawn).
    /// Not drawn: probes above the surface, and all by a technique without illuminance. Probes beside the pavement have no twin.
    Readings finish() const;

  private:
    struct Series {
        std::vector<double> drawn, twin;
        bool beside_road = false; ///< beyond the pavement at some moment: what is drawn there is the verge, which the twin does not know
        bool not_drawn = false;   ///< the technique computes no illuminance
        bool near_field = false;  ///< nearer to a lamp than its photometric distance at some moment
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Series> found_;
};

} // namespace fernlicht
