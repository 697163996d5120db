#include "renderer/light_pass/peaks.h"

#include "renderer/light_pass/peaks_packs.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <functional>
#include <oneapi/tbb/info.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr int times = 5;
constexpr std::size_t look_ups = 1'000'000, sums = 2'000'000, quotients = 500'000; ///< packs of each chain in a run: some ms
constexpr double least_stream_bytes = 64.0 * (1 << 20), most_stream_bytes = 512.0 * (1 << 20);

/// Of each thread a second of its CPU time. `work`: of one run.
double best_rate(int threads, double work, const std::function<void(std::size_t thread)>& run) {
    double best = 0.0;
    for (int time = 0; time < times; ++time) {
        const std::clock_t start = std::clock();
        {
            std::vector<std::jthread> all;
            for (std::size_t thread = 0; thread < static_cast<std::size_t>(threads); ++thread)
                all.emplace_back([&run, thread] { run(thread); });
        }
        const double cpu_s = static_cast<double>(std::max<std::clock_t>(1, std::clock() - start)) / CLOCKS_PER_SEC;
        best = std::max(best, threads * work / cpu_s);
    }
    return best;
}

/// Of numbers in each of a thread's three arrays.
std::size_t stream_count(int threads) {
    const double cache_bytes = static_cast<double>(std::max(0L, ::sysconf(_SC_LEVEL3_CACHE_SIZE)));
    const double bytes = std::clamp(4.0 * cache_bytes, least_stream_bytes, most_stream_bytes);
    return static_cast<std::size_t>(bytes / (3.0 * sizeof(float) * threads * packs::most_lanes)) * packs::most_lanes;
}

} // namespace

Peaks measure_peaks(packs::Level level, long long table_texels) {
    Peaks peaks;
    peaks.level = level;
    peaks.threads = oneapi::tbb::info::default_concurrency();
    const auto lanes = static_cast<double>(packs::lanes_of(level));
    std::atomic<float> kept = 0.0F; // so that nothing is left out
    {
        struct Arrays {
            std::vector<float> a, b, to;
        };
        const std::size_t count = stream_count(peaks.threads);
        std::vector<Arrays> arrays(static_cast<std::size_t>(peaks.threads));
        for (Arrays& of : arrays)
            of = {std::vector<float>(count, 1.0F), std::vector<float>(count, 2.0F), std::vector<float>(count)};
        peaks.bytes_per_s = best_rate(peaks.threads, 3.0 * sizeof(float) * static_cast<double>(count), [&](std::size_t thread) {
            Arrays& of = arrays[thread];
            AT_LEVEL(level, stream)(of.a.data(), of.b.data(), of.to.data(), count);
        });
    }
    const std::vector<float> table(static_cast<std::size_t>(std::max(table_texels, 2LL * static_cast<long long>(packs::most_lanes))), 1.0F);
    peaks.look_ups_per_s = best_rate(peaks.threads, lanes * look_ups,
                                     [&](std::size_t) { kept = AT_LEVEL(level, look_up)(table.data(), table.size(), look_ups); });
    peaks.operations_per_s = best_rate(peaks.threads, lanes * sums * 2.0 * packs::chains_of_sums,
                                       [&](std::size_t) { kept = AT_LEVEL(level, multiply_and_add)(0.5F, 0.25F, sums); });
    peaks.divisions_per_s = best_rate(peaks.threads, lanes * quotients * packs::chains_of_quotients,
                                      [&](std::size_t) { kept = AT_LEVEL(level, divide)(1.5F, quotients); });
    return peaks;
}

} // namespace fernlicht
