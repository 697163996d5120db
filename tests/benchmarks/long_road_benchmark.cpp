// A frame on a road of 50 km against one of 1 km: what lies behind the horizon must cost nothing. Run with
// --benchmark_filter=frame_on --benchmark_repetitions=15 --benchmark_enable_random_interleaving=true.
#include "renderer/renderer.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/benchmarks/country_road.h"

#include <benchmark/benchmark.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace fernlicht {
namespace {

/// Two lanes, straight and level, with lines: OpenDRIVE in a file of its own.
RoadNetwork straight_road(double length_m) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / fmt::format("fernlicht-straight-{:.0f}.xodr", length_m);
    const char* lane =
        R"(<lane id="{}" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/><roadMark sOffset="0" type="solid" width="0.12"/></lane>)";
    std::ofstream(file) << fmt::format(
        R"(<OpenDRIVE><header revMajor="1" revMinor="6"/><road name="straight" length="{0}" id="1" junction="-1">
<planView><geometry s="0" x="0" y="0" hdg="0" length="{0}"><line/></geometry></planView>
<lanes><laneSection s="0"><left>{1}</left><center><lane id="0" type="none"/></center><right>{2}</right></laneSection></lanes></road></OpenDRIVE>)",
        length_m, fmt::format(fmt::runtime(lane), 1), fmt::format(fmt::runtime(lane), -1));
    RoadNetwork network = read_opendrive(file);
    std::filesystem::remove(file);
    return network;
}

void frame_on(benchmark::State& state) {
    static Device device = open_device("auto");
    const Scene scene = build_scene(straight_road(static_cast<double>(state.range(0)) * 1000.0));
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

} // namespace
} // namespace fernlicht
