// Illuminance at named points ahead of the car, from the drawn lux image and from the twin.
#pragma once

#include "runner/play.h"

namespace fernlicht {

class ProbeFold {
  public:
    ProbeFold(const Drive& drive, const Route& route) : drive_(drive), route_(route), found_(drive.probes.size()) {}

    void add(const Moment& moment, const Draw& draw);
    /// For each probe NAME: probe_NAME_lx (drawn) and probe_NAME_twin_lx, medians over the drive; probe_NAME_min_lx and _max_lx (drawn).
    /// Probes above the surface are drawn as the target that faces each lamp.
    Readings finish() const;

  private:
    struct Series {
        std::vector<double> drawn, twin;
        bool near_field = false; ///< nearer to a lamp than its photometric distance at some moment
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Series> found_;
};

} // namespace fernlicht
