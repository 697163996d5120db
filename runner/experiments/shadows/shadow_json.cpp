#include "metrics/statistics/statistics.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/shadows/shadow_result.h"
#include "runner/files/json_text.h"
#include "runner/findings/context_json.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const auto& value) { return value ? Json(*value) : Json(nullptr); }

Json area_json(const ShadowArea& area) {
    return {{"counted", area.counted},
            {"shadowed", area.shadowed},
            {"wrongly_lit", area.wrongly_lit},
            {"wrongly_dark", area.wrongly_dark},
            {"wrong_share", area.wrong_share()}};
}

Json time_interval_json(const std::optional<Interval>& time) {
    return time ? Json{{"median", time->value}, {"low", time->low}, {"high", time->high}, {"interval", interval_name(*time)}}
                : Json(nullptr);
}

Json shadow_row_json(const ShadowRow& row) {
    Json out{{"shadows", name(row.method)}, {"not_measured", measured(row) ? Json(nullptr) : Json(row.why_not)}};
    if (!measured(row))
        return out;
    Json edges = Json::array(), passes = Json::array();
    for (std::size_t d = 0; d < row.edges.size(); ++d)
        edges.push_back({{"distance_m", edge_distances_m[d]},
                         {"edges", row.edges[d].edges},
                         {"lost", row.edges[d].lost},
                         {"invented", row.edges[d].invented},
                         {"rms_cm", number_or_null(row.edges[d].rms_cm)},
                         {"worst_cm", number_or_null(row.edges[d].worst_cm)}});
    for (const auto& [pass, time] : row.pass_s)
        passes.push_back({{"name", pass}, {"seconds", time_interval_json(time)}});
    Json crawl{{"cm", number_or_null(row.crawl_cm)}, {"not_measured", row.crawl_cm ? Json(nullptr) : Json(row.no_crawl)}};
    Json work(nullptr);
    if (const auto counted = typical_work(row.work))
        work = {{"passes", counted->passes},     {"draws", counted->draws},         {"calls", counted->calls},
                {"samplers", counted->samplers}, {"triangles", counted->triangles}, {"fragments", counted->fragments}};
    out.update({{"ground_m2", area_json(row.ground_m2)},
                {"wrong_share_by_moment", row.wrong_by_moment},
                {"view_px", area_json(row.view_px)},
                {"discs_px", row.discs_px ? area_json(*row.discs_px) : Json(nullptr)},
                {"spots",
                 {{"acne", row.spots.acne},
                  {"acne_px", row.spots.acne_px},
                  {"leaks", row.spots.leaks},
                  {"leaks_px", row.spots.leaks_px},
                  {"sure_px", row.spots.sure_px}}},
                {"edges", edges},
                {"crawl", crawl},
                {"frame", time_interval_json(frame_time(row))},
                {"frame_s", row.samples.frame_s},
                {"cpu_s", row.samples.cpu_s},
                {"passes", passes},
                {"texture_bytes", number_or_null(row.texture_bytes)},
                {"work", work}});
    return out;
}

Json scene_json(const ShadowSceneResult& scene) {
    Json moments = Json::array(), rows = Json::array();
    for (const auto& [tick, time_s] : scene.moments)
        moments.push_back({{"frame", tick}, {"time_s", time_s}});
    for (const ShadowRow& row : scene.rows)
        rows.push_back(shadow_row_json(row));
    return {{"name", scene.name},
            {"title", scene.title},
            {"of_drive", scene.of_drive},
            {"moments", moments},
            {"vertical_fov_deg", degrees(scene.vertical_fov_rad)},
            {"timed_px", {{"width", scene.width_px}, {"height", scene.height_px}}},
            {"rows", rows}};
}

} // namespace

std::string shadow_json(const ShadowResult& result) {
    Json scenes = Json::array();
    for (const ShadowSceneResult& scene : result.scenes)
        scenes.push_back(scene_json(scene));
    return json_text(Json{{"schema", "fernlicht shadows"},
                          {"schema_version", 1},
                          {"context", context_json(result.context)},
                          {"interrupted", result.interrupted.empty() ? Json(nullptr) : Json(result.interrupted)},
                          {"missing", result.missing},
                          {"cores", result.cores},
                          {"cores_used_by_others", number_or_null(result.others.cores)},
                          {"rounds", result.rounds},
                          {"map_texels", {{"width", result.map_width}, {"height", result.map_height}}},
                          {"lamp_radius_m", result.lamp_radius_m},
                          {"floor_lx", result.floor_lx},
                          {"scenes", scenes}});
}

} // namespace fernlicht
