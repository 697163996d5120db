#include "renderer/renderer.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace fernlicht {
namespace {

constexpr int frames = 9;

/// Median time of a frame of four results over an empty night scene, two always on their way when overlapped.
double frame_time(Device& device, ReadBack way) {
    const Scene scene;
    RendererSettings settings;
    settings.read_back = way;
    Renderer renderer(device, scene, settings);
    const View view;
    const Wanted wanted{.colour = true, .illuminance = true, .luminance = true, .depth = true};
    std::vector<double> seconds;
    Pending earlier = renderer.submit({}, view, wanted);
    for (int i = 0; i < frames; ++i) {
        const auto start = std::chrono::steady_clock::now();
        Pending next = renderer.submit({}, view, wanted);
        earlier();
        earlier = std::move(next);
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    earlier();
    std::ranges::sort(seconds);
    return seconds[frames / 2];
}

} // namespace

ReadBackCheck check_read_back(Device& device) { return {frame_time(device, ReadBack::plain), frame_time(device, ReadBack::overlapped)}; }

} // namespace fernlicht
