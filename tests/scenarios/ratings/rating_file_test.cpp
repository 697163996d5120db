// Rating files: those that ship, what is refused, and lamp sets of another file in a drive.
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/drive.h"
#include "scenarios/ratings/rating.h"
#include "scenarios/yaml/library_file.h"
#include "tests/scenarios/drives/yaml_schema_check.h"
#include "tests/shipped.h"
#include "tests/trial.h"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

namespace fernlicht {
namespace {

using testing::HasSubstr;

std::string text_of_file(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// What an editor would say of a file.
std::string violation_of(const std::filesystem::path& file, const char* schema) {
    return SchemaCheck(json::parse(std::ifstream(shipped_library / ".." / schema)))
        .violation(to_json(parse_yaml(text_of_file(file), file)));
}

TEST(RatingFile, AllThatShipAreGoodAndSoAreTheirDrives) {
    std::vector<std::filesystem::path> files{shipped_library / "../rating.example.yaml"};
    for (const std::string& name : library_names("rating"))
        files.push_back(library_file("rating", name, "", {}));
    ASSERT_GE(files.size(), 3U);
    for (const std::filesystem::path& file : files) {
        EXPECT_EQ(violation_of(file, "rating.schema.json"), "") << file;
        const Rating rating = read_rating(file);
        for (const RatingRow& row : rating.rows) {
            EXPECT_EQ(violation_of(row.drive, "drive.schema.json"), "") << row.drive;
            EXPECT_NO_THROW(read_drive(row.drive)) << row.drive;
        }
    }
}

TEST(RatingFile, TheTrackTestHasTheLimitsOfTheRule) {
    const Rating rating = read_rating(library_file("rating", "adb-track", "", {}));
    ASSERT_EQ(rating.rows.size(), 8U);
    const std::vector<LimitRange>& opposite = limits_named(rating, "opposite-direction")->ranges;
    ASSERT_EQ(opposite.size(), 4U);
    EXPECT_EQ(opposite[0].limit_lx(20.0), 3.1);
    EXPECT_EQ(opposite[1].limit_lx(59.9), 1.8);
    EXPECT_EQ(opposite[2].limit_lx(60.0), 0.6);
    EXPECT_EQ(opposite[3].limit_lx(220.0), 0.3);
    EXPECT_FALSE(rating.rules.excess.allowed);
    EXPECT_EQ(rating.rules.round_lx, 0.1);
    EXPECT_EQ(rating.rules.pitch_off_mean_deg, 0.3);
    for (const Photometer& photometer : rating.photometers)
        EXPECT_EQ(photometer.is, Known::assumed) << photometer.name;
}

const std::string head = "fernlicht_rating: 1\nedition: 1\nsource: us\n";

/// A rating of one row, whose keys may be others; key by key a line, rows from line 6 on.
std::string rating_text(const std::string& row, const std::string& more = "") {
    return head +
           "limits: {glare: {is: stated, ranges: [{from_m: 15, to_m: 30, at_most_lx: 3}]}}\n"
           "photometers: {eye: {on: fixture, position_m: [1, 0, 1], is: assumed}}\n" +
           fmt::format("rows:\n  r: {{drive: {}, {}}}\n", (shipped_library / "ratings/adb-track/1.yaml").string(), row) + more;
}

std::string rating_refusal(const std::string& text) {
    return tests::refusal_of([&] { read_rating(tests::written("rating.yaml", text)); }, "");
}

TEST(RatingFile, SaysWhereAndWhyItCannotBeUsed) {
    const std::string good = "photometers: [eye], limits: glare, is: stated";
    ASSERT_EQ(rating_refusal(rating_text(good)), "");
    const struct {
        std::string text, said;
    } cases[] = {
        {rating_text(good + ", wieght: 2"), "rating.yaml:7:"},
        {rating_text(good + ", wieght: 2"), "expected 'weight', the nearest known key"},
        {rating_text("photometers: [ear], limits: glare, is: stated"), "no photometer 'ear' in this rating, expected one of eye"},
        {rating_text("photometers: [eye], limits: glares, is: stated"), "no limits 'glares' in this rating, expected one of glare"},
        {rating_text("photometers: [eye], is: stated"), "limits: missing"},
        {rating_text("photometers: [eye], limits: glare"), "is: missing"},
        {rating_text("photometers: [eye], limits: glare, is: known"), "expected one of stated, assumed"},
        {rating_text(good + ", reading: reach_5lx_road_own_m"), "reading, or photometers and limits; one of them"},
        {rating_text("is: stated"), "reading, or photometers and limits; one of them"},
        {rating_text(good + ", at_most: 3"), "at_most of a row of light on photometers, expected none"},
        {rating_text("reading: reach_5lx_road_own_m, at_least: 60, at_most: 50, is: stated"), "at least at_least, 60"},
        {rating_text("reading: reach_5lx_road_own_m, from_m: 3, is: stated"), "from_m of a row of a reading, expected none"},
        {rating_text(good + ", from_m: 50, to_m: 20"), "more than from_m, 50 m"},
        {rating_text(good + ", from_m: 100, to_m: 200"), "limits that have no range where the row measures"},
        {rating_text(good + ", speed_kmh: [70, 60]"), "a greatest value below the least"},
        {rating_text("reading: reach_5lx_road_own_m, points: 3, points_by: [[1, 0], [2, 3]], is: stated"), "points beside points_by"},
        {rating_text("reading: reach_5lx_road_own_m, points_by: [[2, 0], [1, 3]], is: stated"), "readings that rise"},
        {rating_text(good, "grades: {good: 5, bad: 1}\n"), "the lowest grade first"},
        {rating_text(good, "momentary_excess: {percent: 20}\n"), "momentary_excess.allowed: missing"},
        {head + "rows: {r: {drive: nowhere.yaml, reading: x, is: stated}}\n", "there is no file"},
        {head + "limits: {a: {is: stated, ranges: [{from_m: 5, to_m: 5}]}}\nrows: {}\n", "more than from_m, 5 m"},
        {head + "limits: {a: {is: stated, ranges: [{from_m: 5, to_m: 9}, {from_m: 8, to_m: 12}]}}\nrows: {}\n", "at least 9 m"},
        {head + "limits: {a: {is: stated, ranges: [{from_m: 5, to_m: 9, at_most_lx: 0}]}}\nrows: {}\n", "at_most_lx"},
        {head + "photometers: {a: {is: stated}}\nrows: {}\n", "on: a road user, with position_m; or at_m"},
        {head + "photometers: {a: {on: car, at_m: 3, is: stated}}\nrows: {}\n", "at_m beside on"},
        {"fernlicht_rating: 2\nedition: 1\nsource: us\nrows: {}\n", "1, the version of the rating file's schema"},
    };
    for (const auto& [text, said] : cases)
        EXPECT_THAT(rating_refusal(text), HasSubstr(said)) << text;
    EXPECT_THAT(tests::refusal_of([] {
                    library_file("rating", "adb-trak", "", {{}, 0, 0, "RATING"});
                }),
                HasSubstr("no rating of that name, expected a rating file, or one of adb-lines, adb-track, iihs (nearest: 'adb-track')"));
}

/// `lamp_sets`: YAML of another file.
Drive drive_with(const std::string& lamp_sets) {
    const std::filesystem::path folder = tests::new_folder();
    std::filesystem::copy_file(shipped_library / "lamps/xenon-low.ies", folder / "mine.ies");
    DriveEdits edits;
    edits.lamp_sets = tests::written("set.yaml", lamp_sets, folder);
    return read_drive(shipped_library / "ratings/adb-track/1.yaml", edits);
}

TEST(LampSetsOfAnotherFile, TakeThePlaceOfTheDrivesOwn) {
    const Drive drive = drive_with("car: {bumper_x_m: 4, mounts: {middle: [3.5, 0, 0.7]}}\n"
                                   "lamp_sets: {one: {lamps: {middle: mine.ies}}, two: {lamps: {middle: {file: mine.ies, level: 0.5}}}}\n");
    ASSERT_EQ(drive.lamp_sets.size(), 2U);
    EXPECT_EQ(drive.lamp_sets[0].lamps.at(0).position_m, glm::dvec3(3.5, 0.0, 0.7));
    EXPECT_EQ(drive.lamp_sources.front().path.filename(), "mine.ies"); // beside that file
    EXPECT_EQ(drive.lamp_sets[1].lamps[0].level, 0.5);
    EXPECT_EQ(drive.bumper_m, 4.0);
    EXPECT_EQ(drive.traffic_rows.size(), 1U); // all else is the drive's
    EXPECT_EQ(drive.name, "adb-track-1");
    EXPECT_TRUE(std::ranges::any_of(drive.opened, [](const FileRead& file) { return file.path.filename() == "set.yaml"; }));
}

TEST(LampSetsOfAnotherFile, MayBeAWholeDrivesWithItsControl) {
    DriveEdits edits;
    edits.lamp_sets = shipped_drives / "glare-free.yaml";
    const Drive drive = read_drive(shipped_library / "ratings/adb-track/1.yaml", edits);
    ASSERT_EQ(drive.lamp_sets.size(), 3U);
    EXPECT_TRUE(drive.lamp_sets[2].control->glare_free);
    EXPECT_EQ(drive.duration_s, 11.0);
}

TEST(LampSetsOfAnotherFile, AreRefusedInThatFile) {
    EXPECT_THAT(tests::refusal_of([] { drive_with("lamp_sets: {one: {file: none.ies}}\n"); }), HasSubstr("set.yaml:1:"));
    EXPECT_THAT(tests::refusal_of([] { drive_with("car: {}\n"); }), HasSubstr("lamp_sets: missing"));
    EXPECT_THAT(tests::refusal_of([] { drive_with("lamp_sets: {one: {file: mine.ies}}\nweather: {wetness: 1}\n"); }),
                HasSubstr("set.yaml:2:1: weather: unknown key"));
}

} // namespace
} // namespace fernlicht
