#include "runner/play/preparation.h"

#include "renderer/gpu_timer.h"
#include "runner/play/display_step.h"
#include "runner/play/lux_map.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace fernlicht {

RendererSettings settings_for(Device& device, bool profile) {
    RendererSettings settings;
    settings.profile = profile;
    if (!device.info().software) {
        settings.read_back = check_read_back(device).faster();
        settings.gpu_clock = check_timer(device).agrees();
    }
    return settings;
}

RendererSettings settings_for(const Drive& drive, RendererSettings settings) {
    settings.technique = drive.technique;
    settings.tone_mapper = drive.tone_mapper;
    settings.beams = drive.beams;
    settings.shadows = drive.shadows;
    if (drive.extent)
        settings.target_height_m = drive.extent->target_height_m;
    return settings;
}

std::vector<std::pair<View, Wanted>> pictures_of(const Drive& drive) {
    std::vector<std::pair<View, Wanted>> pictures;
    const DisplayStep display(drive);
    for (const View& view : drive.views)
        pictures.emplace_back(view, display.with_light(stored_results(view, drive.capture), view, true, false));
    if (!drive.views.empty())
        pictures.emplace_back(drive.views.front(), display.with_light({.colour = true}, drive.views.front(), false, true));
    const View map = map_of("map", 0.0, 1.0, 1.0, 4, 4); // variants do not depend on the size
    if (drive.extent)
        pictures.emplace_back(map, Wanted{.illuminance = true, .target = true});
    if (!drive.probes.empty())
        pictures.emplace_back(map, Wanted{.illuminance = true});
    return pictures;
}

std::vector<Moment> distinct_moments(const Drive& drive, const Route& route, const Variant& variant, TickRange ticks) {
    // Light and weather, lamps of others, and the own lamps with whether they shine.
    std::set<std::tuple<int, bool, std::vector<std::pair<const LampFile*, bool>>>> seen;
    std::vector<Moment> moments;
    State state = start(drive);
    for (int tick = 0; tick <= std::min(ticks.last, tick_count(drive) - 1); ++tick, state = advance(state, drive)) {
        if (tick < ticks.first)
            continue;
        Moment moment = moment_at(state, drive, route, variant);
        std::vector<std::pair<const LampFile*, bool>> lamps;
        for (const LitLamp& lamp : moment.lamps)
            lamps.emplace_back(lamp.file.get(), lamp.intensity_factor > 0.0);
        const int around = (moment.daylight.horizontal_illuminance_lx > 0.0 ? 1 : 0) + (moment.daylight.direct() ? 2 : 0) +
                           (moment.weather.extinction_per_m > 0.0 ? 4 : 0) + (moment.weather.wetness > 0.0 ? 8 : 0);
        if (drive.shadows.method == ShadowMethod::planar) // it refuses moments on ground that is not one plane, before the first frame
            moments.push_back(std::move(moment));
        else if (seen.emplace(around, !moment.other_lamps.empty(), std::move(lamps)).second)
            moments.push_back(std::move(moment));
    }
    for (std::size_t i = 0, count = moments.size(); i < count; ++i) // reach is measured without lamps of others
        if (!moments[i].other_lamps.empty()) {
            moments.push_back(moments[i]);
            moments.back().other_lamps.clear();
        }
    return moments;
}

void prepare(Renderer& renderer, const Drive& drive, const Route& route, const Variant& variant, TickRange ticks) {
    const std::vector<Moment> moments = distinct_moments(drive, route, variant, ticks);
    for (const auto& [view, wanted] : pictures_of(drive))
        renderer.prepare(moments, view, wanted);
}

} // namespace fernlicht
