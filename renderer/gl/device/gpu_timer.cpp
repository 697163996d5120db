#include "renderer/gpu_timer.h"

#include "renderer/gl/device/pass_clock.h"

#include <optional>

namespace fernlicht {

struct GpuTimer::State {
    explicit State(gl::Context& c) : context(c), clock(std::in_place, c, false, true) {}
    gl::Context& context;
    std::optional<gl::PassClock> clock;
};

GpuTimer::GpuTimer(Device& device) : state_(std::make_unique<State>(device.context())) {}
GpuTimer::~GpuTimer() = default;

void GpuTimer::begin() { state_->clock->begin("piece"); }
void GpuTimer::end() { state_->clock->end(); }

double GpuTimer::seconds() {
    double sum = 0.0;
    for (const auto& [name, seconds] : state_->clock->seconds())
        sum += seconds;
    state_->clock.emplace(state_->context, false, true);
    return sum;
}

} // namespace fernlicht
