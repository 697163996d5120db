// The line of error against run time in reports, through the program; lamps that `soft-map` draws as discs are discs in what its pictures
// are held against.
#include "tests/runner/experiments/shadows/short_drive.h"
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

/// The report of a run of one drive, which fits its schema.
json report_of(const TemporaryFolder& folder, const std::string& drive, const std::string& flags, const std::string& out) {
    const Outcome run = run_program("run " + drive + " --quiet " + flags + " --out " + (folder / out));
    EXPECT_LE(run.exit_code, 1) << run.output;
    json report = json::parse(content_of(folder / (out + "/report.json")));
    EXPECT_THAT(tests::complaints(report, "run/report"), IsEmpty());
    return report;
}

json played(const TemporaryFolder& folder, const std::string& name, const std::string& flags) {
    return report_of(folder, library_file("drives/straight.yaml"), "--resolution 160x120 --frames 0:2 " + flags, name);
}

TEST(DriveError, StandsInEveryReport) {
    const TemporaryFolder folder;
    const json report = played(folder, "ours", "");
    ASSERT_EQ(report.at("drives").size(), 2U);
    for (const json& drive : report.at("drives")) {
        const json& accuracy = drive.at("accuracy");
        EXPECT_EQ(accuracy.at("frames"), json({0, 1, 2}));
        EXPECT_EQ(accuracy.at("width_px"), 160);
        EXPECT_GT(accuracy.at("road").at("pixels"), 1000);
        EXPECT_LT(accuracy.at("tiles"), accuracy.at("tiles_of"));
        for (const char* errors : {"road", "target", "luminance"}) { // to a quarter, or to the reference's noise
            const json& e = accuracy.at(errors);
            const double low = e.at("relative_p95_between").at("low"), high = e.at("relative_p95_between").at("high"),
                         p95 = e.at("relative").at("p95"), floor = e.at("relative_floor").at("p95");
            EXPECT_LE(0.5 * (high - low), std::max(0.25 * p95, floor)) << errors;
            EXPECT_TRUE(low <= p95 && p95 <= high) << errors;
        }
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

// Faces of others' lamps are hundreds of cd/m2 before a dark sky, and the reference does not show them.
TEST(DriveError, OfLuminanceDoesNotCountFacesOfLamps) {
    const TemporaryFolder folder;
    const json report = report_of(folder, library_file("drives/oncoming.yaml"), "--resolution 160x120 --frames 2:2", "oncoming");
    for (const json& drive : report.at("drives"))
        EXPECT_LT(std::abs(drive.at("accuracy").at("luminance").at("mean").get<double>()), 1.0) << drive.at("lamp_set");
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

const std::string soft_30_cm = "{method: soft-map, lamp_radius_m: 0.3}";

TEST(LampDiscs, AreThoseOfTheDriveInItsAccuracy) {
    const TemporaryFolder folder;
    const auto accuracy = [&](const std::string& shadows, const std::string& out) {
        return report_of(folder, short_drive(folder, "shelter", shadows), "--resolution 96x72 --frames 1:1", out)
            .at("drives")
            .at(0)
            .at("accuracy");
    };
    EXPECT_EQ(accuracy(soft_30_cm, "soft").at("lamp_radius_m"), 0.3);
    EXPECT_THAT(content_of(folder / "soft/report.html"), HasSubstr("with lamps that are discs of 30 cm radius, as soft-map renders them"));
    EXPECT_FALSE(accuracy("map", "hard").contains("lamp_radius_m"));
    EXPECT_THAT(content_of(folder / "hard/report.html"), Not(HasSubstr("lamps that are discs")));
}

TEST(LampDiscs, AreThoseOfTheDriveInItsReference) {
    const TemporaryFolder folder;
    const auto drawn = [&](const std::string& shadows, const std::string& flags, const std::string& out) {
        printed("reference " + short_drive(folder, "shelter", shadows) + " --quiet --resolution 32x24 " + "--max-samples 64 " + flags +
                " --out " + (folder / out));
        return json::parse(content_of(folder / (out + "/reference.json"))).at("settings");
    };
    EXPECT_EQ(drawn(soft_30_cm, "", "drive").at("lamp_radius_m"), 0.3);
    EXPECT_EQ(drawn(soft_30_cm, "--lamp-radius 0", "points").at("lamp_radius_m"), 0.0);
    EXPECT_EQ(drawn(soft_30_cm, "--lamp-radius 0.3", "flag").at("lamp_radius_m"), 0.3);
    EXPECT_EQ(drawn("map", "", "map").at("lamp_radius_m"), 0.0);
    const auto picture = [&](const char* out) { return content_of(folder / (std::string(out) + "/reference.exr")); };
    EXPECT_TRUE(picture("drive") == picture("flag"));
    EXPECT_FALSE(picture("drive") == picture("points"));
}

// One truth for all methods has points: page, text and JSON say what that does to soft-map, where it takes part.
TEST(LampDiscs, AreNotInTheTruthThatMethodsShare) {
    const TemporaryFolder folder;
    const auto compared = [&](const std::string& shadows, const std::string& out) {
        return printed("accuracy " + short_drive(folder, "shelter", shadows) +
                       " --quiet --techniques photometric --resolutions 96x72 --shadow-maps 256x128,128x64 --beams float "
                       "--count 1 --rounds 1 --max-samples 16 --out " +
                       (folder / out));
    };
    const std::string note = "the half shadows of soft-map, whose lamps are discs of 30 cm radius, count as its errors here";
    EXPECT_THAT(compared(soft_30_cm, "soft"), HasSubstr("Note: lamps are points in the reference: " + note));
    EXPECT_THAT(content_of(folder / "soft/accuracy.html"), HasSubstr("Lamps are points in the reference: " + note));
    EXPECT_THAT(content_of(folder / "soft/accuracy.json"), HasSubstr(note));
    EXPECT_THAT(compared("map", "hard"), Not(HasSubstr("lamps are points")));
    EXPECT_THAT(content_of(folder / "hard/accuracy.html"), Not(HasSubstr("ps are points")));
}

} // namespace

} // namespace fernlicht
