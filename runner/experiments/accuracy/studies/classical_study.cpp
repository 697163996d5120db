#include "runner/experiments/accuracy/studies/studies.h"

#include "metrics/images/pixel_errors.h"
#include "runner/experiments/reference/reference_result.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double never_met = 1e-9; // a target that no pixel meets: each gets all samples

/// A way to draw, and what is varied in it.
struct Way {
    ReferenceSettings settings;
    std::string varied, value;
};

ReferenceSettings drawn_by(const ClassicalStudy& study, Integrator integrator, int samples) {
    ReferenceSettings settings;
    settings.integrator = integrator;
    settings.target_error = never_met;
    settings.min_samples = settings.max_samples = samples;
    settings.solver = study.solver;
    settings.seed = study.seed;
    return settings;
}

std::vector<Way> ways_of(const ClassicalStudy& study) {
    std::vector<Way> ways;
    for (const Integrator integrator : {Integrator::direct, Integrator::whitted, Integrator::path})
        for (const int samples : study.samples)
            ways.push_back({drawn_by(study, integrator, samples), "samples", fmt::format("{}", samples)});
    for (const bool gather : {false, true}) {
        for (const double patch_m : study.patches_m) {
            ways.push_back({drawn_by(study, Integrator::radiosity, study.gather_samples), "patch_m", fmt::format("{}", patch_m)});
            ways.back().settings.solver.patch_m = patch_m;
            ways.back().settings.solver.final_gather = gather;
        }
        for (const std::int64_t photons : study.photons) {
            ways.push_back({drawn_by(study, Integrator::photon_map, study.gather_samples), "photons", fmt::format("{}", photons)});
            SolverSettings& solver = ways.back().settings.solver;
            const double share = static_cast<double>(*std::ranges::max_element(study.photons)) / static_cast<double>(photons);
            solver.photons = photons;
            solver.radius_m *= std::pow(share, 1.0 / 6.0); // bias as r^2 and noise as 1 / (r sqrt(photons)) fall together
            solver.final_gather = gather;
        }
    }
    return ways;
}

PixelErrors errors_of(const ReferenceImage& tested, const ReferenceImage& truth) {
    PixelErrorFold fold;
    const Image<float>&mean = truth.illuminance_lx.mean, &error = truth.illuminance_lx.standard_error;
    for (int y = 0; y < mean.height(); ++y)
        for (int x = 0; x < mean.width(); ++x)
            if (truth.ids.at(x, y) != 0)
                fold.add({.tested = tested.illuminance_lx.mean.at(x, y),
                          .reference = mean.at(x, y),
                          .standard_error = error.at(x, y),
                          .area_m2 = {},
                          .x = x,
                          .y = y});
    return fold.finish().value_or(PixelErrors{});
}

/// Named, with nothing measured yet.
WorkPrecisionRow row_of(const Way& way) {
    const SolverSettings& solver = way.settings.solver;
    const bool solved = way.settings.integrator == Integrator::radiosity || way.settings.integrator == Integrator::photon_map;
    const std::string name = integrator_name(way.settings.integrator) + (solved && solver.final_gather ? " with final gathering" : "");
    WorkPrecisionRow row;
    row.label = fmt::format("{}, {} {}", name, way.value, way.varied == "patch_m" ? "m patches" : way.varied);
    row.parameters = {{"integrator", name}, {way.varied, way.value}};
    if (way.settings.integrator == Integrator::photon_map)
        row.parameters.emplace_back("radius_m", fmt::format("{:.3g}", solver.radius_m));
    return row;
}

WorkPrecisionRow row_of(const Way& way, const ReferenceImage& image, const ReferenceImage& truth) {
    const PixelErrors errors = errors_of(image, truth);
    WorkPrecisionRow row = row_of(way);
    row.parameters.emplace_back("median_percent", fmt::format("{:.3g}", 100.0 * errors.error.median));
    row.parameters.emplace_back("mean_percent", fmt::format("{:.3g}", 100.0 * errors.mean));
    row.parameters.emplace_back("rays", fmt::format("{}", image.rays));
    row.floor = 100.0 * errors.floor.p95;
    if (errors.pixels == 0) {
        row.why_not = "no pixel has 0.05 lx";
        return row;
    }
    row.error = exactly(100.0 * errors.error.p95);
    row.seconds = Interval{image.seconds, image.seconds, image.seconds, 1};
    return row;
}

} // namespace

WorkPrecision classical_study(const Scene& scene, const Moment& moment, const View& view, const ClassicalStudy& study,
                              const std::function<bool()>& go_on) {
    WorkPrecision diagram{
        "classical",
        "Global methods, error against path tracing",
        "error of a pixel's illuminance, 95 % of the pixels",
        "%",
        "time of a picture",
        "noise of the paths",
        {fmt::format("{} x {} pixels, those with at least 0.05 lx, against paths of {} samples and another seed; one run each",
                     view.width_px, view.height_px, study.truth_samples),
         "direct light and Whitted's leave bounces out; radiosity and photon map are biased by patches and radius; without final "
         "gathering lamps' direct light is by feelers, the rest as solved"},
        {}};
    const Reference reference(scene);
    const auto draw = [&](const ReferenceSettings& settings) { return reference.render(moment, view, {.illuminance = true}, settings); };
    if (!go_on())
        return diagram;
    ReferenceSettings converged = drawn_by(study, Integrator::path, study.truth_samples);
    converged.seed = study.seed + 1000;
    const ReferenceImage truth = draw(converged);
    const bool has_weather = moment.weather.extinction_per_m > 0.0 || moment.weather.wetness > 0.0;
    for (const Way& way : ways_of(study)) {
        if (!go_on())
            return diagram;
        if (has_weather && !knows_weather(way.settings.integrator)) {
            diagram.rows.push_back(row_of(way));
            diagram.rows.back().why_not = "knows neither fog nor wet roads";
        } else {
            diagram.rows.push_back(row_of(way, draw(way.settings), truth));
        }
    }
    return diagram;
}

} // namespace fernlicht
