#include "runner/experiments/accuracy/studies/traffic_study.h"

#include "renderer/renderer.h"
#include "renderer/traffic_levels.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double nothing_left_out_lx = 1e-6;

/// Differences of two pictures, ascending.
std::vector<double> traffic_differences(const Image<float>& tested, const Image<float>& truth) {
    std::vector<double> all(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
        all[i] = std::abs(static_cast<double>(tested.pixels()[i]) - static_cast<double>(truth.pixels()[i]));
    std::ranges::sort(all);
    return all;
}

} // namespace

WorkPrecision traffic_study(const Stage& stage, const Variant& variant, Device& device, const StudyGoesOn& go_on) {
    WorkPrecision diagram{
        "traffic-" + stage.drive.name,
        fmt::format("Lamps of others, by the least lux that is drawn: {}, {}", stage.drive.name, variant.name),
        "illuminance in the driver's view, worst pixel",
        "lx",
        "time of a frame",
        "",
        {fmt::format(
            "against each lamp with its own beam and nothing left out above {:g} lx; by bounds no pair of lamps is off by more than "
            "{:g} times the least lux. Shadows that road users cast in the light of others are in neither",
            nothing_left_out_lx, worst_traffic_error)},
        {}};
    Moment moment = moments_at({tick_count(stage.drive) / 2}, stage, variant).front();
    const View* const view = driver_view(stage.drive);
    if (moment.other_lamps.empty() || view == nullptr)
        return diagram;
    RendererSettings settings;
    settings.technique = "photometric";
    settings.shadows = stage.drive.shadows;
    settings.tone_mapper = stage.drive.tone_mapper;
    settings.traffic_shadows = false; // edges move by texels, whatever the levels do
    RendererSettings one_by_one = settings;
    one_by_one.traffic_levels = false;
    Renderer coarse(device, stage.scene, settings), fine(device, stage.scene, one_by_one);
    const double own_lx = moment.least_traffic_lx;
    moment.least_traffic_lx = nothing_left_out_lx;
    const Image<float> truth = fine.draw(moment, *view, {.illuminance = true}).illuminance_lx;
    const auto add = [&](Renderer& renderer, double least_lx, std::string label, std::string note) {
        moment.least_traffic_lx = least_lx;
        const std::vector<double> errors = traffic_differences(renderer.draw(moment, *view, {.illuminance = true}).illuminance_lx, truth);
        const Work work = renderer.count(moment, *view, {.colour = true});
        WorkPrecisionRow row;
        row.label = std::move(label);
        row.note =
            fmt::format("{}{}95 % of the pixels within {:.2g} lx; lights of lamps on places: {} by their own beam, {} by one beam for two, "
                        "{} by vertex, {} as points",
                        note, note.empty() ? "" : "; ", errors[errors.size() * 95 / 100], work.traffic_full, work.traffic_merged,
                        work.traffic_by_vertex, work.traffic_point);
        row.parameters = {{"least_lx", fmt::format("{:g}", least_lx)}, {"levels", &renderer == &coarse ? "yes" : "no"}};
        row.error = Interval{errors.back(), errors.back(), errors.back()};
        row.seconds = timed([&] {
            renderer.render(moment, *view, {.colour = true});
            renderer.finish();
        });
        diagram.rows.push_back(std::move(row));
    };
    for (const double least_lx : {1.0, 0.3, 0.1, 0.05, 0.02, 0.005}) {
        if (!go_on())
            return diagram;
        add(coarse, least_lx, fmt::format("least {:g} lx", least_lx), least_lx == own_lx ? "the drive's own" : "");
    }
    if (go_on())
        add(fine, own_lx, fmt::format("each lamp with its own beam, least {:g} lx", own_lx), "");
    return diagram;
}

} // namespace fernlicht
