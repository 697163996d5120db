#include "runner/play/fit_tone_mapper.h"

#include "metrics/display/tone_fit.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int looked_at = 12, widest_px = 320;
constexpr double middle_grey = 0.18;
constexpr double least_range = 1.0e-3; // of a display whose black is dark: three decades, what an eye tells apart at a time

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
        for (const Variant& variant : stage.drive.variants)
            for (const Moment& moment : moments_at(spread_ticks(tick_count(stage.drive)), stage, variant))
                (sources ? seen.all : seen.surfaces).add(renderer.draw(moment, view, {.luminance = true}).luminance_cdm2);
    }
    return seen;
}

} // namespace

void fit_tone_mapper(Stage& stage, Device& device, const RendererSettings& settings) {
    ToneMapper& mapper = stage.drive.tone_mapper;
    if (!mapper.is_open())
        return;
    const View* const driver = driver_view(stage.drive);
    if (driver == nullptr)
        throw InputError({stage.drive.file, 0, 0, "tone_mapper"}, "a tone mapper that is fitted, of a drive without a driver's view",
                         "a view that is no map, or numbers for s and l_max_cdm2");
    const SeenLuminances luminances = seen(stage, device, settings, small_view(*driver));
    const double brightest = mapper.white == WhitePoint::surfaces ? luminances.surfaces.most_cdm2() : luminances.all.most_cdm2();
    if (mapper.white != WhitePoint::given && brightest > 0.0)
        mapper.l_max_cdm2 = std::clamp(brightest, 1.0e-6, 1.0e9);
    if (mapper.fitted_s)
        mapper.s = std::min(fitted_s(luminances.all.log_mean_cdm2(), mapper.l_max_cdm2, middle_grey), 1.0e6);
    if (mapper.kind == ToneMapperKind::histogram) {
        const DisplayProfile display = stage.drive.display.profile.value_or(srgb_display());
        mapper = histogram_mapper(luminances.all, mapper.l_max_cdm2, std::max(display.black_cdm2 / display.peak_cdm2(), least_range));
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
                          luminances.all.most_cdm2(), log_mean_cdm2, result));
}

void refuse_open_tone_mapper(const Drive& drive) {
    if (drive.tone_mapper.is_open())
        throw InputError({drive.file, 0, 0, "tone_mapper"},
                         "a tone mapper that is fitted to the drive's pictures, which `fernlicht run` does",
                         "numbers for s and l_max_cdm2, as the resolved drive of a run has them");
}

} // namespace fernlicht
