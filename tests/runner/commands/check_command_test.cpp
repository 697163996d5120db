// `fernlicht check`: all that is wrong with files, of every kind, and nothing that is not.
#include "tests/runner/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string written(const TemporaryFolder& folder, const std::string& name, const std::string& content) {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

TEST(Check, TellsAllErrorsOfADriveAtTheirPlaces) {
    const TemporaryFolder folder;
    const std::string drive = written(folder, "d.yaml", R"(fernlicht: 1
road: fernlicht:roads/nowhere.xodr
route: {s_m: 20, lane: left}
speed_kmh: fast
rate_hz: 10
duraton_s: 6
lamp_sets:
  a: {file: missing.ies, source: filament}
  b: {file: fernlicht:lamps/led-low.ies, source: led}
views:
  driver: {pitch_deg: 100, resolution_px: [0, 480]}
measure:
  extent: {thresholds_lx: [1, -3], cell_m: 0}
dressing: grand
)");
    const std::string said = printed("check " + drive, 2);
    for (const char* const problem :
         {":2:7: error: road: ", ":3:24: error: route.lane: found 'left', expected a whole number", ":4:12: error: speed_kmh: found 'fast'",
          ":6:1: error: duraton_s: unknown key, expected 'duration_s'", ":8:13: error: lamp_sets.a.file: there is no file",
          ":9:6: error: lamp_sets.b: an LED without a colour", ":11:23: error: views.driver.pitch_deg: ",
          ":11:44: error: views.driver.resolution_px[0]: ", ":13:31: error: measure.extent.thresholds_lx[1]: ",
          ":13:44: error: measure.extent.cell_m: ", ":14:11: error: dressing: found 'grand'"})
        EXPECT_THAT(said, HasSubstr(drive + problem));
    EXPECT_THAT(said, Not(HasSubstr("missing, expected"))) << "duration_s stands there by another name";
    EXPECT_EQ(lines_of(said).size(), 12U) << said;
    EXPECT_EQ(lines_of(said).back(), "1 file, 11 errors, 0 warnings");
    EXPECT_EQ(lines_of(printed("run " + drive, 2)).size(), 1U) << "who plays it hears of the first alone";
}

TEST(Check, FindsWhatTheFirstFrameWouldLack) {
    const TemporaryFolder folder;
    const std::string drive = "fernlicht: 1\nroad: r.xodr\nspeed_kmh: 50\nduration_s: 1\nlamp_sets: {a: {file: l.ies}}\n";
    written(folder, "l.ies", content_of(library_file("lamps/halogen-low.ies")));
    written(folder, "r.xodr",
            "<OpenDRIVE><header revMajor='1' revMinor='6'/><road id='1' length='x'/><road id='2' length='y'/></OpenDRIVE>");
    const std::string said = printed("check " + written(folder, "d.yaml", drive), 2);
    EXPECT_THAT(said, HasSubstr(folder / "r.xodr:1: error: road@length"));
    EXPECT_THAT(said, HasSubstr("2 errors")) << "each road of its own: " << said;
    written(folder, "r.xodr", content_of(library_file("roads/straight.xodr")));
    EXPECT_THAT(printed("check " + (folder / "d.yaml")), HasSubstr("1 file, 0 errors, 0 warnings"));
    EXPECT_THAT(printed("check " + written(folder, "n.yaml", drive + "technique: best\n"), 2), HasSubstr("error: "));
}

TEST(Check, KnowsEachKindByItsContent) {
    const TemporaryFolder folder;
    const std::string png("\x89PNG\r\n\x1a\n\0\0", 10), exr("\x76\x2f\x31\x01\2\0", 6);
    int number = 0;
    for (const auto& [kind, content, problem] :
         {std::tuple("study", std::string("fernlicht_study: 1\nlamps: {a: {low: x.ies}}\ndrives: [y.yaml]\nnights: 3\n"), 3),
          {"lamp", "fernlicht_pixel_lamp: 1\nraster: {pixels: [0, 3], h_deg: [-1, 1], v_deg: [2, 1]}\nsteps: -1\n", 2},
          {"recipe", "fernlicht_recipe: 1\nlayout: round\ndelimiter: none\nunit: lx\n", 2},
          {"rating", "fernlicht_rating: 1\nedition: 1\nsource: 2\nrows: {a: {drive: none.yaml}}\nphotometer: 3\n", 2},
          {"view set", "fernlicht_views: 1\nviews: {a: {pitch_deg: x}, b: {yaw_deg: y}}\n", 2},
          {"display", "fernlicht_display: 1\npeak_cdm2: 100\ntransfer: sine\ngamut: none\nbits: 9\n", 3},
          {"known failures", "known:\n  - {id: a, kind: never, reason: '', expires: soon}\n  - {id: b/c}\n", 5},
          {"lamp sets", "lamp_sets:\n  a: {file: none.ies}\n  b: {file: no.ies}\n", 2},
          {"road", "<?xml version='1.0'?><OpenDRIVE><header revMajor='1' revMinor='4'/></OpenDRIVE>", 1},
          {"storyboard", "<?xml version='1.0'?><OpenSCENARIO/>", 1},
          {"bus database", "VERSION \"\"\n\nBO_ x\n", 1},
          {"recording", "(1.0) can0 123#00\n(2.0) can0 zz\nwhat\n(3.0) can0 123#00\n", 2},
          {"model", "glTF\1\2\3\4", 1},
          {"picture", png, 1},
          {"picture", exr, 1},
          {"lamp", "IESNA:LM-63-2002\nTILT=NONE\n1 1 1\n", 1},
          {"lamp", "# unit: furlong\nV\\H, 0, 1\n0, 1, 2\n", 1}}) {
        const std::string file = written(folder, fmt::format("f{}", ++number), content);
        const nlohmann::json found = nlohmann::json::parse(printed("check --json " + file, 2));
        EXPECT_THAT(found.at("files").at(0).at("kind").get<std::string>(), testing::StartsWith(kind)) << content;
        EXPECT_GE(found.at("errors").get<int>(), problem) << content << found.dump(1);
        for (const nlohmann::json& one : found.at("problems"))
            EXPECT_FALSE(one.at("text").get<std::string>().empty());
    }
}

TEST(Check, OurOwnFilesAreSound) {
    const std::string said = printed("check '" + library_file("") + "' '" FERNLICHT_SOURCE_DIR "/scenarios/pixel-lamp.example.yaml'");
    EXPECT_THAT(said, HasSubstr(" 0 errors")) << said;
}

TEST(Check, WarnsOfLamps) {
    const TemporaryFolder folder;
    const std::string weak = folder / "weak.ies";
    printed("lamp '" + library_file("lamps/halogen-low.ies") + "' --scale 0.01 --convert " + weak);
    EXPECT_THAT(printed("check " + weak), HasSubstr(weak + ": warning: units: "));
    printed("check --fail-on-warning " + weak, 1);
    EXPECT_THAT(printed("check --fail-on-warning '" + library_file("lamps/halogen-low.ies") + "'"),
                HasSubstr("1 file, 0 errors, 0 warnings"));
}

TEST(Check, SaysNothingOfTheLightOfALampReadByHalf) {
    const TemporaryFolder folder;
    std::string table = content_of(library_file("lamps/xenon-low.ies"));
    const std::size_t number = table.find_last_of("0123456789");
    table.replace(number, 1, "x");
    const std::string said = printed("check " + written(folder, "lamp.ies", table), 2);
    EXPECT_THAT(said, HasSubstr("lamp.ies:"));
    EXPECT_THAT(said, HasSubstr("1 file, 1 error, 0 warnings")) << "no finding of what the rest would be";
}

TEST(Check, FindsAStoryboardsPlacesThatAreNotThere) {
    const TemporaryFolder folder;
    std::string story = content_of(library_file("storyboards/s-bend-dusk.xosc"));
    const std::size_t road = story.rfind("../roads/");
    ASSERT_NE(road, std::string::npos);
    story.replace(road, 3, library_file(""));
    const std::string place = "roadId=\"";
    const std::size_t at = story.find(place);
    ASSERT_NE(at, std::string::npos);
    EXPECT_THAT(printed("check " + written(folder, "here.xosc", story)), HasSubstr("0 errors"));
    story.insert(at + place.size(), "7");
    EXPECT_THAT(printed("check " + written(folder, "nowhere.xosc", story), 2), HasSubstr("nowhere.xosc:"));
}

TEST(Check, NamesTheNearestShippedFileAndReadingAndAllThatIsWrong) {
    const TemporaryFolder folder;
    const std::string drive = "fernlicht: 1\nroad: fernlicht:roads/straight.xodr\nspeed_kmh: 50\nduration_s: 1\n"
                              "measure: {glare: {oncoming: {opposite: {at_m: 250}}}}\n";
    EXPECT_THAT(printed("check " + written(folder, "lamp.yaml", drive + "lamp_sets: {a: {file: fernlicht:lamps/halogen-lo.ies}}\n"), 2),
                HasSubstr("'fernlicht:lamps/halogen-lo.ies', which is no shipped file, expected one as 'fernlicht:lamps/halogen-low.ies'"));
    const std::string said = printed("check " + written(folder, "limits.yaml",
                                                        drive + "lamp_sets: {a: {file: fernlicht:lamps/halogen-low.ies}}\nlimits:\n"
                                                                "- {reading: glare_oposite_facing_max_lx, at_most: 2}\n"
                                                                "- {reading: reach_5lx_roda_own_m, at_least: 40}\n"
                                                                "- {reading: reach_5lx_target_own, at_least: 40}\n"
                                                                "technique: photometri\n"),
                                     2);
    EXPECT_THAT(said, HasSubstr("limits.yaml:11:1: error: technique: found 'photometri', expected 'photometric'"));
    EXPECT_THAT(said, HasSubstr("limits.yaml:8: error: limits: found reading 'glare_oposite_facing_max_lx', expected a reading of this "
                                "drive (the nearest is 'glare_opposite_facing_max_lx')"));
    EXPECT_THAT(said, HasSubstr("(the nearest is 'reach_5lx_road_own_m')"));
    EXPECT_THAT(said, HasSubstr("(the nearest is 'reach_5lx_target_own_m')")) << "among those of the extent";
    EXPECT_THAT(printed("check " + written(folder, "way.yaml",
                                           drive + "lamp_sets: {a: {file: fernlicht:lamps/halogen-low.ies}}\nroute: {road: 7}\n"),
                        2),
                HasSubstr("way.yaml:7:1: error: route: found no road '7', expected one of the roads 1"))
        << "the drive's fault, not the road's";
    EXPECT_THAT(printed("check " + written(folder, "walker.yaml",
                                           drive + "lamp_sets: {a: {file: fernlicht:lamps/halogen-low.ies}}\n"
                                                   "traffic:\n  walker: {kind: pedestrian, speed_kmh: 5, lane: {road: 9, lane: -1}}\n"),
                        2),
                HasSubstr("walker.yaml:8:44: error: traffic.walker.lane: found no road '9'"));
}

TEST(Check, TellsWhatRoadTrafficAndReadingsLackAtOnce) {
    const TemporaryFolder folder;
    const std::string drive = "fernlicht: 1\nroad: fernlicht:roads/straight.xodr\nspeed_kmh: 50\nduration_s: 1\n"
                              "lamp_sets: {a: {file: fernlicht:lamps/halogen-low.ies}}\nlimits:\n"
                              "- {reading: reach_5lx_roda_own_m, at_least: 40}\n- {reading: glare_opposite_facing_max_lx, at_most: 2}\n"
                              "measure: {glare: {oncoming: {opposite: {at_m: 250}}}}\n",
                      limit = "wrong.yaml:7: error: limits: found reading 'reach_5lx_roda_own_m'";
    std::string said =
        printed("check " + written(folder, "wrong.yaml",
                                   drive + "traffic:\n  walker: {kind: pedestrian, speed_kmh: 5, lane: {road: 9, lane: -1}}\n"
                                           "  car: {kind: car, speed_kmh: 50, ahead: {gap_m: 90000}}\n"),
                2);
    for (const std::string& problem : {limit, std::string("traffic.walker.lane: found no road '9'"),
                                       std::string("traffic.car: found a road user 90000 m along the route, expected 0 to 1000 m")})
        EXPECT_THAT(said, HasSubstr(problem));
    EXPECT_THAT(said, HasSubstr("1 file, 3 errors"));
    const std::string extent =
        "- {reading: reach_10lx_target_own_m, at_least: 5}\n- {reading: width_3lx_target_all_at_33m_m, at_least: 5}\n"
        "- {reading: width_3lx_target_all_at_50m_m, at_least: 5}\nmeasure: {extent: {thresholds_lx: [3]}}\n";
    said = printed("check " + written(folder, "extent.yaml", drive.substr(0, drive.find("- {")) + extent), 2);
    EXPECT_THAT(said,
                HasSubstr("extent.yaml:7: error: limits: found reading 'reach_10lx_target_own_m', expected 10 in `thresholds_lx` of"));
    EXPECT_THAT(said, HasSubstr("expected 33 in `width_at_m` of `measure: extent`"));
    EXPECT_THAT(said, HasSubstr("1 file, 2 errors"));
    said = printed("check " + written(folder, "wrong.yaml",
                                      drive + "route: {road: 7}\ntraffic:\n  car: {speed_kmh: 50, ahead: {gap_m: 90000}}\n"
                                              "  walker: {kind: pedestrian, speed_kmh: 5, lane: {road: 9, lane: -1}}\n"),
                   2);
    EXPECT_THAT(said, HasSubstr(limit)) << "judged on another road";
    EXPECT_THAT(said, HasSubstr("route: found no road '7'"));
    EXPECT_THAT(said, HasSubstr("traffic.walker.lane: found no road '9'"));
    EXPECT_THAT(said, HasSubstr("1 file, 3 errors")) << "a gap along the route needs one";
}

TEST(Check, WhatStandsInAnothersPlaceIsNamed) {
    const TemporaryFolder folder;
    EXPECT_THAT(printed("check " + written(folder, "aim.yaml",
                                           "fernlicht: 1\nroad: fernlicht:roads/straight.xodr\nspeed_kmh: 50\nduration_s: 1\n"
                                           "lamp_sets: {a: {file: fernlicht:lamps/halogen-low.ies, aim: -0.3}}\n"),
                        2),
                HasSubstr("found '-0.3', expected one of as-is, auto, or a map as {cut_off_percent: ..., pitch_deg: ..."));
    const std::string lamp = library_file("lamps/halogen-low.ies"), out = " --out " + (folder / "out");
    EXPECT_THAT(printed("run " + lamp + out, 2), HasSubstr("is a lamp, expected a drive that names it"));
    EXPECT_THAT(printed("study " + lamp + out, 2), HasSubstr("is a lamp, expected a study that names it"));
    EXPECT_THAT(printed("study " + library_file("drives/straight.yaml") + out, 2), HasSubstr("is a drive, expected a study"));
}

TEST(Check, TakesAnythingForAFile) {
    const TemporaryFolder folder;
    written(folder, "empty.yaml", "");
    written(folder, "binary.yaml", std::string("\x00\x01\x02\xff\xfe", 5) + std::string(100'000, '\x80'));
    written(folder, "broken.yaml", "fernlicht: 1\nroad: [\n");
    written(folder, "tab.yaml", "fernlicht: 1\n\troad: x.xodr\nviews: {\n");
    written(folder, "notes.txt", "nothing of ours\n");
    ::mkfifo((folder / "pipe.yaml").c_str(), 0600);
    std::filesystem::create_symlink("loop.yaml", folder / "loop.yaml");
    std::filesystem::create_directory(folder / "below");
    std::filesystem::create_directory_symlink("..", folder / "below/up");
    std::filesystem::resize_file(written(folder, "large.yaml", "fernlicht: 1\n"), std::uintmax_t{100} << 20);
    for (const auto& [file, problem] : {std::pair("empty.yaml", "is empty"),
                                        {"binary.yaml", "is of no kind"},
                                        {"broken.yaml", "is not YAML"},
                                        {"tab.yaml", "tab.yaml:2:1: error: found a tab before the text, expected blanks"},
                                        {"notes.txt", "is of no kind that fernlicht reads, expected one of study, rating"},
                                        {"pipe.yaml", "is not a regular file"},
                                        {"loop.yaml", "cannot be read"},
                                        {"gone.yaml", "cannot be read"},
                                        {"large.yaml", "104857600 bytes"}})
        EXPECT_THAT(printed("check " + (folder / file), 2), HasSubstr(problem));
    const std::string said = printed("check " + (folder / ""), 2);
    EXPECT_THAT(said, Not(HasSubstr("notes.txt")));
    EXPECT_THAT(lines_of(said).back(), HasSubstr("of other kinds left out"));
    EXPECT_THAT(said, Not(HasSubstr("below/up")));
}

TEST(Check, FindsReadingsThatNoDriveOfAStudyCanHave) {
    const TemporaryFolder folder;
    const std::string study =
        "fernlicht_study: 1\nlamps: {a: {low: fernlicht:lamps/led-low.ies}, b: {low: fernlicht:lamps/halogen-low.ies}}\n"
        "drives: [fernlicht:drives/straight.yaml, fernlicht:drives/s-bend.yaml]\nmeasure: {visibility: true}\n";
    const std::string said =
        printed("check " + written(folder, "s.yaml",
                                   study + "decide: [detection_pedestrian_light_left_m, detection_card_own_m]\nlimits:\n"
                                           "  - {reading: reach_7lx_target_own_m, at_least: 5}\n"
                                           "  - {reading: glare_own_facing_max_lx, at_most: 5}\n"),
                2);
    EXPECT_THAT(said,
                HasSubstr("s.yaml:5:1: error: decide: found reading 'detection_pedestrian_light_left_m', expected a reading of this drive "
                          "(the nearest is 'detection_pedestrian-light_left_m')"));
    EXPECT_THAT(said, HasSubstr("s.yaml:7: error: limits: found reading 'reach_7lx_target_own_m', expected 7 in `thresholds_lx`"));
    EXPECT_THAT(said, HasSubstr("s.yaml:8: error: limits: found reading 'glare_own_facing_max_lx', expected `glare` in `measure:`"));
    EXPECT_THAT(said, HasSubstr("1 file, 3 errors"));
    EXPECT_THAT(printed("check " + written(folder, "axis.yaml",
                                           study + "axes: {measure.extent.thresholds_lx: [[3], [7]]}\nlimits:\n"
                                                   "  - {reading: reach_7lx_target_own_m, at_least: 5}\n")),
                HasSubstr("1 file, 0 errors"))
        << "some point measures it";
}

TEST(Check, ShippedFilesHaveTheirNameOnAnyCommandLine) {
    EXPECT_THAT(printed("check fernlicht:drives/straight.yaml fernlicht:roads/country.xodr"), HasSubstr("2 files, 0 errors, 0 warnings"));
    EXPECT_THAT(printed("check fernlicht:drives/straigh.yaml", 2),
                HasSubstr("fernlicht: found 'fernlicht:drives/straigh.yaml', which is no shipped file"));
    const TemporaryFolder folder;
    const std::string out = (folder / "out");
    printed("run fernlicht:drives/straight.yaml --road=fernlicht:roads/country.xodr --lamp left=fernlicht:lamps/led-low.ies --frames 0:0 "
            "--no-accuracy --quiet --out " +
            out);
    std::ifstream report(out + "/report.json");
    const std::string text{std::istreambuf_iterator<char>(report), {}};
    for (const char* read : {"roads/country.xodr", "lamps/led-low.ies"})
        EXPECT_THAT(text, HasSubstr(read));
    EXPECT_THAT(printed("run s-bend-dusk --frames 0:0 --no-accuracy --quiet --out " + (folder / "story")), HasSubstr("s-bend-dusk"));
}

TEST(Check, ReadsStandardInput) {
    const TemporaryFolder folder;
    written(folder, "l.ies", content_of(library_file("lamps/halogen-low.ies")));
    written(folder, "d.yaml",
            "fernlicht: 1\nroad: fernlicht:roads/straight.xodr\nspeed_kmh: 50\nduration_s: 1\nlamp_sets: {a: {file: l.ies}}\n");
    const std::string check = "cd " + folder.path().string() + " && '" FERNLICHT_BINARY "' check - <";
    EXPECT_EQ(run_shell(check + "d.yaml").output, "1 file, 0 errors, 0 warnings\n") << "its paths start here";
    const Outcome none = run_shell(check + "/dev/null");
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.output, HasSubstr("-: error: is empty"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2) << "nothing stays";
}

} // namespace
} // namespace fernlicht
