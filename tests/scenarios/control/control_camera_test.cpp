// The own car's camera: whom it finds, when laws hear of it, and what is hidden from it.
#include "scenarios/control/control_camera.h"
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/play/staged_drive.h"
#include "tests/shipped.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

OtherUser user_at(const std::string& name, double ahead_m, double left_m = 0.0, bool oncoming = true) {
    return {name, ahead_m, left_m, oncoming ? 3.14 : 0.0, 20.0};
}

std::vector<std::string> found(const ControlCameraParameters& parameters, const std::vector<OtherUser>& there) {
    ControlCameraParameters at_once = parameters;
    at_once.latency_s = 0.0;
    ControlCamera camera(at_once);
    std::vector<std::string> names;
    for (const OtherUser& other : camera.step(0.0, there))
        names.push_back(other.name);
    return names;
}

TEST(ControlCamera, FindsLampsWithinReachAndField) {
    OtherUser bicycle = user_at("bicycle", 80.0);
    bicycle.bicycle = true;
    OtherUser unlit = user_at("unlit", 50.0), hidden = user_at("hidden", 50.0);
    unlit.lamps_on = false;
    hidden.hidden = true;
    const std::vector<OtherUser> there{user_at("near", 390.0),
                                       user_at("far", 410.0),
                                       user_at("farther", 810.0),
                                       user_at("ahead", 90.0, 0.0, false),
                                       user_at("gone", 110.0, 0.0, false),
                                       bicycle,
                                       unlit,
                                       hidden,
                                       user_at("beside", 20.0, 9.0),
                                       user_at("aside", 20.0, 9.6)};
    EXPECT_THAT(found({.grade = CameraGrade::legal}, there), testing::ElementsAre("near", "ahead", "beside")) << "tan 25 degrees is 0.466";
    EXPECT_THAT(found({}, there), testing::ElementsAre("near", "far", "ahead", "gone", "bicycle", "beside"));
    EXPECT_THAT(found({.oncoming_m = 900.0, .hides = false}, there), testing::IsSupersetOf({"farther", "hidden"}));
}

/// Frames at 0, 0.1, 0.2 s ... through 0.15 s later.
TEST(ControlCamera, TellsOfAFrameAfterItsLatency) {
    ControlCamera camera({.rate_hz = 10.0, .latency_s = 0.15});
    std::vector<double> told;
    for (int tick = 0; tick < 20; ++tick) {
        const std::vector<OtherUser> now = camera.step(0.02 * tick, {user_at("other", 100.0 - tick)});
        told.push_back(now.empty() ? 0.0 : now[0].ahead_m);
    }
    for (int tick = 0; tick < 20; ++tick) // 0.16 s is the first tick at or after 0.15; then that of 0.1 at 0.26, 0.2 at 0.36
        EXPECT_EQ(told[static_cast<std::size_t>(tick)], tick < 8 ? 0.0 : tick < 13 ? 100.0 : tick < 18 ? 95.0 : 90.0) << tick;
}

TEST(ControlCamera, MissesAndErrsBySeed) {
    const auto played = [](int seed) {
        ControlCamera camera({.rate_hz = 100.0, .latency_s = 0.0, .noise_rad = 0.01, .missed = 0.3, .seed = seed});
        const std::vector<OtherUser> there{user_at("other", 100.0, 10.0)};
        std::vector<double> bearings;
        for (int tick = 0; tick < 4000; ++tick)
            for (const OtherUser& other : camera.step(0.01 * tick, there))
                bearings.push_back(std::atan2(other.left_m, other.ahead_m) - std::atan2(10.0, 100.0));
        return bearings;
    };
    const std::vector<double> one = played(1);
    EXPECT_EQ(one, played(1));
    EXPECT_NE(one, played(2));
    EXPECT_NEAR(static_cast<double>(one.size()) / 4000.0, 0.7, 0.03) << "4 standard deviations";
    double sum = 0.0, squares = 0.0;
    for (const double off : one)
        sum += off, squares += off * off;
    const double count = static_cast<double>(one.size());
    EXPECT_NEAR(sum / count, 0.0, 4.0 * 0.01 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), 0.01, 4.0 * 0.01 / std::sqrt(2.0 * count));
}

class HiddenOthers : public DriveFixture {
  protected:
    /// How many the laws know of at a moment.
    static double known(const StagedDrive& played, std::size_t moment) {
        const ControlRun& run = *played.drive.lamp_sets[0].motion->control;
        return run.rows.at(moment).at(signal::others_count);
    }
    StagedDrive crest(const std::string& camera) {
        const auto library = [](const std::string& name) { return (shipped_library / name).string(); };
        return StagedDrive(
            read("fernlicht: 1\nroad: " + library("roads/country.xodr") +
                 "\nroute: {s_m: 300}\nspeed_kmh: 80\nrate_hz: 10\nduration_s: 8\ncontrol: {high_beam: {lamps: [left]}, camera: " + camera +
                 "}\ntraffic: {one: {oncoming: {gap_m: 330}, speed_kmh: 80, file: low.ies, repeat: {count: 2, every_m: 10}}}\n"
                 "lamp_sets:\n  one: {file: low.ies}\n"));
    }
};

/// From 300 m on the road rises by 4 % to 400 m, bends over until 600 m and falls: a lamp 330 m ahead is behind the crest. The second car
/// is hidden by the first as long as the road is straight.
TEST_F(HiddenOthers, ComeOverACrestOneAfterTheOther) {
    const StagedDrive sees = crest("{latency_s: 0}"), knows = crest("{latency_s: 0, hides: false}");
    EXPECT_EQ(known(sees, 0), 0.0);
    EXPECT_EQ(known(knows, 0), 2.0);
    std::size_t first = 0;
    while (first < 79 && known(sees, first) == 0.0)
        ++first;
    EXPECT_GT(first, 5U);
    EXPECT_LT(first, 70U) << "it comes over";
    EXPECT_EQ(known(sees, first), 1.0) << "the one behind it does not";
}

TEST_F(HiddenOthers, ACameraThatNobodyAsksIsRefused) {
    EXPECT_THAT(refusal(minimal + "control: {camera: good}\n"), testing::HasSubstr("a camera that nobody asks"));
    EXPECT_THAT(refusal(minimal + "control: {high_beam: {lamps: [left]}, camera: best}\n"), testing::HasSubstr("one of good, legal"));
}

} // namespace
} // namespace fernlicht
