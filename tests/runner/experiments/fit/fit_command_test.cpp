#include "runner/experiments/fit/fit_result.h"
#include "runner/experiments/fit/fit_run.h"
#include "scenarios/drives/play/advance.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"
#include "tests/trial.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string straight = library_file("drives/straight.yaml");
const std::string heads = "name,ahead_m,left_m,above_m,facing,lamps,lux,uncertainty_percent,uncertainty_lx\n";

/// What a luxmeter would have read before the halogen lamps of straight.yaml, with the lamps planted as told: a tunnel's grid at 10, 25 and
/// 50 m from the bumper, noise of 3 % and of 0.02 lx.
struct Tunnel {
    LampShift left{radians(-0.25), radians(0.4), std::log(0.93), 0.0}, right{radians(0.17), radians(-0.3), std::log(1.06), 0.01};

    std::string csv(unsigned seed) const {
        const Drive drive = read_drive(straight);
        std::vector<MountedLamp> lamps = drive.lamp_sets.front().lamps;
        lamps.at(0) = shifted(lamps.at(0), left);
        lamps.at(1) = shifted(lamps.at(1), right);
        std::mt19937_64 random(seed);
        std::string text = heads;
        int number = 0;
        for (const double ahead_m : {10.0, 25.0, 50.0})
            for (int column = 0; column < 10; ++column)
                for (int row = 0; row < 8; ++row) {
                    const double h = -0.1 + 0.024 * column, level = -0.01 + std::max(h, 0.0) * 0.268; // tangents; the cut-off there
                    const double v = row < 3 ? level + 0.005 * (row - 1) + 0.0007 * (column - 4) : level - 0.01 * (row - 2);
                    const char* shone = (number % 4 == 0) ? "left" : (number % 4 == 1) ? "right" : "";
                    const glm::dvec3 place{drive.bumper_m + ahead_m, -ahead_m * h, std::max(0.65 + ahead_m * v, 0.02)};
                    double lux = 0.0;
                    for (const MountedLamp& lamp : lamps)
                        if (*shone == '\0' || lamp.name == shone) {
                            const Pose pose = lamp.pose();
                            const glm::dvec3 to = place - pose.position_m, in_lamp = to * pose.axes;
                            const double d = glm::length(to);
                            lux += lamp.intensity_factor() *
                                   intensity_cd(lamp.file->table, degrees(std::atan2(-in_lamp.y, in_lamp.x)),
                                                degrees(std::asin(in_lamp.z / d))) /
                                   (d * d) * to.x / d; // a plane across the car's axis
                        }
                    const double noise = static_cast<double>(random() >> 11) / 9007199254740992.0 - 0.5; // even, of deviation 1 / sqrt(12)
                    lux = std::max(lux + std::sqrt(12.0) * noise * std::hypot(0.03 * lux, 0.02), 0.0);
                    text += fmt::format("P{},{},{:.4f},{:.4f},car,{},{:.4f},3,0.02\n", ++number, ahead_m, place.y, place.z, shone, lux);
                }
        return text;
    }
};

const json& value(const json& found, const std::string& lamp, const std::string& quantity) {
    for (const json& one : found.at("values"))
        if (one.at("lamp") == lamp && one.at("quantity") == quantity)
            return one;
    throw std::runtime_error("no " + quantity + " of " + lamp);
}

TEST(FitCommand, FindsTheLampsOfATunnelAndWritesTheDriveAsMeasured) {
    const TemporaryFolder folder;
    const std::filesystem::path points = tests::written("points.csv", Tunnel{}.csv(11));
    const std::string said = printed("fit " + straight + " --points " + points.string() + " --out " + (folder / "out"));
    EXPECT_THAT(said, HasSubstr("The residuals are as large as the uncertainties say"));
    const json found = tests::checked(content_of(folder / "out/fit.json"), fit_members);
    const auto near = [&](const std::string& lamp, const std::string& quantity, double planted, double within) {
        const json& one = value(found, lamp, quantity);
        EXPECT_NEAR(one.at("change"), planted, within) << lamp << ' ' << quantity;
        EXPECT_LT(one.at("standard_error"), within) << lamp << ' ' << quantity;
    };
    near("left", "pitch", -0.25, 0.02);
    near("left", "yaw", 0.4, 0.05);
    near("left", "flux", 0.93, 0.015);
    near("right", "pitch", 0.17, 0.02);
    near("right", "flux", 1.06, 0.02);
    EXPECT_NEAR(value(found, "left", "height").at("fitted"), 0.65, 0.02);
    EXPECT_EQ(found.at("points").size(), 240U);
    for (const char* name : {"report.html", "fit.csv", "residuals.svg", "agreement.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE"));
    EXPECT_EQ(csv_rows(content_of(folder / "out/fit.csv")).size(), 241U);

    // The drive as measured: its lamps are where the points say, and nothing is left to fit.
    const Drive fitted = read_drive(folder / "out/fitted.yaml");
    const MountedLamp& left = fitted.lamp_sets.front().lamps.at(0);
    EXPECT_DOUBLE_EQ(left.flux_factor, value(found, "left", "flux").at("fitted"));
    EXPECT_EQ(fitted.lamp_sets.at(1).lamps.at(0).flux_factor, 1.0) << "the other lamp set is as it was";
    printed("fit " + (folder / "out/fitted.yaml") + " --points " + points.string() + " --out " + (folder / "again"));
    const json again = json::parse(content_of(folder / "again/fit.json"));
    for (const char* quantity : {"pitch", "yaw", "height"})
        EXPECT_NEAR(value(again, "right", quantity).at("change"), 0.0, 1e-5) << quantity;
    EXPECT_NEAR(value(again, "right", "flux").at("change"), 1.0, 1e-5);
    // And it plays.
    printed("run " + (folder / "out/fitted.yaml") + " --frames 0:0 --no-accuracy --quiet --out " + (folder / "run"));
}

TEST(FitCommand, TheSamePointsGiveTheSameBytes) {
    const TemporaryFolder folder;
    const std::filesystem::path points = tests::written("points.csv", Tunnel{}.csv(2));
    for (const char* out : {"a", "b"})
        printed("fit " + straight + " --points " + points.string() + " --hold left.height --out " +
                (folder / out)); // planted where it is held
    for (const char* name : {"fit.csv", "fitted.yaml", "residuals.svg"})
        EXPECT_EQ(content_of(folder / ("a/" + std::string(name))), content_of(folder / ("b/" + std::string(name)))) << name;
    const json found = json::parse(content_of(folder / "a/fit.json"));
    EXPECT_EQ(value(found, "left", "height").at("held"), "as asked");
}

TEST(FitCommand, ExitsWithOneWhereThePointsContradictTheirUncertainties) {
    const TemporaryFolder folder;
    std::string text = Tunnel{}.csv(3);
    for (std::size_t at = text.find(",3,0.02\n"); at != std::string::npos; at = text.find(",3,0.02\n", at + 1))
        text.replace(at, 8, ",1,0.01\n");
    const std::string said =
        printed("fit " + straight + " --points " + tests::written("points.csv", text).string() + " --out " + (folder / "out"), 1);
    EXPECT_THAT(said, HasSubstr("The residuals are larger than the uncertainties say"));
    EXPECT_THAT(said, HasSubstr("Standard errors are multiplied by"));
}

TEST(FitCommand, NamesOutliersAndWhatOneDistanceCannotTell) {
    const TemporaryFolder folder;
    std::string text = heads;
    for (const auto& row : csv_rows(Tunnel{}.csv(5)))
        if (row.at(1) == "25") {
            const bool gross = row.at(0) == "P95";
            text += fmt::format("{},{},{},{},{},{},{},{},{}\n", row[0], row[1], row[2], row[3], row[4], row[5],
                                gross ? fmt::format("{}", 3.0 * std::stod(row[6])) : row[6], row[7], row[8]);
        }
    const std::string said =
        printed("fit " + straight + " --points " + tests::written("points.csv", text).string() + " --out " + (folder / "out"));
    EXPECT_THAT(said, HasSubstr("height of left is held at 0.650 m: the points cannot tell it from pitch of left"));
    EXPECT_THAT(said, HasSubstr("line 16, P95: read "));
    const json found = json::parse(content_of(folder / "out/fit.json"));
    EXPECT_EQ(std::ranges::count_if(found.at("points"), [](const json& point) { return point.at("outlier").get<bool>(); }), 1);
}

TEST(FitCommand, WarnsOfLuxInAnotherUnitAndOfFewPoints) {
    const TemporaryFolder folder;
    std::string wrong_unit = heads, few = heads;
    int number = 0;
    for (const auto& row : csv_rows(Tunnel{}.csv(7)))
        if (row.at(0) != "name") {
            const auto line = [&](double factor) {
                return fmt::format("{},{},{},{},{},{},{},{},{}\n", row[0], row[1], row[2], row[3], row[4], row[5],
                                   factor * std::stod(row[6]), row[7], factor * std::stod(row[8]));
            };
            wrong_unit += line(10.0);
            if (++number % 40 == 1)
                few += line(1.0);
        }
    const auto said = [&](const std::string& text, const char* out) {
        return run_program("fit " + straight + " --points " + tests::written("points.csv", text).string() + " --out " + (folder / out))
            .output;
    };
    const std::string tenfold = said(wrong_unit, "ten");
    EXPECT_THAT(tenfold, testing::ContainsRegex("by the points left has about 9"));
    EXPECT_THAT(
        tenfold,
        HasSubstr("by the points right has about 10.6 times the light of the drive's: are the points in lux (a foot-candle is 10.8 lx)"));
    EXPECT_THAT(tenfold, testing::Not(HasSubstr("are few")));
    const std::string six = said(few, "six");
    EXPECT_THAT(six, HasSubstr("Warning: 6 points for"));
    EXPECT_THAT(six, HasSubstr("at least 200 points at three distances are asked for"));
}

TEST(FitCommand, NamesSemicolonsBetweenColumns) {
    for (const char* text : {"name;ahead_m;left_m;above_m;facing;lux;uncertainty_percent\nA1;25;-1,5;0,31;car;4,62;3\n",
                             "name;ahead_m;left_m;above_m;facing;lux;uncertainty_percent\nA1;25;-1.5;0.31;car;4.62;3\n",
                             "name\tahead_m\tleft_m\nA1\t25\t-1.5\n"})
        EXPECT_THAT(printed("fit " + straight + " --points " + tests::written("points.csv", text).string(), 2),
                    HasSubstr("points.csv:1: found 'name"))
            << text;
    EXPECT_THAT(printed("fit " + straight + " --points " + tests::written("points.csv", "name;ahead_m\nA;1,5\n").string(), 2),
                HasSubstr("expected columns separated by commas, not by semicolons or tabs, and a point before decimals"));
}

TEST(FitCommand, RefusesWrongFilesByLineAndColumn) {
    const auto refused = [](const std::string& text, const std::string& flags = "") {
        return printed("fit " + straight + flags + " --points " + tests::written("points.csv", text).string(), 2);
    };
    const std::string good = "P,25,0,0.3,car,,2.5,3,0.01\n";
    EXPECT_THAT(refused("name,ahead,left_m,above_m,facing,lux,uncertainty_lx\n"),
                HasSubstr("points.csv:1:2: found column 'ahead', expected ahead_m"));
    EXPECT_THAT(refused("ahead_m,left_m,facing,lux,uncertainty_lx\n1,1,car,1,1\n"), HasSubstr("points.csv:1: has no column 'above_m'"));
    EXPECT_THAT(refused("ahead_m,left_m,above_m,facing,lux\n1,1,1,car,1\n"),
                HasSubstr("neither 'uncertainty_percent' nor 'uncertainty_lx'"));
    EXPECT_THAT(refused("ahead_m,left_m,above_m,lux,uncertainty_lx\n1,1,1,1,1\n"), HasSubstr("where the luxmeter looked"));
    EXPECT_THAT(refused("ahead_m;left_m;above_m;lux\n1;1;1;1\n"), HasSubstr("columns separated by commas"));
    EXPECT_THAT(refused(heads + good + "P,25,0,0.3,car,,bright,3,0.01\n"),
                HasSubstr("points.csv:3: lux: found 'bright', expected a number from 0 to 1e+06"));
    EXPECT_THAT(refused(heads + "P,25,0,0.3,down,,2.5,3,0.01\n"),
                HasSubstr("points.csv:2: facing: found 'down', expected lamp, car or up"));
    EXPECT_THAT(refused(heads + good + "P,25,0,0.3,car,,2.5,0,0\n"),
                HasSubstr("points.csv:3: uncertainty_percent: found '0', expected an uncertainty above 0"));
    EXPECT_THAT(refused(heads + "P,25,0,0.3,car,,0,3,\n"),
                HasSubstr("uncertainty_lx: found '', expected an uncertainty_lx above 0 beside it"));
    EXPECT_THAT(refused(heads + "P,25,0,0.3,car,middle,2.5,3,0.01\n"),
                HasSubstr("points.csv:2: lamps: found 'middle', expected lamps of the lamp set: left, right"));
    EXPECT_THAT(refused(heads + "P,25,0,0.3,car,left+left,2.5,3,0.01\n"), HasSubstr("each lamp once"));
    EXPECT_THAT(refused(heads), HasSubstr("has no readings"));
    EXPECT_THAT(refused(heads + "P,25,0,0.3,car,,2.5,3\n"), HasSubstr("points.csv:2: found 8 fields, expected 9"));
    EXPECT_THAT(refused("time_s,ahead_m,left_m,above_m,facing,lux,uncertainty_lx\n10,25,0,0.3,car,2,1\n"),
                HasSubstr("points.csv:2: time_s: found 10 s, expected 0 to 9.900 s, the drive's moments"));
    EXPECT_THAT(refused(heads + good, " --hold hight"),
                HasSubstr("--hold: found 'hight', expected some of pitch, yaw, flux, height, left.pitch"));
    EXPECT_THAT(printed("fit " + straight, 2), HasSubstr("found no --points, expected fernlicht fit [options] DRIVE --points FILE"));
}

TEST(LuxPoints, ReadWhatSpreadsheetsWrite) {
    FilesRead opened;
    const auto path = tests::written("points.csv", "\xEF\xBB\xBF"
                                                   "ahead_m,left_m, above_m,lux,normal_ahead,normal_left,normal_up,uncertainty_percent\r\n"
                                                   "25,-1.5,0.25, 3.5,-3,0,4,5\r\n,,,,,,,\r\n\r\n");
    const std::vector<LuxReading> read = read_lux_points(path, opened);
    ASSERT_EQ(read.size(), 1U);
    EXPECT_EQ(read[0].left_m, -1.5);
    EXPECT_EQ(read[0].lux, 3.5);
    EXPECT_EQ(read[0].line, 2U);
    const glm::dvec3 normal = normal_of(read[0]).value();
    EXPECT_DOUBLE_EQ(normal.x, -0.6);
    EXPECT_DOUBLE_EQ(normal.z, 0.8);
    EXPECT_EQ(opened.size(), 1U);
}

TEST(AsFitted, MovesChangesWithTheirLamp) {
    Drive drive = read_drive(library_file("drives/first-light.yaml"));
    LampSet& set = drive.lamp_sets.front();
    set.changes.push_back({.time_s = 9.0, .lamp = "left", .pitch_rad = 0.02});
    Shifts shifts(set.lamps.size(), LampShift{});
    shifts[0] = {0.01, -0.02, std::log(1.1), 0.005};
    const Drive fitted = as_fitted(drive, set.name, shifts);
    const LampSet& now = fitted.lamp_sets.front();
    EXPECT_DOUBLE_EQ(now.lamps[0].pitch_rad, set.lamps[0].pitch_rad + 0.01);
    EXPECT_DOUBLE_EQ(now.lamps[0].flux_factor, 1.1);
    EXPECT_DOUBLE_EQ(now.lamps[0].position_m.z, 0.655);
    EXPECT_DOUBLE_EQ(*now.changes.back().pitch_rad, 0.03);
    EXPECT_FALSE(now.changes.back().yaw_rad.has_value());
    EXPECT_EQ(now.changes.front().lamp, set.changes.front().lamp);
    EXPECT_EQ(fitted.lamp_sets[1].lamps[0].pitch_rad, drive.lamp_sets[1].lamps[0].pitch_rad);
}

} // namespace
} // namespace fernlicht
