// The shipped set of six views against its first one, on the country road: pictures alone, nothing read but colour.
// `--benchmark_filter=views --benchmark_enable_random_interleaving=true --benchmark_repetitions=9` takes them in turns.
#include "renderer/renderer.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/roads/road_network.h"

#include <benchmark/benchmark.h>
#include <filesystem>
#include <unistd.h>

namespace fernlicht {
namespace {

struct Road {
    Road() : drive(with_six_views()), network(read_opendrive(drive.road_file)), route(network, drive.start, drive.via) {
        scene = build_scene(network, {.seed = drive.seed});
        for (State state = start(drive); state.tick < tick_count(drive); state = advance(state, drive))
            if (state.tick % 25 == 0)
                moments.push_back(moment_at(state, drive, route, drive.variants[0]));
    }

    static Drive with_six_views() {
        const std::string library = FERNLICHT_SOURCE_DIR "/scenarios/library/";
        const std::filesystem::path file = std::filesystem::temp_directory_path() / ("six-views-" + std::to_string(::getpid()) + ".yaml");
        write_file(file, "fernlicht: 1\nroad: " + library + "roads/country.xodr\nspeed_mps: 20\nduration_s: 20\nview_set: " + library +
                             "views/six.yaml\nvariants: {a: {source: filament, file: " + library + "lamps/halogen-low.ies}}\n");
        Drive drive = read_drive(file);
        std::filesystem::remove(file);
        return drive;
    }

    Drive drive;
    RoadNetwork network;
    Route route;
    Scene scene;
    std::vector<Moment> moments;
};

/// All moments, each with so many views.
void views(benchmark::State& state) {
    static const Road road;
    static Device device = open_device("auto");
    static Renderer renderer(device, road.scene, {});
    const auto count = static_cast<std::size_t>(state.range(0));
    const Wanted colour{.colour = true};
    for (std::size_t v = 0; v < count; ++v)
        renderer.prepare(road.moments, road.drive.views[v], colour);
    for (auto _ : state)
        for (const Moment& moment : road.moments)
            for (std::size_t v = 0; v < count; ++v)
                benchmark::DoNotOptimize(renderer.draw(moment, road.drive.views[v], colour));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(road.moments.size()));
}
BENCHMARK(views)->ArgName("count")->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

} // namespace
} // namespace fernlicht
