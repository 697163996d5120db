#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/files/clean_text.h"
#include "runner/files/json_text.h"
#include "runner/findings/context_json.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json part_json(const AliasingPart& part) {
    return {{"rms_cdm2", part.rms}, {"contrast_percent", part.contrast_percent}, {"thresholds", part.visible}};
}

Json bands_json(const AliasingResult& result, const SpatialAliasing& spatial) {
    Json bands = Json::array();
    for (const AliasingBand& band : spatial.bands)
        bands.push_back({{"from_cycles_per_px", band.from},
                         {"to_cycles_per_px", band.to},
                         {"from_cycles_per_degree", band.from * result.pixels_per_degree},
                         {"to_cycles_per_degree", band.to * result.pixels_per_degree},
                         {"aliasing", part_json(band.aliasing)},
                         {"lost", part_json(band.lost)}});
    return bands;
}

Json edge_json(const std::optional<EdgeJaggedness>& edge, const std::string& why_not) {
    if (!edge)
        return {{"not_measured", why_not}};
    return {{"rms_px", edge->found.rms_px}, {"standard_error_px", edge->found.standard_error_px},
            {"floor_px", edge->floor_px},   {"worst_px", edge->found.worst_px},
            {"points", edge->found.points}, {"without_partner", edge->found.without}};
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json found_json(const TemporalAliasing& temporal) {
    Json spectrum = Json::array();
    for (const FlickerBand& band : temporal.spectrum)
        spectrum.push_back({{"hertz", band.hertz}, {"contrast_percent", band.contrast_percent}});
    return {{"tracks", temporal.tracks},
            {"crawl_percent", optional_json(temporal.crawl_percent)},
            {"flicker_percent", temporal.flicker_percent},
            {"standing_percent", optional_json(temporal.standing_percent)},
            {"thresholds", temporal.visible},
            {"spectrum", spectrum}};
}

Json temporal_json(const AliasingRow& row) {
    if (!row.temporal)
        return {{"not_measured", row.no_temporal}};
    Json found = found_json(*row.temporal);
    found["motion"] = row.by_flow ? Json{{"by", "optical flow"},
                                         {"started", row.by_flow->started},
                                         {"followed", row.by_flow->followed},
                                         {"without_contrast", row.by_flow->flat},
                                         {"median_motion_px", row.by_flow->median_motion_px},
                                         {"median_return_px", row.by_flow->median_return_px}}
                                  : Json{{"by", "depth and the car's path"}};
    return found;
}

Json flows_json(const AliasingResult& result) {
    Json flows = Json::array();
    for (const FlowComparison& flow : result.flows)
        flows.push_back({{"pictures", flow.pictures},
                         {"method", method_name(flow.method)},
                         {"points", flow.error.points},
                         {"known_motion_px", flow.error.known_motion_px},
                         {"left_out_percent", flow.error.left_out_percent},
                         {"mean_error_px", flow.error.mean_px},
                         {"median_error_px", flow.error.median_px},
                         {"off_by_half_a_pixel_percent", flow.error.far_percent},
                         {"temporal", flow.temporal ? found_json(*flow.temporal) : Json(nullptr)},
                         {"temporal_by_known_motion", flow.known ? found_json(*flow.known) : Json(nullptr)}});
    return flows;
}

Json row_json(const AliasingResult& result, const AliasingRow& row) {
    const AliasingConfiguration& c = row.configuration;
    const bool ours = c.others.empty();
    const std::string beams = c.beams ? fmt::format("{}x{}x{}", c.beams->width, c.beams->height, c.beams->bits) : "float";
    Json out{{"label", name_of(c)},
             {"technique", ours ? Json(c.technique) : Json(nullptr)},
             {"beams", ours ? Json(beams) : Json(nullptr)},
             {"filter", ours ? Json(filter_name(c.filter)) : Json(nullptr)},
             {"samples", ours ? Json(c.samples) : Json(nullptr)},
             {"varied", c.varied.empty() ? Json(nullptr) : Json(c.varied)}};
    if (!row.why_not.empty()) {
        out["not_measured"] = row.why_not;
        return out;
    }
    const SpatialAliasing& s = row.spatial;
    if (measured_over_space(row))
        out.update({{"aliasing", part_json(s.aliasing)},
                    {"folded", part_json(s.folded)},
                    {"rest", part_json(s.rest)},
                    {"lost", part_json(s.lost)},
                    {"bands", bands_json(result, s)},
                    {"worst", {{"thresholds", s.worst_visible}, {"x_px", s.worst_x}, {"y_px", s.worst_y}}}});
    else
        out["aliasing"] = {{"not_measured", row.no_spatial}};
    out.update({{"jaggedness", {{"cut_off", edge_json(row.cut_off, row.no_cut_off)}, {"marks", edge_json(row.marks, row.no_marks)}}},
                {"temporal", temporal_json(row)}});
    return out;
}

} // namespace

std::string filter_name(SurfaceFilter filter) {
    return filter == SurfaceFilter::none ? "none" : filter == SurfaceFilter::trilinear ? "trilinear" : "mipmapped";
}

bool measured_over_space(const AliasingRow& row) { return row.why_not.empty() && row.no_spatial.empty(); }

std::string name_of(const AliasingConfiguration& c) {
    if (!c.others.empty())
        return c.others;
    std::string name = c.technique;
    name += c.beams ? fmt::format(", {}x{}x{} beams", c.beams->width, c.beams->height, c.beams->bits) : ", float beams";
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

std::string aliasing_json(const AliasingResult& result) {
    Json moments = Json::array(), rows = Json::array(), order = Json::array();
    for (const auto& [tick, time_s] : result.moments)
        moments.push_back({{"frame", tick}, {"time_s", time_s}});
    for (const AliasingRow& row : result.rows)
        rows.push_back(row_json(result, row));
    for (const std::size_t i : ranked(result))
        order.push_back(name_of(result.rows[i].configuration));
    return json_text(Json{{"schema", "fernlicht aliasing"},
                          {"schema_version", 2},
                          {"context", context_json(result.context)},
                          {"interrupted", result.interrupted.empty() ? Json(nullptr) : Json(result.interrupted)},
                          {"notes", result.notes},
                          {"drive", result.drive},
                          {"title", result.title},
                          {"variant", result.variant},
                          {"width_px", result.view.width_px},
                          {"height_px", result.view.height_px},
                          {"pixels_per_degree", result.pixels_per_degree},
                          {"supersample", result.supersample == 0 ? Json(nullptr) : Json(result.supersample)},
                          {"picture", result.displayed ? "display" : "luminance"},
                          {"level_lx", result.level_lx > 0.0 ? Json(result.level_lx) : Json(nullptr)},
                          {"moments", moments},
                          {"shown_frame", result.moments.at(result.shown).first},
                          {"rows", rows},
                          {"optical_flow", flows_json(result)},
                          {"least_to_most", order}});
}

std::string aliasing_csv(const AliasingResult& result) {
    std::string out = "label,technique,beams,filter,samples,aliasing_thresholds,aliasing_percent,folded_percent,rest_percent,lost_percent,"
                      "aliasing_rms_cdm2,cut_off_px,cut_off_error_px,marks_px,marks_error_px,flicker_thresholds,flicker_percent,"
                      "standing_percent,crawl_percent,not_measured\r\n";
    for (const AliasingRow& row : result.rows) {
        const AliasingConfiguration& c = row.configuration;
        const SpatialAliasing& s = row.spatial;
        const std::string beams = c.beams ? fmt::format("{}x{}x{}", c.beams->width, c.beams->height, c.beams->bits) : "float";
        out += c.others.empty()
                   ? fmt::format("{},{},{},{},{},", csv_text(name_of(c)), csv_text(c.technique), beams, filter_name(c.filter), c.samples)
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
