// Can this driver's own clock (GL_TIME_ELAPSED) be believed?
#pragma once

#include "renderer/device.h"

namespace fernlicht {

struct TimerCheck {
    double query_s = 0.0;  ///< what GL_TIME_ELAPSED says of a known load, median of several
    double finish_s = 0.0; ///< the same load from submit to glFinish
    /// Within a tenth of one another: anything else, and GPU times are not measured on this driver.
    bool agrees() const;
};

/// Draws a load of some ten milliseconds several times, timed both ways.
TimerCheck check_timer(Device& device);

} // namespace fernlicht
