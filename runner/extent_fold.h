// Road extent of each moment, twice over: from a rendered lux map and from the double-precision twin.
#pragma once

#include "runner/play.h"

namespace fernlicht {

class ExtentFold {
  public:
    /// The drive must ask for an extent. Drive and route must outlive the fold.
    ExtentFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {}

    ExtentRow add(const Moment& moment, const Draw& draw);

  private:
    const Drive& drive_;
    const Route& route_;
};

/// The smallest map view of this moment that covers the grid, at most 0.25 m a pixel where 1024 pixels a side allow.
View map_over(const ExtentGrid& grid, const Moment& moment);

} // namespace fernlicht
