#include "runner/experiments/bench/bench_result.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

template <class Count> Count typical(const std::vector<Work>& work, Count Work::*count) {
    std::vector<Count> values;
    for (const Work& moment : work)
        values.push_back(moment.*count);
    std::ranges::sort(values);
    return values[(values.size() - 1) / 2];
}

} // namespace

std::optional<Work> typical_work(const std::vector<Work>& work) {
    if (work.empty())
        return std::nullopt;
    return Work{typical(work, &Work::passes),       typical(work, &Work::draws),       typical(work, &Work::calls),
                typical(work, &Work::samplers),     typical(work, &Work::shadow_maps), typical(work, &Work::lamps),
                typical(work, &Work::features),     typical(work, &Work::triangles),   typical(work, &Work::fragments),
                typical(work, &Work::texture_bytes)};
}

std::vector<BenchRow> summarise(const BenchResult& result) {
    const auto reference = std::ranges::find(result.techniques, reference_technique, [](const BenchedTechnique& t) { return t.row.name; });
    std::vector<BenchRow> rows;
    for (const BenchedTechnique& benched : result.techniques) {
        const ContestSamples& samples = benched.samples;
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
    switch (difference) {
    case Difference::faster:
        return "faster";
    case Difference::slower:
        return "slower";
    case Difference::not_distinguishable:
        break;
    }
    return "not distinguishable";
}

std::string verdict_text(const PairedRatio& ratio) {
    return fmt::format("{} (ratio {:.2f}, spread {:.2f}..{:.2f})", difference_name(ratio.difference), ratio.median, ratio.p05, ratio.p95);
}

std::vector<std::string> bench_warnings(const BenchResult& result) {
    std::vector<std::string> warnings;
    if (!result.others.cores)
        warnings.emplace_back("whether others used the machine could not be seen: /proc/stat does not tell");
    else if (*result.others.cores > disturbing_cores)
        warnings.push_back(
            fmt::format("others used {:.2f} of the machine's {} cores meanwhile{}: times are longer than on a quiet machine, and "
                        "their spread is wider",
                        *result.others.cores, result.cores,
                        result.others.busiest.empty()
                            ? ""
                            : fmt::format(" (busiest seen: '{}' with {:.2f})", result.others.busiest, result.others.busiest_cores)));
    if (result.orders.size() < fewest_rounds)
        warnings.push_back(fmt::format("{} rounds are too few to tell techniques apart; it takes {}", result.orders.size(), fewest_rounds));
    if (!result.interrupted.empty())
        warnings.push_back(fmt::format("{} of {} rounds were done: {}", result.orders.size(), result.rounds_planned, result.interrupted));
    if (std::ranges::none_of(result.techniques, [](const BenchedTechnique& t) { return t.row.name == reference_technique; }))
        warnings.push_back(fmt::format("no ratios: {} did not take part", reference_technique));
    return warnings;
}

} // namespace fernlicht
