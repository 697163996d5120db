#include "metrics/statistics/statistics.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/shadows/shadow_result.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

WorkPrecision empty_diagram(const std::string& name, const std::string& title) {
    WorkPrecision diagram;
    diagram.name = name;
    diagram.title = title;
    diagram.error_name = "ground wrongly lit or wrongly dark, of what is lit without shadows";
    diagram.error_unit = "%";
    diagram.time_name = "time a frame";
    return diagram;
}

/// The least number of timings that a row has.
std::string times_words(const std::vector<WorkPrecisionRow>& rows) {
    std::optional<Interval> fewest;
    for (const WorkPrecisionRow& row : rows)
        if (row.seconds && (!fewest || row.seconds->samples < fewest->samples))
            fewest = row.seconds;
    return fewest ? "horizontally, times are " + timings_text(*fewest) : "times were not taken";
}

WorkPrecisionRow diagram_row(const ShadowRow& found, const ShadowSceneResult& scene) {
    WorkPrecisionRow row;
    row.label = name(found.method);
    row.parameters = {{"shadows", row.label}, {"scene", scene.name}};
    row.why_not = found.why_not;
    if (!found.why_not.empty())
        return row;
    const double share = 100.0 * found.ground_m2.wrong_share();
    const auto [least, most] = std::ranges::minmax(found.wrong_by_moment);
    row.error = {share, std::min(share, 100.0 * least), std::max(share, 100.0 * most)};
    row.seconds = frame_time(found);
    if (!row.seconds)
        row.why_not = "ended before times were taken";
    row.bytes = found.texture_bytes;
    return row;
}

WorkPrecision scene_diagram(const ShadowSceneResult& scene) {
    WorkPrecision diagram = empty_diagram("shadows-" + scene.name, "Shadow methods: " + scene.title);
    for (const ShadowRow& row : scene.rows)
        diagram.rows.push_back(diagram_row(row, scene));
    diagram.notes = {fmt::format("{}, {} x {} pixels; lamps are points; vertical bars from the least to the most of the moments",
                                 counted(scene.moments.size(), "moment"), scene.width_px, scene.height_px),
                     times_words(diagram.rows)};
    return diagram;
}

/// Of the scenes that every row of the diagram can be compared in.
WorkPrecision scenes_diagram(const ShadowResult& result) {
    WorkPrecision diagram = empty_diagram("shadows-all", "Shadow methods: all scenes together");
    for (std::size_t i = 0; i < result.scenes.front().rows.size(); ++i) {
        WorkPrecisionRow row;
        row.label = name(result.scenes.front().rows[i].method);
        row.parameters = {{"shadows", row.label}};
        std::vector<double> shares, seconds; // by round, over the scenes
        for (const ShadowSceneResult& scene : result.scenes) {
            if (i >= scene.rows.size() || !measured(scene.rows[i]) || scene.rows[i].samples.frame_s.empty()) {
                row.why_not = "not measured in " + scene.name;
                if (i < scene.rows.size() && !measured(scene.rows[i]))
                    row.why_not += ": " + scene.rows[i].why_not;
                break;
            }
            const ShadowRow& found = scene.rows[i];
            shares.push_back(100.0 * found.ground_m2.wrong_share());
            seconds.resize(seconds.empty() ? found.samples.frame_s.size() : std::min(seconds.size(), found.samples.frame_s.size()));
            for (std::size_t round = 0; round < seconds.size(); ++round)
                seconds[round] += found.samples.frame_s[round] / static_cast<double>(result.scenes.size());
        }
        if (row.why_not.empty()) {
            const Spread spread = spread_of(shares).value();
            row.error = {spread.mean, spread.minimum, spread.maximum};
            row.seconds = time_of(seconds);
        }
        diagram.rows.push_back(std::move(row));
    }
    diagram.notes = {fmt::format("mean over {}, each with the same weight; vertical bars from the best to the worst scene",
                                 counted(result.scenes.size(), "scene")),
                     times_words(diagram.rows)};
    return diagram;
}

} // namespace

bool measured(const ShadowRow& row) { return row.why_not.empty(); }

std::optional<Interval> frame_time(const ShadowRow& row) { return time_of(row.samples.frame_s); }

std::optional<double> cpu_time(const ShadowRow& row) {
    const auto spread = spread_of(row.samples.cpu_s);
    return spread ? std::optional(spread->median) : std::nullopt;
}

std::vector<WorkPrecision> shadow_diagrams(const ShadowResult& result) {
    std::vector<WorkPrecision> diagrams;
    if (result.scenes.size() > 1)
        diagrams.push_back(scenes_diagram(result));
    for (const ShadowSceneResult& scene : result.scenes)
        if (!scene.rows.empty())
            diagrams.push_back(scene_diagram(scene));
    return diagrams;
}

} // namespace fernlicht
