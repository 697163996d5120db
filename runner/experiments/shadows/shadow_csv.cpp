#include "runner/experiments/shadows/shadow_result.h"
#include "runner/files/clean_text.h"

#include <fmt/format.h>

namespace fernlicht {

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
