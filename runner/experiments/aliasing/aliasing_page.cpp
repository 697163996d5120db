#include "report_files.h"
#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/files/clean_text.h"
#include "runner/write/page_base.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

std::string short_number(double value) { return fmt::format("{:.3g}", value); }

std::string edge_words(const std::optional<EdgeJaggedness>& edge) {
    return edge ? fmt::format("{:.3f} ± {:.3f}", edge->found.rms_px, edge->found.standard_error_px) : "not measured";
}

data row_part(const AliasingRow& row, std::size_t rank) {
    data part;
    part.set("label", clean_text(name_of(row.configuration)));
    if (!row.why_not.empty()) {
        part.set("seen", "not measured");
        return part;
    }
    part.set("rank", row.no_spatial.empty() ? fmt::format("{}", rank + 1) : "");
    const SpatialAliasing& space = row.spatial;
    const bool known = measured_over_space(row);
    part.set("seen", known ? short_number(space.aliasing.visible) : "not measured");
    part.set("aliasing", known ? short_number(space.aliasing.contrast_percent) : "");
    part.set("folded", known ? short_number(space.folded.contrast_percent) : "");
    part.set("rest", known ? short_number(space.rest.contrast_percent) : "");
    part.set("lost", known ? short_number(space.lost.contrast_percent) : "");
    part.set("cut_off", edge_words(row.cut_off));
    part.set("marks", edge_words(row.marks));
    const auto optional = [](const std::optional<double>& value) { return value ? short_number(*value) : std::string("not measured"); };
    part.set("flicker_seen", row.temporal ? short_number(row.temporal->visible) : "not measured");
    part.set("flicker", row.temporal ? short_number(row.temporal->flicker_percent) : "");
    part.set("standing", row.temporal ? optional(row.temporal->standing_percent) : "");
    part.set("crawl", row.temporal ? optional(row.temporal->crawl_percent) : "");
    return part;
}

data flow_part(const FlowComparison& flow) {
    data part;
    part.set("by", method_name(flow.method) + ", " + flow.pictures);
    part.set("median", fmt::format("{:.3f}", flow.error.median_px));
    part.set("mean", fmt::format("{:.3f}", flow.error.mean_px));
    part.set("far", short_number(flow.error.far_percent));
    part.set("left_out", short_number(flow.error.left_out_percent));
    part.set("flicker", flow.temporal ? short_number(flow.temporal->flicker_percent) : "not measured");
    part.set("known", flow.known ? short_number(flow.known->flicker_percent) : "not measured");
    return part;
}

data notes_part(const AliasingResult& result) {
    data notes{List::list};
    std::vector<std::string> said;
    const auto say = [&](const std::string& what, const std::string& why) {
        const std::string text = what + " not measured: " + why;
        if (why.empty() || std::ranges::find(said, text) != said.end())
            return;
        said.push_back(text);
        notes.push_back(clean_text(text));
    };
    for (const AliasingRow& row : result.rows) {
        say(name_of(row.configuration), row.why_not);
        say("Aliasing over space of " + name_of(row.configuration), row.no_spatial);
        say("Jaggedness of the cut-off, " + name_of(row.configuration), row.no_cut_off);
        say("Jaggedness of road marks, " + name_of(row.configuration), row.no_marks);
        say("Flicker", row.no_temporal);
    }
    for (const AliasingRow& row : result.rows)
        if (row.by_flow && row.temporal)
            notes.push_back(motion_text(*row.by_flow));
    for (const std::string& note : result.notes)
        notes.push_back(clean_text(note));
    return notes;
}

} // namespace

std::string aliasing_html(const AliasingResult& result) {
    data page, rows{List::list}, sheets{List::list};
    const std::vector<std::size_t> order = ranked(result);
    std::vector<std::size_t> shown = order; // least first, then what was not measured
    for (std::size_t i = 0; i < result.rows.size(); ++i)
        if (std::ranges::find(order, i) == order.end())
            shown.push_back(i);
    for (const std::size_t i : shown) {
        const auto at = std::ranges::find(order, i);
        rows.push_back(row_part(result.rows[i], static_cast<std::size_t>(at - order.begin())));
        if (at == order.end())
            continue;
        data sheet;
        sheet.set("svg", aliasing_sheet_svg(result, result.rows[i]));
        sheets.push_back(sheet);
    }
    const auto& [tick, time_s] = result.moments.at(result.shown);
    page.set("style", std::string(report_file("report.css")));
    page.set("started", clean_text(result.context.started_utc));
    page.set("interrupted", clean_text(result.interrupted));
    page.set("is_interrupted", !result.interrupted.empty());
    page.set("title", short_text(result.title, 160));
    page.set("variant", result.variant.empty() ? "" : ", " + short_text(result.variant, 40));
    page.set("when", result.moments.size() == 1 ? fmt::format("Frame {} at {:.3f} s", tick, time_s)
                                                : fmt::format("Frames {} to {}; pictures are of frame {} at {:.3f} s",
                                                              result.moments.front().first, result.moments.back().first, tick, time_s));
    page.set("size", fmt::format("{} x {}", result.view.width_px, result.view.height_px));
    page.set("supersample", fmt::format("{}", result.supersample));
    page.set("has_reference", result.supersample > 0);
    page.set("quantity", result.displayed ? "the picture as displayed" : "the scene's luminance");
    page.set("level", result.level_lx > 0.0 ? fmt::format("{}", result.level_lx) : "a level in");
    page.set("rows", rows);
    page.set("notes", notes_part(result));
    const std::string ranking = ranking_svg(result);
    page.set("has_ranking", !ranking.empty());
    page.set("ranking", ranking);
    page.set("over_space", result.supersample > 0);
    page.set("has_spatial", !order.empty());
    page.set("spatial", order.empty() ? "" : spatial_plot_svg(result));
    const std::string temporal = temporal_plot_svg(result);
    data flows{List::list};
    for (const FlowComparison& flow : result.flows)
        flows.push_back(flow_part(flow));
    page.set("has_flows", !result.flows.empty());
    page.set("flows", flows);
    page.set("flow_picture", flow_svg(result));
    if (!result.flows.empty())
        page.set("known_motion", fmt::format("{:.2f}", result.flows.front().error.known_motion_px));
    page.set("has_temporal", !temporal.empty());
    page.set("temporal", temporal);
    page.set("sheets", sheets);
    page.set("context", context_part(result.context));
    kainjow::mustache::mustache page_template{std::string(report_file("aliasing.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("aliasing.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
