
#include "renderer/renderer.h"
#include "renderer/traffic_levels.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "runner/play/shadows/shadow_truth.h"
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

constexpr int compared_moments = 5;
constexpr double fully_shadowed = 4.0; ///< light of a unit, in least lux, from which on its shadow is drawn in full (docs/traffic.md)

std::vector<Moment> traffic_shadow_moments(const Stage& stage, const LampSet& lamp_set) {
    std::vector<int> ticks;
    for (int i = 0; i < compared_moments; ++i)
        ticks.push_back((2 * i + 1) * tick_count(stage.drive) / (2 * compared_moments));
    return moments_at(ticks, stage, lamp_set);
}

} // namespace

WorkPrecision traffic_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on) {
    WorkPrecision diagram{
        "traffic",
        "Other vehicles' lamps, by the least lux that is rendered",
        "illuminance in the driver's view, worst pixel",
        "lx",
        "time of a frame",
        "",
        {fmt::format(
            "against each lamp with its own beam and nothing left out above {:g} lx; by bounds no pair of lamps is off by more than "
            "{:g} times the least lux. Shadows that road users cast in other vehicles' light are in neither",
            nothing_left_out_lx, worst_traffic_error)},
        {}};
    Moment moment = moments_at({tick_count(stage.drive) / 2}, stage, lamp_set).front();
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
    const double own_lx = moment.min_traffic_lx;
    moment.min_traffic_lx = nothing_left_out_lx;
    const Image<float> truth = fine.draw(moment, *view, {.illuminance = true}).illuminance_lx;
    const auto add = [&](Renderer& renderer, double min_lx, std::string label, std::string note) {
        moment.min_traffic_lx = min_lx;
        const std::vector<double> errors = traffic_differences(renderer.draw(moment, *view, {.illuminance = true}).illuminance_lx, truth);
        const Work work = renderer.count(moment, *view, {.colour = true});
        WorkPrecisionRow row;
        row.label = std::move(label);
        row.note =
            fmt::format("{}{}95 % of the pixels within {:.2g} lx; lights of lamps on places: {} by their own beam, {} by one beam for two, "
                        "{} by vertex, {} as points",
                        note, note.empty() ? "" : "; ", errors[errors.size() * 95 / 100], work.traffic_full, work.traffic_merged,
                        work.traffic_by_vertex, work.traffic_point);
        row.parameters = {{"min_lx", fmt::format("{:g}", min_lx)}, {"levels", &renderer == &coarse ? "yes" : "no"}};
        row.error = exactly(errors.back());
        row.seconds = timed([&] {
            renderer.render(moment, *view, {.colour = true});
            renderer.finish();
        });
        diagram.rows.push_back(std::move(row));
    };
    for (const double min_lx : {1.0, 0.3, 0.1, 0.05, 0.02, 0.005}) {
        if (!go_on())
            return diagram;
        add(coarse, min_lx, fmt::format("least {:g} lx", min_lx), min_lx == own_lx ? "the drive's own" : "");
    }
    if (go_on())
        add(fine, own_lx, fmt::format("each lamp with its own beam, least {:g} lx", own_lx), "");
    return diagram;
}

WorkPrecision traffic_shadow_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on) {
    WorkPrecision diagram{"traffic-shadows",
                          "Shadows in other vehicles' light",
                          "wrongly lit or dark of what other vehicles light in the driver's view",
                          "%",
                          "time of a frame",
                          "",
                          {},
                          {}};
    const View* const view = driver_view(stage.drive);
    const std::vector<Moment> all = traffic_shadow_moments(stage, lamp_set);
    if (view == nullptr || !stage.drive.shadows.any() ||
        std::ranges::all_of(all, [](const Moment& moment) { return moment.other_lamps.empty(); }))
        return diagram;
    RendererSettings settings;
    settings.tone_mapper = stage.drive.tone_mapper;
    settings.shadows = stage.drive.shadows;
    std::vector<Moment> others = all; // own lamps' shadows are another diagram
    for (Moment& moment : others)
        moment.lamps.clear();
    const Reference rays(stage.scene);
    Renderer unshadowed(device, stage.scene, without_shadows(settings));
    ShadowTruth truth(rays, unshadowed, others,
                      at_size(*view, shadow_error_width_px, std::max(1, view->height_px * shadow_error_width_px / view->width_px)));
    const int middle = tick_count(stage.drive) / 2;
    const std::vector<Moment> timed_moments = moments_at({std::max(0, middle - 1), middle}, stage, lamp_set); // in turn: all maps are drawn
    const double floor_lx = std::max(shadow_floor_lx, all.front().min_traffic_lx);
    ShadowArea area;
    std::string bright; // errors where shadows are drawn in full
    const auto add = [&](const RendererSettings& own, std::string label) {
        if (!go_on())
            return false;
        Renderer renderer(device, stage.scene, own);
        area = {};
        ShadowArea whole; // where shadows are drawn in full
        for (std::size_t m = 0; m < others.size(); ++m) {
            const ShadowImages images = truth.images(renderer, m);
            area += shadow_area(images, 1.0, floor_lx);
            whole += shadow_area(images, 1.0, fully_shadowed * floor_lx);
        }
        WorkPrecisionRow row;
        row.label = std::move(label);
        row.note = own.shadows == stage.drive.shadows && own.traffic_shadows ? "the drive's own" : "";
        bright += fmt::format("{}{} {:.2g} %", bright.empty() ? "" : ", ", row.label, 100.0 * whole.wrong_share());
        const bool drawn = own.traffic_shadows;
        row.parameters = {{"traffic_shadows", drawn ? "yes" : "no"},
                          {"map_texels", drawn ? fmt::format("{}x{}", own.shadows.width / 2, own.shadows.height / 2) : "none"}};
        row.error = exactly(100.0 * area.wrong_share());
        renderer.prepare(timed_moments, *view, {.colour = true});
        std::size_t next = 0;
        row.seconds = timed([&] {
            renderer.render(timed_moments[next++ % timed_moments.size()], *view, {.colour = true});
            renderer.finish();
        });
        row.bytes = renderer.count(timed_moments.back(), *view, {.colour = true}).texture_bytes;
        diagram.rows.push_back(std::move(row));
        return true;
    };
    RendererSettings none = settings;
    none.traffic_shadows = false;
    bool going = add(none, "none");
    for (const int factor : {1, 2, 4}) {
        RendererSettings finer = settings;
        finer.shadows.width = std::min(8192, factor * settings.shadows.width / 2);
        finer.shadows.height = std::min(8192, factor * settings.shadows.height / 2);
        going = going && add(finer, fmt::format("maps of {} x {}", finer.shadows.width / 2, finer.shadows.height / 2));
    }
    diagram.notes = {
        fmt::format("against a ray from each pixel's centre to each of other vehicles' lamps, in {} moments evenly spread over the drive, "
                    "{} pixels wide; own lamps are off. A pixel that is half as dark as it should be counts half. Of {:.0f} "
                    "pixels with at least {:g} lx {:.0f} lie in shadow",
                    others.size(), shadow_error_width_px, area.counted, floor_lx, area.shadowed),
        fmt::format("where other vehicles bring {:g} lx and more: {}", fully_shadowed * floor_lx, bright),
        "times: the middle moment and the one before it in turn, own lamps on, whose maps have four times as many texels and grow as these "
        "do"};
    return diagram;
}

} // namespace fernlicht
