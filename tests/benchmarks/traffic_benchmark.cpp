// A frame with 0 to 400 oncoming cars on 17 km of straight road, lamps, bodies and faces, one car each 40 m or 25 m. Run with
// --benchmark_filter=frame_with_traffic --benchmark_repetitions=21 --benchmark_enable_random_interleaving=true --benchmark_min_time=0.01.
// shadows: of these lamps; the own lamps' are there always. moving: each frame is the next of 16 a sixtieth of a second apart, in which all
// cars drive, so that no map stands already; else one moment.
// What is drawn is made once for each number of cars, so that rounds alternate between them quickly.
#include "renderer/renderer.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/traffic/road_user_mesh.h"

#include <benchmark/benchmark.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <unistd.h>

namespace fernlicht {
namespace {

constexpr int moving_frames = 16;
constexpr double frames_a_second = 60.0;

/// Two lanes of 17 km and a row of cars that come, the first 40 m ahead.
Drive oncoming(int cars, int every_m) {
    const auto folder = std::filesystem::temp_directory_path();
    const std::string road = (folder / fmt::format("fernlicht-traffic-{}.xodr", ::getpid())).string(),
                      file = (folder / fmt::format("fernlicht-traffic-{}.yaml", ::getpid())).string();
    const char* lane =
        R"(<lane id="{}" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/><roadMark sOffset="0" type="solid" width="0.12"/></lane>)";
    std::ofstream(road) << fmt::format(
        R"(<OpenDRIVE><header revMajor="1" revMinor="6"/><road name="straight" length="17000" id="1" junction="-1">
<planView><geometry s="0" x="0" y="0" hdg="0" length="17000"><line/></geometry></planView>
<lanes><laneSection s="0"><left>{}</left><center><lane id="0" type="none"/></center><right>{}</right></laneSection></lanes></road></OpenDRIVE>)",
        fmt::format(fmt::runtime(lane), 1), fmt::format(fmt::runtime(lane), -1));
    const std::string lamp = FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies";
    std::ofstream(file) << fmt::format("fernlicht: 1\nroad: {}\nspeed_mps: 20\nduration_s: 1\nvariants: {{one: {{file: {}}}}}\n", road,
                                       lamp);
    if (cars > 0)
        std::ofstream(file, std::ios::app) << fmt::format(
            "traffic: {{row: {{file: {}, oncoming: {{gap_m: 40}}, speed_mps: 20, repeat: {{count: {}, every_m: {}}}}}}}\n", lamp, cars,
            every_m);
    Drive drive = read_drive(file);
    std::filesystem::remove(file);
    return drive;
}

/// All that is drawn, and who draws it; uploaded and compiled.
struct Stage {
    Stage(Device& device, int cars, int every_m, bool levels, bool shadows, bool moving) : drive(oncoming(cars, every_m)) {
        const RoadNetwork network = read_opendrive(drive.road_file);
        std::filesystem::remove(drive.road_file);
        const Route route(network, drive.start, drive.via);
        place_traffic(drive, network, route);
        scene = build_scene(network);
        FilesRead opened;
        add_road_users(scene, drive.traffic, opened);
        renderer.emplace(device, scene, RendererSettings{.traffic_levels = levels, .traffic_shadows = shadows});
        for (int frame = 0; frame < (moving ? moving_frames : 1); ++frame) {
            const double time_s = frame / frames_a_second;
            moments.push_back(moment_at({frame, time_s, distance_m(drive.speed, time_s), 20.0}, drive, route, drive.variants.front()));
        }
        renderer->prepare(moments, drive.views.front(), {.colour = true});
        for (int warm_up = 0; warm_up < 2; ++warm_up)
            draw();
    }
    const Moment& next() { return moments[drawn++ % moments.size()]; }
    void draw() {
        renderer->render(next(), drive.views.front(), {.colour = true});
        renderer->finish();
    }

    Drive drive;
    Scene scene;
    std::optional<Renderer> renderer;
    std::vector<Moment> moments;
    std::size_t drawn = 0;
};

void frame_with_traffic(benchmark::State& state) {
    static Device device = open_device("auto");
    static std::map<std::tuple<int, int, bool, bool, bool>, std::unique_ptr<Stage>> stages;
    const auto arg = [&](std::size_t i) { return static_cast<int>(state.range(i)); };
    std::unique_ptr<Stage>& stage = stages[{arg(0), arg(1), arg(2) != 0, arg(3) != 0, arg(4) != 0}];
    if (!stage)
        stage = std::make_unique<Stage>(device, arg(0), arg(1), arg(2) != 0, arg(3) != 0, arg(4) != 0);
    stage->draw(); // caches are another number of cars'
    for (auto _ : state)
        stage->draw();
    const Work work = stage->renderer->count(stage->moments.front(), stage->drive.views.front(), {.colour = true});
    state.counters["full"] = work.traffic_full;
    state.counters["merged"] = work.traffic_merged;
    state.counters["vertex"] = work.traffic_by_vertex;
    state.counters["point"] = work.traffic_point;
    state.counters["faces"] = work.traffic_faces;
    state.counters["maps"] = work.shadow_maps;
    state.counters["draws"] = work.draws;
    state.counters["triangles"] = static_cast<double>(work.triangles);
}
BENCHMARK(frame_with_traffic)
    ->ArgNames({"cars", "every_m", "levels", "shadows", "moving"})
    ->Args({0, 40, 1, 1, 0})
    ->Args({1, 40, 1, 1, 0})
    ->Args({10, 40, 1, 1, 0})
    ->Args({100, 40, 1, 1, 0})
    ->Args({400, 40, 1, 1, 0})
    ->Args({100, 25, 1, 1, 0})
    ->Args({100, 40, 0, 1, 0})
    ->Args({1, 40, 1, 0, 0})
    ->Args({10, 40, 1, 0, 0})
    ->Args({100, 40, 1, 0, 0})
    ->Args({100, 25, 1, 0, 0})
    ->Args({1, 40, 1, 1, 1})
    ->Args({10, 40, 1, 1, 1})
    ->Args({100, 40, 1, 1, 1})
    ->Args({1, 40, 1, 0, 1})
    ->Args({10, 40, 1, 0, 1})
    ->Args({100, 40, 1, 0, 1})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace
} // namespace fernlicht
