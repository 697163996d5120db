// What a run warns of beside its figures.
#include "runner/experiments/run/run_notes.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

TEST(GazeWarnings, NameEyesThatLookIntoTheLamps) {
    PlayedCell played;
    played.drive = "country-1";
    const auto warned = [&](const char* over, const std::vector<Value>& theta) {
        played.seeing = {
            {"glare_bend", "Oncoming driver bend", over, {0, 1}, {200.0, 90.0}, {{"theta_left_deg", "", "deg", false, false, theta}}}};
        return gaze_warnings(std::vector{played, played});
    };
    EXPECT_THAT(warned("distance to the observer", {0.9, 0.32}),
                testing::ElementsAre("country-1: Oncoming driver bend: the line of sight passes the lamps at 0.32°: veil, threshold "
                                     "increment and de Boer's rating are of one who looks into them"));
    EXPECT_THAT(warned("distance to the observer", {0.3, 0.9}), testing::IsEmpty())
        << "1.4 m beside; far away every lamp is near the line of sight";
    EXPECT_THAT(warned("distance along the route", {0.9, 0.32}), testing::IsEmpty()) << "mirrors";
    EXPECT_THAT(warned("distance to the observer", {0.9, Value::not_measured("hidden")}), testing::IsEmpty());
}

} // namespace
} // namespace fernlicht
