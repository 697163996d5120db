// Road extent of each moment, twice over: from a rendered lux map and from the double-precision twin.
#pragma once

#include "runner/play/play.h"

namespace fernlicht {

/// What the extents of one moment are measured in.
struct ExtentDrawing {
    Moment moment;
    ExtentGrid grid;
    View view;
    Frame frame; ///< its lux images are empty where the technique computes none
};

class ExtentFold {
  public:
    /// The drive must ask for an extent. Drive and route must outlive the fold.
    ExtentFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {}

    /// By the thread that draws.
    ExtentDrawing draw(const Moment& moment, const Draw& draw) const;
    /// By any thread. No rendered extents of a plane whose lux image is empty.
    ExtentRow measure(const ExtentDrawing& drawing) const;
    /// Only what is measured in the frame's pictures.
    std::vector<LaneExtent> rendered(const ExtentDrawing& drawing) const;

  private:
    const Drive& drive_;
    const Route& route_;
};

/// The smallest map view of this moment that covers the grid, at most 0.25 m a pixel where 1024 pixels a side allow.
View map_over(const ExtentGrid& grid, const Moment& moment);

} // namespace fernlicht
