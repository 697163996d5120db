// What is computed for every moment of a run, and over a bench's samples.
#include "metrics/images/image_difference.h"
#include "metrics/road/extent.h"
#include "metrics/statistics/statistics.h"
#include "tests/benchmarks/country_road.h"

#include <benchmark/benchmark.h>

namespace fernlicht {
namespace {

const ExtentParameters parameters;

ExtentGrid grid_ahead() { return make_extent_grid(country_road().route, country_road().moment, country_road().drive.bumper_m, parameters); }

void extent_grid(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(grid_ahead());
}
BENCHMARK(extent_grid)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime(); // parallel inside

void twin_of_extent(benchmark::State& state) {
    const ExtentGrid grid = grid_ahead();
    for (auto _ : state)
        benchmark::DoNotOptimize(twin_illuminance_lx(grid, country_road().moment, ExtentPlane::road));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(grid.surface.size()));
}
BENCHMARK(twin_of_extent)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void lit_road(benchmark::State& state) {
    const ExtentGrid grid = grid_ahead();
    const std::vector<double> lx = twin_illuminance_lx(grid, country_road().moment, ExtentPlane::road);
    for (auto _ : state)
        benchmark::DoNotOptimize(measure_extent(grid, lx, ExtentPlane::road, parameters.limits_lx, parameters.width_at_m));
}
BENCHMARK(lit_road)->Unit(benchmark::kMillisecond);

void sensitivity_of_reach(benchmark::State& state) {
    const ExtentGrid grid = grid_ahead();
    for (auto _ : state)
        benchmark::DoNotOptimize(reach_sensitivity(grid, country_road().moment, parameters.limits_lx));
}
BENCHMARK(sensitivity_of_reach)->Unit(benchmark::kMillisecond);

void image_difference(benchmark::State& state) {
    Image<float> a(1024, 768), b(1024, 768);
    for (std::size_t i = 0; i < a.size(); ++i) {
        a.pixels()[i] = static_cast<float>(i % 977);
        b.pixels()[i] = static_cast<float>(i % 983);
    }
    for (auto _ : state)
        benchmark::DoNotOptimize(compare_images(a, b, 0.01, 0.01));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(a.size()));
}
BENCHMARK(image_difference)->Unit(benchmark::kMillisecond);

std::vector<double> times(std::int64_t count) {
    std::mt19937_64 chance(1);
    std::vector<double> values;
    for (std::int64_t i = 0; i < count; ++i)
        values.push_back(0.010 + 1e-6 * static_cast<double>(below(1000, chance)));
    return values;
}

void spread_of_samples(benchmark::State& state) {
    const std::vector<double> samples = times(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(spread_of(samples));
}
BENCHMARK(spread_of_samples)->Arg(21)->Arg(10000)->Unit(benchmark::kMicrosecond);

void median_interval_of_samples(benchmark::State& state) {
    const std::vector<double> samples = times(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(median_interval(samples));
}
BENCHMARK(median_interval_of_samples)->Arg(21)->Arg(10000)->Unit(benchmark::kMicrosecond);

void ratio_of_pairs(benchmark::State& state) {
    const std::vector<double> samples = times(21);
    std::vector<double> reversed(samples.rbegin(), samples.rend());
    for (auto _ : state)
        benchmark::DoNotOptimize(paired_ratio(samples, reversed));
}
BENCHMARK(ratio_of_pairs)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace fernlicht
