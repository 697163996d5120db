#include "metrics/images/pixel_errors.h"
#include "metrics/statistics/statistics.h"
#include "renderer/reference/reference.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "runner/experiments/bench/bench_run.h"
#include "scenarios/drives/play/advance.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int small_width_px = 64, small_height_px = 48;
constexpr double never = 1e-9; // a target that no pixel meets: each gets all samples

/// Root mean square of the errors in shares, where the truth has at least 0.05 lx, with the noise of the truth itself.
struct Deviation {
    double error = 0.0, floor = 0.0;
};
Deviation deviation(const ReferenceImage& tested, const ReferenceImage& truth, double min_lx) {
    double squares = 0.0, noise = 0.0, count = 0.0;
    for (std::size_t i = 0; i < truth.illuminance_lx.mean.size(); ++i) {
        const auto right = static_cast<double>(truth.illuminance_lx.mean.pixels()[i]);
        if (right < min_lx)
            continue;
        const double error = (static_cast<double>(tested.illuminance_lx.mean.pixels()[i]) - right) / right,
                     own = static_cast<double>(truth.illuminance_lx.standard_error.pixels()[i]) / right;
        squares += error * error;
        noise += own * own;
        count += 1.0;
    }
    return count > 0.0 ? Deviation{std::sqrt(squares / count), std::sqrt(noise / count)} : Deviation{};
}

} // namespace

std::vector<WorkPrecision> reference_study(const Stage& stage, const LampSet& lamp_set, std::uint64_t seed, const StudyGoesOn& go_on) {
    const int ticks = tick_count(stage.drive);
    const Moment moment = moments_at({ticks / 2}, stage, lamp_set).front();
    const View view = at_size(*driver_view(stage.drive), small_width_px, small_height_px);
    const Reference reference(stage.scene);
    const auto draw = [&](Integrator integrator, int samples, std::uint64_t from_seed) {
        ReferenceSettings settings;
        settings.integrator = integrator;
        settings.target_error = never;
        settings.min_samples = settings.max_samples = samples;
        settings.shadows = stage.drive.shadows.objects_cast;
        settings.seed = from_seed;
        return reference.render(moment, view, {.illuminance = true}, settings);
    };
    std::vector<WorkPrecision> diagrams;
    for (const auto& [integrator, name, most] :
         {std::tuple(Integrator::direct, "direct", 1024), std::tuple(Integrator::path, "path", 256)}) {
        if (!go_on())
            return diagrams;
        WorkPrecision diagram{
            fmt::format("reference-{}", name),
            fmt::format("The reference, {}", name),
            "error of a pixel's illuminance, root mean square",
            "%",
            "time of a picture",
            "noise of the finest",
            {fmt::format(
                "{} x {} pixels of the driver's view with at least 0.05 lx; against {} samples of another seed; bars over four seeds",
                small_width_px, small_height_px, 4 * most)},
            {}};
        const ReferenceImage truth = draw(integrator, 4 * most, seed + 1000);
        std::vector<std::pair<double, double>> by_samples;
        for (int samples = 16; samples <= most && go_on(); samples *= 4) {
            WorkPrecisionRow row;
            row.label = fmt::format("{} samples", samples);
            row.parameters = {{"integrator", name}, {"samples", fmt::format("{}", samples)}};
            std::vector<double> errors, seconds;
            for (std::uint64_t k = 0; k < 4; ++k) {
                const ReferenceImage image = draw(integrator, samples, seed + k);
                const Deviation found = deviation(image, truth, ReferenceSettings{}.floor_lx);
                errors.push_back(100.0 * found.error);
                row.floor = 100.0 * found.floor;
                seconds.push_back(image.seconds);
            }
            row.error = time_of(errors);
            row.seconds = time_of(seconds);
            by_samples.emplace_back(samples, row.error->value);
            diagram.rows.push_back(std::move(row));
        }
        if (const auto slope = logarithmic_slope(by_samples))
            diagram.notes.push_back(fmt::format("The error goes as the samples to the power of {:.2f}", *slope));
        diagrams.push_back(std::move(diagram));
    }
    return diagrams;
}

} // namespace fernlicht
