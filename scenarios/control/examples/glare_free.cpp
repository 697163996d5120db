// Example of a control law in C++: glare-free high beam. Windows of a lamp in segments fade out where others with lamps on are, and back
// in.
#include "scenarios/control/fernlicht_control.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace {

constexpr double margin_deg = 0.7, reach_m = 400.0, fade_out_s = 0.1, fade_in_s = 0.6;
constexpr double degrees_per_rad = 57.29577951308232;

struct GlareFree {
    std::map<size_t, std::vector<double>> levels; // by lamp
};

bool meets(const fernlicht_other& other, const fernlicht_lamp& lamp, size_t segment) {
    const double x_m = other.x_m - lamp.x_m, y_m = other.y_m - lamp.y_m;
    if (!other.lamps_on || x_m <= 0.0 || std::hypot(x_m, y_m) > reach_m)
        return false;
    const double beam_rad = lamp.aim_rad + lamp.swivel_rad;
    const double from_deg = degrees_per_rad * (beam_rad - std::atan2(y_m + 0.5 * other.width_m, x_m)) - margin_deg;
    const double to_deg = degrees_per_rad * (beam_rad - std::atan2(y_m - 0.5 * other.width_m, x_m)) + margin_deg;
    return from_deg < lamp.segment_to_deg[segment] && to_deg > lamp.segment_from_deg[segment];
}

int step(void* state, const fernlicht_control_input* in, fernlicht_control_output* out) {
    auto& levels = static_cast<GlareFree*>(state)->levels;
    for (size_t i = 0; i < in->lamp_count; ++i) {
        const fernlicht_lamp& lamp = in->lamps[i];
        if (!lamp.may_move || lamp.segment_count == 0)
            continue;
        std::vector<double>& now = levels.try_emplace(i, lamp.segment_count, 1.0).first->second;
        for (size_t segment = 0; segment < lamp.segment_count; ++segment) {
            const bool dark = std::any_of(in->others, in->others + in->other_count,
                                          [&](const fernlicht_other& other) { return meets(other, lamp, segment); });
            now[segment] = in->dt_s == 0.0 ? (dark ? 0.0 : 1.0)
                           : dark          ? std::max(now[segment] - in->dt_s / fade_out_s, 0.0)
                                           : std::min(now[segment] + in->dt_s / fade_in_s, 1.0);
            out->lamps[i].segments[segment] = now[segment];
        }
    }
    return 0;
}

} // namespace

extern "C" const fernlicht_control_plugin_info* fernlicht_control_plugin() {
    static const fernlicht_control_plugin_info info{FERNLICHT_CONTROL_VERSION,
                                                    sizeof(fernlicht_control_plugin_info),
                                                    "glare-free high beam (example)",
                                                    [](const char*) -> void* { return new GlareFree; },
                                                    step,
                                                    [](void* state) { delete static_cast<GlareFree*>(state); }};
    return &info;
}
