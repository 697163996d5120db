#include "runner/experiments/bench/bench_result.h"
#include "runner/files/clean_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {

std::string bench_csv(const BenchResult& result) {
    std::string out = "technique,round,place,frame_s,cpu_s,gpu_s,latency_median_s\r\n";
    const std::size_t moments = result.moments.size();
    for (std::size_t i = 0; i < result.techniques.size(); ++i) {
        const ContestSamples& samples = result.techniques[i].samples;
        for (std::size_t round = 0; round < samples.frame_s.size(); ++round) {
            const auto& order = result.orders.at(round);
            const auto first = samples.latency_s.begin() + static_cast<std::ptrdiff_t>(round * moments);
            const Spread latency = spread_of({first, first + static_cast<std::ptrdiff_t>(moments)}).value();
            out += fmt::format("{},{},{},{},{},{},{}\r\n", csv_text(std::string(result.techniques[i].row.name)), round,
                               std::ranges::find(order, i) - order.begin(), samples.frame_s[round], samples.cpu_s[round],
                               samples.gpu_s.empty() ? "" : fmt::format("{}", samples.gpu_s[round]), latency.median);
        }
    }
    return out;
}

} // namespace fernlicht
