// Tone mappers and displays through the program: what a drive asks for is what its pictures are, and what it does not ask for changes
// nothing.
#include "metrics/display/display_colour.h"
#include "metrics/display/night_vision.h"
#include "runner/experiments/compare/picture_comparison.h"
#include "runner/files/picture_file.h"
#include "runner/play/display_pipeline.h"
#include "scenarios/display/tone_mapper.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::AllOf, testing::HasSubstr, testing::IsEmpty, testing::Not;

using nlohmann::json;

constexpr const char* few_shown = " --quiet --frames 20:22 --resolution 96x72 --capture all --no-accuracy --backend software ";
constexpr const char* halogen_white = "; white adapted 0.66 to x=0.4234 y=0.3989";
constexpr const char *picture = "/frames/oncoming-1-halogen/driver-000021.png", *exr = "/frames/oncoming-1-halogen/driver-000021.exr";

/// The shipped drive with oncoming cars, halogen alone and nothing measured, with other lines at its end.
std::string drive_with(const TemporaryFolder& folder, const std::string& name, const std::string& lines) {
    std::string text = content_of(library_file("drives/oncoming.yaml"));
    for (std::size_t at = 0; (at = text.find("../", at)) != std::string::npos;)
        text.replace(at, 3, library_file(""));
    text.erase(text.find("  xenon: "), text.find("traffic_light: ") - text.find("  xenon: "));
    text.erase(text.find("  map: "));
    text += std::string("measure: {extent: false}\n") + (lines.find("shadows: ") == std::string::npos ? "shadows: none\n" : "");
    std::string path = folder / (name + ".yaml");
    std::ofstream(path) << text << lines;
    return path;
}

std::string played(const TemporaryFolder& folder, const std::string& name, const std::string& lines) {
    std::string out = folder / name;
    const Outcome run = run_program("run " + drive_with(folder, name, lines) + few_shown + "--out " + out);
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
    EXPECT_EQ(read_png_tags(played(folder, "plain", "") + picture).shown_by,
              std::string("rational s=20 white=100 cd/m2; display srgb") + halogen_white);
    const std::string out =
        played(folder, "eye",
               "tone_mapper: {kind: linear, l_max_cdm2: 50}\ndisplay: {profile: " + library_file("displays/projector.yaml") +
                   ", windscreen: {haze: 0.02}, eye: {veil: {age_years: 60}, colours: true, sharpness: true}}\n");
    EXPECT_THAT(
        read_png_tags(out + picture).shown_by,
        testing::MatchesRegex(
            "linear white=50 cd/m2; display projector \\([0-9a-f]*\\); windscreen 0.75 haze "
            "0.02; eye of 60 years, pigmentation 0.5; colours at night; sharpness at night; white adapted 0.66 to x=0.4... y=0.3..."));
    const json report = json::parse(content_of(out + "/report.json"));
    EXPECT_THAT(content_of(out + "/report.json"), Not(HasSubstr("compiled during the drive")));
    std::vector<std::string> passes;
    for (const json& row : report.at("times").at(0).at("passes"))
        passes.push_back(row.at("pass").get<std::string>());
    EXPECT_THAT(passes, testing::IsSupersetOf({"display: windscreen", "display: veil in the eye", "display: colours at night",
                                               "display: sharpness at night", "display: tone mapper and display"}));
}

json drive_in(const std::string& out) {
    const json report = json::parse(content_of(out + "/report.json"));
    EXPECT_THAT(tests::complaints(report, "run/report"), IsEmpty());
    return report.at("drives").at(0);
}

// rational with s = 20 and white at 100 cd/m2 shows 0.1 cd/m2 with 2 / 101.9 of white, 10 with 200 / 290.
TEST(DisplayRun, ReportAndPageSayHowPicturesWereShown) {
    const TemporaryFolder folder;
    const auto shown = [](const json& drive, std::size_t i) {
        return drive.at("shown_by").at("luminances").at(i).at("shown_cdm2").get<double>();
    };
    const std::string plain = played(folder, "plain", "shadows: map\n");
    json drive = drive_in(plain);
    const std::string white = "white of an eye adapted to light of x = 0.4234, y = 0.3989 by 0.66 (CAT16)";
    EXPECT_EQ(drive.at("shown_by").at("text"), std::string("rational s=20 white=100 cd/m2; display srgb") + halogen_white);
    EXPECT_EQ(drive.at("shown_by").at("gamut"), "clip");
    EXPECT_EQ(drive.at("shown_by").at("stages"), json{white});
    EXPECT_NEAR(shown(drive, 0), 80.0 * 2.0 / 101.9, 1e-5);
    EXPECT_EQ(drive.at("shadows"), json::parse(R"({"method": "map", "objects_cast": true, "not_used": null,
        "settings": {"map_texels": [1024, 512], "tolerance_m": 0.03, "redraw_texels": 0}})"));
    const std::string short_page = content_of(plain + "/report.html");
    EXPECT_THAT(short_page, HasSubstr(std::string("By <code>rational s=20 white=100 cd/m2; display srgb") + halogen_white +
                                      "</code>: 0.1, 1 and 10 cd/m² as 1.57, 13.4 and 55.2 cd/m² where white is 80 cd/m²"));
    EXPECT_THAT(short_page, HasSubstr("Shadows by <code>map</code> (map_texels [1024, 512], tolerance_m 0.03)"));
    EXPECT_THAT(short_page, Not(HasSubstr("<li>Tone mapper")));

    const std::string all = played(
        folder, "all",
        "shadows: {method: soft-map, lamp_places: 2, redraw_texels: 0.5}\ndisplay: {profile: " + library_file("displays/hdr-monitor.yaml") +
            ", windscreen: {haze: 0.02}, eye: {veil: {age_years: 60}, colours: true, sharpness: true}, "
            "adaptation: {brighter_s: 0.5, darker_s: 10}}\n");
    drive = drive_in(all);
    EXPECT_NEAR(shown(drive, 0), 0.001 + 999.999 * 2.0 / 101.9, 1e-4);
    EXPECT_NEAR(shown(drive, 2), 0.001 + 999.999 * 200.0 / 290.0, 1e-3);
    EXPECT_EQ(drive.at("shown_by").at("display"), "hdr-monitor");
    EXPECT_EQ(drive.at("shown_by").at("gamut"), "keep-luminance");
    const json stages{"windscreen, transmittance 0.75, haze 0.02",
                      "veil in an eye of 60 years, pigmentation 0.5",
                      "colours at night",
                      "sharpness at night",
                      white,
                      "adaptation: white follows the driver's picture, in 0.5 s towards brighter and 10 s towards darker light"};
    EXPECT_EQ(drive.at("shown_by").at("stages"), stages);
    EXPECT_EQ(drive.at("shadows").at("settings").at("lamp_places"), 2);
    const std::string page = content_of(all + "/report.html");
    for (const char* words :
         {"<li>windscreen, transmittance 0.75, haze 0.02</li>", "<li>veil in an eye of 60 years, pigmentation 0.5</li>",
          "<li>colours at night</li>", "<li>sharpness at night</li>", "<li>adaptation: white follows",
          "Tone mapper <code>rational</code>, s = 20, white at 100 cd/m² at first",
          ("Display <code>hdr-monitor</code> (HDR monitor, 1000 cd/m2): peak 1000 cd/m², black 0.001 cd/m², 16 bits; colours "
           "that it does not hold keep their luminance"),
          "0.1, 1 and 10 cd/m² is shown with 19.6, 168 and 690 cd/m² at first", "redraw_texels 0.5, lamp_radius_m 0.06, lamp_places 2)",
          ">display: veil in the eye</td>", ">display: tone mapper and display</td>"})
        EXPECT_THAT(page, HasSubstr(words));

    // Published techniques have shadows of their own, or none.
    const std::string full = folder / "full";
    const Outcome run =
        run_program("run " + drive_with(folder, "full", "shadows: volumes\n") + few_shown + "--technique full --out " + full);
    EXPECT_LE(run.exit_code, 1) << run.output;
    EXPECT_EQ(read_png_tags(full + picture).shown_by, "rational s=20 white=100 cd/m2; display srgb"); // it knows no colours of lamps
    EXPECT_EQ(drive_in(full).at("shadows").at("not_used"), "it renders no shadows of lamps");
    EXPECT_THAT(content_of(full + "/report.html"), HasSubstr("technique <code>full</code> does not use it: it renders no shadows"));
}

/// Colours change and nothing else; the resolved drive has what was found, and `degree: 0` leaves colours as they are.
TEST(DisplayRun, ColoursAreThoseOfAnEyeInTheLampsLight) {
    const TemporaryFolder folder;
    const std::string usual = played(folder, "usual", ""), plain = played(folder, "plain", "display: {eye: {white: {degree: 0}}}\n");
    EXPECT_THAT(content_of(usual + "/oncoming-1.yaml"), HasSubstr("white: {degree: 0.66, xy: [0.4234, 0.3989]}"));
    EXPECT_EQ(read_png_tags(plain + picture).shown_by, "rational s=20 white=100 cd/m2; display srgb");
    EXPECT_EQ(content_of(usual + exr), content_of(plain + exr));
    const Image<Rgb8> adapted = read_png(usual + picture), as_it_is = read_png(plain + picture);
    const auto seen = [](const Rgb8& p) { return shown_xyz(srgb_display(), glm::dvec3(p.r, p.g, p.b) / 255.0); };
    const glm::dvec3 road = seen(adapted.at(48, 60)), orange = seen(as_it_is.at(48, 60));
    EXPECT_NEAR(road.y / orange.y, 1.0, 0.03); // codes are rounded
    EXPECT_NEAR(chromaticity_of(road).x, 0.346, 0.012);
    EXPECT_NEAR(chromaticity_of(orange).x, 0.423, 0.012);
}

/// A camera's noise is the same in each run. The sky is lit where nothing stands before it. EXRs keep their bytes.
TEST(DisplayRun, CameraAndNightSkyAreInPicturesAlone) {
    const TemporaryFolder folder;
    const std::string lines = "display: {eye: {camera: {iso: 1600, bloom: 0}, white: {degree: 0}}}\n";
    const std::string out = played(folder, "camera", lines), again = played(folder, "again", lines), plain = played(folder, "plain", "");
    EXPECT_EQ(read_png_tags(out + picture).shown_by,
              "camera 0.02 s f/1.8 ISO 1600, 4000 e- at saturation, read noise 3 e-, bloom 0, tone srgb");
    EXPECT_EQ(content_of(out + picture), content_of(again + picture));
    const json shown_by = drive_in(out).at("shown_by");
    EXPECT_NEAR(shown_by.at("white_cdm2").get<double>(), 12.15, 1e-4); // 78 / 1600 lx s by 0.65 0.02 / 1.8^2
    EXPECT_NEAR(shown_by.at("luminances").at(1).at("shown_cdm2").get<double>(), 80.0 / 12.15, 1e-3);
    const std::string sky = played(folder, "sky", "display: {sky: {towns: {a: {azimuth_deg: 90, distance_km: 3, inhabitants: 1e6}}}}\n");
    const Image<Rgb8> lit = read_png(sky + picture), dark = read_png(plain + picture);
    EXPECT_GT(lit.at(20, 30).g, lit.at(20, 2).g); // brighter towards the horizon
    EXPECT_GT(lit.at(20, 30).g, dark.at(20, 30).g + 20);
    EXPECT_THAT(read_png_tags(sky + picture).shown_by, HasSubstr("; night sky 0.00025 cd/m2 ("));
    for (const std::string& other : {out, sky})
        EXPECT_EQ(content_of(other + exr), content_of(plain + exr));
}

// As docs/display.md says: white at the display's peak shows L as L + black (1 - L / peak). The codes that are written are decoded for the
// mean, and 16 bits of PQ are 0.0003 apart.
TEST(DisplayRun, WhiteAtThePeakOfAnHdrDisplayShowsLuminancesOneToOne) {
    const TemporaryFolder folder;
    const std::string out =
        played(folder, "one",
               "tone_mapper: {kind: linear, l_max_cdm2: 1000}\ndisplay: {profile: " + library_file("displays/hdr-monitor.yaml") + "}\n");
    const json drive = drive_in(out);
    for (const auto& [i, seen] : {std::pair(0, 0.1), std::pair(1, 1.0), std::pair(2, 10.0)})
        EXPECT_NEAR(drive.at("shown_by").at("luminances").at(static_cast<std::size_t>(i)).at("shown_cdm2").get<double>(),
                    seen + 0.001 * (1.0 - seen / 1000.0), 1e-6 * seen);
    double sum = 0.0;
    std::size_t pixels = 0;
    for (const char* tick : {"20", "21", "22"})
        for (const PictureChannel& channel : read_exr(out + "/frames/oncoming-1-halogen/driver-0000" + tick + ".exr"))
            if (channel.name == "luminance.cdm2")
                for (const float l : channel.values.pixels()) {
                    const double shown = std::min(static_cast<double>(l), 1000.0);
                    sum += shown + 0.001 * (1.0 - shown / 1000.0);
                    ++pixels;
                }
    ASSERT_EQ(pixels, std::size_t{3 * 96 * 72});
    const json& view = drive.at("display").at("views").at(0);
    ASSERT_EQ(view.at("pictures"), 3);
    EXPECT_NEAR(view.at("mean_cdm2").get<double>() / (sum / static_cast<double>(pixels)), 1.0, 0.005);
}

TEST(DisplayRun, FittedNumbersStandInTheResolvedDriveWhichGivesTheSamePictures) {
    for (const std::string mapper : {"{kind: rational, s: fitted, l_max_cdm2: surfaces}", "{kind: linear, l_max_cdm2: all}",
                                     "{kind: histogram, l_max_cdm2: surfaces}"}) {
        const TemporaryFolder folder;
        const std::string out = played(folder, "open", "tone_mapper: " + mapper + "\n"), resolved = content_of(out + "/oncoming-1.yaml");
        EXPECT_EQ(resolved.find("fitted\n"), std::string::npos);
        EXPECT_EQ(resolved.find("l_max_cdm2: surfaces"), std::string::npos);
        EXPECT_THAT(content_of(out + "/report.json"), HasSubstr("tone mapper fitted to 12 moments")) << mapper;
        const Outcome again = run_program("run " + out + "/oncoming-1.yaml" + few_shown + "--out " + (folder / "again"));
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

/// A curve has its own white, e^3 cd/m2; a plain word is that kind; a kind writes what it uses; and what is written is read to the same.
TEST(DisplayRun, ResolvedToneMappersSayWhatTheyUseAndNoMore) {
    const TemporaryFolder folder;
    const auto written = [&](const std::string& name, const std::string& mapper) {
        const std::string out = played(folder, name, "tone_mapper: " + mapper + "\n"), resolved = content_of(out + "/oncoming-1.yaml");
        const std::size_t at = resolved.find("tone_mapper: ");
        std::string line = resolved.substr(at, resolved.find('\n', at) - at);
        const std::string again = folder / (name + "-again");
        EXPECT_LE(run_program("run " + out + "/oncoming-1.yaml" + few_shown + "--out " + again).exit_code, 1);
        EXPECT_THAT(content_of(again + "/oncoming-1.yaml"), HasSubstr(line + "\n"));
        EXPECT_EQ(content_of(again + picture), content_of(out + picture)) << mapper;
        return line;
    };
    const std::string curve = written("curve", "{kind: histogram, curve: [[-4.6, -5.3], [0, -1.6], [3.0, 0]]}");
    EXPECT_THAT(curve,
                testing::StartsWith("tone_mapper: {kind: histogram, l_max_cdm2: 20.085536923187668, curve: [[-4.6, -5.3], [0, -1.6], ["));
    EXPECT_THAT(read_png_tags(folder / "curve" + picture).shown_by, HasSubstr(" white=20.0855 cd/m2"));
    EXPECT_THAT(written("rounded", "{kind: histogram, l_max_cdm2: 100, curve: [[-4.6, -5.3], [0, -1.6], [4.605, 0]]}"),
                HasSubstr("l_max_cdm2: 100, curve: [[-4.6, -5.3], [0, -1.6], [4.605170"));
    EXPECT_EQ(written("linear", "linear"), "tone_mapper: {kind: linear, l_max_cdm2: 100}");
    EXPECT_EQ(written("word", "logarithmic"), "tone_mapper: {kind: logarithmic, s: 20, l_max_cdm2: 100}");
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
    EXPECT_THAT(read_png_tags(out + picture).shown_by, testing::EndsWith(std::string(halogen_white) + "; adapting"));
    EXPECT_THAT(content_of(out + "/report.json"), Not(HasSubstr("compiled during the drive")));
    EXPECT_THAT(read_png_tags(out + "/frames/oncoming-1-halogen/driver-000020.png").shown_by, HasSubstr("white=100 cd/m2"));
    EXPECT_THAT(read_png_tags(out + picture).shown_by, Not(HasSubstr("white=100 cd/m2")));
}

TEST(DisplayRun, PicturesOfAnHdrMonitorHaveSixteenBitsAndItsProfile) {
    const TemporaryFolder folder;
    const std::string out = played(folder, "hdr", "display: " + library_file("displays/hdr-monitor.yaml") + "\n");
    const std::string bytes = content_of(out + picture);
    EXPECT_EQ(bytes[24], 16); // IHDR: bits
    EXPECT_THAT(bytes, HasSubstr("iCCP"));
    EXPECT_THAT(content_of(played(folder, "plain", "") + picture), HasSubstr("sRGB"));
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
    EXPECT_THAT(compared(stored("exposure", {}, mapper)), HasSubstr("was shown by 'rational s=20 white=50 cd/m2; display srgb'"));
    mapper = {};
    mapper.kind = ToneMapperKind::logarithmic;
    EXPECT_THAT(compared(stored("mapper", {}, mapper)), HasSubstr("expected 'rational s=20 white=100 cd/m2; display srgb'"));
    mapper = {};
    mapper.s = 19.0;
    EXPECT_THAT(compared(stored("s", {}, mapper)), HasSubstr("s=19 "));
    DisplaySettings halogen;
    halogen.white = {0.66, glm::dvec2(0.4234, 0.399)};
    EXPECT_THAT(compared(stored("halogen", halogen, {})), HasSubstr("display srgb; white adapted 0.66 to x=0.4234 y=0.3990'"));
    FilesRead opened;
    DisplaySettings projector;
    projector.profile = read_display_profile(library_file("displays/projector.yaml"), opened);
    EXPECT_THAT(compared(stored("profile", projector, {})), HasSubstr("display projector"));
    DisplaySettings eye;
    eye.veil = EyeVeil{60.0, 0.0};
    const std::string dark = stored("dark", eye, {});
    eye.veil->pigmentation = 1.2;
    const Outcome eyes = run_program("compare " + dark + " " + stored("light", eye, {}));
    EXPECT_EQ(eyes.exit_code, 2);
    EXPECT_THAT(eyes.output, AllOf(HasSubstr("eye of 60 years, pigmentation 1.2'"),
                                   HasSubstr("expected 'rational s=20 white=100 cd/m2; display srgb, luminance kept; eye of 60 years, "
                                             "pigmentation 0'")));
    // The same tone mapper and display, each channel clipped as drawn and with luminance kept.
    DisplaySettings clear;
    clear.windscreen = Windscreen{1.0, 0.0};
    EXPECT_THAT(compared(stored("kept", clear, {})), HasSubstr("display srgb, luminance kept; windscreen 1 haze 0'"));
    write_png(Image<Rgb8>(16, 16), {shown_by(projector, {}), icc_profile(*projector.profile)}, folder / "icc.png");
    const Outcome same = run_program("compare " + (folder / "icc.png") + " " + (folder / "icc.png"));
    EXPECT_EQ(same.exit_code, 2);
    EXPECT_THAT(same.output, HasSubstr("ICC profile"));
    EXPECT_EQ(run_program("compare " + plain + " " + plain).exit_code, 0);
}

/// Of others, or of programs that drop what a PNG carries: nothing is known, and where one alone tells, it is said.
TEST(DisplayRun, PicturesThatDoNotTellHowTheyWereShownAreComparedWithANote) {
    const TemporaryFolder folder;
    write_png(Image<Rgb8>(16, 16, {20, 30, 40}), {shown_by({}, {}), ""}, folder / "ours.png");
    write_png(Image<Rgb8>(16, 16, {20, 30, 40}), folder / "others.png");
    const std::string ours = folder / "ours.png", others = folder / "others.png";
    const Outcome one = run_program("compare " + ours + " " + others), other = run_program("compare " + others + " " + ours);
    EXPECT_EQ(one.exit_code, 0) << one.output;
    EXPECT_THAT(one.output, HasSubstr("note: A was shown by 'rational s=20 white=100 cd/m2; display srgb', and B does not tell"));
    EXPECT_THAT(other.output, HasSubstr("note: B was shown by"));
    EXPECT_THAT(run_program("compare " + others + " " + others).output, Not(HasSubstr("note:")));
    EXPECT_THAT(run_program("compare " + ours + " " + ours).output, Not(HasSubstr("note:")));
    EXPECT_EQ(tests::checked(printed("compare --json " + ours + " " + others), pictures_members).at("notes").size(), 1U);
}

/// A projector from 2.5 m (2.1 mm a pixel) with the view's 72 rows, and one that says only half of it.
TEST(DisplayRun, TheReportSaysHowLargePicturesAreSeen) {
    const TemporaryFolder folder;
    const std::string out = played(folder, "seen", "display: " + library_file("displays/projector.yaml") + "\n");
    const json report = json::parse(content_of(out + "/report.json"));
    EXPECT_THAT(tests::complaints(report, "run/report"), IsEmpty());
    const json& display = report.at("drives").at(0).at("display");
    EXPECT_EQ(display.at("profile"), "projector");
    const json& view = display.at("views").at(0);
    EXPECT_EQ(view.at("view"), "driver");
    EXPECT_EQ(view.at("pictures"), 3);
    EXPECT_NEAR(view.at("display_pixel_arcmin").get<double>(), 2.8877, 1.0e-3);
    const double scene = view.at("scene_pixel_arcmin"), mean = view.at("mean_cdm2");
    EXPECT_NEAR(view.at("magnification").get<double>(), 2.8877 / scene, 1.0e-3);
    EXPECT_NEAR(view.at("life_size_m").get<double>(), 0.0021 / (scene / 60.0 * 3.14159265 / 180.0), 1.0e-3);
    EXPECT_FALSE(view.at("finer_than_eye_by_day").get<bool>());
    // Mean luminance as the files have it, not as the run says.
    FilesRead ignored;
    const DisplayProfile profile = read_display_profile(library_file("displays/projector.yaml"), ignored);
    double sum = 0.0;
    for (const char* tick : {"20", "21", "22"}) {
        const Image<Rgb8> shown = read_png(out + "/frames/oncoming-1-halogen/driver-0000" + tick + ".png");
        for (const Rgb8& pixel : shown.pixels())
            sum += shown_xyz(profile, glm::dvec3(pixel.r, pixel.g, pixel.b) / 255.0).y / static_cast<double>(shown.size());
    }
    EXPECT_NEAR(mean, sum / 3.0, 1.0e-9);
    EXPECT_NEAR(view.at("resolved_arcmin").get<double>(), 30.0 / acuity_cycles_per_deg(mean), 1.0e-9);
    EXPECT_EQ(view.at("finer_than_eye").get<bool>(), 2.8877 <= view.at("resolved_arcmin").get<double>());
    EXPECT_THAT(content_of(out + "/report.html"),
                AllOf(HasSubstr("How the pictures are seen on the display"), HasSubstr("looked at from 2.5 m")));

    std::string half = content_of(library_file("displays/projector.yaml"));
    half.erase(half.find("viewing_distance_m"), half.find("pixel_pitch_mm") - half.find("viewing_distance_m"));
    std::ofstream(folder / "half.yaml") << half;
    const std::string unknown = played(folder, "unknown", "display: " + (folder / "half.yaml") + "\n");
    EXPECT_FALSE(json::parse(content_of(unknown + "/report.json")).at("drives").at(0).contains("display"));
    EXPECT_THAT(content_of(unknown + "/report.html"), Not(HasSubstr("How the pictures are seen")));
}

/// Profiles that are no mistake, and make pictures that nobody would want.
TEST(DisplayRun, DisplaysThatHideWhatWasDrawnAreWarnedOf) {
    const TemporaryFolder folder;
    int runs = 0;
    const auto warnings = [&](const std::string& name, const std::string& from, const std::string& to) {
        std::string profile = content_of(library_file("displays/" + name + ".yaml"));
        if (!from.empty())
            profile.replace(profile.find(from), from.size(), to);
        std::ofstream(folder / "display.yaml") << profile;
        const json report = json::parse(
            content_of(played(folder, "r" + std::to_string(++runs), "display: " + (folder / "display.yaml") + "\n") + "/report.json"));
        std::string all;
        for (const json& warning : report.at("warnings"))
            all += warning.get<std::string>() + "\n";
        return all;
    };
    EXPECT_THAT(warnings("projector", "black_cdm2: 0.12", "black_cdm2: 60"),
                HasSubstr("oncoming-1: display 'display' has a contrast of 2 : 1 (peak 120 cd/m2, black 60 cd/m2), less than the 3 : 1"));
    EXPECT_THAT(warnings("projector", "black_cdm2: 0.12", "black_cdm2: 39"), Not(HasSubstr("contrast")));
    // ST 2084: from 1 cd/m2 to the code of 8 bits above it, 7.92 %.
    EXPECT_THAT(warnings("hdr-monitor", "bits: 16", "bits: 8"),
                HasSubstr("transfer: pq in 8 bits, where ITU-R BT.2100 has 10 or 12: its codes are 7.9 % of luminance apart"));
    EXPECT_THAT(warnings("hdr-monitor", "", ""), Not(HasSubstr("display '")));
}

/// Nothing shines: what was to be fitted is said not to be.
TEST(DisplayRun, AToneMapperIsNotSaidToBeFittedToTheDark) {
    const TemporaryFolder folder;
    std::ofstream(folder / "off.yaml")
        << "fernlicht: 1\nname: off\nspeed_kmh: 60\nduration_s: 0.4\nroad: " << library_file("roads/straight.xodr")
        << "\nlamp_sets: {off: {level: 0, file: " << library_file("lamps/halogen-low.ies")
        << "}}\nviews: {driver: {resolution_px: [32, 24]}}\nmeasure: {extent: false}\ntone_mapper: histogram\n";
    const Outcome run = run_program("run " + (folder / "off.yaml") + " --quiet --no-accuracy --backend software --out " + (folder / "out"));
    EXPECT_EQ(run.exit_code, 0) << run.output;
    const std::string report = content_of(folder / "out/report.json");
    EXPECT_THAT(report, testing::ContainsRegex("tone mapper: nothing to fit to, as [0-9]+ moments of each lamp set had no light"));
    EXPECT_THAT(report, Not(HasSubstr("tone mapper fitted")));
}

TEST(DisplayRun, WhatFitsNothingRefusesAMapperThatIsToBeFitted) {
    const TemporaryFolder folder;
    const std::string drive = drive_with(folder, "open", "tone_mapper: {kind: histogram, l_max_cdm2: all}\n");
    for (const std::string command : {"reference ", "aliasing "}) {
        const Outcome run = run_program(command + drive + " --out " + (folder / "o"));
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_THAT(run.output, HasSubstr("as the resolved drive of a run has them")) << command;
        EXPECT_FALSE(std::filesystem::exists(folder / "o"));
    }
}

TEST(DisplayRun, RefusalsAreASentence) {
    const TemporaryFolder folder;
    std::string black = content_of(library_file("displays/projector.yaml"));
    black.replace(black.find("black_cdm2: 0.12"), 16, "black_cdm2: 120");
    std::ofstream(folder / "black.yaml") << black;
    const std::pair<std::string, std::string> refusals[] = {
        {"tone_mapper: {kind: linear, s: fitted}",
         "tone_mapper.s: a key that kind 'linear' does not use, expected none but kind, l_max_cdm2"},
        {"tone_mapper: {kind: histogram, s: 20}",
         "tone_mapper.s: a key that kind 'histogram' does not use, expected none but kind, l_max_cdm2, curve"},
        {"tone_mapper: {kind: logarithmic, s: fitted}", "only `kind: rational`"},
        {"tone_mapper: histogramm", "(nearest: 'histogram')"},
        {"tone_mapper: [histogram]", "expected linear, rational, logarithmic, histogram, or a map"},
        {"tone_mapper: {kind: histogram, l_max_cdm2: 100, curve: [[-4.6, -5.3], [0, -1.6], [3.0, 0]]}",
         "tone_mapper.l_max_cdm2: 100 as white, expected the luminance of the curve's last knot, exp(3) = "
         "20.09 cd/m2, within 1 %, or no l_max_cdm2"},
        {"tone_mapper: {kind: histogram, l_max_cdm2: all, curve: [[-4.6, -5.3], [3.0, 0]]}", "all as white"},
        {"tone_mapper: {s: fitted}\ntechnique: full", "computes no luminance"},
        {"tone_mapper: {s: fit}", "tone_mapper.s: found 'fit', expected a number from 1 to 1e+06, or, "
                                  "with `kind: rational`, `fitted`"},
        {"tone_mapper: {l_max_cdm2: none}", "tone_mapper.l_max_cdm2: found 'none'"},
        {"tone_mapper: {l_max_cdm2: none}", "`all` (the brightest of the drive) or `surfaces`"},
        {"tone_mapper: {l_max_cdm2: [1]}", "`surfaces`"},
        {"display: " + (folder / "black.yaml"), "peak_cdm2: a peak of 120 cd/m2 with black_cdm2: 120, expected more than black_cdm2"},
        {"display: nowhere.yaml", "nowhere.yaml"},
        {"display: {eye: {veil: true, camera: true}}", "display.eye: a camera beside eye.veil, expected one of the two"},
        {"display: {eye: {white: {xy: [0.9, 0.3]}}}", "display.eye.white.xy: the chromaticity 0.9, 0.3, expected x and y of a light"},
        {"display: {eye: {white: {xy: [0.7, 0.05]}}}", "the chromaticity 0.7, 0.05, expected x and y of a light that all three receptors"},
        {"display: {eye: {camera: true}}\ntone_mapper: linear", "display.eye: a camera beside tone_mapper"},
        {"display: {windscreen: {haze: 0.5}}", "0.3"},
        {"tone_mapper: {kind: histogram, curve: [[0, -1], [1, -2]]}", "rise"}};
    for (const auto& [lines, sentence] : refusals) {
        const Outcome run = run_program("run " + drive_with(folder, "bad", lines + "\n") + few_shown + "--out " + (folder / "bad"));
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_THAT(run.output, HasSubstr(sentence)) << lines;
    }
}

} // namespace
} // namespace fernlicht
