// Lamps that `soft-map` draws as discs are discs in what its pictures are held against.
#include "tests/runner/experiments/shadows/short_drive.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string soft_30_cm = "{method: soft-map, lamp_radius_m: 0.3}";

json report_of(const TemporaryFolder& folder, const std::string& drive, const std::string& out) {
    const Outcome run = run_program("run " + drive + " --quiet --resolution 96x72 --frames 1:1 --out " + (folder / out));
    EXPECT_LE(run.exit_code, 1) << run.output;
    json report = json::parse(content_of(folder / (out + "/report.json")));
    EXPECT_THAT(tests::complaints_about(report, "run/report"), IsEmpty());
    return report.at("drives").at(0).at("accuracy");
}

TEST(LampDiscs, AreThoseOfTheDriveInItsAccuracy) {
    const TemporaryFolder folder;
    EXPECT_EQ(report_of(folder, short_drive(folder, "shelter", soft_30_cm), "soft").at("lamp_radius_m"), 0.3);
    EXPECT_THAT(content_of(folder / "soft/report.html"), HasSubstr("with lamps that are discs of 30 cm radius, as soft-map draws them"));
    EXPECT_FALSE(report_of(folder, short_drive(folder, "shelter", "map"), "hard").contains("lamp_radius_m"));
    EXPECT_THAT(content_of(folder / "hard/report.html"), Not(HasSubstr("lamps that are discs")));
}

TEST(LampDiscs, AreThoseOfTheDriveInItsReference) {
    const TemporaryFolder folder;
    const auto drawn = [&](const std::string& shadows, const std::string& flags, const std::string& out) {
        const Outcome run = run_program("reference " + short_drive(folder, "shelter", shadows) + " --quiet --resolution 32x24 " +
                                        "--most-samples 64 " + flags + " --out " + (folder / out));
        EXPECT_EQ(run.exit_code, 0) << run.output;
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
        const Outcome run = run_program("accuracy " + short_drive(folder, "shelter", shadows) +
                                        " --quiet --techniques photometric --resolutions 96x72 --shadow-maps 256x128,128x64 --beams float "
                                        "--moments 1 --rounds 1 --out " +
                                        (folder / out));
        EXPECT_EQ(run.exit_code, 0) << run.output;
        return run.output;
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
