// A frame with 1 to 400 oncoming cars on 12 km of straight road, lamps, bodies and faces. Run with
// --benchmark_filter=frame_with_traffic --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true.
#include "renderer/renderer.h"
#include "scenarios/drives/advance.h"
#include "scenarios/roads/road_mesh.h"
#include "scenarios/traffic/place_traffic.h"
#include "scenarios/traffic/road_user_mesh.h"

#include <benchmark/benchmark.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

namespace fernlicht {
namespace {

/// Two lanes of 12 km and a row of cars that come, 40 m or two seconds from one to the next.
Drive oncoming(int cars) {
    const auto folder = std::filesystem::temp_directory_path();
    const std::string road = (folder / fmt::format("fernlicht-traffic-{}.xodr", ::getpid())).string(),
                      file = (folder / fmt::format("fernlicht-traffic-{}.yaml", ::getpid())).string();
    const char* lane =
        R"(<lane id="{}" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/><roadMark sOffset="0" type="solid" width="0.12"/></lane>)";
    std::ofstream(road) << fmt::format(
        R"(<OpenDRIVE><header revMajor="1" revMinor="6"/><road name="straight" length="12000" id="1" junction="-1">
<planView><geometry s="0" x="0" y="0" hdg="0" length="12000"><line/></geometry></planView>
<lanes><laneSection s="0"><left>{}</left><center><lane id="0" type="none"/></center><right>{}</right></laneSection></lanes></road></OpenDRIVE>)",
        fmt::format(fmt::runtime(lane), 1), fmt::format(fmt::runtime(lane), -1));
    const std::string lamp = FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies";
    std::ofstream(file) << fmt::format("fernlicht: 1\nroad: {}\nspeed_mps: 20\nduration_s: 1\nvariants: {{one: {{file: {}}}}}\n", road,
                                       lamp);
    if (cars > 0)
        std::ofstream(file, std::ios::app) << fmt::format(
            "traffic: {{row: {{file: {}, oncoming: {{gap_m: 40}}, speed_mps: 20, repeat: {{count: {}, every_m: 40}}}}}}\n", lamp, cars);
    Drive drive = read_drive(file);
    std::filesystem::remove(file);
    return drive;
}

void frame_with_traffic(benchmark::State& state) {
    static Device device = open_device("auto");
    Drive drive = oncoming(static_cast<int>(state.range(0)));
    const RoadNetwork network = read_opendrive(drive.road_file);
    std::filesystem::remove(drive.road_file);
    const Route route(network, drive.start, drive.via);
    place_traffic(drive, network, route);
    Scene scene = build_scene(network);
    FilesRead opened;
    add_road_users(scene, drive.traffic, opened);
    RendererSettings settings;
    settings.traffic_levels = state.range(1) != 0;
    Renderer renderer(device, scene, settings);
    const Moment moment = moment_at(start(drive), drive, route, drive.variants.front());
    const View view = drive.views.front();
    for (int warm_up = 0; warm_up < 2; ++warm_up)
        renderer.render(moment, view, {.colour = true});
    renderer.finish();
    for (auto _ : state) {
        renderer.render(moment, view, {.colour = true});
        renderer.finish();
    }
    const Work work = renderer.count(moment, view, {.colour = true});
    state.counters["full"] = work.traffic_full;
    state.counters["merged"] = work.traffic_merged;
    state.counters["vertex"] = work.traffic_by_vertex;
    state.counters["point"] = work.traffic_point;
    state.counters["faces"] = work.traffic_faces;
    state.counters["draws"] = work.draws;
}
BENCHMARK(frame_with_traffic)
    ->ArgNames({"cars", "levels"})
    ->Args({0, 1})
    ->Args({1, 1})
    ->Args({10, 1})
    ->Args({100, 1})
    ->Args({400, 1})
    ->Args({100, 0})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace
} // namespace fernlicht
