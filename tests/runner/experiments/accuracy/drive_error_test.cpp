// The line of error against run time in reports, through the program.
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

json played(const TemporaryFolder& folder, const std::string& name, const std::string& flags) {
    const Outcome run = run_program("run --quiet --resolution 160x120 --frames 0:2 " + flags + " --out " + (folder / name + " ") +
                                    library_file("drives/straight.yaml"));
    EXPECT_LE(run.exit_code, 1) << run.output;
    json report = json::parse(content_of(folder / name + "/report.json"));
    EXPECT_THAT(tests::complaints_about(report, "run/report"), IsEmpty());
    return report;
}

TEST(DriveError, StandsInEveryReport) {
    const TemporaryFolder folder;
    const json report = played(folder, "ours", "");
    ASSERT_EQ(report.at("drives").size(), 2U);
    for (const json& drive : report.at("drives")) {
        const json& accuracy = drive.at("accuracy");
        EXPECT_EQ(accuracy.at("frames"), json({0, 1, 2}));
        EXPECT_EQ(accuracy.at("width_px"), 160);
        EXPECT_GT(accuracy.at("road").at("pixels"), 3000);
        EXPECT_LT(accuracy.at("road").at("relative").at("median"), 0.005); // what so few samples leave
        EXPECT_GT(accuracy.at("rays"), 100000);
        EXPECT_LT(accuracy.at("target").at("relative").at("median"), 0.005);
        EXPECT_LT(accuracy.at("luminance").at("relative").at("median"), 0.2); // textures, sampled once a pixel
        EXPECT_GT(accuracy.at("luminance").at("relative").at("p95"), accuracy.at("road").at("relative").at("p95"));
        EXPECT_EQ(accuracy.at("road_p95_by_moment").size(), 3U);
        ASSERT_EQ(accuracy.at("reach").size(), 8U); // two planes, four limits
        for (const json& reach : accuracy.at("reach")) {
            EXPECT_EQ(reach.at("moments"), 3);
            EXPECT_LT(std::abs(reach.at("worst_m").get<double>()), 0.01); // rays through the same places
        }
    }
    EXPECT_EQ(report.at("times").size(), 2U);
    EXPECT_GT(report.at("times").at(0).at("comparing_s"), 0.0);
    const std::string page = content_of(folder / "ours/report.html");
    for (const char* part : {"Error against run time", "luminance, whole view", "Error of reach"})
        EXPECT_THAT(page, HasSubstr(part));

    const json full = played(folder, "full", "--technique full"); // which leaves the cosine out
    EXPECT_GT(full.at("drives").at(0).at("accuracy").at("road").at("relative").at("median"), 0.5);
    EXPECT_GT(full.at("drives").at(0).at("accuracy").at("road").at("mean"), 0.5);
    EXPECT_GT(full.at("drives").at(0).at("accuracy").at("reach").at(0).at("worst_m"), 10.0);
    EXPECT_EQ(full.at("drives").at(0).at("accuracy").at("target").at("not_measured"),
              "technique full does not compute the illuminance of targets");
}

TEST(DriveError, SaysWhyThereIsNone) {
    const TemporaryFolder folder;
    const json plain = played(folder, "plain", "--technique plain");
    EXPECT_EQ(plain.at("drives").at(0).at("accuracy").at("not_measured"), "technique plain does not compute an illuminance");
    EXPECT_TRUE(plain.at("times").at(0).at("comparing_s").is_null());
    const json without = played(folder, "without", "--no-accuracy");
    EXPECT_TRUE(without.at("drives").at(0).at("accuracy").is_null());
    EXPECT_THAT(content_of(folder / "without/report.html"), Not(HasSubstr("Error against run time")));
}

} // namespace
} // namespace fernlicht
