#include "runner/experiments/bench/bench_result.h"
#include "runner/findings/figures.h"
#include "runner/findings/plots/axes.h"

#include <algorithm>
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
                                   is_reference ? "the reference" : difference_name(row.ratio->difference)});
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

/// "Lighting a frame takes 6.93 ms of CPU, 2.9 times its floor of 2.40 ms (operations)."
std::string roofline_text(const Roofline& roofline, const std::vector<BenchRow>& rows, bool by_cpu) {
    const Roofline::Ceiling bound = roofline.bound();
    std::string text =
        fmt::format("Lighting a frame on the CPU takes {:.2f} ms of CPU time, {:.1f} times its floor of {:.2f} ms: the {} that its {} "
                    "pixels ask for, at "
                    "the peak of this machine's cores ({}, packs of {}).",
                    1e3 * roofline.light.cpu_s, roofline.ratio(), 1e3 * bound.floor_s(), bound.what, roofline.light.pixels,
                    counted(static_cast<std::size_t>(roofline.peaks.threads), "thread"), packs::lanes_of(roofline.peaks.level));
    const auto row = std::ranges::find(rows, "photometric", [](const BenchRow& one) { return one.benched->row.name; });
    if (by_cpu && row != rows.end())
        text += fmt::format(" The other {:.2f} ms of photometric, in its quickest round, are GL's: it finds what each pixel shows.",
                            1e3 * (row->cpu.minimum - roofline.light.cpu_s));
    return text;
}

Table roofline_table(const Roofline& roofline) {
    Table table{"roofline",
                "What lighting a frame asks for",
                columns_of("what<|a pixel|a frame [million]|a core at best [million/ms]|CPU at least [ms]"),
                {}};
    for (const Roofline::Ceiling& ceiling : roofline.ceilings())
        table.rows.push_back({ceiling.what,
                              {fmt::format("{:.1f}", ceiling.a_frame / static_cast<double>(roofline.light.pixels)),
                               ceiling.a_frame / static_cast<double>(roofline.light.pixels)},
                              {fmt::format("{:.2f}", 1e-6 * ceiling.a_frame), 1e-6 * ceiling.a_frame},
                              {fmt::format("{:.2f}", 1e-9 * ceiling.peak_per_s), 1e-9 * ceiling.peak_per_s},
                              ms(ceiling.floor_s())});
    return table;
}

template <class Counts, class Count> Count typical(const std::vector<Counts>& work, Count Counts::*count) {
    std::vector<Count> values;
    for (const Counts& moment : work)
        values.push_back(moment.*count);
    std::ranges::sort(values);
    return values[(values.size() - 1) / 2];
}

constexpr plots::Colour ink{51, 51, 51}, faint{110, 110, 110}, grid{222, 224, 228};
constexpr double width_px = 900.0, bar_px = 16.0, step_px = 24.0, top_px = 74.0, bottom_px = 46.0, gap_px = 12.0;

plots::Colour colour_of(const BenchRow& row) {
    if (row.benched->row.name == reference_technique)
        return plots::series_colour(2);
    return plots::series_colour(row.benched->row.thesis_row > 0 ? 0 : 1);
}

std::string label_of(const BenchRow& row) {
    const Technique& technique = row.benched->row;
    return technique.thesis_row > 0 ? fmt::format("{}. {}", technique.thesis_row, technique.name) : std::string(technique.name);
}

std::string value_of(const BenchRow& row) {
    std::string ms = fmt::format("{:.2f} ms", 1e3 * row.frame.median);
    if (!row.ratio)
        return ms;
    const bool open = row.ratio->difference == Difference::not_distinguishable && row.benched->row.name != reference_technique;
    return fmt::format("{}, x {:.2f}{}", ms, row.ratio->median, open ? " (not distinguishable)" : "");
}

double widest(const std::vector<BenchRow>& rows, std::string (*text)(const BenchRow&)) {
    double width = 0.0;
    for (const BenchRow& row : rows)
        width = std::max(width, plots::text_width(text(row), 12.0));
    return width;
}

/// Where the bars lie: from `left` over `width` pixels, for 0 .. axis.to.
struct PlotGround {
    double left = 0.0, width = 0.0;
    plots::Axis axis;
    double x(double value) const { return left + width * plots::position(axis, value); }
};

void draw_bar(plots::Drawing& canvas, const BenchRow& row, const PlotGround& ground, double y) {
    const double middle = y + 0.5 * bar_px, end = ground.x(1e3 * row.frame.median);
    const double low = ground.x(1e3 * row.frame.p05), high = ground.x(1e3 * row.frame.p95);
    canvas.text(ground.left - 8.0, middle + 4.0, label_of(row), {.size_px = 12.0, .colour = ink, .anchor = "end"});
    canvas.rectangle(ground.left, y, end - ground.left, bar_px, {.fill = css(colour_of(row)), .opacity = 0.75});
    canvas.line({{low, middle}, {high, middle}}, {.colour = ink, .width_px = 1.4});
    for (const double x : {low, high})
        canvas.line({{x, middle - 4.0}, {x, middle + 4.0}}, {.colour = ink, .width_px = 1.4});
    canvas.text(std::max(end, high) + 8.0, middle + 4.0, value_of(row), {.size_px = 12.0, .colour = faint});
}

void draw_axis(plots::Drawing& canvas, const PlotGround& ground, double bottom) {
    for (const plots::Tick& tick : plots::ticks_of(ground.axis, 8)) {
        const double x = ground.x(tick.value);
        canvas.line({{x, top_px - 6.0}, {x, bottom}}, {.colour = grid});
        canvas.text(x, bottom + 16.0, tick.label, {.size_px = 12.0, .colour = ink, .anchor = "middle"});
    }
    canvas.text(ground.left + 0.5 * ground.width, bottom + 36.0, "time a frame, back to back, median and 5 to 95 % of the rounds [ms]",
                {.size_px = 12.0, .colour = ink, .anchor = "middle"});
}

} // namespace

Document document(const BenchResult& result) {
    const RunContext& context = result.context;
    const std::vector<BenchRow> rows = summarise(result);
    Document document{"Techniques against one another", {}};
    Section& section = document.sections.emplace_back();
    section.blocks.emplace_back(fmt::format("{}, {}: {} x {}, {} x {} pixels, orders from seed {}.", result.drive, result.lamp_set,
                                            counted(result.moments.size(), "moment"), counted(result.orders.size(), "round"),
                                            result.width_px, result.height_px, context.seed));
    section.blocks.emplace_back(fmt::format("{} through {}; {}, {} cores; load average {} before, {} after.", context.gl_renderer,
                                            context.backend, context.cpu, result.cores, load_text(result.load_before),
                                            load_text(result.load_after)));
    if (!result.lit_by.empty())
        section.blocks.emplace_back(fmt::format("Light of photometric by {}.", result.lit_by));
    if (!result.gpu_not_measured.empty())
        section.blocks.emplace_back(fmt::format("GPU times are not measured: {}.", result.gpu_not_measured));
    for (const std::string& warning : bench_warnings(result))
        section.blocks.emplace_back("warning: " + warning + ".");
    section.blocks.emplace_back(Plot{"bench", bench_plot(result), {}, 2.0});
    for (Table table : {speed_table(rows, true), speed_table(rows, false), cost_table(rows)})
        if (!table.rows.empty())
            section.blocks.emplace_back(std::move(table));
    if (result.roofline) {
        section.blocks.emplace_back(roofline_text(*result.roofline, rows, result.lit_by == lit_by_cpu));
        section.blocks.emplace_back(roofline_table(*result.roofline));
    } else if (!result.roofline_not_measured.empty()) {
        section.blocks.emplace_back(fmt::format("The floor of photometric's light is not measured: {}.", result.roofline_not_measured));
    }
    return document;
}

std::optional<Work> typical_work(const std::vector<Work>& work) {
    if (work.empty())
        return std::nullopt;
    return Work{typical(work, &Work::passes),       typical(work, &Work::draws),       typical(work, &Work::calls),
                typical(work, &Work::samplers),     typical(work, &Work::shadow_maps), typical(work, &Work::lamps),
                typical(work, &Work::features),     typical(work, &Work::triangles),   typical(work, &Work::fragments),
                typical(work, &Work::texture_bytes)};
}

LightWork typical_light(const std::vector<LightWork>& work) {
    return {typical(work, &LightWork::pixels),    typical(work, &LightWork::bytes),    typical(work, &LightWork::operations),
            typical(work, &LightWork::divisions), typical(work, &LightWork::look_ups), typical(work, &LightWork::beam_texels),
            typical(work, &LightWork::cpu_s)};
}

std::vector<BenchRow> summarise(const BenchResult& result) {
    const auto reference = std::ranges::find(result.techniques, reference_technique, [](const BenchedTechnique& t) { return t.row.name; });
    std::vector<BenchRow> rows;
    for (const BenchedTechnique& benched : result.techniques) {
        const TimingSamples& samples = benched.samples;
        if (samples.frame_s.empty())
            continue;
        BenchRow row;
        row.benched = &benched;
        row.frame = spread_of(samples.frame_s).value();
        row.cpu = spread_of(samples.cpu_s).value();
        row.latency = spread_of(samples.latency_s).value();
        row.gpu = spread_of(samples.gpu_s);
        row.frame_deviation_s = median_absolute_deviation(samples.frame_s).value();
        row.frame_median = median_interval(samples.frame_s);
        if (reference != result.techniques.end())
            row.ratio = paired_ratio(samples.frame_s, reference->samples.frame_s);
        row.work = typical_work(benched.work);
        rows.push_back(row);
    }
    return rows;
}

const char* difference_name(Difference difference) {
    return difference == Difference::faster ? "faster" : difference == Difference::slower ? "slower" : "not distinguishable";
}

std::string verdict_text(const PairedRatio& ratio) {
    return fmt::format("{} (ratio {:.2f}, spread {:.2f}..{:.2f})", difference_name(ratio.difference), ratio.median, ratio.p05, ratio.p95);
}

std::vector<std::string> bench_warnings(const BenchResult& result) {
    std::vector<std::string> warnings;
    if (std::string disturbed = disturbance_text(result.others, result.cores); !disturbed.empty())
        warnings.push_back(std::move(disturbed));
    if (result.orders.size() < fewest_rounds)
        warnings.push_back(fmt::format("{} rounds are too few to tell techniques apart; it takes {}", result.orders.size(), fewest_rounds));
    if (!result.interrupted.empty())
        warnings.push_back(fmt::format("{} of {} rounds were done: {}", result.orders.size(), result.rounds_planned, result.interrupted));
    if (std::ranges::none_of(result.techniques, [](const BenchedTechnique& t) { return t.row.name == reference_technique; }))
        warnings.push_back(fmt::format("no ratios: {} did not take part", reference_technique));
    return warnings;
}

plots::Drawing bench_plot(const BenchResult& result) {
    const std::vector<BenchRow> rows = summarise(result);
    std::vector<double> highest{0.0};
    for (const BenchRow& row : rows)
        highest.push_back(1e3 * row.frame.p95);
    PlotGround ground;
    ground.axis = plots::axis_around("time a frame", "ms", highest, plots::Scale::linear, true);
    ground.left = 16.0 + std::max(60.0, widest(rows, label_of));
    ground.width = std::max(100.0, width_px - ground.left - widest(rows, value_of) - 16.0);
    const bool split = std::ranges::any_of(rows, [](const BenchRow& row) { return row.benched->row.thesis_row > 0; }) &&
                       std::ranges::any_of(rows, [](const BenchRow& row) { return row.benched->row.thesis_row == 0; });
    const double bottom = top_px + step_px * static_cast<double>(rows.size()) + (split ? gap_px : 0.0);
    plots::Drawing canvas{width_px, bottom + bottom_px, "Frame times by technique"};
    canvas.rectangle(0.0, 0.0, width_px, bottom + bottom_px, {.fill = "#ffffff"});
    canvas.text(16.0, 24.0, "Frame times by technique", {.size_px = 16.0, .colour = ink, .bold = true});
    canvas.text(16.0, 42.0,
                fmt::format("{}, {}, {} x {}; {} moments x {} rounds; x: ratio to {}; numbers: rows of Table 6.1", result.drive,
                            result.lamp_set, result.width_px, result.height_px, result.moments.size(), result.orders.size(),
                            reference_technique),
                {.size_px = 12.0, .colour = faint});
    canvas.text(16.0, 58.0, fmt::format("{}, {}", result.context.gl_renderer, result.context.cpu), {.size_px = 12.0, .colour = faint});
    draw_axis(canvas, ground, bottom);
    double y = top_px;
    for (std::size_t i = 0; i < rows.size(); ++i, y += step_px) {
        if (split && i > 0 && rows[i - 1].benched->row.thesis_row > 0 && rows[i].benched->row.thesis_row == 0)
            y += gap_px;
        draw_bar(canvas, rows[i], ground, y);
    }
    return canvas;
}

} // namespace fernlicht
