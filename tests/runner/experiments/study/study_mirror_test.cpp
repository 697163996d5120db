// Left-hand traffic through the program: the mirrored drive reads as the drive in a mirror, and a lamp for the other side shows it.
#include "runner/files/picture_file.h"
#include "scenarios/drives/edits/mirrored_drive.h"
#include "tests/runner/program.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;

struct Cell {
    std::map<std::string, double> readings;
    std::filesystem::path picture; ///< of the driver's view, EXR
};

class StudyMirror : public testing::Test {
  protected:
    TemporaryFolder folder_;

    /// The same halogen lamp twice; the second stays a right-hand lamp when traffic is mirrored.
    std::map<std::string, Cell> played(const std::string& drive) {
        const std::string file = folder_ / "mirror.yaml";
        std::ofstream(file)
            << "fernlicht_study: 1\nlamps:\n  at-home: {low: " << library_file("lamps/halogen-low.ies")
            << "}\n  abroad: {low: " << library_file("lamps/halogen-low.ies") << ", mirrors: false}\ndrives: ["
            << library_file("drives/" + drive + ".yaml")
            << "]\nconditions: {mirror: [false, true]}\npictured_moments: 1\nresolution_px: [96, 72]\n"
               "measure:\n  glare: {oncoming: {opposite: {at_m: 70}}, mirrors: true}\n"
               "  sensors: {points: {right-edge: {at_m: 70, across: right-edge}, left-edge: {at_m: 70, across: left-edge}}}\n"
               "  places: [boards, markings]\n";
        const Outcome run = run_program("study " + file + " --frames 0:2 --quiet --no-accuracy --out " + (folder_ / "out"));
        EXPECT_EQ(run.exit_code, 0) << run.output;
        const json study = json::parse(content_of(folder_ / "out/study.json"));
        std::map<std::string, Cell> cells;
        for (const json& cell : study.at("cells")) {
            Cell& found = cells[cell.at("name")];
            for (const json& row : cell.at("readings"))
                if (const json& value = row.at("value"); !value.is_null()) // bounds by their figure
                    found.readings[row.at("name")] = value.is_object() ? value.front() : value;
            for (const auto& entry :
                 std::filesystem::recursive_directory_iterator(folder_ / ("out/cells/" + cell.at("name").get<std::string>() + "/frames")))
                if (entry.path().extension() == ".exr" && entry.path().string().find("driver") != std::string::npos)
                    found.picture = entry.path();
        }
        return cells;
    }
};

Image<float> lux_of(const std::filesystem::path& file) {
    for (PictureChannel& channel : read_exr(file))
        if (channel.name == "illuminance.lx")
            return std::move(channel.values);
    throw std::runtime_error("no lux in " + file.string());
}

TEST_F(StudyMirror, ReadsAsTheDriveInAMirror) {
    for (const char* drive : {"s-bend", "village"}) { // with bends and fences, with kerbs and houses
        SCOPED_TRACE(drive);
        const std::map<std::string, Cell> cells = played(drive);
        ASSERT_EQ(cells.size(), 4U);
        const Cell &right = cells.at(std::string(drive) + "_at-home"), &left = cells.at(std::string(drive) + "_at-home_mirrored");
        ASSERT_EQ(right.readings.size(), left.readings.size());
        std::size_t exact = 0, sided = 0;
        for (const auto& [name, value] : right.readings) {
            ASSERT_TRUE(left.readings.contains(other_side(name))) << name;
            sided += other_side(name) == name ? 0U : 1U;
            if (name.find("_grid_error") != std::string::npos || name.find("_twin_difference") != std::string::npos)
                continue; // of every second sample, which are not the images of one another; of shadows, which the twin has not
            // Calculated in double precision, or drawn: reaches along lines of the grid, which is its own image. Areas are summed over
            // triangles whose diagonals are not, and shadows of trees and houses end on other pixels: reaches across all lanes by less than
            // half a cell of 0.25 m.
            const bool drawn = !name.starts_with("glare_") && !name.starts_with("sensor_") && !name.starts_with("mirror_") &&
                               !name.starts_with("board_") && !name.starts_with("marking_");
            const double off = std::abs(left.readings.at(other_side(name)) - value), size = std::abs(value);
            const double allowed = !drawn ? 1e-9 * size : name.starts_with("reach_") ? 0.12 : 0.05 * size + 0.1;
            EXPECT_LE(off, allowed) << name << " " << value;
            exact += drawn ? 0U : 1U;
        }
        EXPECT_GT(exact, 60U);
        EXPECT_GT(sided, 100U);
        const Image<float> here = lux_of(right.picture), there = lux_of(left.picture);
        ASSERT_EQ(here.width(), there.width());
        int alike = 0, lit = 0;
        for (int y = 0; y < here.height(); ++y)
            for (int x = 0; x < here.width(); ++x) {
                const float a = here.at(x, y), b = there.at(here.width() - 1 - x, y);
                lit += a > 0.1F ? 1 : 0;
                alike += std::abs(a - b) <= 1e-3F * std::max(a, b) + 1e-4F ? 1 : 0;
            }
        EXPECT_GT(lit, 300);
        EXPECT_GT(alike, here.width() * here.height() * 98 / 100) << "all but pixels on edges, which belong to either side";
        std::filesystem::remove_all(folder_ / "out");
    }
}

TEST_F(StudyMirror, ALampForTheOtherSideGlares) {
    const std::map<std::string, Cell> cells = played("straight");
    const auto largest = [&](const std::string& cell) { return cells.at("straight_" + cell).readings.at("glare_opposite_facing_max_lx"); };
    EXPECT_EQ(largest("at-home"), largest("abroad")) << "the same lamp where nothing is mirrored";
    EXPECT_GT(largest("abroad_mirrored"), 3.0 * largest("at-home_mirrored")) << "its kink rises towards oncoming eyes";
    const auto reach = [&](const std::string& cell, const std::string& edge) {
        return cells.at("straight_" + cell).readings.at("reach_1lx_target_own_" + edge + "_edge_m");
    };
    EXPECT_GT(reach("abroad_mirrored", "right"), reach("abroad_mirrored", "left")) << "still a right-hand beam";
    EXPECT_GT(reach("at-home_mirrored", "left"), reach("at-home_mirrored", "right"));
}

} // namespace
} // namespace fernlicht
