// Whole drives with pictures that are made up: order, errors, memory, and techniques that compute no illuminance.
#include "runner/commands/run_files.h"
#include "runner/findings/summary.h"
#include "runner/judge/limits.h"
#include "runner/play/frame_times.h"
#include "runner/play/lux_map.h"
#include "runner/play/play.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <malloc.h>
#include <new>

namespace {

/// Bytes in live blocks of at least 64 KiB: pictures and grids, none of the small rows.
std::atomic<std::size_t> large_bytes{0}, max_large_bytes{0};
constexpr std::size_t large = std::size_t{64} << 10;

void* counted(std::size_t bytes, const std::nothrow_t&) noexcept {
    void* const block = std::malloc(bytes > 0 ? bytes : 1);
    if (const std::size_t size = block ? malloc_usable_size(block) : 0; size >= large) {
        const std::size_t now = large_bytes += size;
        for (std::size_t most = max_large_bytes; now > most && !max_large_bytes.compare_exchange_weak(most, now);) {
        }
    }
    return block;
}

void* counted(std::size_t bytes) {
    void* const block = counted(bytes, std::nothrow);
    if (!block)
        throw std::bad_alloc();
    return block;
}

void freed(void* block) {
    if (const std::size_t size = block ? malloc_usable_size(block) : 0; size >= large)
        large_bytes -= size;
    std::free(block);
}

} // namespace

void* operator new(std::size_t bytes) { return counted(bytes); }
void* operator new[](std::size_t bytes) { return counted(bytes); }
// Also those that do not throw, which std::stable_sort asks: under AddressSanitizer they are its own, and their blocks are not malloc's.
void* operator new(std::size_t bytes, const std::nothrow_t& quiet) noexcept { return counted(bytes, quiet); }
void* operator new[](std::size_t bytes, const std::nothrow_t& quiet) noexcept { return counted(bytes, quiet); }
void operator delete(void* block) noexcept { freed(block); }
void operator delete[](void* block) noexcept { freed(block); }
void operator delete(void* block, std::size_t) noexcept { freed(block); }
void operator delete[](void* block, std::size_t) noexcept { freed(block); }

namespace fernlicht {
namespace {

/// The straight with a small grid, 10 moments a second.
struct Played {
    Drive drive = read_drive(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/drives/straight.yaml", {});
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};

    Played() {
        drive.extent->ahead_m = 30.0;
        drive.extent->beside_m = 6.0;
        drive.duration_s = 1000.0;
        drive.capture.exr = drive.capture.png = false;
        drive.probes = {{"near", 10.0, 0.0, 0.0}};
        for (View& view : drive.views)
            view.width_px = view.height_px = 256;
    }
    PlayedCell play_with(const Draw& draw, int moments, Writers& writers, const std::filesystem::path& folder = {}) const {
        return play(drive, route, drive.lamp_sets.front(), PlayOptions{.ticks = {0, moments - 1}, .folder = folder}, draw, writers);
    }
};

/// Everything that is wanted, lit evenly.
Frame even(const View& view, const FrameOutputs& outputs, float lx) {
    Frame frame{.cpu_s = 0.01};
    const auto lit = [&](bool asked) { return asked ? Image<float>(view.width_px, view.height_px, lx) : Image<float>(); };
    frame.illuminance_lx = lit(outputs.illuminance);
    frame.target_lx = lit(outputs.target);
    frame.luminance_cdm2 = lit(outputs.luminance);
    frame.depth_m = lit(outputs.depth);
    if (outputs.colour)
        frame.colour = Image<Rgb8>(view.width_px, view.height_px);
    return frame;
}

Draw evenly(float lx) {
    return [lx](const Moment&, const View& view, const FrameOutputs& outputs) -> Pending {
        return [&view, outputs, lx] { return even(view, outputs, lx); };
    };
}

/// A technique that believes in no illuminance; with `road` in that of surfaces only.
Draw without_lux(bool road) {
    return [road](const Moment&, const View& view, FrameOutputs outputs) -> Pending {
        outputs.illuminance = outputs.illuminance && road;
        outputs.target = false;
        return [&view, outputs] { return even(view, outputs, 20.0F); };
    };
}

const Reading& reading_named(const Readings& readings, const std::string& name) {
    const auto found = std::ranges::find(readings, key_of(name), &Reading::key);
    if (found == readings.end())
        throw std::out_of_range(name);
    return *found;
}

TEST(PlayLoop, MeasuresEveryMomentInOrder) {
    const Played stage;
    Writers writers;
    const PlayedCell played = stage.play_with(evenly(20.0F), 25, writers);
    ASSERT_EQ(played.extents.size(), 25U);
    for (int tick = 0; tick < 25; ++tick) {
        const ExtentRow& row = played.extents[static_cast<std::size_t>(tick)];
        EXPECT_EQ(row.tick, tick);
        EXPECT_TRUE(row.rendered.front().reach_is_cut_off) << "lit with 20 lx as far as was looked";
        EXPECT_FALSE(row.twin.empty());
    }
    EXPECT_EQ(played.throughput.moments, 22);
    EXPECT_GT(*played.throughput.moments_per_s(), 0.0);
    EXPECT_NEAR(*played.throughput.view_s, 0.01, 1e-12);
    EXPECT_GT(played.throughput.peak_memory_mib, 1.0);
}

TEST(PlayLoop, WithoutTimesNoPictureIsDrawnThatNobodyStores) {
    const Played stage;
    std::map<std::string, int> drawn;
    const Draw counted = [&](const Moment& moment, const View& view, const FrameOutputs& outputs) {
        ++drawn[view.name];
        return evenly(20.0F)(moment, view, outputs);
    };
    Writers writers;
    PlayOptions options{.ticks = {0, 24}};
    const auto play_counted = [&] {
        drawn.clear();
        play(stage.drive, stage.route, stage.drive.lamp_sets.front(), options, counted, writers);
    };
    play_counted();
    EXPECT_EQ(drawn, (std::map<std::string, int>{{"driver", 25}, {"map", 5}, {"extent", 25}, {"probe", 25}}));
    options.no_times = "others beside it";
    play_counted();
    EXPECT_EQ(drawn, (std::map<std::string, int>{{"driver", 5}, {"map", 5}, {"extent", 25}, {"probe", 25}})) << "two are stored a second";
}

TEST(PlayLoop, StopsAtTheMomentThatWasAskedForAndKeepsWhatWasMeasured) {
    const Played stage;
    Writers writers;
    PlayOptions options{.go_on = [](int done) { return done < 7; }};
    const PlayedCell played = play(stage.drive, stage.route, stage.drive.lamp_sets.front(), options, evenly(20.0F), writers);
    EXPECT_EQ(played.ticks_done, 7);
    EXPECT_EQ(played.extents.size(), 7U);
}

TEST(PlayLoop, ThrowsWhatMeasuringThrewElsewhere) {
    const Played stage;
    Writers writers;
    EXPECT_THROW(stage.play_with(evenly(std::numeric_limits<float>::quiet_NaN()), 4, writers), std::invalid_argument);
    const Draw failing = [](const Moment& moment, const View& view, const FrameOutputs& outputs) -> Pending {
        if (moment.tick == 3)
            throw std::runtime_error("device lost");
        return [&view, outputs] { return even(view, outputs, 20.0F); };
    };
    EXPECT_THROW(stage.play_with(failing, 9, writers), std::runtime_error);
}

TEST(PlayLoop, HoldsAsManyPicturesForALongDriveAsForAShortOne) {
    Played stage;
    stage.drive.capture.all = stage.drive.capture.exr = true; // 256 KiB a picture and more than one picture a moment
    const TemporaryFolder folder;
    const auto max_bytes = [&](int moments) {
        Writers writers;
        const std::size_t before = large_bytes;
        max_large_bytes = before;
        const PlayedCell played = stage.play_with(evenly(20.0F), moments, writers, folder.path());
        EXPECT_EQ(played.frames.size(), static_cast<std::size_t>(moments) * stage.drive.views.size());
        EXPECT_EQ(played.maps.size(), max_pictured_moments);
        return max_large_bytes - before;
    };
    const std::size_t few = max_bytes(40), many = max_bytes(160);
    EXPECT_GT(few, std::size_t{3} << 20) << "twelve maps at least";
    // A map each of 120 more moments would be 30 MiB. What is waiting to be written or measured differs by a few pictures.
    EXPECT_LT(many, few + (std::size_t{15} << 20));
}

TEST(PlayLoop, KeepsTheMapsThatThePageShowsAndOthersInCaseOfAnInterruption) {
    LuxMaps all(100), some(100);
    const auto map_at = [](int tick) { return [tick] { return LuxMap{.tick = tick}; }; };
    for (int i = 0; i < 100; ++i)
        all.add(static_cast<std::size_t>(i), map_at(i));
    for (int i = 0; i < 20; ++i)
        some.add(static_cast<std::size_t>(i), map_at(i));
    std::vector<int> ticks;
    for (const LuxMap& map : all.finish(true))
        ticks.push_back(map.tick);
    EXPECT_EQ(ticks, (std::vector<int>{0, 9, 18, 27, 36, 45, 54, 63, 72, 81, 90, 99})); // i * 99 / 11
    const std::vector<LuxMap> interrupted = some.finish(false);
    EXPECT_GE(interrupted.size(), 10U);
    EXPECT_LE(interrupted.size(), 2 * max_pictured_moments);
}

TEST(FrameTimes, ComeFromMomentsThatWereDrawnAlone) {
    FrameTimes times(3, false);
    std::vector<int> alone;
    for (int k = 0; k < 30; ++k) {
        const bool stored = k % 6 == 0; // 6, 12, 18, 24 after the warm-up
        if (times.begin_moment(stored ? "frame, stored" : "frame"))
            alone.push_back(k);
        Frame frame{.cpu_s = stored ? 0.5 : 0.1};
        times.add(stored ? "frame, stored" : "frame", frame);
        frame.cpu_s = 0.05;
        times.add(frame);
        times.end_moment();
    }
    EXPECT_EQ(alone, (std::vector<int>{3, 6, 13, 18, 23}));
    PlayedCell played;
    times.finish(played);
    ASSERT_EQ(played.passes.size(), 2U);
    EXPECT_EQ(played.passes[0].seconds, (std::vector<double>{0.1, 0.1, 0.1}));
    EXPECT_EQ(played.passes[1].seconds, (std::vector<double>{0.5, 0.5}));
    EXPECT_EQ(played.warm_up_dropped, 3);
    EXPECT_EQ(played.throughput.moments, 27);
    EXPECT_NEAR(*played.throughput.view_s, 0.1, 1e-12);
    EXPECT_NEAR(*played.throughput.drawing_s, (4 * 0.55 + 23 * 0.15) / 27.0, 1e-12);
}

TEST(FrameTimes, OfTooFewMomentsAreNotMeasured) {
    FrameTimes times(3, false);
    times.begin_moment("frame");
    times.end_moment();
    PlayedCell played;
    times.finish(played);
    EXPECT_EQ(played.warm_up_dropped, 1);
    EXPECT_FALSE(played.throughput.view_s || played.throughput.drawing_s || played.throughput.moments_per_s());
}

TEST(TechniqueWithoutIlluminance, LeavesEveryReadingFromItNotMeasured) {
    Played stage;
    stage.drive.technique = "merged-beams";
    stage.drive.limits = {{"reach_1lx_road_own_m", 10.0, {}}, {"probe_near_lx", {}, 1000.0}, {"probe_near_twin_lx", {}, 1000.0}};
    Writers writers;
    PlayedCell played = stage.play_with(without_lux(false), 5, writers);
    const std::string why = "technique merged-beams does not compute an illuminance";
    EXPECT_TRUE(played.maps.empty());
    ASSERT_EQ(played.extents.size(), 5U);
    EXPECT_TRUE(played.extents[0].rendered.empty());
    EXPECT_FALSE(played.extents[0].twin.empty());
    Readings readings = played.readings;
    played.extent_summaries = summarise_extents(played, *stage.drive.extent);
    std::ranges::copy(extent_readings(played), std::back_inserter(readings));
    for (const char* name :
         {"probe_near_lx", "probe_near_min_lx", "probe_near_max_lx", "reach_1lx_road_own_m", "reach_5lx_target_all_p05_m",
          "width_3lx_road_own_at_20m_m", "area_10lx_target_all_m2", "reach_1lx_road_own_twin_difference_m",
          "reach_1lx_road_own_left_edge_m", "unlit_before_reach_1lx_road_own_m"}) {
        EXPECT_FALSE(reading_named(readings, name).value.measured()) << name;
        EXPECT_EQ(reading_named(readings, name).value.reason(), why) << name;
    }
    EXPECT_TRUE(reading_named(readings, "probe_near_twin_lx").value.measured()) << "the twin draws nothing";
    const std::vector<Verdict> verdicts = judge_limits(stage.drive, readings);
    ASSERT_EQ(verdicts.size(), 3U);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::not_measured);
    EXPECT_EQ(verdicts[1].kind, VerdictKind::not_measured);
    EXPECT_EQ(verdicts[2].kind, VerdictKind::pass);
    const bool has_map = std::ranges::any_of(stage.drive.views, [](const View& view) { return view.projection == Projection::map; });
    EXPECT_EQ(has_map, !played.notes.empty());
    Report report{.played = {played}};
    report.played[0].readings = readings;
    const TemporaryFolder folder;
    write_report(report, folder.path()); // no picture is missed
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "report.html"));
}

TEST(TechniqueWithoutIlluminance, MayKnowTheSurfaceAndNotTargets) {
    const Played stage;
    Writers writers;
    PlayedCell played = stage.play_with(without_lux(true), 4, writers);
    played.extent_summaries = summarise_extents(played, *stage.drive.extent);
    const Readings readings = extent_readings(played);
    EXPECT_TRUE(reading_named(readings, "area_1lx_road_own_m2").value.measured() ||
                reading_named(readings, "area_1lx_road_own_m2").value.reason().find("technique") == std::string::npos);
    EXPECT_NE(reading_named(readings, "area_1lx_target_own_m2").value.reason().find("does not compute the illuminance of targets"),
              std::string::npos);
    for (const LaneExtent& extent : played.extents[0].rendered)
        EXPECT_EQ(extent.surface, Surface::road);
}

} // namespace
} // namespace fernlicht
