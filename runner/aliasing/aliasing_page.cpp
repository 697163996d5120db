#include "report_files.h"
#include "runner/aliasing/aliasing_result.h"
#include "runner/report/clean_text.h"
#include "runner/report/page_parts.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

std::string three_digits(double value) { return fmt::format("{:.3g}", value); }

data row_part(const AliasingRow& row, std::size_t rank) {
    data part;
    part.set("label", clean_text(name_of(row.configuration)));
    if (!row.why_not.empty()) {
        part.set("seen", "not measured");
        return part;
    }
    part.set("rank", fmt::format("{}", rank + 1));
    part.set("seen", three_digits(row.spatial.aliasing.visible));
    part.set("aliasing", three_digits(row.spatial.aliasing.contrast_percent));
    part.set("folded", three_digits(row.spatial.folded.contrast_percent));
    part.set("rest", three_digits(row.spatial.rest.contrast_percent));
    part.set("lost", three_digits(row.spatial.lost.contrast_percent));
    part.set("jaggedness", row.jaggedness ? fmt::format("{:.3f}", row.jaggedness->rms_px) : "not measured");
    part.set("flicker_seen", row.temporal ? three_digits(row.temporal->visible) : "not measured");
    part.set("flicker", row.temporal ? three_digits(row.temporal->flicker_percent) : "");
    part.set("crawl", row.temporal ? three_digits(row.temporal->crawl_percent) : "");
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
        say("Jaggedness of " + name_of(row.configuration), row.no_jaggedness);
        say("Flicker", row.no_temporal);
    }
    return notes;
}

} // namespace

std::string aliasing_html(const AliasingResult& result) {
    data page, rows{List::list}, sheets{List::list};
    const std::vector<std::size_t> order = ranked(result);
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
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
    page.set("variant", short_text(result.variant, 40));
    page.set("when", result.moments.size() == 1 ? fmt::format("Frame {} at {:.3f} s", tick, time_s)
                                                : fmt::format("Frames {} to {}; pictures are of frame {} at {:.3f} s",
                                                              result.moments.front().first, result.moments.back().first, tick, time_s));
    page.set("size", fmt::format("{} x {}", result.view.width_px, result.view.height_px));
    page.set("supersample", fmt::format("{}", result.supersample));
    page.set("quantity", result.displayed ? "the picture as displayed" : "the scene's luminance");
    page.set("level", fmt::format("{}", result.level_lx));
    page.set("rows", rows);
    page.set("notes", notes_part(result));
    page.set("spatial", order.empty() ? "" : spatial_plot_svg(result));
    const std::string temporal = temporal_plot_svg(result);
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
