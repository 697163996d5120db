#include "tests/runner/sample_report.h"

#include "runner/findings/summary.h"
#include "runner/write/plots/png.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace fernlicht::tests {
namespace {

/// Two lamps 0.65 m above a plane road, 1.2 m apart, of Gaussian spread below a cut-off that rises towards the right.
struct MadeUpBeam {
    double peak_cd, spread_deg, depth_deg, aim_deg;

    double intensity_cd(double h_deg, double v_deg) const {
        const double cut_off_deg = aim_deg + std::max(0.0, std::min(h_deg, 8.0)) * 0.27;
        const double below_deg = cut_off_deg - v_deg;
        const double edge = 1.0 / (1.0 + std::exp(-below_deg / 0.12));
        return peak_cd * edge * std::exp(-std::pow(h_deg / spread_deg, 2.0)) * std::exp(-std::max(0.0, below_deg) / depth_deg);
    }
    double lux(double ahead_m, double left_m, Surface surface) const {
        double sum = 0.0;
        for (const double lamp_left_m : {0.6, -0.6}) {
            const double height_m = surface == Surface::road ? 0.65 : 0.40;
            const double beside_m = lamp_left_m - left_m, d2 = ahead_m * ahead_m + beside_m * beside_m + height_m * height_m;
            if (ahead_m <= 0.1)
                continue;
            const double h_deg = degrees(std::atan2(beside_m, ahead_m)),
                         v_deg = -degrees(std::atan2(height_m, std::hypot(ahead_m, beside_m)));
            const double facing = surface == Surface::road ? height_m / std::sqrt(d2) : 1.0;
            sum += intensity_cd(h_deg, v_deg) * facing / d2;
        }
        return sum;
    }
};

LaneExtent extent_of(const MadeUpBeam& beam, Surface surface, double threshold_lx, const std::string& lane, double centre_m) {
    LaneExtent extent;
    extent.threshold_lx = threshold_lx;
    extent.surface = surface;
    extent.lane = lane;
    extent.same_direction = lane != "left 1";
    const auto reach = [&](double left_m) {
        for (double ahead_m = 200.0; ahead_m > 0.0; ahead_m -= 0.5)
            if (beam.lux(ahead_m, left_m, surface) >= threshold_lx)
                return ahead_m;
        return 0.0;
    };
    extent.reach_centre_m = reach(centre_m);
    extent.reach_left_edge_m = reach(centre_m + 1.75);
    extent.reach_right_edge_m = reach(centre_m - 1.75);
    extent.reach_is_cut_off = extent.reach_centre_m >= 200.0;
    for (const double at_m : {20.0, 50.0}) {
        double left_m = 0.0, right_m = 0.0;
        while (left_m < 20.0 && beam.lux(at_m, left_m, surface) >= threshold_lx)
            left_m += 0.125;
        while (right_m > -20.0 && beam.lux(at_m, right_m, surface) >= threshold_lx)
            right_m -= 0.125;
        extent.widths.push_back({at_m, left_m, right_m, left_m - right_m});
    }
    for (double ahead_m = 1.0; ahead_m < 200.0; ahead_m += 2.0)
        for (double left_m = centre_m - 1.75; left_m < centre_m + 1.75; left_m += 0.5)
            extent.area_m2 += beam.lux(ahead_m, left_m, surface) >= threshold_lx ? 1.0 : 0.0;
    return extent;
}

ExtentRow extents_at(MadeUpBeam beam, int tick) {
    ExtentRow row{
        .tick = tick, .time_s = 0.1 * tick, .distance_m = 2.0 * tick, .rendered = {}, .twin = {}, .grid_errors = {}, .nudged = {}};
    beam.aim_deg += 0.12 * std::sin(0.25 * tick) * std::exp(-0.02 * tick); // the car nods
    for (const Surface surface : {Surface::road, Surface::target})
        for (const double threshold_lx : {1.0, 3.0, 5.0, 10.0}) {
            for (const auto& [lane, centre_m] : {std::pair<const char*, double>{"own", 0.0}, {"left 1", 3.5}}) {
                row.rendered.push_back(extent_of(beam, surface, threshold_lx, lane, centre_m));
                row.twin.push_back(row.rendered.back());
                row.twin.back().reach_centre_m += 0.2 * std::sin(1.7 * tick + threshold_lx);
            }
            const auto moved = [&](double by_m) {
                LaneExtent extent = row.nudged.as_is.back();
                extent.reach_centre_m += by_m / std::sqrt(threshold_lx);
                return extent;
            };
            row.nudged.as_is.push_back(extent_of(beam, surface, threshold_lx, "own", 0.0));
            for (std::size_t kind = 0; const double by_m : {8.0, -8.0, 1.1, -1.1})
                row.nudged.nudged[kind++].push_back(moved(by_m));
            row.grid_errors.push_back({threshold_lx, surface, "own", 0.25});
            row.grid_errors.push_back({threshold_lx, surface, "all", {}, {}, {}, 1.5});
        }
    return row;
}

LuxMap map_of(const MadeUpBeam& beam, int tick) {
    LuxMap map;
    map.ahead_m = 100.0;
    map.behind_m = 5.0;
    map.left_m = map.right_m = 20.0;
    map.lx = Image<float>(160, 420);
    for (int y = 0; y < map.lx.height(); ++y)
        for (int x = 0; x < map.lx.width(); ++x)
            map.lx.at(x, y) = static_cast<float>(beam.lux(100.0 - (y + 0.5) * 0.25 - 3.6, 20.0 - (x + 0.5) * 0.25, Surface::road));
    const auto bend_m = [&](double ahead_m) { return 0.002 * std::sin(0.05 * tick) * ahead_m * ahead_m; };
    for (const auto& [kind, left_m] :
         {std::pair<const char*, double>{"lane edge", 5.25}, {"lane edge", 1.75}, {"lane edge", -1.75}, {"road edge", -2.5}}) {
        LuxMap::Polyline edge{kind, {}};
        for (double ahead_m = -5.0; ahead_m <= 100.0; ahead_m += 2.5)
            edge.ahead_left_m.emplace_back(ahead_m, left_m + bend_m(ahead_m));
        map.edges.push_back(edge);
    }
    map.tick = tick;
    map.time_s = 0.1 * tick;
    return map;
}

PlayedCell played_with(const std::string& name, const MadeUpBeam& beam, int moments) {
    PlayedCell played;
    played.drive = "country road";
    played.lamp_set = name;
    played.lamps = {{"left", name + "-low.ies"}, {"right", name + "-low.ies"}};
    played.ticks_planned = played.ticks_done = moments;
    played.warm_up_dropped = 3;
    PassTime frame{"frame", {}}, shadow{"shadow", {}};
    for (int tick = 0; tick < moments; ++tick) {
        played.extents.push_back(extents_at(beam, tick));
        played.speed_mps.emplace_back(0.1 * tick, 20.0 + 3.0 * std::sin(0.05 * tick));
        frame.seconds.push_back(0.031 + 0.004 * std::abs(std::sin(12.9898 * tick)) + (tick % 37 == 5 ? 0.02 : 0.0));
        shadow.seconds.push_back(0.006 + 0.001 * std::abs(std::sin(78.233 * tick)));
        if (tick % 5 == 0) {
            played.maps.push_back(map_of(beam, tick));
            for (const char* const view : {"driver", "bumper"})
                played.frames.push_back({tick, 0.1 * tick, view, fmt::format("frames/{}-{}-{:05}.png", name, view, tick), ""});
        }
    }
    ExtentParameters parameters;
    parameters.ahead_m = 250.0; // beyond all reaches
    played.extent_summaries = summarise_extents(played, parameters);
    played.passes = {frame, shadow};
    played.readings = {{key_of("reach_5lx_road_own_m").value(), extents_at(beam, 0).rendered[4].reach_centre_m, "own lane, centre"},
                       {key_of("probe_wall_lx").value(), beam.lux(25.0, 0.0, Surface::target), "wall, 25 m ahead", 0},
                       {key_of("glare_own_time_above_1lx_s").value(), Value::not_measured("nobody came towards the car")}};
    played.verdicts = {{VerdictKind::pass, "reach_1lx_road_own_m", "28.0 m, limit at least 25 m", ""}};
    played.left_out = {"Sun: it is night.", "Second lamp pair: none is mounted."};
    played.notes = {"Nearer than 3 m the lamps are not point sources; 2.1 % of the map is marked near-field."};
    return played;
}

plots::Colour seen(const MadeUpBeam& beam, double right_deg, double up_deg) {
    if (up_deg >= -0.2)
        return {3, 4, 9};
    const double ahead_m = 1.2 / std::tan(radians(-up_deg)), left_m = -ahead_m * std::tan(radians(right_deg));
    const bool marking = std::abs(std::abs(left_m) - 1.75) < 0.07;
    const double luminance = beam.lux(ahead_m, left_m, Surface::road) * (marking ? 0.1 : 0.02);
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(std::min(1.0, luminance * 0.8), 1.0 / 2.2)));
    return {grey, grey, static_cast<std::uint8_t>(grey * 0.9)};
}

const MadeUpBeam halogen{24000.0, 14.0, 3.0, -0.573}, xenon{42000.0, 19.0, 2.6, -0.573};

} // namespace

void write_sample_frames(const Report& report, const std::filesystem::path& folder) {
    for (const PlayedCell& played : report.played)
        for (const StoredFrame& frame : played.frames) {
            Image<plots::Colour> pixels(320, 180);
            for (int y = 0; y < pixels.height(); ++y)
                for (int x = 0; x < pixels.width(); ++x)
                    pixels.at(x, y) = seen(played.lamp_set == "xenon" ? xenon : halogen, (x - 159.5) * 0.12, (70.0 - y) * 0.12);
            std::filesystem::create_directories((folder / frame.png).parent_path());
            write_file(folder / frame.png, plots::png_of_pixels(pixels));
        }
}

SeeingSeries sample_seeing() {
    return {"glare_eye",
            "Oncoming driver",
            "distance to the observer",
            {0, 1},
            {30.0, 20.0},
            {{"facing_lx", "facing illuminance", "lx", true, true, {0.5, 1.25}},
             {"de_boer", "de Boer's rating", "", false, true, {Value::not_measured("no light"), Value::at_least(4.0)}},
             {"theta_left_deg", "angle of left", "deg", false, false, {1.0, 2.0}}}};
}

Report sample_report(int moments) {
    Report report;
    report.context.versions = {{"fernlicht", "0.1.0"}, {"compiler", "g++ 12.2.0"}, {"Mesa", "22.3.6"}};
    report.context.backend = "egl";
    report.context.gl_renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    report.context.gl_version = "4.5 (Core Profile) Mesa 22.3.6";
    report.context.cpu = "made-up CPU, 8 cores";
    report.context.os = "Debian GNU/Linux 12 (bookworm)";
    report.context.command = "fernlicht run 'drives/country road.yaml' --out out/sample";
    report.context.started_utc = "2024-11-21T19:30:00Z";
    report.context.inputs = {{"drives/country road.yaml", 1834, "0123456789abcdef0123456789abcdef"},
                             {"lamps/halogen-low.ies", 48213, "fedcba9876543210fedcba9876543210"}};
    report.played.push_back(played_with("halogen", halogen, moments));
    report.played.push_back(played_with("xenon", xenon, moments));
    report.played[0].verdicts.push_back({VerdictKind::fail, "reach_5lx_road_own_m", "13.5 m, limit at least 15 m",
                                         "fernlicht run 'drives/country road.yaml' --frames 0:1"});
    report.played[1].verdicts.push_back({VerdictKind::pass, "reach_5lx_road_own_m", "17.5 m, limit at least 15 m", ""});
    return report;
}

TEST(SampleReport, IsPlausible) {
    const Report report = sample_report(2);
    ASSERT_EQ(report.played.size(), 2U);
    for (const PlayedCell& played : report.played) {
        const LaneExtent& own_5lx = played.extents[0].rendered[4];
        EXPECT_EQ(own_5lx.threshold_lx, 5.0);
        EXPECT_GT(own_5lx.reach_centre_m, 10.0);
        EXPECT_LT(own_5lx.reach_centre_m, 60.0);
        EXPECT_GT(own_5lx.area_m2, 20.0);
    }
}

} // namespace fernlicht::tests
