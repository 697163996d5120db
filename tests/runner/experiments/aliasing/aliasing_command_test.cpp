#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/files/picture_file.h"
#include "scenarios/display/display_profile.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json checked_aliasing(const std::filesystem::path& file) { return tests::checked(content_of(file), aliasing_members); }

/// The row that was drawn so; the test fails without it.
const json& row_with(const json& found, const std::string& beams, const std::string& filter, int samples) {
    for (const json& row : found.at("rows"))
        if (row.at("beams") == beams && row.at("filter") == filter && row.at("samples") == samples)
            return row;
    throw std::runtime_error("no row with " + beams + ", " + filter);
}

double seen(const json& row) { return row.at("aliasing").at("thresholds"); }
double contrast(const json& row) { return row.at("aliasing").at("contrast_percent"); }

TEST(AliasingCommand, ACarOnSpringsIsSimulatedAsInRun) {
    const TemporaryFolder folder;
    printed("aliasing --quiet --moment 1 --resolution 64x48 --beams float --samples 1 --texture-filters trilinear --out " +
            (folder / "out") + " " + library_file("drives/braking.yaml"));
    EXPECT_EQ(checked_aliasing(folder / "out/aliasing.json").at("rows").size(), 1U);
}

TEST(AliasingCommand, RanksWhatIsKnown) {
    const TemporaryFolder folder;
    const std::string said =
        printed("aliasing --quiet --moment 2 --resolution 256x192 --supersample 8 --beams float,512x128x8 --samples 1,4 "
                "--texture-filters trilinear,none --out " +
                (folder / "out") + " " + library_file("drives/first-light.yaml"));
    const json found = checked_aliasing(folder / "out/aliasing.json");
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
    // Stairs of edges that have a name: 8 bits along the cut-off, one sample along marks. Several standard errors, so that chance does not
    // decide.
    const auto stairs = [](const json& row, const char* edge, const char* value) -> double {
        return row.at("jaggedness").at(edge).at(value);
    };
    EXPECT_GT(stairs(eight_bit, "cut_off", "rms_px"),
              stairs(fine, "cut_off", "rms_px") + 5.0 * stairs(eight_bit, "cut_off", "standard_error_px"));
    EXPECT_LT(stairs(fine, "cut_off", "rms_px"), stairs(fine, "cut_off", "floor_px") + 5.0 * stairs(fine, "cut_off", "standard_error_px"));
    EXPECT_GT(stairs(fine, "marks", "rms_px"), stairs(four, "marks", "rms_px") + 2.0 * stairs(four, "marks", "standard_error_px"));
    EXPECT_EQ(found.at("least_to_most").at(0), four.at("label"));
    EXPECT_THAT(said, HasSubstr("least to most: photometric, float beams, trilinear, 4 samples < "));
    for (const char* name :
         {"aliasing.csv", "aliasing.html", "ranking.png", "bands.svg", "bands.png", "01-photometric__float_beams__trilinear__1_sample.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE"));
}

/// What `aliasing` refuses, flag by flag, each with a part of its sentence.
void expect_refused(const std::string& start, const std::vector<std::pair<std::string, std::string>>& refusals) {
    for (const auto& [flags, sentence] : refusals) {
        EXPECT_THAT(printed("aliasing --quiet " + start + flags, 2), HasSubstr(sentence)) << flags;
    }
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
    printed("aliasing --quiet --flow --frames 4:11 --resolution 96x72 --beams float --samples 1 --texture-filters none,trilinear --out " +
            (folder / speed_kmh) + " " + (folder / (speed_kmh + ".yaml")));
    const json found = json::parse(content_of(folder / (speed_kmh + "/aliasing.json")));
    json row = found.at("rows").at(0).at("temporal");
    row["flow"] = found.at("optical_flow");
    EXPECT_TRUE(std::filesystem::exists(folder / (speed_kmh + "/flow.png")));
    return row;
}

TEST(AliasingCommand, AStandingCarSeesNothingFlicker) {
    const TemporaryFolder folder;
    const json still = over_time(folder, "0"), moving = over_time(folder, "80");
    ASSERT_EQ(still.at("flow").size(), 4U);
    for (const json& flow : still.at("flow")) {                         // standing pictures move by nothing, known or estimated
        const bool exact = flow.at("method") == "dense inverse search"; // Farnebäck's is off by rounding in single precision
        EXPECT_LT(flow.at("known_motion_px"), 1e-4);
        EXPECT_LT(flow.at("mean_error_px"), exact ? 1e-4 : 0.01);
        EXPECT_LE(flow.at("temporal").at("flicker_percent"), exact ? 0.0 : 0.2);
    }
    EXPECT_GT(moving.at("flow").at(0).at("known_motion_px"), 0.1);
    EXPECT_GT(moving.at("flow").at(0).at("points"), 1000);
    EXPECT_GT(still.at("tracks"), 500); // every second pixel each way of what is no sky
    EXPECT_EQ(still.at("thresholds"), 0.0);
    EXPECT_EQ(still.at("flicker_percent"), 0.0);
    EXPECT_EQ(still.at("crawl_percent"), 0.0);
    EXPECT_GT(moving.at("tracks"), 30);
    EXPECT_GT(moving.at("flicker_percent"), 1.0);
    EXPECT_EQ(moving.at("spectrum").size(), 4U);
}

TEST(AliasingCommand, RefusesWhatItCannotDoInOneSentence) {
    expect_refused(library_file("drives/straight.yaml") + " ",
                   {{"--supersample 5", "--supersample: found '5', expected an even number, 4 to 16"},
                    {"--samples 1,3", "--samples: found '3', expected 1, 4, 9 or 16"},
                    {"--samples 4,4", "--samples: found '4 twice', expected each value once"},
                    {"--texture-filters linear", "--texture-filters: found 'linear', expected none, mipmapped or trilinear"},
                    {"--moment 1 --frames 1:9", "--moment: found --frames too, expected one of the two"},
                    {"--frames 1:3", "found 1:3, expected 8 to 64 frames in a row"},
                    {"--moment 1e9", "expected 0 to "},
                    {"--flow", "--flow: found no --frames"},
                    {"--level 0", "--level: found '0', expected lux above 0"},
                    {"--resolution 4096x3072 --supersample 8", "expected at most 16384 pixels each way"},
                    {"--techniques photometric,photometric", "found photometric twice"}});
}

/// Frames as another simulator would leave them: a ring that moves, drawn by its value at the pixels' centres.
void write_ring(const std::string& folder, int frames, int k, bool png, double ramp_px) {
    std::filesystem::create_directories(folder);
    for (int t = 0; t < frames; ++t) {
        Frame frame;
        const int width = 96 * k, height = 80 * k;
        frame.luminance_cdm2 = Image<float>(width, height);
        frame.colour = Image<Rgb8>(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double px = (x + 0.5) / k - 0.618 * t, py = (y + 0.5) / k, from_edge = 24.0 - std::hypot(px - 40.0, py - 40.0);
                const double inside =
                    ramp_px > 0.0 ? 0.5 + 0.5 * std::sin(std::numbers::pi * std::clamp(from_edge / ramp_px, -0.5, 0.5)) : from_edge > 0.0;
                const double grain = 0.1 * (std::sin(0.5 * px) * std::cos(0.43 * py) + std::sin(0.31 * (px + py)));
                const double value = (0.2 + 0.8 * inside) * (1.0 + grain);
                frame.luminance_cdm2.at(x, y) = static_cast<float>(value);
                const auto level = static_cast<std::uint8_t>(std::lround(200.0 * value / 1.2));
                frame.colour.at(x, y) = {level, level, level};
            }
        const std::string name = folder + "/frame_" + std::to_string(1000 + t);
        View view;
        view.width_px = width;
        view.height_px = height;
        if (png)
            write_png(frame.colour, name + ".png");
        else
            write_exr(frame, Moment{}, view, name + ".exr");
    }
}

json sequence_found(const TemporaryFolder& folder, const std::string& flags, const std::string& out, int exit_code = 0) {
    const Outcome run = run_program("aliasing --quiet --rate 30 --ppd 20 " + flags + " --out " + (folder / out));
    EXPECT_EQ(run.exit_code, exit_code) << run.output;
    const json found = checked_aliasing(folder / (out + "/aliasing.json"));
    EXPECT_TRUE(std::filesystem::exists(folder / (out + "/aliasing.html")));
    return found.at("rows").at(0);
}

TEST(AliasingCommand, MeasuresFramesOfOthersByOpticalFlow) {
    const TemporaryFolder folder;
    write_ring(folder / "step", 10, 1, false, 0.0);
    write_ring(folder / "fine", 10, 4, false, 0.0);
    write_ring(folder / "ramp", 10, 1, false, 5.0);
    const json alone = sequence_found(folder, "--sequence " + (folder / "step"), "alone");
    const json smooth = sequence_found(folder, "--sequence " + (folder / "ramp"), "smooth");
    std::filesystem::copy_file(folder / "step/frame_1003.exr", folder / "step/other_1003.exr");
    const json pattern = sequence_found(folder, "--sequence '" + (folder / "step/frame_*.exr") + "'", "pattern");
    EXPECT_EQ(pattern.at("temporal"), alone.at("temporal")); // the same frames, the same bytes
    std::filesystem::remove(folder / "step/other_1003.exr");
    const json against = sequence_found(folder, "--sequence " + (folder / "step") + " --supersampled " + (folder / "fine"), "against");
    EXPECT_TRUE(alone.at("aliasing").contains("not_measured"));
    EXPECT_TRUE(alone.at("temporal").at("crawl_percent").is_null());
    EXPECT_NEAR(alone.at("temporal").at("motion").at("median_motion_px"), 0.618, 0.05);
    EXPECT_GT(alone.at("temporal").at("tracks"), 500);
    EXPECT_LT(smooth.at("temporal").at("flicker_percent"), 0.5);
    EXPECT_GT(alone.at("temporal").at("flicker_percent"), 1.0);
    EXPECT_GT(against.at("aliasing").at("contrast_percent"), 1.0);
    EXPECT_GT(against.at("temporal").at("flicker_percent"), 1.0);
    // With and without a reference, the same edge flickers much the same; an edge's aliasing spreads further once the reference tells it.
    EXPECT_NEAR(against.at("temporal").at("flicker_percent").get<double>() / alone.at("temporal").at("flicker_percent").get<double>(), 1.0,
                0.5);
    EXPECT_TRUE(against.at("technique").is_null());
}

TEST(AliasingCommand, ASkyIsNoSceneToFollow) {
    // A black sky with one small lit patch, 1 % of the picture, in which something moves.
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "night");
    for (int t = 0; t < 9; ++t) {
        Image<Rgb8> picture(320, 256);
        for (int y = 60; y < 84; ++y)
            for (int x = 60; x < 84; ++x) {
                const double wave = std::sin(0.6 * (x - 0.3 * t)) * std::cos(0.5 * y) + std::sin(0.4 * (x - 0.3 * t + y));
                const auto level = static_cast<std::uint8_t>(std::lround(120.0 + 40.0 * wave));
                picture.at(x, y) = {level, level, level};
            }
        write_png(picture, folder / ("night/frame_" + std::to_string(1000 + t) + ".png"));
    }
    const json row = sequence_found(folder, "--sequence " + (folder / "night"), "sky", 1);
    EXPECT_THAT(row.at("temporal").at("not_measured").get<std::string>(),
                HasSubstr("of 20480 points through all frames, and 5 % at least"));
}

TEST(AliasingCommand, RefusesFramesThatAreNoSequence) {
    const TemporaryFolder folder;
    for (const char* name : {"png", "gap", "mixed", "twice"})
        write_ring(folder / name, 9, 1, true, 0.0);
    std::filesystem::remove(folder / "gap/frame_1004.png");
    write_ring(folder / "few", 7, 1, true, 0.0);
    std::filesystem::copy_file(folder / "png/frame_1000.png", folder / "twice/other1003.png");
    write_ring(folder / "exr", 9, 1, false, 0.0);
    std::filesystem::rename(folder / "mixed/frame_1008.png", folder / "mixed/old.part");
    std::filesystem::copy_file(folder / "exr/frame_1008.exr", folder / "mixed/frame_1008.exr");
    std::filesystem::create_directories(folder / "broken");
    for (int t = 0; t < 8; ++t)
        std::ofstream(folder / ("broken/" + std::to_string(t) + ".png")) << "no picture";
    const std::string rate = " --rate 30 --ppd 20", ours = "--sequence " + (folder / "png");
    expect_refused("", {{"--sequence " + (folder / "nowhere") + rate, "is no folder, expected a folder of PNG or EXR files"},
                        {"--sequence " + (folder / "gap") + rate, "frame 1004 is missing"},
                        {"--sequence " + (folder / "few") + rate, "found 7 numbered frames, expected 8 to 64"},
                        {"--sequence " + (folder / "twice") + rate, "frame 1003 is there twice: frame_1003.png and other1003.png"},
                        {"--sequence " + (folder / "mixed") + rate, "is exr among others"},
                        {"--sequence '" + (folder / "twice/other*.png") + "'" + rate, "found 1 numbered frames"},
                        {"--sequence " + (folder / "broken") + rate, "cannot be read"},
                        {ours + " --ppd 20", "--rate: is missing"},
                        {ours + " --rate 7 --ppd 20", "--rate: found '7', expected 8 to 10000"},
                        {ours + " --rate 30", "--ppd: is missing"},
                        {ours + rate + " --vertical-fov 30", "--ppd: found --vertical-fov too"},
                        {ours + rate + " --frames 1000:1020", "has no frame 1009"},
                        {ours + rate + " --supersampled " + (folder / "png"), "expected 4, 6, 8 ... or 16 times"},
                        {ours + rate + " " + library_file("drives/straight.yaml"), "DRIVE: found --sequence too"},
                        {ours + rate + " --samples 4", "--sequence: found beside --samples, expected one of them"},
                        {"--quiet", "DRIVE: is missing"}});
}

/// The ring again, saying how it was shown; frames from `other_from` on say something else.
void write_shown_ring(const std::string& folder, int k, const PictureTags& tags, int other_from = 9, const PictureTags& other = {}) {
    write_ring(folder, 9, k, true, 0.0);
    for (int t = 0; t < 9; ++t) {
        const std::string file = folder + "/frame_" + std::to_string(1000 + t) + ".png";
        write_png(read_png(file), t < other_from ? tags : other, file);
    }
}

TEST(AliasingCommand, RefusesFramesThatWereShownInDifferentWays) {
    const TemporaryFolder folder;
    const PictureTags usual{"rational s=20 white=100 cd/m2; display srgb", ""}, linear{"linear white=50 cd/m2; display srgb", ""};
    write_shown_ring(folder / "usual", 1, usual);
    write_shown_ring(folder / "fine", 4, usual);
    write_shown_ring(folder / "fine-linear", 4, linear);
    write_shown_ring(folder / "mixed", 1, usual, 5, linear);
    write_shown_ring(folder / "fine-unknown", 4, {});
    FilesRead opened;
    write_shown_ring(folder / "profile", 1,
                     {usual.shown_by, icc_profile(read_display_profile(library_file("displays/projector.yaml"), opened))});
    expect_refused("--rate 30 --ppd 20 --out " + (folder / "refused") + " --sequence ",
                   {{(folder / "usual") + " --supersampled " + (folder / "fine-linear"),
                     "frame_1000.png: was shown by 'linear white=50 cd/m2; display srgb', expected 'rational s=20 white=100 cd/m2; "
                     "display srgb' as the sequence, or the EXRs of the same moments"},
                    {folder / "mixed", "frame_1005.png: was shown by 'linear white=50 cd/m2; display srgb', expected 'rational s=20 "
                                       "white=100 cd/m2; display srgb' as the first frame"},
                    {folder / "profile", "frame_1000.png: has the colour space of a display, by an ICC profile"}});
    EXPECT_FALSE(std::filesystem::exists(folder / "refused"));
    // The same words as those of `compare`.
    EXPECT_THAT(printed("compare " + (folder / "usual/frame_1000.png") + " " + (folder / "mixed/frame_1008.png"), 2),
                HasSubstr("was shown by 'linear white=50 cd/m2; display srgb', expected 'rational s=20 white=100 cd/m2; "
                          "display srgb' as the reference, or the EXRs of the same moments"));
    sequence_found(folder, "--sequence " + (folder / "usual") + " --supersampled " + (folder / "fine"), "alike");
    sequence_found(folder, "--sequence " + (folder / "usual") + " --supersampled " + (folder / "fine-unknown"), "unknown");
    const auto notes = [&](const std::string& out) { return json::parse(content_of(folder / (out + "/aliasing.json"))).at("notes"); };
    EXPECT_EQ(notes("alike").size(), 0U);
    ASSERT_EQ(notes("unknown").size(), 1U);
    EXPECT_THAT(notes("unknown").at(0).get<std::string>(), HasSubstr("--supersampled does not tell (no fernlicht:shown_by)"));
    EXPECT_THAT(content_of(folder / "unknown/aliasing.html"), HasSubstr("--supersampled does not tell"));
}

TEST(AliasingCommand, WhatHasNoLuminanceIsNotMeasuredUnlessAsDisplayed) {
    const TemporaryFolder folder;
    const std::string common =
        "aliasing --quiet --moment 1 --resolution 64x48 --techniques full --beams float --samples 1 --texture-filters none "
        "--out ";
    EXPECT_THAT(printed(common + (folder / "none") + " " + library_file("drives/straight.yaml"), 1),
                HasSubstr("technique full computes no luminance"));
    printed(common + (folder / "shown") + " --values display " + library_file("drives/straight.yaml"));
    const json row = json::parse(content_of(folder / "shown/aliasing.json")).at("rows").at(0);
    EXPECT_GT(row.at("aliasing").at("contrast_percent"), 0.1);
}

} // namespace
} // namespace fernlicht
