#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The row that was drawn so; the test fails without it.
const json& row_with(const json& found, const std::string& beams, const std::string& filter, int samples) {
    for (const json& row : found.at("rows"))
        if (row.at("beams") == beams && row.at("filter") == filter && row.at("samples") == samples)
            return row;
    throw std::runtime_error("no row with " + beams + ", " + filter);
}

double seen(const json& row) { return row.at("aliasing").at("thresholds"); }
double contrast(const json& row) { return row.at("aliasing").at("contrast_percent"); }

TEST(AliasingCommand, RanksWhatIsKnown) {
    const TemporaryFolder folder;
    const Outcome run =
        run_program("aliasing --quiet --moment 2 --resolution 256x192 --supersample 8 --beams float,512x128x8 --samples 1,4 "
                    "--filter trilinear,none --out " +
                    (folder / "out") + " " + library_file("drives/first-light.yaml"));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const json found = json::parse(content_of(folder / "out/aliasing.json"));
    tests::Schema schema(json::parse(content_of(FERNLICHT_SOURCE_DIR "/runner/aliasing/aliasing.schema.json")));
    EXPECT_THAT(schema.check(found), IsEmpty());
    const json& fine = row_with(found, "float", "trilinear", 1);
    const json& eight_bit = row_with(found, "512x128x8", "trilinear", 1);
    const json& unfiltered = row_with(found, "float", "none", 1);
    const json& four = row_with(found, "float", "trilinear", 4);
    // More than the third digit, so that no rounding decides.
    EXPECT_GT(seen(eight_bit), 1.02 * seen(fine));
    EXPECT_GT(contrast(eight_bit), 1.02 * contrast(fine));
    EXPECT_GT(seen(unfiltered), 1.02 * seen(fine));
    EXPECT_GT(contrast(unfiltered), 1.02 * contrast(fine));
    EXPECT_GT(seen(fine), 1.2 * seen(four));
    EXPECT_GT(contrast(fine), 1.05 * contrast(four));
    EXPECT_GT(eight_bit.at("rest").at("contrast_percent"), fine.at("rest").at("contrast_percent"));
    EXPECT_EQ(found.at("least_to_most").at(0), four.at("label"));
    EXPECT_THAT(run.output, HasSubstr("least to most: photometric, float beams, trilinear, 4 samples < "));
    for (const char* name :
         {"aliasing.csv", "aliasing.html", "bands.svg", "bands.png", "01-photometric__float_beams__trilinear__1_sample.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE"));
}

/// Eight frames of a car that drives, or stands.
json over_time(const TemporaryFolder& folder, const std::string& speed_kmh) {
    std::string drive = content_of(library_file("drives/straight.yaml"));
    const auto set = [&](const std::string& key, const std::string& value) {
        const std::size_t at = drive.find(key + ":");
        drive.replace(at, drive.find('\n', at) - at, key + ": " + value);
    };
    set("speed_kmh", speed_kmh);
    set("road", library_file("roads/straight.xodr"));
    for (const std::string lamps : {"../lamps/"})
        for (std::size_t at = drive.find(lamps); at != std::string::npos; at = drive.find(lamps))
            drive.replace(at, lamps.size(), library_file("lamps/"));
    std::ofstream(folder / (speed_kmh + ".yaml")) << drive;
    const Outcome run =
        run_program("aliasing --quiet --frames 4:11 --resolution 96x72 --beams float --samples 1 --filter none,trilinear --out " +
                    (folder / speed_kmh) + " " + (folder / (speed_kmh + ".yaml")));
    EXPECT_EQ(run.exit_code, 0) << run.output;
    return json::parse(content_of(folder / (speed_kmh + "/aliasing.json"))).at("rows").at(0).at("temporal");
}

TEST(AliasingCommand, AStandingCarSeesNothingFlicker) {
    const TemporaryFolder folder;
    const json still = over_time(folder, "0"), moving = over_time(folder, "80");
    EXPECT_GT(still.at("tracks"), 500); // every second pixel each way of what is no sky
    EXPECT_EQ(still.at("thresholds"), 0.0);
    EXPECT_EQ(still.at("flicker_percent"), 0.0);
    EXPECT_EQ(still.at("crawl_percent"), 0.0);
    EXPECT_GT(moving.at("tracks"), 30);
    EXPECT_GT(moving.at("flicker_percent"), 1.0);
    EXPECT_EQ(moving.at("spectrum").size(), 4U);
}

TEST(AliasingCommand, RefusesWhatItCannotDoInOneSentence) {
    const std::string drive = " " + library_file("drives/straight.yaml");
    for (const auto& [flags, sentence] :
         {std::pair("--supersample 5", "--supersample: found '5', expected an even number, 4 to 16"),
          std::pair("--samples 1,3", "--samples: found '3', expected 1, 4, 9 or 16"),
          std::pair("--samples 4,4", "--samples: found '4 twice', expected each value once"),
          std::pair("--filter linear", "--filter: found 'linear', expected none, mipmapped or trilinear"),
          std::pair("--moment 1 --frames 1:9", "--moment: found --frames too, expected one of the two"),
          std::pair("--frames 1:3", "found 1:3, expected 8 to 64 frames in a row"), std::pair("--moment 1e9", "expected 0 to "),
          std::pair("--level 0", "--level: found '0', expected lux above 0"),
          std::pair("--resolution 4096x3072 --supersample 8", "expected at most 16384 pixels each way"),
          std::pair("--techniques photometric,photometric", "found photometric twice")}) {
        const Outcome run = run_program("aliasing --quiet " + std::string(flags) + drive);
        EXPECT_EQ(run.exit_code, 2) << flags << run.output;
        EXPECT_THAT(run.output, HasSubstr(sentence)) << flags;
    }
}

TEST(AliasingCommand, WhatHasNoLuminanceIsNotMeasuredUnlessAsDisplayed) {
    const TemporaryFolder folder;
    const std::string common = "aliasing --quiet --moment 1 --resolution 64x48 --techniques full --beams float --samples 1 --filter none "
                               "--out ";
    const Outcome none = run_program(common + (folder / "none") + " " + library_file("drives/straight.yaml"));
    EXPECT_EQ(none.exit_code, 1) << none.output;
    EXPECT_THAT(none.output, HasSubstr("technique full computes no luminance"));
    const Outcome shown = run_program(common + (folder / "shown") + " --picture display " + library_file("drives/straight.yaml"));
    EXPECT_EQ(shown.exit_code, 0) << shown.output;
    const json row = json::parse(content_of(folder / "shown/aliasing.json")).at("rows").at(0);
    EXPECT_GT(row.at("aliasing").at("contrast_percent"), 0.1);
}

} // namespace
} // namespace fernlicht
