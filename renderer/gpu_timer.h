// The GPU's own clock round pieces of work. Reliable only where check_timer() agrees.
// Can this driver's own clock (GL_TIME_ELAPSED) be believed?
#pragma once

#include "renderer/device.h"

namespace fernlicht {

class GpuTimer {
  public:
    /// The device must outlive the timer.
    explicit GpuTimer(Device& device);
    ~GpuTimer();
    GpuTimer(const GpuTimer&) = delete;
    GpuTimer& operator=(const GpuTimer&) = delete;

    /// Pieces do not nest, and nothing else may time passes meanwhile.
    void begin();
    void end();
    /// Waits for the pieces since it was last asked; their sum.
    double seconds();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

struct TimerCheck {
    double query_s = 0.0;  ///< what GL_TIME_ELAPSED says of a known load, median of several
    double finish_s = 0.0; ///< the same load from submit to glFinish
    /// Within a tenth of one another: anything else, and GPU times are not measured on this driver.
    bool agrees() const;
};

/// Draws a load of some ten milliseconds several times, timed both ways.
TimerCheck check_timer(Device& device);

} // namespace fernlicht
