#include "report_files.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/shadows/shadow_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/findings/shadow_figures.h"
#include "runner/write/page_base.h"

#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

/// Of a cell, each unbroken.
std::vector<std::string> edge_words(const EdgeError& edge) {
    if (edge.edges + edge.lost + edge.invented == 0)
        return {"none there"};
    std::vector<std::string> words;
    if (edge.rms_cm)
        words.push_back(fmt::format("{} / {}", shadow_cm(*edge.rms_cm), shadow_cm(*edge.worst_cm)));
    if (edge.lost > 0)
        words.push_back(fmt::format("{} of {} lost", edge.lost, edge.lost + edge.edges));
    if (edge.invented > 0)
        words.push_back(fmt::format("{} invented", edge.invented));
    for (std::size_t i = 0; i + 1 < words.size(); ++i)
        words[i] += ",";
    return words;
}

data error_part(const ShadowRow& row) {
    data part;
    part.set("method", std::string(name(row.method)));
    part.set("is_measured", measured(row));
    part.set("why_not", clean_text(row.why_not));
    if (!measured(row))
        return part;
    part.set("wrong", shadow_percent(row.ground_m2.wrong_share()));
    part.set("lit", shadow_m2(row.ground_m2.wrongly_lit));
    part.set("dark", shadow_m2(row.ground_m2.wrongly_dark));
    part.set("view", shadow_percent(row.view_px.wrong_share()));
    part.set("discs", row.discs_px ? shadow_percent(row.discs_px->wrong_share()) : "");
    data edges{List::list};
    for (const EdgeError& edge : row.edges) {
        data cell, words{List::list};
        for (const std::string& word : edge_words(edge))
            words.push_back(word);
        cell.set("words", words);
        edges.push_back(cell);
    }
    part.set("edges", edges);
    part.set("acne", fmt::format("{} / {}", row.spots.acne, row.spots.acne_px));
    part.set("leaks", fmt::format("{} / {}", row.spots.leaks, row.spots.leaks_px));
    part.set("crawl", row.crawl_cm ? shadow_cm(*row.crawl_cm) : "none there");
    const auto time = frame_time(row);
    const auto cpu = cpu_time(row);
    part.set("frame", time ? time_text(time->value) : "not measured");
    part.set("spread", time ? fmt::format("{} … {}", time_text(time->low), time_text(time->high)) : "");
    part.set("cpu", cpu ? time_text(*cpu) : "");
    std::string passes;
    for (const auto& [pass, seconds] : row.pass_s)
        passes += fmt::format("{}{} {}", passes.empty() ? "" : ", ", pass, time_text(seconds.value));
    part.set("passes", passes);
    part.set("memory", row.texture_bytes ? fmt::format("{:.1f}", static_cast<double>(*row.texture_bytes) / (1 << 20)) : "");
    const auto work = typical_work(row.work);
    part.set("count", work ? fmt::format("{} / {} / {}", work->passes, work->draws, work->triangles) : "");
    return part;
}

/// What a diagram's marks and bars are, and who is not in it.
data caption_parts(const WorkPrecision& diagram) {
    data sentences{List::list};
    for (std::string note : diagram.notes) {
        if (note.front() >= 'a' && note.front() <= 'z')
            note.front() = static_cast<char>(note.front() - 'a' + 'A');
        sentences.push_back(clean_text(note));
    }
    for (const WorkPrecisionRow& row : diagram.rows)
        if (!row.measured())
            sentences.push_back(clean_text(fmt::format("Not in the diagram: {}, {}", row.label, row.why_not)));
    return sentences;
}

data scene_part(const ShadowSceneResult& scene, const std::vector<WorkPrecision>& diagrams) {
    data part, rows{List::list}, figures{List::list};
    part.set("title", short_text(scene.title, 160));
    part.set("name", clean_text(scene.name));
    std::string moments;
    if (scene.of_drive)
        for (const auto& [tick, time_s] : scene.moments)
            moments += fmt::format("{}{:.2f} s", moments.empty() ? ", at " : ", ", time_s);
    part.set("moments", moments);
    part.set("fov", fmt::format("{:.0f}", degrees(scene.vertical_fov_rad)));
    part.set("size", fmt::format("{} x {}", scene.width_px, scene.height_px));
    for (const ShadowRow& row : scene.rows)
        rows.push_back(error_part(row));
    part.set("rows", rows);
    part.set("sheet", scene.rows.empty() ? "" : shadow_sheet_svg(scene));
    for (const WorkPrecision& diagram : diagrams)
        if (diagram.name == "shadows-" + scene.name) {
            data figure;
            figure.set("svg", work_precision_svg(diagram));
            figure.set("caption", caption_parts(diagram));
            figures.push_back(figure);
        }
    part.set("figures", figures);
    return part;
}

} // namespace

std::string shadow_html(const ShadowResult& result) {
    const std::vector<WorkPrecision> diagrams = shadow_diagrams(result);
    data page, scenes{List::list}, missing{List::list};
    for (const ShadowSceneResult& scene : result.scenes)
        scenes.push_back(scene_part(scene, diagrams));
    for (const std::string& what : result.missing)
        missing.push_back(clean_text(what));
    const bool together = !diagrams.empty() && diagrams.front().name == "shadows-all";
    page.set("style", std::string(report_file("report.css")));
    page.set("started", clean_text(result.context.started_utc));
    page.set("interrupted", clean_text(result.interrupted));
    page.set("is_interrupted", !result.interrupted.empty());
    page.set("missing", missing);
    page.set("texels", fmt::format("{} x {}", result.map_width, result.map_height));
    page.set("floor", fmt::format("{:g}", result.floor_lx));
    page.set("radius", fmt::format("{:g}", 100.0 * result.lamp_radius_m));
    const bool has_discs = result.lamp_radius_m > 0.0;
    page.set("has_discs", has_discs);
    page.set("view_columns", has_discs ? "2" : "1");
    page.set("all_columns", has_discs ? "11" : "10");
    page.set("step", fmt::format("{:g}", crawl_step_m));
    page.set("crawl_at", fmt::format("{:g}", crawl_distance_m));
    page.set("has_all", together);
    page.set("all", together ? work_precision_svg(diagrams.front()) : "");
    page.set("all_caption", together ? caption_parts(diagrams.front()) : data{List::list});
    page.set("scenes", scenes);
    page.set("context", context_part(result.context));
    kainjow::mustache::mustache page_template{std::string(report_file("shadows.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("shadows.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
