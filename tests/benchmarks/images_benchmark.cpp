// Metrics of pictures, 1024 x 768. `--benchmark_enable_random_interleaving=true --benchmark_repetitions=5` takes them in turns.
#include "metrics/images/ciede2000.h"
#include "metrics/images/flip.h"
#include "metrics/images/image_difference.h"
#include "metrics/images/ssim.h"
#include "tests/metrics/images/direct_flip.h"
#include "tests/metrics/images/made_pictures.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace fernlicht {
namespace {

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
