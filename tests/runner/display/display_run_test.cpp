// Tone mappers and displays through the program: what a drive asks for is what its pictures are, and what it does not ask for changes
// nothing.
#include "metrics/display/display_colour.h"
#include "runner/display/icc_profile.h"
#include "runner/display/shown_picture.h"
#include "runner/picture_file.h"
#include "scenarios/display/tone_curve.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;

constexpr const char* few = " --quiet --frames 20:22 --resolution 96x72 --capture all --no-accuracy --backend osmesa ";
constexpr const char* picture = "/frames/oncoming-1-halogen/driver-000021.png";

/// The shipped drive with oncoming cars, halogen alone and nothing measured, with other lines at its end.
std::string drive_with(const TemporaryFolder& folder, const std::string& name, const std::string& lines) {
    std::string text = content_of(library_file("drives/oncoming.yaml"));
    for (std::size_t at = 0; (at = text.find("../", at)) != std::string::npos;)
        text.replace(at, 3, library_file(""));
    text.erase(text.find("  xenon: "), text.find("traffic_light: ") - text.find("  xenon: "));
    text.erase(text.find("  map: "));
    text += "measure: {extent: false}\n";
    const std::string path = folder / (name + ".yaml");
    std::ofstream(path) << text << lines;
    return path;
}

std::string played(const TemporaryFolder& folder, const std::string& name, const std::string& lines) {
    const std::string out = folder / name;
    const Outcome run = run_program("run " + drive_with(folder, name, lines) + few + "--out " + out);
    EXPECT_LE(run.exit_code, 1) << run.output;
    return out;
}

double brightest(const Image<Rgb8>& image) {
    int most = 0;
    for (const Rgb8& pixel : image.pixels())
        most = std::max({most, int{pixel.r}, int{pixel.g}, int{pixel.b}});
    return most;
}

TEST(DisplayRun, NamingTheDefaultsChangesNoPixel) {
    const TemporaryFolder folder;
    const Image<Rgb8> plain = read_png(played(folder, "plain", "") + picture);
    EXPECT_EQ(read_png(played(folder, "named", "tone_mapper: {kind: rational, s: 20, l_max_cdm2: 100}\n") + picture), plain);
    // The same after drawing, with each channel clipped, within a code: the drawing rounds its floats first. Where others' lamps are seen,
    // a few pixels, drawing takes the brighter of lamp and surface in each channel, and light adds up.
    const std::string profile = folder / "clipping.yaml";
    std::ofstream(profile) << content_of(library_file("displays/srgb.yaml")) << "gamut: clip\n";
    const Image<Rgb8> after = read_png(played(folder, "after", "display: " + profile + "\n") + picture);
    ASSERT_EQ(after.size(), plain.size());
    int apart = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const Rgb8 a = after.pixels()[i], b = plain.pixels()[i];
        apart += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 1 ? 1 : 0;
    }
    EXPECT_LT(apart, 40);
    EXPECT_LT(apart, static_cast<int>(plain.size()) / 100);
}

TEST(DisplayRun, PicturesSayWhatTheyWereShownBy) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_png_tags(played(folder, "plain", "") + picture).shown_by, "rational s=20 white=100 cd/m2; display srgb");
    const std::string out =
        played(folder, "eye",
               "tone_mapper: {kind: linear, l_max_cdm2: 50}\ndisplay: {profile: " + library_file("displays/projector.yaml") +
                   ", windscreen: {haze: 0.02}, eye: {veil: {age_years: 60}, colours: true, sharpness: true}}\n");
    EXPECT_THAT(read_png_tags(out + picture).shown_by,
                testing::MatchesRegex("linear white=50 cd/m2; display projector \\([0-9a-f]*\\); windscreen 0.75 haze "
                                      "0.02; eye of 60 years; colours at night; sharpness at night"));
    const json report = json::parse(content_of(out + "/report.json"));
    std::vector<std::string> passes;
    for (const json& row : report.at("timing"))
        passes.push_back(row.at("pass").get<std::string>());
    EXPECT_THAT(passes, testing::IsSupersetOf({"display: windscreen", "display: veil in the eye", "display: colours at night",
                                               "display: sharpness at night", "display: tone mapper and display"}));
}

TEST(DisplayRun, FittedNumbersStandInTheResolvedDriveWhichGivesTheSamePictures) {
    for (const std::string mapper : {"{kind: rational, s: fitted, l_max_cdm2: surfaces}", "{kind: linear, l_max_cdm2: all}",
                                     "{kind: histogram, l_max_cdm2: surfaces}"}) {
        const TemporaryFolder folder;
        const std::string out = played(folder, "open", "tone_mapper: " + mapper + "\n"), resolved = content_of(out + "/oncoming-1.yaml");
        EXPECT_EQ(resolved.find("fitted\n"), std::string::npos);
        EXPECT_EQ(resolved.find("l_max_cdm2: surfaces"), std::string::npos);
        EXPECT_THAT(content_of(out + "/report.json"), testing::HasSubstr("tone mapper fitted to 12 moments")) << mapper;
        const Outcome again = run_program("run " + out + "/oncoming-1.yaml" + few + "--out " + (folder / "again"));
        EXPECT_LE(again.exit_code, 1) << again.output;
        EXPECT_EQ(content_of(folder / "again" + picture), content_of(out + picture)) << mapper;
    }
}

/// White is the brightest of all, so that light sources alone are white; or of surfaces, so that the road is brighter.
TEST(DisplayRun, WhiteOfSurfacesClipsTheLightSources) {
    const TemporaryFolder folder;
    const auto white = [&](const std::string& name, const std::string& l_max) {
        const std::string resolved =
            content_of(played(folder, name, "tone_mapper: {kind: linear, l_max_cdm2: " + l_max + "}\n") + "/oncoming-1.yaml");
        return std::stod(resolved.substr(resolved.find("l_max_cdm2: ") + 12));
    };
    const double all = white("all", "all"), surfaces = white("surfaces", "surfaces");
    EXPECT_GT(all, 10.0 * surfaces);
    EXPECT_GT(surfaces, 0.5);
    EXPECT_EQ(brightest(read_png(folder / "surfaces" + picture)), 255.0);
}

TEST(DisplayRun, VeilAndWindscreenDoWhatTheySay) {
    const TemporaryFolder folder;
    const auto mean = [&](const std::string& name, const std::string& lines) {
        const Image<Rgb8> image = read_png(played(folder, name, "tone_mapper: {kind: linear, l_max_cdm2: 20}\n" + lines) + picture);
        double sum = 0.0;
        for (const Rgb8& pixel : image.pixels())
            sum += decoded(srgb_display(), pixel.g / 255.0);
        return sum / static_cast<double>(image.size());
    };
    const double plain = mean("plain", ""), behind = mean("behind", "display: {windscreen: {transmittance: 0.5, haze: 0}}\n");
    EXPECT_LT(behind, 0.8 * plain);
    EXPECT_GT(mean("veiled", "display: {eye: {veil: {age_years: 80}}}\n"), plain); // the sky beside the oncoming lamps
}

TEST(DisplayRun, AdaptationNeedsNoMoreThanItsPictures) {
    const TemporaryFolder folder;
    const std::string out = played(folder, "adapting", "display: {adaptation: {brighter_s: 0.05, darker_s: 0.05}}\n");
    EXPECT_THAT(read_png_tags(out + picture).shown_by, testing::EndsWith("; adapting"));
    EXPECT_THAT(read_png_tags(out + "/frames/oncoming-1-halogen/driver-000020.png").shown_by, testing::HasSubstr("white=100 cd/m2"));
    EXPECT_THAT(read_png_tags(out + picture).shown_by, testing::Not(testing::HasSubstr("white=100 cd/m2")));
}

TEST(DisplayRun, PicturesOfAnHdrMonitorHaveSixteenBitsAndItsProfile) {
    const TemporaryFolder folder;
    const std::string out = played(folder, "hdr", "display: " + library_file("displays/hdr-monitor.yaml") + "\n");
    const std::string bytes = content_of(out + picture);
    EXPECT_EQ(bytes[24], 16); // IHDR: bits
    EXPECT_THAT(bytes, testing::HasSubstr("iCCP"));
    EXPECT_THAT(content_of(played(folder, "plain", "") + picture), testing::HasSubstr("sRGB"));
}

/// Two exposures, two tone mappers, two values of s, two displays: refused, each by what differs.
TEST(DisplayRun, PicturesWithoutACommonScaleAreNotCompared) {
    const TemporaryFolder folder;
    const auto stored = [&](const std::string& name, const DisplaySettings& display, const ToneMapper& mapper) {
        write_png(Image<Rgb8>(16, 16, {20, 30, 40}), {shown_by(display, mapper), ""}, folder / (name + ".png"));
        return folder / (name + ".png");
    };
    ToneMapper mapper;
    const std::string plain = stored("plain", {}, mapper);
    const auto compared = [&](const std::string& other) {
        const Outcome run = run_program("compare " + plain + " " + other);
        EXPECT_EQ(run.exit_code, 2) << run.output;
        return run.output;
    };
    mapper.l_max_cdm2 = 50.0;
    EXPECT_THAT(compared(stored("exposure", {}, mapper)), testing::HasSubstr("was shown by 'rational s=20 white=50 cd/m2; display srgb'"));
    mapper = {};
    mapper.kind = ToneMapperKind::logarithmic;
    EXPECT_THAT(compared(stored("mapper", {}, mapper)), testing::HasSubstr("expected 'rational s=20 white=100 cd/m2; display srgb'"));
    mapper = {};
    mapper.s = 19.0;
    EXPECT_THAT(compared(stored("s", {}, mapper)), testing::HasSubstr("s=19 "));
    FilesRead opened;
    DisplaySettings projector;
    projector.profile = read_display_profile(library_file("displays/projector.yaml"), opened);
    EXPECT_THAT(compared(stored("profile", projector, {})), testing::HasSubstr("display projector"));
    write_png(Image<Rgb8>(16, 16), {shown_by(projector, {}), icc_profile(*projector.profile)}, folder / "icc.png");
    const Outcome same = run_program("compare " + (folder / "icc.png") + " " + (folder / "icc.png"));
    EXPECT_EQ(same.exit_code, 2);
    EXPECT_THAT(same.output, testing::HasSubstr("ICC profile"));
    EXPECT_EQ(run_program("compare " + plain + " " + plain).exit_code, 0);
}

TEST(DisplayRun, WhatFitsNothingRefusesAMapperThatIsToBeFitted) {
    const TemporaryFolder folder;
    const std::string drive = drive_with(folder, "open", "tone_mapper: {kind: histogram, l_max_cdm2: all}\n");
    for (const std::string command : {"reference ", "aliasing "}) {
        const Outcome run = run_program(command + drive + " --out " + (folder / "o"));
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_THAT(run.output, testing::HasSubstr("as the resolved drive of a run has them")) << command;
        EXPECT_FALSE(std::filesystem::exists(folder / "o"));
    }
}

TEST(DisplayRun, RefusalsAreASentence) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& lines) {
        const Outcome run = run_program("run " + drive_with(folder, "bad", lines) + few + "--out " + (folder / "bad"));
        EXPECT_EQ(run.exit_code, 2) << run.output;
        return run.output;
    };
    EXPECT_THAT(refused("tone_mapper: {kind: linear, s: fitted}\n"), testing::HasSubstr("only `kind: rational`"));
    EXPECT_THAT(refused("tone_mapper: {s: fitted}\ntechnique: full\n"), testing::HasSubstr("computes no luminance"));
    EXPECT_THAT(refused("display: nowhere.yaml\n"), testing::HasSubstr("nowhere.yaml"));
    EXPECT_THAT(refused("display: {eye: {age: 3}}\n"), testing::HasSubstr("display.eye"));
    EXPECT_THAT(refused("display: {windscreen: {haze: 0.5}}\n"), testing::HasSubstr("0.3"));
    EXPECT_THAT(refused("tone_mapper: {kind: histogram, curve: [[0, -1], [1, -2]]}\n"), testing::HasSubstr("rise"));
}

} // namespace
} // namespace fernlicht
