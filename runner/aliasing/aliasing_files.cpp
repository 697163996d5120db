#include "runner/aliasing/aliasing_result.h"
#include "runner/bench/aligned_table.h"
#include "runner/capture.h"
#include "runner/plots/png.h"
#include "runner/report/clean_text.h"
#include "runner/report/json_text.h"
#include "scenarios/values/files.h"

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

Json jaggedness_json(const AliasingRow& row) {
    if (!row.jaggedness)
        return {{"not_measured", row.no_jaggedness}};
    return {{"rms_px", row.jaggedness->rms_px},
            {"worst_px", row.jaggedness->worst_px},
            {"points", row.jaggedness->points},
            {"without_partner", row.jaggedness->without}};
}

Json temporal_json(const AliasingRow& row) {
    if (!row.temporal)
        return {{"not_measured", row.no_temporal}};
    Json spectrum = Json::array();
    for (const FlickerBand& band : row.temporal->spectrum)
        spectrum.push_back({{"hertz", band.hertz}, {"contrast_percent", band.contrast_percent}});
    return {{"tracks", row.temporal->tracks},
            {"crawl_percent", row.temporal->crawl_percent},
            {"flicker_percent", row.temporal->flicker_percent},
            {"thresholds", row.temporal->visible},
            {"spectrum", spectrum}};
}

Json row_json(const AliasingResult& result, const AliasingRow& row) {
    const AliasingConfiguration& c = row.configuration;
    Json out{{"label", name_of(c)},
             {"technique", c.technique},
             {"beams", c.beams ? fmt::format("{}x{}x{}", c.beams->width, c.beams->height, c.beams->bits) : "float"},
             {"filter", filter_name(c.filter)},
             {"samples", c.samples},
             {"varied", c.varied.empty() ? Json(nullptr) : Json(c.varied)}};
    if (!row.why_not.empty()) {
        out["not_measured"] = row.why_not;
        return out;
    }
    const SpatialAliasing& s = row.spatial;
    out.update({{"aliasing", part_json(s.aliasing)},
                {"folded", part_json(s.folded)},
                {"rest", part_json(s.rest)},
                {"lost", part_json(s.lost)},
                {"bands", bands_json(result, s)},
                {"worst", {{"thresholds", s.worst_visible}, {"x_px", s.worst_x}, {"y_px", s.worst_y}}},
                {"jaggedness", jaggedness_json(row)},
                {"temporal", temporal_json(row)}});
    return out;
}

std::string three_digits(double value) { return fmt::format("{:.3g}", value); }

std::vector<std::string> cells_of(const AliasingRow& row) {
    std::vector<std::string> cells{name_of(row.configuration)};
    if (!row.why_not.empty()) {
        cells.insert(cells.end(), 9, "-");
        return cells;
    }
    const SpatialAliasing& s = row.spatial;
    for (const double value :
         {s.aliasing.visible, s.aliasing.contrast_percent, s.folded.contrast_percent, s.rest.contrast_percent, s.lost.contrast_percent})
        cells.push_back(three_digits(value));
    cells.push_back(row.jaggedness ? fmt::format("{:.3f}", row.jaggedness->rms_px) : "-");
    if (row.temporal)
        for (const double value : {row.temporal->visible, row.temporal->flicker_percent, row.temporal->crawl_percent})
            cells.push_back(three_digits(value));
    else
        cells.insert(cells.end(), 3, "-");
    return cells;
}

std::string numbered(const AliasingResult& result, std::size_t i) {
    return fmt::format("{:02}-{}", i + 1, file_name_of(name_of(result.rows[i].configuration)));
}

void write_svg(const std::string& svg, const std::filesystem::path& folder, const std::string& name) {
    if (svg.empty())
        return;
    write_file(folder / (name + ".svg"), svg);
    write_file(folder / (name + ".png"), plots::png_of_svg(svg, 1.0));
}

} // namespace

std::string filter_name(SurfaceFilter filter) {
    return filter == SurfaceFilter::none ? "none" : filter == SurfaceFilter::trilinear ? "trilinear" : "mipmapped";
}

std::string name_of(const AliasingConfiguration& c) {
    std::string name = c.technique;
    name += c.beams ? fmt::format(", {}x{}x{} beams", c.beams->width, c.beams->height, c.beams->bits) : ", float beams";
    name += c.filter == SurfaceFilter::none ? ", no filter" : ", " + filter_name(c.filter);
    return name + fmt::format(", {} sample{}", c.samples, c.samples == 1 ? "" : "s");
}

std::vector<std::size_t> ranked(const AliasingResult& result) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < result.rows.size(); ++i)
        if (result.rows[i].why_not.empty())
            order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return result.rows[i].spatial.aliasing.visible; });
    return order;
}

std::string aliasing_text(const AliasingResult& result) {
    std::vector<std::vector<std::string>> rows;
    std::string out, why;
    for (const AliasingRow& row : result.rows) {
        rows.push_back(cells_of(row));
        if (!row.why_not.empty())
            why += name_of(row.configuration) + ": not measured, " + row.why_not + "\n";
        else if (!row.jaggedness)
            why += name_of(row.configuration) + ": jaggedness not measured, " + row.no_jaggedness + "\n";
    }
    const auto& [first, first_s] = result.moments.front();
    const auto& [last, last_s] = result.moments.back();
    out += first == last
               ? fmt::format("{}, {}, frame {} at {:.3f} s", result.title, result.variant, first, first_s)
               : fmt::format("{}, {}, frames {} to {}, {:.3f} to {:.3f} s", result.title, result.variant, first, last, first_s, last_s);
    out += fmt::format("; {}x{} against {} times as fine each way, {:.1f} pixels a degree, {}\n\n", result.view.width_px,
                       result.view.height_px, result.supersample, result.pixels_per_degree,
                       result.displayed ? "as displayed" : "luminance of the scene");
    out += aligned_table(
        "<>>>>>>>>>",
        {"drawn by", "seen (1)", "aliasing %", "folded %", "rest %", "lost %", "jagged px", "flicker seen (1)", "flicker %", "crawl %"},
        rows);
    out += "\n(1) in multiples of the contrast that an eye just sees; % are contrasts to the luminance around, r.m.s. over the picture\n" +
           why;
    const std::vector<std::size_t> order = ranked(result);
    if (order.size() > 1) {
        out += "least to most: ";
        for (std::size_t i = 0; i < order.size(); ++i)
            out += (i == 0 ? "" : " < ") + name_of(result.rows[order[i]].configuration);
        out += "\n";
    }
    return out;
}

std::string aliasing_json(const AliasingResult& result) {
    const RunContext& context = result.context;
    Json versions = Json::object(), inputs = Json::array(), moments = Json::array(), rows = Json::array(), order = Json::array();
    for (const auto& [name, version] : context.versions)
        versions[name] = version;
    for (const FileRead& file : context.inputs)
        inputs.push_back({{"path", file.path.string()}, {"bytes", file.bytes}, {"xxh128", file.xxh128}});
    for (const auto& [tick, time_s] : result.moments)
        moments.push_back({{"frame", tick}, {"time_s", time_s}});
    for (const AliasingRow& row : result.rows)
        rows.push_back(row_json(result, row));
    for (const std::size_t i : ranked(result))
        order.push_back(name_of(result.rows[i].configuration));
    return json_text(Json{{"schema", "fernlicht aliasing"},
                          {"schema_version", 1},
                          {"context",
                           {{"command", context.command},
                            {"started_utc", context.started_utc},
                            {"seed", context.seed},
                            {"backend", context.backend},
                            {"gl_renderer", context.gl_renderer},
                            {"gl_version", context.gl_version},
                            {"cpu", context.cpu},
                            {"os", context.os},
                            {"versions", versions},
                            {"inputs", inputs}}},
                          {"interrupted", result.interrupted.empty() ? Json(nullptr) : Json(result.interrupted)},
                          {"drive", result.drive},
                          {"title", result.title},
                          {"variant", result.variant},
                          {"width_px", result.view.width_px},
                          {"height_px", result.view.height_px},
                          {"pixels_per_degree", result.pixels_per_degree},
                          {"supersample", result.supersample},
                          {"picture", result.displayed ? "display" : "luminance"},
                          {"level_lx", result.level_lx},
                          {"moments", moments},
                          {"shown_frame", result.moments.at(result.shown).first},
                          {"rows", rows},
                          {"least_to_most", order}});
}

std::string aliasing_csv(const AliasingResult& result) {
    std::string out = "label,technique,beams,filter,samples,aliasing_thresholds,aliasing_percent,folded_percent,rest_percent,lost_percent,"
                      "aliasing_rms_cdm2,jaggedness_px,flicker_thresholds,flicker_percent,crawl_percent,not_measured\r\n";
    for (const AliasingRow& row : result.rows) {
        const AliasingConfiguration& c = row.configuration;
        const SpatialAliasing& s = row.spatial;
        const std::string beams = c.beams ? fmt::format("{}x{}x{}", c.beams->width, c.beams->height, c.beams->bits) : "float";
        out += fmt::format("{},{},{},{},{},", csv_text(name_of(c)), csv_text(c.technique), beams, filter_name(c.filter), c.samples);
        out += row.why_not.empty()
                   ? fmt::format("{},{},{},{},{},{},", s.aliasing.visible, s.aliasing.contrast_percent, s.folded.contrast_percent,
                                 s.rest.contrast_percent, s.lost.contrast_percent, s.aliasing.rms)
                   : ",,,,,,";
        out += row.jaggedness ? fmt::format("{},", row.jaggedness->rms_px) : ",";
        out += row.temporal ? fmt::format("{},{},{},", row.temporal->visible, row.temporal->flicker_percent, row.temporal->crawl_percent)
                            : ",,,";
        out += csv_text(row.why_not) + "\r\n";
    }
    return out;
}

void write_aliasing(const AliasingResult& result, const std::filesystem::path& folder) {
    write_file(folder / "aliasing.json", aliasing_json(result));
    write_file(folder / "aliasing.csv", aliasing_csv(result));
    for (std::size_t i = 0; i < result.rows.size(); ++i)
        if (result.rows[i].why_not.empty())
            write_svg(aliasing_sheet_svg(result, result.rows[i]), folder, numbered(result, i));
    write_svg(spatial_plot_svg(result), folder, "bands");
    write_svg(temporal_plot_svg(result), folder, "flicker");
    write_file(folder / "aliasing.html", aliasing_html(result));
}

} // namespace fernlicht
