#include "runner/experiments/bench/bench_result.h"
#include "runner/findings/figures.h"
#include "runner/write/aligned_table.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using Cells = std::vector<std::string>;

std::string ms(double seconds) { return fmt::format("{:.2f}", 1e3 * seconds); }
std::string fps(double per_s) { return fmt::format("{:.{}f}", per_s, per_s < 9.995 ? 2 : 1); }

std::string load_text(const std::optional<std::array<double, 3>>& load) { return load ? fmt::format("{:.2f}", load->front()) : "unknown"; }

Cells ratio_cells(const BenchRow& row) {
    if (!row.ratio)
        return {"-", "-", "-"};
    const bool is_reference = row.benched->row.name == reference_technique;
    return {fmt::format("{:.2f}", row.ratio->median), is_reference ? "" : fmt::format("{:.2f}..{:.2f}", row.ratio->p05, row.ratio->p95),
            is_reference ? "is what they are held against" : difference_name(row.ratio->difference)};
}

Cells joined(Cells first, const Cells& then) {
    first.insert(first.end(), then.begin(), then.end());
    return first;
}

std::string thesis_table(const std::vector<BenchRow>& rows) {
    std::vector<Cells> lines;
    for (const BenchRow& row : rows)
        if (const Technique& technique = row.benched->row; technique.thesis_row > 0)
            lines.push_back(joined({fmt::format("{}", technique.thesis_row), std::string(technique.name), std::string(technique.thesis_fps),
                                    fps(row.frames_per_s())},
                                   ratio_cells(row)));
    if (lines.empty())
        return "";
    return "Table 6.1, and here\n" +
           aligned_table("><>>>><", {"#", "technique", "thesis, frames/s", "here, frames/s", "ratio", "spread", "verdict"}, lines) + "\n";
}

std::string other_table(const std::vector<BenchRow>& rows) {
    std::vector<Cells> lines;
    for (const BenchRow& row : rows)
        if (row.benched->row.thesis_row == 0)
            lines.push_back(joined({std::string(row.benched->row.name), fps(row.frames_per_s())}, ratio_cells(row)));
    if (lines.empty())
        return "";
    return "Other techniques\n" + aligned_table("<>>><", {"technique", "frames/s", "ratio", "spread", "verdict"}, lines) + "\n";
}

std::string cost_table(const std::vector<BenchRow>& rows) {
    const auto count = [](const BenchRow& row, auto Work::*member) {
        return row.work ? fmt::format("{}", (*row.work).*member) : std::string("-");
    };
    std::vector<Cells> lines;
    for (const BenchRow& row : rows)
        lines.push_back({std::string(row.benched->row.name), ms(row.frame.median), ms(row.frame.p95), ms(row.latency.median),
                         ms(row.latency.p95), ms(row.cpu.median), row.gpu ? ms(row.gpu->median) : "-", count(row, &Work::passes),
                         count(row, &Work::draws), count(row, &Work::triangles), count(row, &Work::fragments),
                         row.work ? fmt::format("{:.1f}", static_cast<double>(row.work->texture_bytes) / (1 << 20)) : "-"});
    return "What a frame costs, in ms\n" + aligned_table("<>>>>>>>>>>>",
                                                         {"technique", "median", "p95", "latency", "p95", "CPU", "GPU", "passes", "draws",
                                                          "triangles", "fragments", "textures, MiB"},
                                                         lines);
}

} // namespace

std::string bench_heading(const BenchResult& result) {
    const RunContext& context = result.context;
    std::string text = fmt::format("{}, {}: {} x {}, {} x {} pixels, orders from seed {}\n", result.drive, result.variant,
                                   counted(result.moments.size(), "moment"), counted(result.orders.size(), "round"), result.width_px,
                                   result.height_px, context.seed);
    text += fmt::format("{} through {}; {}, {} cores; load average {} before, {} after\n", context.gl_renderer, context.backend,
                        context.cpu, result.cores, load_text(result.load_before), load_text(result.load_after));
    if (!result.gpu_not_measured.empty())
        text += fmt::format("GPU times are not measured: {}\n", result.gpu_not_measured);
    for (const std::string& warning : bench_warnings(result))
        text += "warning: " + warning + "\n";
    return text;
}

std::string bench_tables(const BenchResult& result) {
    const std::vector<BenchRow> rows = summarise(result);
    return thesis_table(rows) + other_table(rows) + (rows.empty() ? "" : cost_table(rows));
}

} // namespace fernlicht
