// Illuminance at fixed places beside the road while the car drives up to them, from the lamps' tables in double. Facing the lamps: sum of
// I / d^2. A crest of the road between lamp and sensor hides the lamp; nothing else does.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/readings/readings.h"
#include "metrics/road/approach.h"
#include "scenarios/drives/play/moment.h"

namespace fernlicht {

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
        bool near_field = false;
        bool passed = false; ///< some moment is beyond it
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Followed> followed_;
};

} // namespace fernlicht
