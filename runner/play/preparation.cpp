#include "runner/play/preparation.h"

#include "metrics/display/display_colour.h"
#include "renderer/gpu_timer.h"
#include "runner/files/log.h"
#include "runner/play/display_step.h"
#include "runner/play/lux_map.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fmt/format.h>
#include <set>
#include <tuple>

namespace fernlicht {
namespace {

constexpr int looked_at = 12, widest_px = 320;
constexpr double middle_grey = 0.18;
constexpr double min_range = 1.0e-3; // of a display whose black is dark: three decades, what an eye tells apart at a time

View small_view(const View& driver) {
    View view = driver;
    view.width_px = std::min(driver.width_px, widest_px);
    view.height_px = std::max(1, driver.height_px * view.width_px / driver.width_px);
    return view;
}

std::vector<int> spread_ticks(int count) {
    std::vector<int> ticks;
    for (int i = 0; i < std::min(count, looked_at); ++i)
        ticks.push_back(static_cast<int>(static_cast<long long>(i) * (count - 1) / std::max(std::min(count, looked_at) - 1, 1)));
    return ticks;
}

/// Once as it is and once without what shines by itself, where white asks for that.
struct SeenLuminances {
    LuminanceHistogram all, surfaces;
};

SeenLuminances seen(const Stage& stage, Device& device, const RendererSettings& settings, const View& view) {
    SeenLuminances seen;
    for (const bool sources : {true, false}) {
        if (!sources && stage.drive.tone_mapper.white != WhitePoint::surfaces)
            continue;
        RendererSettings own = settings;
        own.sources = sources;
        Renderer renderer(device, stage.scene, own);
        if (!renderer.available({.luminance = true}).luminance)
            throw InputError(
                {stage.drive.file, 0, 0, "tone_mapper"},
                fmt::format("a tone mapper that is fitted, of technique {}, which computes no luminance", stage.drive.technique),
                "numbers for s and l_max_cdm2, or technique photometric");
        for (const LampSet& lamp_set : stage.drive.lamp_sets)
            for (const Moment& moment : moments_at(spread_ticks(tick_count(stage.drive)), stage, lamp_set))
                (sources ? seen.all : seen.surfaces).add(renderer.draw(moment, view, {.luminance = true}).luminance_cdm2);
    }
    return seen;
}

} // namespace

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
    settings.white = light_adaptation(drive.display.white);
    settings.beams = drive.beams;
    settings.shadows = drive.shadows;
    if (drive.extent)
        settings.target_height_m = drive.extent->target_height_m;
    return settings;
}

std::vector<std::pair<View, FrameOutputs>> pictures_of(const Drive& drive) {
    std::vector<std::pair<View, FrameOutputs>> pictures;
    const DisplayStep display(drive);
    for (const View& view : drive.views)
        pictures.emplace_back(view, display.with_light(stored_results(view, drive.capture), view, true, false));
    if (!drive.views.empty())
        pictures.emplace_back(drive.views.front(), display.with_light({.colour = true}, drive.views.front(), false, true));
    const View map = map_of("map", 0.0, 1.0, 1.0, 4, 4); // variants do not depend on the size
    if (drive.extent)
        pictures.emplace_back(map, FrameOutputs{.illuminance = true, .target = true});
    if (!drive.probes.empty())
        pictures.emplace_back(map, FrameOutputs{.illuminance = true});
    return pictures;
}

namespace {

void each_moment(const Drive& drive, const Route& route, const LampSet& lamp_set, TickRange ticks,
                 const std::function<void(Moment)>& take) {
    State state = start(drive);
    for (int tick = 0; tick <= std::min(ticks.last, tick_count(drive) - 1); ++tick, state = advance(state, drive))
        if (tick >= ticks.first)
            take(moment_at(state, drive, route, lamp_set));
}

/// Lamps of others, sun, moon, fog or water: shaders that look at all this come in many variants.
bool has_many_variants(const Moment& moment) {
    return !moment.other_lamps.empty() || moment.daylight.direct() || moment.weather.extinction_per_m > 0.0 || moment.weather.wetness > 0.0;
}

} // namespace

std::vector<std::pair<const View*, FrameOutputs>> pictures_at(const Drive& drive, const DisplayStep& display, int tick, bool timed) {
    std::vector<std::pair<const View*, FrameOutputs>> pictures;
    const bool captured = is_captured(drive.capture, tick, drive.step_s);
    if (!captured && !timed && !display.adapts())
        return pictures;
    for (const View& view : drive.views) {
        const FrameOutputs outputs = captured ? stored_results(view, drive.capture) : FrameOutputs{.colour = true};
        pictures.emplace_back(&view, display.with_light(outputs, view, captured, pictures.empty()));
        if (!captured)
            break;
    }
    return pictures;
}

std::vector<Moment> distinct_moments(const Drive& drive, const Route& route, const LampSet& lamp_set, TickRange ticks) {
    // Light and weather, lamps of others, and the own lamps with whether they shine.
    std::set<std::tuple<int, bool, std::vector<std::pair<const LampFile*, bool>>>> seen;
    std::vector<Moment> moments;
    each_moment(drive, route, lamp_set, ticks, [&](Moment moment) {
        std::vector<std::pair<const LampFile*, bool>> lamps;
        for (const LitLamp& lamp : moment.lamps)
            lamps.emplace_back(lamp.file->state_of ? lamp.file->state_of.get() : lamp.file.get(), lamp.intensity_factor > 0.0);
        const int around = (moment.daylight.horizontal_illuminance_lx > 0.0 ? 1 : 0) + (moment.daylight.direct() ? 2 : 0) +
                           (moment.weather.extinction_per_m > 0.0 ? 4 : 0) + (moment.weather.wetness > 0.0 ? 8 : 0);
        // Planar shadows refuse moments on ground that is not one plane, before the first frame.
        if (drive.shadows.method == ShadowMethod::planar || seen.emplace(around, !moment.other_lamps.empty(), std::move(lamps)).second)
            moments.push_back(std::move(moment));
    });
    for (std::size_t i = 0, count = moments.size(); i < count; ++i) // reach is measured without lamps of others
        if (!moments[i].other_lamps.empty()) {
            moments.push_back(moments[i]);
            moments.back().other_lamps.clear();
        }
    return moments;
}

void prepare(Renderer& renderer, const Drive& drive, const Route& route, const LampSet& lamp_set, TickRange ticks, Foreseen foreseen) {
    const TraceSpan span("prepare", "play");
    const int before = renderer.compiled_programs();
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Moment> moments = distinct_moments(drive, route, lamp_set, ticks);
    renderer.keep_programs_of(moments);
    std::vector<std::pair<View, FrameOutputs>> pictures = pictures_of(drive);
    if (foreseen != Foreseen::nothing && std::ranges::any_of(moments, has_many_variants)) {
        pictures.erase(pictures.begin(), pictures.begin() + static_cast<std::ptrdiff_t>(drive.views.empty() ? 0 : drive.views.size() + 1));
        const DisplayStep display(drive);
        each_moment(drive, route, lamp_set, ticks, [&](Moment moment) {
            for (LitLamp& lamp : moment.lamps)
                if (lamp.file->state_of)
                    lamp.file = lamp.file->state_of; // whatever its levels
            for (const auto& [view, outputs] : pictures_at(drive, display, moment.tick, foreseen == Foreseen::timed_pictures))
                renderer.prepare({moment}, *view, outputs, true);
        });
    }
    for (const auto& [view, outputs] : pictures)
        renderer.prepare(moments, view, outputs);
    const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const int compiled = renderer.compiled_programs() - before;
    tell(LogLevel::debug, fmt::format("{}, {}: {} shader variants compiled in {:.1f} s", drive.name, lamp_set.name, compiled, took_s),
         {{"drive", drive.name}, {"lamp_set", lamp_set.name}, {"compiled", std::int64_t{compiled}}, {"seconds", took_s}});
}

void fit_tone_mapper(Stage& stage, Device& device, const RendererSettings& settings) {
    ToneMapper& mapper = stage.drive.tone_mapper;
    if (!mapper.is_open())
        return;
    const View* const driver = driver_view(stage.drive);
    if (driver == nullptr)
        throw InputError({stage.drive.file, 0, 0, "tone_mapper"}, "a tone mapper that is fitted, of a drive without a driver's view",
                         "a view that is no map, or numbers for s and l_max_cdm2");
    const SeenLuminances luminances = seen(stage, device, settings, small_view(*driver));
    const double brightest = mapper.white == WhitePoint::surfaces ? luminances.surfaces.max_cdm2() : luminances.all.max_cdm2();
    if (mapper.white != WhitePoint::given && brightest > 0.0)
        mapper.l_max_cdm2 = std::clamp(brightest, 1.0e-6, 1.0e9);
    if (mapper.fitted_s)
        mapper.s = std::min(fitted_s(luminances.all.log_mean_cdm2(), mapper.l_max_cdm2, middle_grey), 1.0e6);
    if (mapper.kind == ToneMapperKind::histogram) {
        const DisplayProfile display = stage.drive.display.profile.value_or(srgb_display());
        mapper = histogram_mapper(luminances.all, mapper.l_max_cdm2, std::max(display.black_cdm2 / display.peak_cdm2(), min_range));
    }
    mapper.white = WhitePoint::given;
    mapper.fitted_s = false;
    const std::size_t count = spread_ticks(tick_count(stage.drive)).size();
    const std::string moments = count == 1 ? "1 moment" : fmt::format("{} moments", count);
    const std::string result = fmt::format("{}, white {:.4g} cd/m2{}", name(mapper.kind), mapper.l_max_cdm2,
                                           mapper.kind == ToneMapperKind::rational ? fmt::format(", s {:.4g}", mapper.s) : "");
    const double log_mean_cdm2 = luminances.all.log_mean_cdm2();
    stage.drive.notes.push_back(
        log_mean_cdm2 == 0.0
            ? fmt::format("tone mapper: nothing to fit to, as {} of each lamp set had no light (above 1e-6 cd/m2): {}", moments, result)
            : fmt::format("tone mapper fitted to {} of each lamp set (0 to {:.3g} cd/m2, log-mean {:.3g}): {}", moments,
                          luminances.all.max_cdm2(), log_mean_cdm2, result));
}

void refuse_unfitted_tone_mapper(const Drive& drive) {
    if (drive.tone_mapper.is_open())
        throw InputError({drive.file, 0, 0, "tone_mapper"},
                         "a tone mapper that is fitted to the drive's pictures, which `fernlicht run` does",
                         "numbers for s and l_max_cdm2, as the resolved drive of a run has them");
}

} // namespace fernlicht
