#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/accuracy/errors_json.h"
#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/context_json.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

JsonMembers part_members(AliasingPart& part) {
    return {{"rms_cdm2", part.rms}, {"contrast_percent", part.contrast_percent}, {"thresholds", part.visible}};
}

JsonMembers edge_members(EdgeJaggedness& edge) {
    return {{"rms_px", edge.found.rms_px}, {"standard_error_px", edge.found.standard_error_px},
            {"floor_px", edge.floor_px},   {"worst_px", edge.found.worst_px},
            {"points", edge.found.points}, {"without_partner", edge.found.without}};
}

JsonMembers flicker_members(FlickerBand& band) { return {{"hertz", band.hertz}, {"contrast_percent", band.contrast_percent}}; }

JsonMembers found_members(TemporalAliasing& temporal) {
    return {{"tracks", temporal.tracks},
            {"crawl_percent", temporal.crawl_percent},
            {"flicker_percent", temporal.flicker_percent},
            {"standing_percent", temporal.standing_percent},
            {"thresholds", temporal.visible},
            {"spectrum", temporal.spectrum, flicker_members}};
}

JsonMembers motion_members(std::pair<bool, FollowedByFlow>& motion) {
    FollowedByFlow& flow = motion.second;
    return joined({{"by", one_of(motion.first,
                                 [] {
                                     return std::vector<std::string>{"depth and the car's path", "optical flow"};
                                 })}},
                  when(motion.first, {{"started", flow.started},
                                      {"followed", flow.followed},
                                      {"without_contrast", flow.flat},
                                      {"median_motion_px", flow.median_motion_px},
                                      {"median_return_px", flow.median_return_px}}));
}

JsonMembers flow_members(FlowComparison& flow) {
    return {{"pictures", flow.pictures},
            {"method", one_of(flow.method, names_of<FlowMethod>(method_name, 2))},
            {"points", flow.error.points},
            {"known_motion_px", flow.error.known_motion_px},
            {"left_out_percent", flow.error.left_out_percent},
            {"mean_error_px", flow.error.mean_px},
            {"median_error_px", flow.error.median_px},
            {"off_by_half_a_pixel_percent", flow.error.far_percent},
            {"temporal", flow.temporal, found_members},
            {"temporal_by_known_motion", flow.known, found_members}};
}

/// A label is taken for the name of pictures of others until something is known of how they were drawn.
JsonMembers configuration_members(AliasingConfiguration& c) {
    const auto if_ours = [&c](auto& value, auto... inner) {
        using Plain = std::remove_cvref_t<decltype(value)>;
        return through([&c, &value] { return c.others.empty() ? std::optional<Plain>(value) : std::nullopt; },
                       [&c, &value](const std::optional<Plain>& given) {
                           if (given)
                               value = *given, c.others.clear();
                       },
                       inner...);
    };
    const auto filter_part = [](SurfaceFilter& filter) { return one_of(filter, names_of<SurfaceFilter>(filter_name, 3)); };
    return {{"label", through([&c] { return name_of(c); }, [&c](const std::string& name) { c.others = name; })},
            {"technique", if_ours(c.technique)},
            {"beams", if_ours(c.beams, beams_part)},
            {"filter", if_ours(c.filter, filter_part)},
            {"samples", if_ours(c.samples)},
            {"varied", or_null(c.varied)}};
}

JsonMembers row_members(AliasingRow& row, const AliasingResult& result) {
    SpatialAliasing& s = row.spatial;
    const bool any = row.why_not.empty(), spatial = measured_over_space(row);
    const auto band_members = [&result](AliasingBand& band) -> JsonMembers {
        return {{"from_cycles_per_px", band.from},
                {"to_cycles_per_px", band.to},
                {"from_cycles_per_degree", band.from * result.pixels_per_degree},
                {"to_cycles_per_degree", band.to * result.pixels_per_degree},
                {"aliasing", band.aliasing, part_members},
                {"lost", band.lost, part_members}};
    };
    const auto temporal_members = [&row](TemporalAliasing& temporal) {
        const auto motion =
            through([&row] { return std::pair(row.by_flow.has_value(), row.by_flow.value_or(FollowedByFlow{})); },
                    [&row](const std::pair<bool, FollowedByFlow>& by) { row.by_flow = by.first ? std::optional(by.second) : std::nullopt; },
                    motion_members);
        return joined(found_members(temporal), JsonMembers{{"motion", motion}});
    };
    return joined(
        configuration_members(row.configuration), when(!any, {{"not_measured", row.why_not}}),
        when(any, {{"aliasing", joined(when(spatial, part_members(s.aliasing)), when(!spatial, {{"not_measured", row.no_spatial}}))}}),
        when(spatial, {{"folded", s.folded, part_members},
                       {"rest", s.rest, part_members},
                       {"lost", s.lost, part_members},
                       {"bands", s.bands, band_members},
                       {"worst", {{"thresholds", s.worst_visible}, {"x_px", s.worst_x}, {"y_px", s.worst_y}}}}),
        when(any, {{"jaggedness",
                    {{"cut_off", or_why(json_part(row.cut_off, edge_members), row.no_cut_off, &row.no_cut_off)},
                     {"marks", or_why(json_part(row.marks, edge_members), row.no_marks, &row.no_marks)}}},
                   {"temporal", or_why(json_part(row.temporal, temporal_members), row.no_temporal, &row.no_temporal)}}));
}

std::vector<std::string> names_by_aliasing(const AliasingResult& result) {
    std::vector<std::string> names;
    for (const std::size_t i : ranked(result))
        names.push_back(name_of(result.rows[i].configuration));
    return names;
}

} // namespace

JsonMembers aliasing_members(AliasingResult& result) {
    return {{"schema", json_constant("fernlicht aliasing")},
            {"schema_version", json_constant(3)},
            {"context", context_members(result.context)},
            {"interrupted", or_null(result.interrupted)},
            {"notes", result.notes},
            {"drive", result.drive},
            {"title", result.title},
            {"lamp_set", result.lamp_set},
            {"width_px", result.view.width_px},
            {"height_px", result.view.height_px},
            {"pixels_per_degree", result.pixels_per_degree},
            {"supersample", or_null(result.supersample)},
            {"picture", one_of(result.displayed,
                               [] {
                                   return std::vector<std::string>{"luminance", "display"};
                               })},
            {"level_lx", or_null(result.level_lx)},
            {"moments", result.moments, moment_members},
            {"shown_frame", one_of(result.shown, ticks_of(result.moments))},
            {"rows", result.rows, [&result](AliasingRow& row) { return row_members(row, result); }},
            {"optical_flow", result.flows, flow_members},
            {"least_to_most", names_by_aliasing(result)}};
}

std::string filter_name(SurfaceFilter filter) {
    return filter == SurfaceFilter::none ? "none" : filter == SurfaceFilter::trilinear ? "trilinear" : "mipmapped";
}

bool measured_over_space(const AliasingRow& row) { return row.why_not.empty() && row.no_spatial.empty(); }

std::string name_of(const AliasingConfiguration& c) {
    if (!c.others.empty())
        return c.others;
    std::string name = c.technique;
    name += ", " + beams_text(c.beams) + " beams";
    name += c.filter == SurfaceFilter::none ? ", no filter" : ", " + filter_name(c.filter);
    return name + fmt::format(", {} sample{}", c.samples, c.samples == 1 ? "" : "s");
}

std::vector<std::size_t> ranked(const AliasingResult& result) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < result.rows.size(); ++i)
        if (measured_over_space(result.rows[i]))
            order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return result.rows[i].spatial.aliasing.visible; });
    return order;
}

std::string motion_text(const FollowedByFlow& flow) {
    return fmt::format("motion by optical flow: {} of {} points followed, {} without contrast, median motion {:.2f} px a frame, back to "
                       "within {:.3f} px{}",
                       flow.followed, flow.started, flow.flat, flow.median_motion_px, flow.median_return_px,
                       2 * flow.followed < flow.started ? "; fewer than half, and flicker is known of those alone" : "");
}

std::string aliasing_csv(const AliasingResult& result) {
    std::string out = "label,technique,beams,filter,samples,aliasing_thresholds,aliasing_percent,folded_percent,rest_percent,lost_percent,"
                      "aliasing_rms_cdm2,cut_off_px,cut_off_error_px,marks_px,marks_error_px,flicker_thresholds,flicker_percent,"
                      "standing_percent,crawl_percent,not_measured\r\n";
    for (const AliasingRow& row : result.rows) {
        const AliasingConfiguration& c = row.configuration;
        const SpatialAliasing& s = row.spatial;
        out += c.others.empty() ? fmt::format("{},{},{},{},{},", csv_text(name_of(c)), csv_text(c.technique), beams_text(c.beams),
                                              filter_name(c.filter), c.samples)
                                : csv_text(c.others) + ",,,,,";
        out += measured_over_space(row)
                   ? fmt::format("{},{},{},{},{},{},", s.aliasing.visible, s.aliasing.contrast_percent, s.folded.contrast_percent,
                                 s.rest.contrast_percent, s.lost.contrast_percent, s.aliasing.rms)
                   : ",,,,,,";
        for (const auto* edge : {&row.cut_off, &row.marks})
            out += *edge ? fmt::format("{},{},", (*edge)->found.rms_px, (*edge)->found.standard_error_px) : ",,";
        const auto optional = [](const std::optional<double>& value) { return value ? fmt::format("{},", *value) : ","; };
        out += row.temporal ? fmt::format("{},{},{}{}", row.temporal->visible, row.temporal->flicker_percent,
                                          optional(row.temporal->standing_percent), optional(row.temporal->crawl_percent))
                            : ",,,,";
        out += csv_text(row.why_not.empty() ? row.no_spatial : row.why_not) + "\r\n";
    }
    return out;
}

} // namespace fernlicht
