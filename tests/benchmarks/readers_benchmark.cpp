// What is read before the first frame.
#include "renderer/beam_texture.h"
#include "renderer/projected_beam.h"
#include "scenarios/drives/yaml_tree.h"
#include "scenarios/lamps/eulumdat.h"
#include "scenarios/lamps/ies.h"
#include "scenarios/roads/road_mesh.h"
#include "tests/benchmarks/country_road.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace fernlicht {
namespace {

void read_ies_file(benchmark::State& state) {
    const std::string path = library_path("lamps/xenon-low.ies"), text = text_of(path);
    for (auto _ : state)
        benchmark::DoNotOptimize(read_ies(path, text, {}, {}));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(read_ies_file)->Unit(benchmark::kMillisecond);

/// Without symmetry: 144 planes every 2.5 degrees with 181 angles each, in cd per 1000 lm.
std::string eulumdat_text() {
    constexpr int planes = 144, angles = 181;
    std::string text = fmt::format("ACME\n2\n0\n{}\n2.5\n{}\n1\nreport\nWidget\n4711\nw.ldt\n2024\n", planes, angles);
    text += "100\n100\n50\n100\n100\n0\n0\n0\n0\n90\n100\n1\n0\n1\n1\nLED\n1000\n4000\n80\n15\n";
    for (int i = 0; i < 10; ++i)
        text += "0\n";
    for (int plane = 0; plane < planes; ++plane)
        text += fmt::format("{}\n", 2.5 * plane);
    for (int angle = 0; angle < angles; ++angle)
        text += fmt::format("{}\n", angle);
    for (int plane = 0; plane < planes; ++plane)
        for (int angle = 0; angle < angles; ++angle)
            text += fmt::format("{}.{}\n", 1000 - 5 * angle, plane % 10);
    return text;
}

void read_eulumdat_text(benchmark::State& state) {
    const std::string text = eulumdat_text();
    LampReadOptions options;
    options.type_c_axis = TypeCAxis::horizontal;
    for (auto _ : state)
        benchmark::DoNotOptimize(read_eulumdat("w.ldt", text, options, {}));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(read_eulumdat_text)->Unit(benchmark::kMillisecond);

void read_opendrive_file(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(read_opendrive(country_road().drive.road_file));
}
BENCHMARK(read_opendrive_file)->Unit(benchmark::kMillisecond);

void build_road_scene(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(build_scene(country_road().network));
}
BENCHMARK(build_road_scene)->Unit(benchmark::kMillisecond);

void parse_drive_yaml(benchmark::State& state) {
    const std::string path = library_path("drives/first-light.yaml"), text = text_of(path);
    for (auto _ : state)
        benchmark::DoNotOptimize(parse_yaml(text, path));
}
BENCHMARK(parse_drive_yaml)->Unit(benchmark::kMillisecond);

/// With its four lamp files.
void read_whole_drive(benchmark::State& state) {
    const std::string path = library_path("drives/first-light.yaml");
    for (auto _ : state)
        benchmark::DoNotOptimize(read_drive(path));
}
BENCHMARK(read_whole_drive)->Unit(benchmark::kMillisecond);

void beam_texture(benchmark::State& state) {
    const CandelaTable& table = country_road().moment.lamps.front().file->table;
    for (auto _ : state)
        benchmark::DoNotOptimize(make_beam_texture(table));
}
BENCHMARK(beam_texture)->Unit(benchmark::kMillisecond);

void projected_beam(benchmark::State& state) {
    const CandelaTable& table = country_road().moment.lamps.front().file->table;
    for (auto _ : state)
        benchmark::DoNotOptimize(make_projected_beam(table, {512, 128, 8}));
}
BENCHMARK(projected_beam)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime(); // parallel inside

} // namespace
} // namespace fernlicht
