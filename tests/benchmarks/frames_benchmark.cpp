// A frame with 0 to 400 oncoming cars on 17 km of straight road, lamps, bodies and faces, one car each 40 m or 25 m. Run with
// --benchmark_filter=frame_with_traffic --benchmark_repetitions=21 --benchmark_enable_random_interleaving=true --benchmark_min_time=0.01.
// shadows: of these lamps; the own lamps' are there always. moving: each frame is the next of 16 a sixtieth of a second apart, in which all
// cars drive, so that no map stands already; else one moment.
// What is drawn is made once for each number of cars, so that rounds alternate between them quickly.
#include "renderer/renderer.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/traffic/road_user_mesh.h"
#include "tests/benchmarks/country_road.h"
#include "tests/trial.h"

#include <array>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <optional>
#include <tuple>

namespace fernlicht {
namespace {

constexpr int moving_frames = 16;
constexpr double frames_a_second = 60.0;

/// Two lanes, straight and level, with lines: OpenDRIVE in a file of its own.
std::filesystem::path straight_road(double length_m) {
    const auto lane = [](int id) {
        return fmt::format("<lane id=\"{}\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>"
                           "<roadMark sOffset=\"0\" type=\"solid\" width=\"0.12\"/></lane>",
                           id);
    };
    return tests::written("straight.xodr",
                          fmt::format(
                              R"(<OpenDRIVE><header revMajor="1" revMinor="6"/><road name="straight" length="{0}" id="1" junction="-1">
<planView><geometry s="0" x="0" y="0" hdg="0" length="{0}"><line/></geometry></planView>
<lanes><laneSection s="0"><left>{1}</left><center><lane id="0" type="none"/></center><right>{2}</right></laneSection></lanes></road></OpenDRIVE>)",
                              length_m, lane(1), lane(-1)));
}

/// Two lanes of 17 km and a row of cars that come, the first 40 m ahead.
Drive oncoming(int cars, int every_m) {
    const std::string lamp = library_path("lamps/halogen-low.ies");
    std::string text = fmt::format("fernlicht: 1\nroad: {}\nspeed_mps: 20\nduration_s: 1\nlamp_sets: {{one: {{file: {}}}}}\n",
                                   straight_road(17'000.0).string(), lamp);
    if (cars > 0)
        text += fmt::format("traffic: {{row: {{file: {}, oncoming: {{gap_m: 40}}, speed_mps: 20, repeat: {{count: {}, every_m: {}}}}}}}\n",
                            lamp, cars, every_m);
    return read_drive(tests::written("traffic.yaml", text));
}

/// All that is drawn, and who draws it; uploaded and compiled.
struct Stage {
    Stage(Device& device, int cars, int every_m, bool levels, bool shadows, bool moving) : drive(oncoming(cars, every_m)) {
        const RoadNetwork network = read_opendrive(drive.road_file);
        const Route route(network, drive.start, drive.via);
        place_traffic(drive, network, route);
        scene = build_scene(network);
        FilesRead opened;
        add_road_users(scene, drive.traffic, opened);
        renderer.emplace(device, scene, RendererSettings{.traffic_levels = levels, .traffic_shadows = shadows});
        for (int frame = 0; frame < (moving ? moving_frames : 1); ++frame) {
            const double time_s = frame / frames_a_second;
            moments.push_back(moment_at({frame, time_s, distance_m(drive.speed, time_s), 20.0}, drive, route, drive.lamp_sets.front()));
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
    ->Apply([](auto* frames) {
        const std::vector<std::int64_t> cases[] = {
            {0, 40, 1, 1, 0},   {1, 40, 1, 1, 0},   {10, 40, 1, 1, 0}, {100, 40, 1, 1, 0}, {400, 40, 1, 1, 0}, {100, 25, 1, 1, 0},
            {100, 40, 0, 1, 0}, {1, 40, 1, 0, 0},   {10, 40, 1, 0, 0}, {100, 40, 1, 0, 0}, {100, 25, 1, 0, 0}, {1, 40, 1, 1, 1},
            {10, 40, 1, 1, 1},  {100, 40, 1, 1, 1}, {1, 40, 1, 0, 1},  {10, 40, 1, 0, 1},  {100, 40, 1, 0, 1}};
        for (const std::vector<std::int64_t>& arguments : cases)
            frames->Args(arguments);
    }) -> Unit(benchmark::kMillisecond) -> MeasureProcessCPUTime() -> UseRealTime();

// A frame of a standard route, plain or dressed, or on another pavement: the mean over 12 moments spread over the drive. Run with
// --benchmark_filter=frame_(dressed|paved) --benchmark_repetitions=15 --benchmark_enable_random_interleaving=true
// --benchmark_min_time=0.25.

using Edits = decltype(DriveEdits::values);

struct RouteStage {
    RouteStage(Device& device, const char* name, const Edits& edits) : drive(read(name, edits)) {
        const RoadNetwork network = read_opendrive(drive.road_file);
        const Route route(network, drive.start, drive.via);
        scene = staged_scene(drive, network, route);
        constexpr int count = 12;
        State state = start(drive);
        for (int tick = 0, next = 0; next < count; ++tick, state = advance(state, drive))
            if (tick == next * tick_count(drive) / count) {
                moments.push_back(moment_at(state, drive, route, drive.lamp_sets.front()));
                ++next;
            }
        renderer.emplace(device, scene, RendererSettings{});
        renderer->prepare(moments, drive.views.front(), {.colour = true});
        draw();
    }
    static Drive read(const std::string& name, const Edits& values) {
        DriveEdits edits;
        edits.values = values;
        return read_drive(library_path("drives/" + name + ".yaml"), edits);
    }
    void draw() {
        for (const Moment& moment : moments)
            renderer->render(moment, drive.views.front(), {.colour = true});
        renderer->finish();
    }
    Drive drive;
    Scene scene;
    std::optional<Renderer> renderer;
    std::vector<Moment> moments;
};

void frame_dressed(benchmark::State& state) {
    static Device device = open_device("auto");
    static std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<RouteStage>> stages;
    static constexpr std::array<const char*, 5> routes{"straight", "s-bend", "country", "motorway", "village"};
    const char* const route = routes[static_cast<std::size_t>(state.range(0))];
    std::unique_ptr<RouteStage>& stage = stages[{state.range(0), state.range(1)}];
    if (!stage)
        stage = std::make_unique<RouteStage>(device, route, Edits{{"dressing", state.range(1) != 0 ? "dressed" : "plain"}});
    for (auto _ : state)
        stage->draw();
    std::size_t triangles = 0;
    for (const Mesh& mesh : stage->scene.meshes)
        triangles += mesh.indices.size() / 3;
    state.counters["triangles"] = static_cast<double>(triangles);
    state.SetLabel(route);
}
BENCHMARK(frame_dressed)
    ->ArgNames({"route", "dressed"})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void frame_paved(benchmark::State& state) {
    static Device device = open_device("auto");
    static std::map<std::int64_t, std::unique_ptr<RouteStage>> stages;
    static const std::array<Edits, 3> surfaces{
        Edits{}, Edits{{"road_surface.pavement", "asphalt-worn"}},
        Edits{{"road_surface.pavement", "asphalt-worn"}, {"road_surface.wheel_tracks", "true"}, {"road_surface.markings.type", "type-2"}}};
    std::unique_ptr<RouteStage>& stage = stages[state.range(0)];
    if (!stage)
        stage = std::make_unique<RouteStage>(device, "oncoming", surfaces[static_cast<std::size_t>(state.range(0))]);
    for (auto _ : state)
        stage->draw();
}
BENCHMARK(frame_paved)
    ->ArgName("surface") // plain; glossy; with tracks and beads
    ->DenseRange(0, 2)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// A frame on a road of 50 km against one of 1 km: what lies behind the horizon must cost nothing. Run with
// --benchmark_filter=frame_on --benchmark_repetitions=15 --benchmark_enable_random_interleaving=true.

void frame_on(benchmark::State& state) {
    static Device device = open_device("auto");
    const Scene scene = build_scene(read_opendrive(straight_road(static_cast<double>(state.range(0)) * 1000.0)));
    Moment moment = country_road().moment;
    const glm::dmat3 back = glm::transpose(moment.ego.axes); // to a car that stands at (20, -1.75) and looks along x
    const glm::dvec3 was = moment.ego.position_m, is(20.0, -1.75, 0.0);
    for (LitLamp& lamp : moment.lamps)
        lamp.pose = {is + back * (lamp.pose.position_m - was), back * lamp.pose.axes};
    moment.ego = {is, glm::dmat3(1.0)};
    Renderer renderer(device, scene, {});
    const View view = country_road().drive.views.front();
    for (int warm_up = 0; warm_up < 3; ++warm_up)
        renderer.render(moment, view, {.colour = true});
    renderer.finish();
    for (auto _ : state) {
        renderer.render(moment, view, {.colour = true});
        renderer.finish();
    }
    const Work work = renderer.count(moment, view, {.colour = true});
    state.counters["draws"] = work.draws;
    state.counters["triangles"] = static_cast<double>(work.triangles);
}
BENCHMARK(frame_on)->ArgName("km")->Arg(1)->Arg(3)->Arg(50)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

// The shipped set of six views against its first one, on the country road: pictures alone, nothing read but colour.
// `--benchmark_filter=views --benchmark_enable_random_interleaving=true --benchmark_repetitions=9` takes them in turns.

struct Road {
    Road() : drive(with_six_views()), network(read_opendrive(drive.road_file)), route(network, drive.start, drive.via) {
        scene = build_scene(network, {.seed = drive.seed});
        for (State state = start(drive); state.tick < tick_count(drive); state = advance(state, drive))
            if (state.tick % 25 == 0)
                moments.push_back(moment_at(state, drive, route, drive.lamp_sets[0]));
    }

    static Drive with_six_views() {
        return read_drive(tests::written(
            "six-views.yaml", "fernlicht: 1\nroad: " + library_path("roads/country.xodr") +
                                  "\nspeed_mps: 20\nduration_s: 20\nview_set: " + library_path("views/six.yaml") +
                                  "\nlamp_sets: {a: {source: filament, file: " + library_path("lamps/halogen-low.ies") + "}}\n"));
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
    const FrameOutputs colour{.colour = true};
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
