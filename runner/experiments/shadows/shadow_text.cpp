#include "runner/experiments/shadows/shadow_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/findings/shadow_figures.h"
#include "runner/write/aligned_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// "1.3", with "-2" for lost and "+1" for invented edges; "-" where there is none.
std::string edge_cell(const EdgeError& edge) {
    std::string text = edge.rms_cm ? shadow_cm(*edge.rms_cm) : "-";
    if (edge.lost > 0)
        text += fmt::format(" \xE2\x88\x92{}", edge.lost);
    if (edge.invented > 0)
        text += fmt::format(" +{}", edge.invented);
    return text;
}

std::string spots_cell(std::size_t spots, std::size_t pixels) { return spots == 0 ? "0" : fmt::format("{} ({} px)", spots, pixels); }

std::vector<std::string> cells_of(const ShadowRow& row) {
    std::vector<std::string> cells{std::string(name(row.method))};
    if (!measured(row)) {
        cells.resize(16, "-");
        return cells;
    }
    const auto work = typical_work(row.work);
    const auto time = frame_time(row);
    const auto cpu = cpu_time(row);
    cells.push_back(shadow_percent(row.ground_m2.wrong_share()));
    cells.push_back(shadow_m2(row.ground_m2.wrongly_lit));
    cells.push_back(shadow_m2(row.ground_m2.wrongly_dark));
    cells.push_back(shadow_percent(row.view_px.wrong_share()));
    cells.push_back(row.discs_px ? shadow_percent(row.discs_px->wrong_share()) : "-");
    for (const EdgeError& edge : row.edges)
        cells.push_back(edge_cell(edge));
    cells.push_back(spots_cell(row.spots.acne, row.spots.acne_px));
    cells.push_back(spots_cell(row.spots.leaks, row.spots.leaks_px));
    cells.push_back(row.crawl_cm ? shadow_cm(*row.crawl_cm) : "-");
    cells.push_back(time ? fmt::format("{:.1f}", 1e3 * time->value) : "-");
    cells.push_back(cpu ? fmt::format("{:.1f}", 1e3 * *cpu) : "-");
    cells.push_back(row.texture_bytes ? fmt::format("{:.1f}", static_cast<double>(*row.texture_bytes) / (1 << 20)) : "-");
    cells.push_back(work ? fmt::format("{}", work->passes) : "-");
    cells.push_back(work ? fmt::format("{}", work->draws) : "-");
    return cells;
}

const std::vector<std::string>& heads() {
    static const std::vector<std::string> names{"shadows",   "wrong %",   "lit m2",    "dark m2", "view %", "discs %",
                                                "edge 10 m", "edge 30 m", "edge 80 m", "acne",    "leaks",  "crawl cm",
                                                "frame ms",  "CPU ms",    "MiB",       "passes",  "draws"};
    return names;
}

constexpr const char* legend =
    "wrong: ground wrongly lit or dark, of what is lit without shadows; lit, dark: its areas; view: the same in pixels of the view; discs: "
    "against lamps that are discs\n"
    "edge: r.m.s. error of a shadow's edge, cm, so far ahead of the lamp, \xE2\x88\x92 edges lost, + invented; acne, leaks: spots wrong "
    "far "
    "from any edge; crawl: how edges' errors change from step to step\n";

} // namespace

std::string shadow_text(const ShadowResult& result) {
    std::string out, refused;
    for (const ShadowSceneResult& scene : result.scenes) {
        std::vector<std::vector<std::string>> rows;
        refused.clear();
        for (const ShadowRow& row : scene.rows) {
            rows.push_back(cells_of(row));
            rows.back().resize(heads().size(), "-");
            if (!measured(row))
                refused += fmt::format("{}: not measured, {}\n", name(row.method), clean_text(row.why_not));
        }
        out += fmt::format("{}: {}, {}\n", scene.name, short_text(scene.title, 90), counted(scene.moments.size(), "moment")) +
               aligned_table("<" + std::string(heads().size() - 1, '>'), heads(), rows) + refused + "\n";
    }
    return out + legend;
}

std::string shadow_markdown(const ShadowResult& result) {
    std::string out = "| scene |", line = "|---|";
    for (const std::string& head : heads()) {
        out += " " + head + " |";
        line += head == "shadows" ? "---|" : "--:|";
    }
    out += "\n" + line + "\n";
    for (const ShadowSceneResult& scene : result.scenes)
        for (const ShadowRow& row : scene.rows) {
            std::vector<std::string> cells = cells_of(row);
            if (!measured(row))
                cells = {cells.front(), "refused"};
            cells.resize(heads().size());
            out += "| " + scene.name + " |";
            for (const std::string& cell : cells)
                out += (cell.empty() ? "" : " ") + cell + " |";
            out += "\n";
        }
    return out;
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
