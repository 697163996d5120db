// Cars of one series over a drive: what varies reaches the readings, and nothing else does.
#include "metrics/folds/seeing_fold.h"
#include "runner/play/series_play.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

const ReadingKey eye_key = key_of("glare_opposite_facing_max_lx").value(), reach_key = key_of("reach_5lx_target_own_m").value();

Stage series_stage(const ToleranceParameters& tolerances) {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/straight.yaml");
    drive.lamp_sets.resize(1);
    drive.extent->thresholds_lx = {5.0};
    drive.extent->ahead_m = 120.0;
    drive.extent->cell_m = 1.0;
    drive.seeing = {};
    drive.seeing.glare.emplace().oncoming = {{"opposite", 100.0, 1.1, 0.0}};
    drive.seeing.tolerances = tolerances;
    return Stage(std::move(drive));
}

/// None varies.
ToleranceParameters no_tolerances() {
    ToleranceParameters none;
    const Tolerance exactly{.from = {}, .to = {}, .source = {}};
    none.pitch_deg = none.yaw_deg = none.roll_deg = none.flux_percent = none.height_mm = exactly;
    none.cars = 24;
    none.draws = 4000;
    return none;
}

constexpr TickRange played_ticks{0, 100};

/// As the drive would be played, by the twin.
SeriesFindings series_of(const ToleranceParameters& tolerances, const std::vector<ReadingKey>& keys) {
    const Stage stage = series_stage(tolerances);
    const Draw none = [](const Moment&, const View&, const FrameOutputs&) -> Pending { return [] { return Frame{}; }; };
    const auto go_on = [](std::size_t, std::size_t) { return true; };
    Readings played;
    for (const ReadingKey& key : keys)
        played.push_back({key, Value(1000.0)});
    return play_series(stage.drive, stage.route, stage.drive.lamp_sets[0], played_ticks, played, none, go_on);
}

/// Of the car as designed, by the fold alone.
double lux_at_eye() {
    const Stage stage = series_stage(no_tolerances());
    const LampSet& lamp_set = stage.drive.lamp_sets[0];
    SeeingFold fold(stage.drive, stage.route);
    State state = start(stage.drive);
    for (int tick = 0; tick < ticks_to_play(stage.drive, played_ticks); ++tick, state = advance(state, stage.drive))
        fold.add(moment_at(state, stage.drive, stage.route, lamp_set), lamp_set);
    for (const Reading& reading : fold.readings())
        if (reading.key == eye_key)
            return reading.value.number().value();
    return 0.0;
}

const ReadingOfCars& car_reading(const SeriesFindings& found, const ReadingKey& key) {
    return *std::ranges::find(found.readings, key, &ReadingOfCars::key);
}

TEST(SeriesPlay, CarsThatDifferInNothingReadWhatTheCarAsDesignedDoes) {
    const SeriesFindings found = series_of(no_tolerances(), {eye_key, reach_key});
    EXPECT_TRUE(found.parts.empty());
    for (const ReadingOfCars& reading : found.readings) {
        EXPECT_EQ(reading.p05, Value(1000.0));
        EXPECT_EQ(reading.p95, Value(1000.0));
    }
}

TEST(SeriesPlay, FluxOfTwoLampsAveragesInAnEye) {
    ToleranceParameters tolerances = no_tolerances();
    tolerances.flux_percent = Tolerance{.sigma = 4.0, .from = {}, .to = {}, .source = {}};
    const SeriesFindings found = series_of(tolerances, {eye_key});
    const ReadingOfCars& glare = car_reading(found, eye_key);
    EXPECT_EQ(found.parts.size(), 2U);
    EXPECT_TRUE(glare.by_slopes);
    EXPECT_LT(glare.slope_error.value(), 1e-9) << "illuminance is linear in the flux of each lamp";
    ASSERT_EQ(glare.variance_shares.size(), 2U);
    EXPECT_NEAR(glare.variance_shares[0] + glare.variance_shares[1], 1.0, 1e-12);
    // w of the light from one lamp: the spread is sigma sqrt(w^2 + (1 - w)^2), and the shares of the variance tell w.
    const double root = std::sqrt(glare.variance_shares[0] / glare.variance_shares[1]), w = root / (1.0 + root);
    const double light = (glare.p95.number().value() - glare.p05.number().value()) / (2.0 * 1.6449 * 0.04 * std::hypot(w, 1.0 - w));
    EXPECT_NEAR(light, lux_at_eye(), 0.05 * lux_at_eye()) << "what the quantiles of 4000 cars leave";
}

TEST(SeriesPlay, PitchMovesReachAndGlareOfTheSameCarsAlike) {
    ToleranceParameters tolerances = no_tolerances();
    tolerances.pitch_deg = Tolerance{.sigma = 0.1, .from = {}, .to = {}, .source = {}};
    const SeriesFindings found = series_of(tolerances, {eye_key, reach_key});
    EXPECT_GT(car_reading(found, reach_key).spread.value(), 0.5);
    EXPECT_GT(car_reading(found, eye_key).spread.value(), 0.0);
    EXPECT_GT(car_reading(found, reach_key).p95.low(), 1000.0) << "the higher half reaches farther";
    EXPECT_LT(car_reading(found, reach_key).p05.high(), 1000.0);
    tolerances.pitch_deg->source = "end of line";
    tolerances.height_mm = Tolerance{.from = -20.0, .to = 20.0, .source = {}};
    const SeriesFindings again = series_of(tolerances, {eye_key, reach_key}), once_more = series_of(tolerances, {eye_key, reach_key});
    EXPECT_EQ(again.parts.size(), 3U);
    EXPECT_EQ(car_reading(again, reach_key).p05, car_reading(once_more, reach_key).p05) << "the same bytes";
    EXPECT_EQ(car_reading(again, eye_key).slope_error, car_reading(once_more, eye_key).slope_error);
}

} // namespace
} // namespace fernlicht
