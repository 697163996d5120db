#include "runner/experiments/bench/bench_result.h"
#include "runner/findings/figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

Cell ms(double seconds) { return {fmt::format("{:.2f}", 1e3 * seconds), seconds}; }
Cell fps(double per_s) { return {fmt::format("{:.{}f}", per_s, per_s < 9.995 ? 2 : 1), per_s}; }

std::string load_text(const std::optional<std::array<double, 3>>& load) { return load ? fmt::format("{:.2f}", load->front()) : "unknown"; }

const std::vector<Column> ratio_columns{{"ratio"}, {"spread"}, {.head = "verdict", .words = true}};

std::vector<Cell> with_ratio(std::vector<Cell> cells, const BenchRow& row) {
    const bool is_reference = row.benched->row.name == reference_technique;
    if (!row.ratio)
        cells.insert(cells.end(), {"", "", ""});
    else
        cells.insert(cells.end(), {{fmt::format("{:.2f}", row.ratio->median), row.ratio->median},
                                   is_reference ? "" : fmt::format("{:.2f}..{:.2f}", row.ratio->p05, row.ratio->p95),
                                   is_reference ? "is what they are held against" : difference_name(row.ratio->difference)});
    return cells;
}

/// Those of the thesis beside its figures, or all others.
Table speed_table(const std::vector<BenchRow>& rows, bool of_thesis) {
    Table table{of_thesis ? "thesis" : "others", of_thesis ? "Table 6.1, and here" : "Other techniques", {}, {}};
    if (of_thesis)
        table.columns = {{"#"}, {.head = "technique", .words = true}, {"thesis, frames/s"}, {"here, frames/s"}};
    else
        table.columns = {{.head = "technique", .words = true}, {"frames/s"}};
    table.columns.insert(table.columns.end(), ratio_columns.begin(), ratio_columns.end());
    for (const BenchRow& row : rows) {
        const Technique& technique = row.benched->row;
        if ((technique.thesis_row > 0) != of_thesis)
            continue;
        std::vector<Cell> cells{std::string(technique.name)};
        if (of_thesis)
            cells = {fmt::format("{}", technique.thesis_row), std::string(technique.name), std::string(technique.thesis_fps)};
        cells.push_back(fps(row.frames_per_s()));
        table.rows.push_back(with_ratio(std::move(cells), row));
    }
    return table;
}

Table cost_table(const std::vector<BenchRow>& rows) {
    const auto count = [](const BenchRow& row, auto Work::*member) {
        return row.work ? Cell(fmt::format("{}", (*row.work).*member), static_cast<double>((*row.work).*member)) : Cell("");
    };
    Table table{"costs",
                "What a frame costs, in ms",
                columns_of("technique<|median|p95|latency|p95|CPU|GPU|passes|draws|triangles|fragments|textures [MiB]"),
                {}};
    for (const BenchRow& row : rows)
        table.rows.push_back({std::string(row.benched->row.name), ms(row.frame.median), ms(row.frame.p95), ms(row.latency.median),
                              ms(row.latency.p95), ms(row.cpu.median), row.gpu ? ms(row.gpu->median) : Cell(""), count(row, &Work::passes),
                              count(row, &Work::draws), count(row, &Work::triangles), count(row, &Work::fragments),
                              row.work ? Cell(mib_text(row.work->texture_bytes), static_cast<double>(row.work->texture_bytes)) : Cell("")});
    return table;
}

} // namespace

Document document(const BenchResult& result) {
    const RunContext& context = result.context;
    const std::vector<BenchRow> rows = summarise(result);
    Document document{"Techniques against one another", {}};
    Section& section = document.sections.emplace_back();
    section.blocks.emplace_back(fmt::format("{}, {}: {} x {}, {} x {} pixels, orders from seed {}.", result.drive, result.variant,
                                            counted(result.moments.size(), "moment"), counted(result.orders.size(), "round"),
                                            result.width_px, result.height_px, context.seed));
    section.blocks.emplace_back(fmt::format("{} through {}; {}, {} cores; load average {} before, {} after.", context.gl_renderer,
                                            context.backend, context.cpu, result.cores, load_text(result.load_before),
                                            load_text(result.load_after)));
    if (!result.gpu_not_measured.empty())
        section.blocks.emplace_back(fmt::format("GPU times are not measured: {}.", result.gpu_not_measured));
    for (const std::string& warning : bench_warnings(result))
        section.blocks.emplace_back("warning: " + warning + ".");
    section.blocks.emplace_back(Plot{"bench", Drawing{bench_svg(result)}, {}, 2.0});
    for (Table table : {speed_table(rows, true), speed_table(rows, false), cost_table(rows)})
        if (!table.rows.empty())
            section.blocks.emplace_back(std::move(table));
    return document;
}

} // namespace fernlicht
