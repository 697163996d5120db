// How the own car moves when a bus says how fast it is, or where: known tick by tick.
#pragma once

#include "scenarios/traffic/traffic_row.h"

#include <optional>
#include <vector>

namespace fernlicht {

/// Speed is linear between the ticks of control, so that the way is its exact integral, as that of a drive's own speed is; or the bus says
/// the way too, which is linear between ticks then. A speed that stays the same makes no new point: a constant one is the same profile as
/// the drive's own.
class BusMotion {
  public:
    /// In order of time, the first at 0 s. `way_m`: always or never.
    void add(double time_s, double speed_mps, std::optional<double> way_m = std::nullopt);

    bool empty() const { return points_.empty(); }
    /// Constant behind the last point.
    double speed_mps(double time_s) const;
    double way_m(double time_s) const;
    std::vector<SpeedPoint> profile() const;

  private:
    struct Point {
        double time_s = 0.0, speed_mps = 0.0, way_m = 0.0;
    };
    std::size_t point_at(double time_s) const;

    std::vector<Point> points_;
    bool way_told_ = false;
};

} // namespace fernlicht
