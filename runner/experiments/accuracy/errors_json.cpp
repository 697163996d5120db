#include "runner/experiments/accuracy/errors_json.h"

#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/findings/extent_keys.h"

#include <cstdio>
#include <fmt/format.h>

namespace fernlicht {
namespace {

JsonMembers quantile_members(ErrorQuantiles& q) { return {{"median", q.median}, {"p95", q.p95}, {"p99", q.p99}}; }

JsonMembers between_members(QuantileInterval& interval) { return {{"low", interval.low}, {"high", interval.high}}; }

JsonMembers beyond_members(std::array<double, 3>& percent) { return {{"1", percent[0]}, {"5", percent[1]}, {"20", percent[2]}}; }

} // namespace

Ticks ticks_of(const std::vector<std::pair<int, double>>& moments) {
    return [&moments] {
        std::vector<int> ticks;
        for (const auto& [tick, time_s] : moments)
            ticks.push_back(tick);
        return ticks;
    };
}

JsonPart shadow_method_part(ShadowMethod& method) {
    return one_of(method, names_of<ShadowMethod>([](ShadowMethod one) { return name(one); }, 10));
}

std::string beams_text(const std::optional<BeamTexels>& beams) {
    return beams ? fmt::format("{}x{}x{}", beams->width, beams->height, beams->bits) : "float";
}

JsonPart beams_part(std::optional<BeamTexels>& beams) {
    return through([&] { return beams_text(beams); },
                   [&](const std::string& text) {
                       BeamTexels t;
                       beams = std::sscanf(text.c_str(), "%dx%dx%d", &t.width, &t.height, &t.bits) == 3 ? std::optional(t) : std::nullopt;
                   });
}

JsonPart errors_part(std::optional<PixelErrors>& errors, const std::string& why_not, std::string* back, const Ticks& frames) {
    const auto worst = [frames](WorstPixel& w) -> JsonMembers {
        return {{"error", w.error}, {"tested", w.tested}, {"reference", w.reference}, {"frame", one_of(w.picture, frames)},
                {"x_px", w.x},      {"y_px", w.y}};
    };
    const auto members = [worst](PixelErrors& e) {
        const bool lit = e.pixels > 0, dark = e.dark_pixels > 0;
        const auto area = through([&e] { return e.area_m2.value_or(0.0); }, [&e](double m2) { e.area_m2 = m2; });
        return joined({{"pixels", e.pixels}, {"dark_pixels", e.dark_pixels}},
                      when(lit && e.p95_between, {{"relative_p95_between", e.p95_between, between_members}}),
                      when(lit, {{"relative", e.error, quantile_members},
                                 {"relative_floor", e.floor, quantile_members},
                                 {"mean", e.mean},
                                 {"worst", e.worst, worst}}),
                      when(lit && e.area_m2, {{"area_m2", area}, {"percent_of_area_beyond", e.percent_beyond, beyond_members}}),
                      when(lit && !e.area_m2, {{"percent_of_pixels_beyond", e.percent_beyond, beyond_members}}),
                      when(dark, {{"dark", e.dark_error, quantile_members},
                                  {"dark_floor", e.dark_floor, quantile_members},
                                  {"dark_worst", e.dark_worst, worst}}));
    };
    return or_why(json_part(errors, members), why_not.empty() ? "no pixel was compared" : why_not, back);
}

JsonMembers reach_members(ReachError& error) {
    return joined({{"surface", one_of(error.surface, names_of<Surface>(surface_name, 2))},
                   {"threshold_lx", error.threshold_lx},
                   {"moments", error.moments}},
                  when(error.why_not.empty(), {{"median_m", error.median_m}, {"worst_m", error.worst_m}}),
                  when(!error.why_not.empty(), {{"not_measured", error.why_not}}));
}

} // namespace fernlicht
