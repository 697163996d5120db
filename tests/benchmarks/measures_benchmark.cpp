// What is computed for every moment of a run, and over a bench's samples.
#include "metrics/images/flip.h"
#include "metrics/images/image_difference.h"
#include "metrics/road/extent.h"
#include "metrics/statistics/statistics.h"
#include "tests/benchmarks/country_road.h"
#include "tests/metrics/images/direct_flip.h"
#include "tests/metrics/images/made_pictures.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

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
        benchmark::DoNotOptimize(twin_illuminance_lx(grid, country_road().moment, Surface::road));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(grid.surface.size()));
}
BENCHMARK(twin_of_extent)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void lit_road(benchmark::State& state) {
    const ExtentGrid grid = grid_ahead();
    const std::vector<double> lx = twin_illuminance_lx(grid, country_road().moment, Surface::road);
    for (auto _ : state)
        benchmark::DoNotOptimize(measure_extent(grid, lx, Surface::road, parameters.thresholds_lx, parameters.width_at_m));
}
BENCHMARK(lit_road)->Unit(benchmark::kMillisecond);

void sensitivity_of_reach(benchmark::State& state) {
    const ExtentGrid grid = grid_ahead();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            nudged_extents(grid, country_road().moment, parameters.thresholds_lx, parameters.width_at_m, usual_nudges({}, {})));
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

// Metrics of pictures, 1024 x 768. `--benchmark_enable_random_interleaving=true --benchmark_repetitions=5` takes them in turns.

const Image<Rgb8>& scene() {
    static const Image<Rgb8> picture = tests::made_scene(1024, 768);
    return picture;
}

const Image<Rgb8>& other() {
    static const Image<Rgb8> picture = tests::disturbed(scene(), 20, 1);
    return picture;
}

/// Threads at most: 0 all.
void flip(benchmark::State& state) {
    const auto threads = static_cast<std::size_t>(state.range(0));
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    threads > 0 ? threads
                                                : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    for (auto _ : state)
        benchmark::DoNotOptimize(flip_ldr(other(), scene()));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene().size()));
}
BENCHMARK(flip)->ArgName("threads")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// The paper's two-dimensional filters in doubles, on 1/64 of the pixels: items per second compare.
void flip_directly(benchmark::State& state) {
    const auto reference = tests::made_scene(128, 96), tested = tests::disturbed(reference, 20, 1);
    for (auto _ : state)
        benchmark::DoNotOptimize(tests::DirectFlip(128, 96, default_pixels_per_degree).errors(tested, reference));
    state.SetItemsProcessed(state.iterations() * 128 * 96);
}
BENCHMARK(flip_directly)->Unit(benchmark::kMillisecond);

void flip_of_luminance(benchmark::State& state) {
    const Image<float> reference = luma_of(scene()), tested = luma_of(other());
    ExposureRange range = exposures_for(reference);
    for (auto _ : state)
        benchmark::DoNotOptimize(flip_hdr(tested, reference, range));
    state.counters["exposures"] = range.count;
}
BENCHMARK(flip_of_luminance)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void structural_similarity(benchmark::State& state) {
    const Image<float> reference = luma_of(scene()), tested = luma_of(other());
    for (auto _ : state)
        benchmark::DoNotOptimize(ssim(tested, reference, 255.0));
}
BENCHMARK(structural_similarity)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void colour_differences(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(ciede2000_map(other(), scene()));
}
BENCHMARK(colour_differences)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

} // namespace
} // namespace fernlicht
