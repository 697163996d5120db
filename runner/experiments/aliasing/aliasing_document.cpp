#include "runner/experiments/aliasing/aliasing_result.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

Cell three_digits(double value) { return {fmt::format("{:.3g}", value), value}; }
Cell three_digits(const std::optional<double>& value) { return value ? three_digits(*value) : Cell("not measured"); }

Cell edge_cell(const std::optional<EdgeJaggedness>& edge) {
    return edge ? Cell(fmt::format("{:.3f} ± {:.3f}", edge->found.rms_px, edge->found.standard_error_px), edge->found.rms_px)
                : Cell("not measured");
}

/// Least first, then what was not measured over space.
std::vector<std::size_t> shown_order(const AliasingResult& result) {
    std::vector<std::size_t> order = ranked(result);
    for (std::size_t i = 0; i < result.rows.size(); ++i)
        if (!measured_over_space(result.rows[i]))
            order.push_back(i);
    return order;
}

Table space_table(const AliasingResult& result) {
    Table table{"aliasing",
                fmt::format("Of {}, by how it was rendered. Seen: in multiples of the contrast that an eye just sees. Contrasts are to the "
                            "luminance around, r.m.s. over the picture. Stairs: of the line of {} lx on the road and of road marks, beyond "
                            "what 32 pixels around have alike",
                            result.displayed ? "the picture as displayed" : "the scene's luminance",
                            result.level_lx > 0.0 ? fmt::format("{}", result.level_lx) : "a level in"),
                columns_of("rendered by<|rank|seen|aliasing [%]|folded back [%]|rest [%]|lost [%]|stairs, cut-off [px]|stairs, marks [px]"),
                {}};
    for (const std::size_t i : shown_order(result)) {
        const AliasingRow& row = result.rows[i];
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{name_of(row.configuration)});
        if (!row.why_not.empty()) {
            cells.emplace_back("not measured, " + row.why_not);
            continue;
        }
        const SpatialAliasing& s = row.spatial;
        if (measured_over_space(row))
            cells.insert(cells.end(), {fmt::format("{}", table.rows.size()), three_digits(s.aliasing.visible),
                                       three_digits(s.aliasing.contrast_percent), three_digits(s.folded.contrast_percent),
                                       three_digits(s.rest.contrast_percent), three_digits(s.lost.contrast_percent)});
        else
            cells.insert(cells.end(), {"", "not measured", "", "", "", ""});
        cells.insert(cells.end(), {edge_cell(row.cut_off), edge_cell(row.marks)});
    }
    return table;
}

Table time_table(const AliasingResult& result) {
    Table table{
        "flicker",
        "Over time, along the paths of points of the scene. Flicker seen: in multiples of the contrast that an eye just sees; crawl is "
        "below 4 Hz, flicker from there up",
        columns_of("rendered by<|flicker seen|flicker [%]|of it standing on the screen [%]|crawl [%]"),
        {}};
    for (const std::size_t i : shown_order(result))
        if (const AliasingRow& row = result.rows[i]; row.temporal)
            table.rows.push_back({name_of(row.configuration), three_digits(row.temporal->visible),
                                  three_digits(row.temporal->flicker_percent), three_digits(row.temporal->standing_percent),
                                  three_digits(row.temporal->crawl_percent)});
        else
            table.rows.push_back({name_of(row.configuration), "not measured"});
    return table;
}

Table flow_table(const AliasingResult& result) {
    Table table{
        "flow",
        fmt::format("Motion by optical flow against the motion that is known from depth and the car's path, from each frame to the next, "
                    "{:.2f} pixels as a median of {} points. Left out: what going there and back does not find again. Flicker: along "
                    "its paths, of aliasing against the reference, or of brightness as rendered; by known motion: aliasing of the same "
                    "points",
                    result.flows.front().error.known_motion_px, result.flows.front().error.points),
        columns_of(
            "by<|off, median [px]|off, mean [px]|off by more than half a pixel [%]|left out [%]|flicker [%]|flicker by known motion [%]"),
        {}};
    const auto flicker = [](const std::optional<TemporalAliasing>& found) {
        return found ? three_digits(found->flicker_percent) : Cell("not measured");
    };
    for (const FlowComparison& flow : result.flows)
        table.rows.push_back({method_name(flow.method) + ", " + flow.pictures,
                              {fmt::format("{:.3f}", flow.error.median_px), flow.error.median_px},
                              {fmt::format("{:.3f}", flow.error.mean_px), flow.error.mean_px},
                              three_digits(flow.error.far_percent),
                              three_digits(flow.error.left_out_percent),
                              flicker(flow.temporal),
                              flicker(flow.known)});
    return table;
}

/// What was not measured and why, each sentence once; how motion was found; what is not known of frames of others.
std::vector<std::string> notes_of(const AliasingResult& result) {
    std::vector<std::string> notes;
    const auto say = [&](const std::string& what, const std::string& why) {
        const std::string text = what + " not measured: " + why;
        if (!why.empty() && std::ranges::find(notes, text) == notes.end())
            notes.push_back(text);
    };
    for (const AliasingRow& row : result.rows) {
        const std::string name = name_of(row.configuration);
        say(name, row.why_not);
        say("Aliasing over space of " + name, row.no_spatial);
        say("Jaggedness of the cut-off, " + name, row.no_cut_off);
        say("Jaggedness of road marks, " + name, row.no_marks);
        say("Flicker", row.no_temporal);
        if (row.by_flow && row.temporal)
            notes.push_back(motion_text(*row.by_flow));
    }
    notes.insert(notes.end(), result.notes.begin(), result.notes.end());
    return notes;
}

} // namespace

Document document(const AliasingResult& result) {
    const auto& [first, first_s] = result.moments.front();
    const auto& [last, last_s] = result.moments.back();
    const auto& [shown, shown_s] = result.moments.at(result.shown);
    Document document{"Aliasing", {}};
    Section& top = document.sections.emplace_back(Section{result.title + (result.lamp_set.empty() ? "" : ", " + result.lamp_set), {}});
    const auto add_drawing = [](Section& section, const std::string& name, const auto& drawn) {
        if (drawn)
            section.blocks.emplace_back(Plot{name, *drawn});
    };
    top.blocks.emplace_back(
        (first == last ? fmt::format("Frame {} at {:.3f} s", first, first_s)
                       : fmt::format("Frames {} to {}, {:.3f} to {:.3f} s; pictures are of frame {} at {:.3f} s", first, last, first_s,
                                     last_s, shown, shown_s)) +
        fmt::format("; {} x {} pixels, {:.1f} to a degree.", result.view.width_px, result.view.height_px, result.pixels_per_degree));
    top.blocks.emplace_back(
        result.supersample > 0
            ? fmt::format(
                  "Aliasing is structure in a picture that is not in the scene: what remains of a picture when all is taken away that a "
                  "blurred or sharp picture of the scene explains, the scene being rendered {} times as fine each way. A part of it is "
                  "what lies beyond the display's limit and folds back; the rest has other causes, as the texels and steps of a beam "
                  "texture. Lost is what blur took away, which is no aliasing.",
                  result.supersample)
            : "Frames without finer ones to hold them against: measured is how points of the scene change their brightness from frame to "
              "frame. What of it is light that really changes within a quarter of a second is not told apart.");
    add_drawing(top, "ranking", ranking_sheet(result));
    if (const std::vector<std::size_t> order = ranked(result); order.size() > 1) {
        std::string names;
        for (const std::size_t i : order)
            names += (names.empty() ? "least to most: " : " < ") + name_of(result.rows[i].configuration);
        top.blocks.emplace_back(std::move(names));
    }
    if (result.supersample > 0)
        top.blocks.emplace_back(space_table(result));
    const std::optional<plots::Figure> flicker = temporal_plot(result);
    if (flicker)
        top.blocks.emplace_back(time_table(result));
    for (const std::string& note : notes_of(result))
        top.blocks.emplace_back(note + ".");
    Section& pictures = document.sections.emplace_back();
    for (const std::size_t i : ranked(result))
        pictures.blocks.emplace_back(
            Plot{fmt::format("{:02}-{}", i + 1, name_of(result.rows[i].configuration)), aliasing_sheet(result, result.rows[i])});
    if (!ranked(result).empty())
        pictures.blocks.emplace_back(Plot{"bands", spatial_plot(result)});
    add_drawing(pictures, "flicker", flicker);
    if (!result.flows.empty()) {
        add_drawing(pictures, "flow", flow_sheet(result));
        pictures.blocks.emplace_back(flow_table(result));
    }
    return document;
}

} // namespace fernlicht
