#include "runner/experiments/shadows/shadow_result.h"
#include "runner/findings/figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

Cell percent(double share) { return {shadow_percent(share), 100.0 * share}; }
Cell centimetres(const std::optional<double>& cm) { return cm ? Cell(shadow_cm(*cm), *cm) : Cell(""); }

/// "1.3", with "−2" for lost and "+1" for invented edges.
Cell edge_cell(const EdgeError& edge) {
    Cell cell = centimetres(edge.rms_cm);
    if (edge.lost > 0)
        cell.text += fmt::format("{}\u2212{}", cell.text.empty() ? "" : " ", edge.lost);
    if (edge.invented > 0)
        cell.text += fmt::format("{}+{}", cell.text.empty() ? "" : " ", edge.invented);
    return cell;
}

Cell spots_cell(std::size_t spots, std::size_t pixels) { return spots == 0 ? "0" : fmt::format("{} ({} px)", spots, pixels); }

std::vector<Column> error_columns() {
    std::vector<Column> columns{{.head = "shadows", .words = true}, {"wrong", "%", "ground"}, {"lit", "m²", "ground"},
                                {"dark", "m²", "ground"},           {"wrong", "%", "view"},   {"discs", "%", "view"}};
    for (const double distance_m : edge_distances_m)
        columns.push_back({fmt::format("{:g} m", distance_m), "cm", "edges"});
    columns.insert(columns.end(), {{"acne", "", "spots"}, {"leaks", "", "spots"}, {"crawl", "cm"}});
    return columns;
}

const std::vector<Column> cost_columns{{.head = "shadows", .words = true}, {"time", "ms", "frame"},      {"CPU", "ms", "frame"},
                                       {"textures", "MiB, for shadows"},   {"passes", "", "of a frame"}, {"draws", "", "of a frame"}};

std::vector<Cell> error_cells(const ShadowRow& row) {
    std::vector<Cell> cells{percent(row.ground_m2.wrong_share()),
                            {shadow_m2(row.ground_m2.wrongly_lit), row.ground_m2.wrongly_lit},
                            {shadow_m2(row.ground_m2.wrongly_dark), row.ground_m2.wrongly_dark},
                            percent(row.view_px.wrong_share()),
                            row.discs_px ? percent(row.discs_px->wrong_share()) : Cell("")};
    for (const EdgeError& edge : row.edges)
        cells.push_back(edge_cell(edge));
    cells.push_back(spots_cell(row.spots.acne, row.spots.acne_px));
    cells.push_back(spots_cell(row.spots.leaks, row.spots.leaks_px));
    cells.push_back(centimetres(row.crawl_cm));
    return cells;
}

std::vector<Cell> cost_cells(const ShadowRow& row) {
    const auto work = typical_work(row.work);
    const auto time = frame_time(row);
    const auto cpu = cpu_time(row);
    const auto milliseconds = [](double s) { return Cell(fmt::format("{:.1f}", 1e3 * s), s); };
    return {time ? milliseconds(time->value) : Cell(""), cpu ? milliseconds(*cpu) : Cell(""),
            row.texture_bytes ? Cell(mib_text(*row.texture_bytes), static_cast<double>(*row.texture_bytes)) : Cell(""),
            work ? fmt::format("{}", work->passes) : "", work ? fmt::format("{}", work->draws) : ""};
}

/// A table of the scene's methods; of those that are not measured, why.
template <class Cells> Table methods_table(const ShadowSceneResult& scene, const std::string& name, const std::string& caption,
                                           std::vector<Column> columns, Cells cells_of) {
    Table table{name + "-" + scene.name, caption, std::move(columns), {}};
    for (const ShadowRow& row : scene.rows) {
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{std::string(fernlicht::name(row.method))});
        if (!measured(row)) {
            cells.emplace_back("not measured, " + row.why_not);
            continue;
        }
        const std::vector<Cell> figures = cells_of(row);
        cells.insert(cells.end(), figures.begin(), figures.end());
    }
    return table;
}

Table errors_table(const ShadowSceneResult& scene) { return methods_table(scene, "errors", "How wrong", error_columns(), error_cells); }

Table costs_table(const ShadowSceneResult& scene) {
    return methods_table(
        scene, "costs",
        fmt::format("What it costs: a frame of {} x {} pixels while the car moves, methods in turns", scene.width_px, scene.height_px),
        cost_columns, cost_cells);
}

/// What the other tables have no room for.
Table details_table(const ShadowSceneResult& scene) {
    std::vector<Column> columns{{.head = "shadows", .words = true}};
    for (const double distance_m : edge_distances_m)
        columns.push_back({fmt::format("{:g} m", distance_m), "cm", "worst edge"});
    columns.insert(columns.end(), {{"from … to", "", "frame"}, {"triangles", "", "frame"}, {.head = "pass by pass", .words = true}});
    Table table =
        methods_table(scene, "details", "Worst edges, spread of times, and passes, each finished and timed by itself, which is slower",
                      std::move(columns), [](const ShadowRow& row) {
                          std::vector<Cell> cells;
                          for (const EdgeError& edge : row.edges)
                              cells.push_back(centimetres(edge.worst_cm));
                          std::string passes;
                          for (const auto& [pass, seconds] : row.pass_s)
                              passes += fmt::format("{}{} {}", passes.empty() ? "" : ", ", pass, time_text(seconds.value));
                          const auto time = frame_time(row);
                          const auto work = typical_work(row.work);
                          cells.insert(cells.end(), {time ? time_text(time->low) + " … " + time_text(time->high) : "",
                                                     work ? fmt::format("{}", work->triangles) : "", passes});
                          return cells;
                      });
    table.folded = table.off_terminal = true;
    return table;
}

Section scene_section(const ShadowSceneResult& scene, const std::vector<WorkPrecision>& diagrams) {
    Section section{scene.title, {}};
    std::string about = scene.name + ", " + counted(scene.moments.size(), "moment");
    if (scene.of_drive)
        for (const auto& [tick, time_s] : scene.moments)
            about += fmt::format("{}{:.2f} s", tick == scene.moments.front().first ? ", at " : ", ", time_s);
    section.blocks.emplace_back(fmt::format("{}, a view {:.0f}° high.", about, degrees(scene.vertical_fov_rad)));
    section.blocks.emplace_back(errors_table(scene));
    section.blocks.emplace_back(costs_table(scene));
    section.blocks.emplace_back(details_table(scene));
    if (scene.luminance_cdm2.size() > 0)
        section.blocks.emplace_back(Plot{"methods-" + scene.name, shadow_sheet(scene)});
    for (const WorkPrecision& diagram : diagrams)
        if (diagram.name == "shadows-" + scene.name)
            section.blocks.push_back(work_precision_section(diagram).blocks.front());
    return section;
}

} // namespace

Document document(const ShadowResult& result) {
    const std::vector<WorkPrecision> diagrams = shadow_diagrams(result);
    Document document{"Shadow methods", {}};
    Section& first = document.sections.emplace_back();
    first.blocks.emplace_back(fmt::format(
        "Each method renders the same scenes with the same light and is held against ray tracing from each pixel's centre to each lamp. A "
        "place is in shadow to the degree 1 \u2212 E / E without shadows; wrongly lit and wrongly dark count by that degree, "
        "where there are at least {:g} lx without shadows. Maps have {} x {} texels.{}",
        result.floor_lx, result.map_width, result.map_height,
        result.lamp_radius_m > 0.0
            ? fmt::format(" Lamps are points, and discs of {:g} cm radius in the column that says so.", 100.0 * result.lamp_radius_m)
            : ""));
    first.blocks.emplace_back(fmt::format("Ground: wrongly lit or dark, of what is lit without shadows. Edges: r.m.s. error of a shadow's "
                                          "edge in the light of one lamp, by maps "
                                          "fitted to the view, so far ahead of the lamp; \u2212 edges lost, + invented. Acne and leaks: "
                                          "spots that are wrong far from any edge. "
                                          "Crawl: how edges' errors change from step to step of {:g} m, {:g} m ahead.",
                                          crawl_step_m, crawl_distance_m));
    if (!diagrams.empty() && diagrams.front().name == "shadows-all")
        first.blocks.push_back(work_precision_section(diagrams.front()).blocks.front());
    for (const ShadowSceneResult& scene : result.scenes)
        document.sections.push_back(scene_section(scene, diagrams));
    return document;
}

Document shadow_paper(const ShadowResult& result) {
    Table all{"all", "", {{.head = "scene", .words = true}}, {}};
    const std::vector<Column> errors = error_columns();
    all.columns.insert(all.columns.end(), errors.begin(), errors.end());
    all.columns.insert(all.columns.end(), cost_columns.begin() + 1, cost_columns.end());
    for (const ShadowSceneResult& scene : result.scenes)
        for (const ShadowRow& row : scene.rows) {
            std::vector<Cell>& cells = all.rows.emplace_back(std::vector<Cell>{scene.name, std::string(name(row.method))});
            if (measured(row))
                for (const std::vector<Cell>& part : {error_cells(row), cost_cells(row)})
                    cells.insert(cells.end(), part.begin(), part.end());
            else
                cells.emplace_back("refused");
        }
    return {"Shadow methods", {{"", {std::move(all)}}}};
}

} // namespace fernlicht
