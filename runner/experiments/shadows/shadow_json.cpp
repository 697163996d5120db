#include "metrics/statistics/statistics.h"
#include "runner/experiments/accuracy/errors_json.h"
#include "runner/experiments/shadows/shadow_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/context_json.h"
#include "runner/findings/figures.h"
#include "scenarios/values/pose.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

JsonMembers area_members(ShadowArea& area) {
    return {{"counted", area.counted},
            {"shadowed", area.shadowed},
            {"wrongly_lit", area.wrongly_lit},
            {"wrongly_dark", area.wrongly_dark},
            {"wrong_share", area.wrong_share()}};
}

/// How often it was taken is not told: two stand for more than one.
JsonMembers time_interval_members(Interval& time) {
    const auto interval = through([&] { return interval_name(time); },
                                  [&](const std::string& name) {
                                      time.samples = name.empty() ? 0 : name == "one timing" ? 1 : 2;
                                      time.of_median = name.starts_with("95");
                                  });
    return {{"median", time.value}, {"low", time.low}, {"high", time.high}, {"interval", interval}};
}

JsonMembers pass_members(std::pair<std::string, Interval>& pass) {
    return {{"name", pass.first}, {"seconds", pass.second, time_interval_members}};
}

JsonMembers work_members(Work& work) {
    return {{"passes", work.passes},     {"draws", work.draws},         {"calls", work.calls},
            {"samplers", work.samplers}, {"triangles", work.triangles}, {"fragments", work.fragments}};
}

JsonMembers shadow_row_members(ShadowRow& row) {
    const auto edge_members = [&row](EdgeError& edge) -> JsonMembers {
        const auto place = static_cast<std::size_t>(&edge - row.edges.data()); // one to be described stands elsewhere
        return {{"distance_m", place < row.edges.size() ? edge_distances_m[place] : 0.0},
                {"edges", edge.edges},
                {"lost", edge.lost},
                {"invented", edge.invented},
                {"rms_cm", edge.rms_cm},
                {"worst_cm", edge.worst_cm}};
    };
    ShadowSpots& spots = row.spots;
    return joined({{"shadows", shadow_method_part(row.method)}, {"not_measured", or_null(row.why_not)}},
                  when(measured(row), {{"ground_m2", row.ground_m2, area_members},
                                       {"wrong_share_by_moment", row.wrong_by_moment},
                                       {"view_px", row.view_px, area_members},
                                       {"discs_px", row.discs_px, area_members},
                                       {"spots",
                                        {{"acne", spots.acne},
                                         {"acne_px", spots.acne_px},
                                         {"leaks", spots.leaks},
                                         {"leaks_px", spots.leaks_px},
                                         {"sure_px", spots.sure_px}}},
                                       {"edges", row.edges, edge_members},
                                       {"crawl", {{"cm", row.crawl_cm}, {"not_measured", or_null(row.no_crawl)}}},
                                       {"frame", frame_time(row), time_interval_members},
                                       {"frame_s", row.samples.frame_s},
                                       {"cpu_s", row.samples.cpu_s},
                                       {"passes", row.pass_s, pass_members},
                                       {"texture_bytes", row.texture_bytes},
                                       {"work", typical_work_part(row.work, work_members)}}));
}

JsonMembers scene_members(ShadowSceneResult& scene) {
    const auto fov = through([&] { return degrees(scene.vertical_fov_rad); },
                             [&](double deg) {
                                 double& rad = scene.vertical_fov_rad; // of which degrees() makes the same again
                                 for (rad = std::nextafter(radians(deg), 0.0); degrees(rad) < deg;)
                                     rad = std::nextafter(rad, 4.0);
                             });
    return {{"name", scene.name},
            {"title", scene.title},
            {"of_drive", scene.of_drive},
            {"moments", scene.moments, moment_members},
            {"vertical_fov_deg", fov},
            {"timed_px", {{"width", scene.width_px}, {"height", scene.height_px}}},
            {"rows", scene.rows, shadow_row_members}};
}

} // namespace

JsonMembers shadow_members(ShadowResult& result) {
    return {{"schema", json_constant("fernlicht shadows")},
            {"schema_version", json_constant(1)},
            {"context", context_members(result.context)},
            {"interrupted", or_null(result.interrupted)},
            {"missing", result.missing},
            {"cores", result.cores},
            {"cores_used_by_others", result.others.cores},
            {"rounds", result.rounds},
            {"map_texels", {{"width", result.map_width}, {"height", result.map_height}}},
            {"lamp_radius_m", result.lamp_radius_m},
            {"floor_lx", result.floor_lx},
            {"scenes", result.scenes, scene_members}};
}

std::string shadow_csv(const ShadowResult& result) {
    std::string out = "scene,shadows,counted_m2,shadowed_m2,wrongly_lit_m2,wrongly_dark_m2,wrong_share,view_wrong_share,discs_wrong_share,";
    for (const double distance_m : edge_distances_m)
        out += fmt::format("edge_{0:g}m_rms_cm,edge_{0:g}m_edges,edge_{0:g}m_lost,edge_{0:g}m_invented,", distance_m);
    out += "acne,acne_px,leaks,leaks_px,crawl_cm,frame_s,frame_low_s,frame_high_s,cpu_s,texture_bytes,passes,draws,not_measured\r\n";
    const auto optional = [](const auto& value) { return value ? fmt::format("{}", *value) : std::string(); };
    for (const ShadowSceneResult& scene : result.scenes)
        for (const ShadowRow& row : scene.rows) {
            out += csv_text(scene.name) + "," + std::string(name(row.method)) + ",";
            if (!measured(row)) {
                out += std::string(31, ',') + csv_text(row.why_not) + "\r\n";
                continue;
            }
            const ShadowArea& g = row.ground_m2;
            out += fmt::format("{},{},{},{},{},{},{},", g.counted, g.shadowed, g.wrongly_lit, g.wrongly_dark, g.wrong_share(),
                               row.view_px.wrong_share(), row.discs_px ? fmt::format("{}", row.discs_px->wrong_share()) : "");
            for (const EdgeError& edge : row.edges)
                out += fmt::format("{},{},{},{},", optional(edge.rms_cm), edge.edges, edge.lost, edge.invented);
            out += fmt::format("{},{},{},{},{},", row.spots.acne, row.spots.acne_px, row.spots.leaks, row.spots.leaks_px,
                               optional(row.crawl_cm));
            const auto time = frame_time(row);
            const auto work = typical_work(row.work);
            out += time ? fmt::format("{},{},{},", time->value, time->low, time->high) : ",,,";
            out += fmt::format("{},{},", optional(cpu_time(row)), optional(row.texture_bytes));
            out += work ? fmt::format("{},{},", work->passes, work->draws) : ",,";
            out += "\r\n";
        }
    return out;
}

} // namespace fernlicht
