// The GPU's own clock round pieces of work. To be believed only where check_timer() agrees.
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

} // namespace fernlicht
