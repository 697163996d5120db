#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"
#include "tests/scenarios/drives/yaml_schema_check.h"
#include "tests/shipped.h"
#include "tests/trial.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <tuple>
#include <unistd.h>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr;

class StudyFile : public testing::Test {
  protected:
    static Study read(const std::string& text) { return read_study(tests::written("study.yaml", text)); }
    static std::string refusal(const std::string& text) {
        return tests::refusal_of([&] { read(text); });
    }
    static std::string with(const std::string& more) {
        return fmt::format("fernlicht_study: 1\nlamps:\n  a: {{low: {0}/lamps/halogen-low.ies}}\n  b: {{left: {0}/lamps/xenon-low.ies, "
                           "right: {0}/lamps/halogen-low.ies, source: arc}}\ndrives: [{0}/drives/straight.yaml]\n{1}",
                           shipped_library.string(), more);
    }
    /// A drive of the library with paths from anywhere and `aim: auto` in each lamp set.
    static std::string content_of_drive(const std::string& name) {
        std::ifstream stream(shipped_drives / name);
        std::string text(std::istreambuf_iterator<char>(stream), {});
        for (const auto& [from, to] :
             {std::pair<std::string, std::string>("../", shipped_library.string() + "/"), {", file:", ", aim: auto, file:"}})
            for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
                text.replace(at, from.size(), to);
        return text;
    }
};

TEST_F(StudyFile, TheExampleAndTheStandardStudyAreRead) {
    const Study example = read_study(FERNLICHT_SOURCE_DIR "/scenarios/study.example.yaml");
    EXPECT_EQ(cells_of(example).size(), 2U * 2U * 3U * 2U * 2U);
    const Study standard = read_study(shipped_library / "studies/standard.yaml");
    EXPECT_EQ(standard.name, "standard-1");
    EXPECT_EQ(cells_of(standard).size(), 10U);
    EXPECT_EQ(cells_of(standard).front().name, "straight_halogen");
    EXPECT_EQ(cells_of(standard).back().name, "village_xenon");
}

TEST_F(StudyFile, ALampThatIsATextGridHasARecipe) {
    const auto folder = tests::new_folder();
    tests::written("grid.txt", "V;-1;1\n-1;500;500\n1;500;500\n", folder);
    tests::written("ours.yaml", "fernlicht_recipe: 1\nlayout: matrix\ndelimiter: semicolon\nunit: cd\n", folder);
    const Study study = read(fmt::format("fernlicht_study: 1\nlamps:\n  a: {{low: {0}/lamps/halogen-low.ies}}\n"
                                         "  b: {{low: {1}/grid.txt, recipe: {1}/ours.yaml}}\ndrives: [{0}/drives/straight.yaml]\n",
                                         shipped_library.string(), folder.string()));
    EXPECT_EQ(study.lamps[0].recipe, "");
    EXPECT_EQ(study.lamps[1].recipe, folder / "ours.yaml");
    const Drive drive = cell_drive(study, cells_of(study)[1]);
    EXPECT_EQ(drive.lamp_sets[0].lamps[0].file->table.cd, (std::vector<double>{500, 500, 500, 500}));
    EXPECT_THAT(refusal(with("").replace(with("").find("a: {"), 4, "a: {recipe: none, ")), HasSubstr("no recipe of that name"));
}

TEST_F(StudyFile, WhatIsNotGivenIsNightAtRegulationAim) {
    const Study study = read(with(""));
    const std::vector<StudyCell> cells = cells_of(study);
    ASSERT_EQ(cells.size(), 2U);
    EXPECT_EQ(cells[0].condition, "night");
    ASSERT_EQ(study.comparisons.size(), 1U) << "all with the first";
    EXPECT_EQ(study.comparisons[0].tested, "b");
    const Drive drive = cell_drive(study, cells[1]);
    ASSERT_EQ(drive.lamp_sets.size(), 1U);
    EXPECT_EQ(drive.lamp_sets[0].name, "b");
    EXPECT_EQ(drive.daylight.horizontal_illuminance_lx, 0.0);
    for (const MountedLamp& lamp : drive.lamp_sets[0].lamps) {
        EXPECT_EQ(lamp.pitch_rad, 0.0) << "the file has its own dip";
        EXPECT_EQ(lamp.source, SourceKind::arc);
        EXPECT_EQ(lamp.file->name, lamp.name == "left" ? "xenon low beam (model)" : "halogen low beam (model)");
    }
}

TEST_F(StudyFile, ConditionsReachTheDrive) {
    const Study study = read(with("conditions: {time_of_day: [night, twilight], aim_percent: [-1, -1.5], voltage_v: [12, 13.2]}\n"));
    const std::vector<StudyCell> cells = cells_of(study);
    ASSERT_EQ(cells.size(), 16U);
    EXPECT_EQ(cells[0].name, "straight_a_night_aim-1_12V");
    EXPECT_EQ(cells[15].name, "straight_b_twilight_aim-1.5_13.2V");
    const Drive drive = cell_drive(study, cells[12]); // twilight, -1.5 %, 12 V, a
    EXPECT_EQ(drive.daylight.horizontal_illuminance_lx, 3.4);
    for (const MountedLamp& lamp : drive.lamp_sets[0].lamps) {
        EXPECT_DOUBLE_EQ(lamp.pitch_rad, std::atan(-0.015) + std::atan(0.01));
        EXPECT_EQ(lamp.voltage_v, 12.0);
    }
}

TEST_F(StudyFile, AnAimByTheCutOffCountsFromTheHorizon) {
    std::string text = with("conditions: {aim_percent: [-1, -1.5]}\n");
    text.insert(text.find("}\n  b:"), ", aim: {rule: auto, yaw_deg: 0.1}");
    const Study study = read(text);
    const std::vector<StudyCell> cells = cells_of(study);
    ASSERT_EQ(cells.size(), 4U);
    for (const std::size_t i : {0U, 2U}) {
        const Drive a = cell_drive(study, cells[i]), b = cell_drive(study, cells[i + 1]);
        for (const MountedLamp& lamp : a.lamp_sets[0].lamps) {
            EXPECT_EQ(lamp.aim_rule, BeamAim::automatic);
            EXPECT_EQ(lamp.cut_off_percent, i == 0 ? -1.0 : -1.5);
            EXPECT_EQ(std::tuple(lamp.pitch_rad, lamp.yaw_rad), std::tuple(0.0, radians(0.1)));
        }
        for (const MountedLamp& lamp : b.lamp_sets[0].lamps) {
            EXPECT_EQ(lamp.aim_rule, BeamAim::as_is);
            EXPECT_DOUBLE_EQ(lamp.pitch_rad, i == 0 ? 0.0 : std::atan(-0.015) + std::atan(0.01));
        }
    }
}

TEST_F(StudyFile, ALampTakesTheDrivesAimOrItsOwn) {
    const std::string drive = content_of_drive("straight.yaml");
    const auto drive_file = tests::written("aimed.yaml", drive + "\n");
    const auto rule = [&](const std::string& lamp_keys) {
        const Study study = read(fmt::format("fernlicht_study: 1\nlamps:\n  a: {{low: {}/lamps/halogen-low.ies{}}}\ndrives: [{}]\n",
                                             shipped_library.string(), lamp_keys, drive_file.string()));
        return cell_drive(study, cells_of(study).front()).lamp_sets[0].lamps.front();
    };
    EXPECT_EQ(rule("").aim_rule, BeamAim::automatic) << "as the drive has its lamps";
    EXPECT_EQ(rule(", aim: as-is").aim_rule, BeamAim::as_is);
    EXPECT_DOUBLE_EQ(rule(", aim: as-is, file_aim_percent: 0").pitch_rad, std::atan(-0.01));
    EXPECT_THAT(
        tests::refusal_of([&] { rule(", file_aim_percent: 0"); }),
        HasSubstr("lamps.a.file_aim_percent: found 0 %, and a drive aims its lamps by their cut-off, expected aim: as-is beside it"));
}

TEST_F(StudyFile, MeasuresReachEveryDriveThatDoesNotAskItself) {
    std::string text = with("measure: {visibility: {age_years: 60}, glare: {oncoming: {stranger: {at_m: 90}}}}\n");
    text.insert(text.find("]\n") /* of drives */, ", " + (shipped_drives / "iihs-straight.yaml").string());
    const Study study = read(text);
    const std::vector<StudyCell> cells = cells_of(study);
    ASSERT_EQ(cells.size(), 4U);
    const SeeingParameters plain = cell_drive(study, cells[0]).seeing, own = cell_drive(study, cells[2]).seeing;
    EXPECT_EQ(plain.visibility.value().age_years, 60.0);
    EXPECT_EQ(plain.glare.value().oncoming.at(0).name, "stranger");
    EXPECT_FALSE(plain.sensors || plain.homogeneity || plain.places) << "nobody asked";
    EXPECT_EQ(own.visibility.value().age_years, 60.0);
    EXPECT_EQ(own.glare.value().oncoming.at(0).name, "lane-centre") << "the drive's own eyes stay";
    EXPECT_TRUE(own.sensors);
    EXPECT_EQ(cell_drive(read(with("")), cells[0]).seeing, SeeingParameters{});
}

TEST_F(StudyFile, MirroredCellsHaveTheRoadInAMirror) {
    const Study study = read(with("conditions: {mirror: [false, true]}\n"));
    const std::vector<StudyCell> cells = cells_of(study);
    ASSERT_EQ(cells.size(), 4U);
    EXPECT_EQ(cells[1].name, "straight_b");
    EXPECT_EQ(std::tuple(cells[3].name, cells[3].condition), std::tuple("straight_b_mirrored", "night, mirrored"));
    const Drive plain = cell_drive(study, cells[1]), mirrored = cell_drive(study, cells[3]);
    EXPECT_FALSE(plain.mirrored_road);
    EXPECT_TRUE(mirrored.mirrored_road);
    // b has a xenon lamp on the left and a halogen lamp on the right.
    for (const MountedLamp& lamp : mirrored.lamp_sets[0].lamps)
        EXPECT_EQ(lamp.file->name, lamp.name == "right" ? "xenon low beam (model)" : "halogen low beam (model)") << lamp.name;
}

TEST_F(StudyFile, RefusesInOneSentenceWithItsPlace) {
    std::string dips = with("");
    dips.insert(dips.find("}\n  b:"), ", aim: auto, file_aim_percent: 0");
    EXPECT_THAT(refusal(dips), HasSubstr("lamps.a.file_aim_percent: file_aim_percent beside aim: auto, expected one of them: auto "
                                         "finds the cut-off in the file"));
    EXPECT_THAT(refusal(with("measure: {visibility: {k: 0}}\n")), HasSubstr("measure.visibility.k"));
    EXPECT_THAT(refusal(with("measure: {extent: true}\n")), HasSubstr("extent"));
    EXPECT_THAT(refusal(with("conditionz: {}\n")), HasSubstr("conditions"));
    EXPECT_THAT(refusal(with("conditions: {time_of_day: dusk}\n")), HasSubstr("night"));
    EXPECT_THAT(refusal(with("conditions: {mirror: [true, true]}\n")),
                HasSubstr("value 2 again, the same as value 1, expected each value once"));
    EXPECT_THAT(refusal(with("conditions: {mirror: left}\n")), HasSubstr("conditions.mirror"));
    EXPECT_THAT(refusal(with("conditions: {weather: rain}\n")), HasSubstr("weather"));
    EXPECT_THAT(refusal(with("conditions: {voltage_v: 24}\n")), HasSubstr("13.8"));
    EXPECT_THAT(refusal(with("conditions: {aim_percent: [-1, -1]}\n")),
                HasSubstr("value 2 again, the same as value 1, expected each value once"));
    EXPECT_THAT(refusal(with("compare: [{new: bb, against: a}]\n")), HasSubstr("no lamp 'bb' in this study, expected one of a, b"));
    EXPECT_THAT(refusal(with("compare: [{new: a, against: a}]\n")), HasSubstr("compared with itself"));
    EXPECT_THAT(refusal(with("limits: [{reading: x}]\n")), HasSubstr("a limit without a number"));
    EXPECT_THAT(refusal("fernlicht_study: 2\n"), HasSubstr("version of the study file's schema"));
    EXPECT_THAT(refusal(with("lamps: {}\n")), HasSubstr("lamps"));
    std::string aims, volts;
    for (int i = 0; i < 95; ++i) {
        aims += (i ? ", " : "") + std::to_string(-0.001 * i);
        volts += (i ? ", " : "") + std::to_string(12.0 + 0.001 * i);
    }
    EXPECT_THAT(refusal(with("conditions: {time_of_day: [night, twilight, day], aim_percent: [" + aims + "], voltage_v: [" + volts +
                             "], mirror: [false, true]}\n")),
                HasSubstr("108300 cells (drives x lamps x techniques x conditions), expected at most 100000"));
    std::string text = with("");
    text.replace(text.find("straight.yaml"), 13, "first-light.yaml");
    const Study study = read(text);
    EXPECT_THAT(tests::refusal_of([&] { cell_drive(study, cells_of(study).front()); }), HasSubstr("lamps.a: found no high beam"));
}

// study.schema.json says the same as the reader of studies: editors that use it must neither refuse good studies nor pass misspelt keys.

const std::filesystem::path scenarios = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios";

std::string content(const std::filesystem::path& file) {
    FilesRead opened;
    return read_file(file, opened);
}

class StudySchema : public testing::Test {
  protected:
    /// Beside the example, so that its relative paths hold.
    std::filesystem::path file_ = scenarios / fmt::format("study-schema-test-{}.yaml", ::getpid());
    SchemaCheck check_{json::parse(std::ifstream(scenarios / "study.schema.json"))};
    void TearDown() override { std::filesystem::remove(file_); }

    std::string violation(const std::string& yaml) { return check_.violation(to_json(parse_yaml(yaml, "test.yaml"))); }
    std::string refusal(const std::string& yaml) {
        std::ofstream(file_) << yaml;
        return tests::refusal_of([&] { read_study(file_); });
    }
};

TEST_F(StudySchema, PassesTheExampleAndEveryShippedStudy) {
    const std::string example = content(scenarios / "study.example.yaml");
    EXPECT_EQ(violation(example), "");
    EXPECT_EQ(refusal(example), "not refused");
    int studies = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenarios / "library/studies")) {
        if (entry.path().extension() != ".yaml")
            continue;
        EXPECT_EQ(violation(content(entry.path())), "") << entry.path();
        ++studies;
    }
    EXPECT_GE(studies, 2);
}

TEST_F(StudySchema, EveryKeyOfTheExampleMisspeltIsRefusedByBoth) {
    const std::string example = content(scenarios / "study.example.yaml");
    const std::regex key(R"(\b([a-z_]{3,})(: ?))");
    std::size_t tried = 0;
    bool in_measure = false; // whose parts are a drive's, and tested there
    for (std::sregex_iterator match(example.begin(), example.end(), key), end; match != end; ++match) {
        const auto at = static_cast<std::size_t>(match->position(1));
        const std::size_t line = example.rfind('\n', at) + 1;
        if (example.substr(line, at - line).find('#') != std::string::npos)
            continue; // a comment
        const std::string name = match->str(1);
        in_measure = at == line ? name == "measure" : in_measure;
        if ((in_measure && at > line + 2) || name == "production" || (name == "new" && example.substr(at - 2, 2) == "  "))
            continue; // names are the user's
        std::string misspelt = example;
        misspelt.insert(at + 2, "q");
        EXPECT_NE(violation(misspelt), "") << name;
        EXPECT_THAT(refusal(misspelt), testing::HasSubstr("unknown key")) << name;
        ++tried;
    }
    EXPECT_GT(tried, 25U);
}

TEST_F(StudySchema, AgreesWithTheReader) {
    const std::string low = (scenarios / "library/lamps/halogen-low.ies").string(),
                      study = fmt::format("fernlicht_study: 1\ndrives: [{}]\n", (scenarios / "library/drives/straight.yaml").string()),
                      lamps = study + fmt::format("lamps: {{a: {{low: {}}}, b: {{low: {}}}}}\n", low, low);
    ASSERT_EQ(refusal(lamps), "not refused");
    for (const std::string& ending : tests::each_of(
             {{"", "title: 5|name: a/b"},
              {"techniques", "[]|[photometric]"},
              {"conditions", "{time_of_day: dusk}|{time_of_day: [day, night]}|{aim_percent: [11]}|{aim_percent: []}|{voltage_v: 11}|"
                             "{voltage_v: [12, 13]}|{mirror: true}|{mirror: [false, true]}|{mirror: []}|{mirror: left}"},
              {"axes",
               "{}|{weather.wetness: [0, 1]}|{weather.wetness: []}|{weather.wetness: 1}|{weather.wetness: {from: 0, to: 1, count: 3}}|"
               "{weather.wetness: {from: 0, to: 1, count: 1}}|{weather.wetness: {from: 0, to: 1, step: 0.1}}|"
               "{weather.wetness: {from: 0, to: 1, step: 0}}|{weather.wetness: {from: 0, count: 3}}|"
               "{weather.wetness: {from: 0, to: 1, count: 3, step: 0.5}}|{wet: {key: weather.wetness, values: [0]}}|"
               "{wet: {key: weather.wetness, values: [0], from: 1}}|{wet: {kay: weather.wetness, values: [0]}}"},
              {"", "sample: grid\naxes: {yaw_deg: [0]}|sample: random\naxes: {yaw_deg: [0]}|sample: {low_discrepancy: 8}\naxes: {yaw_deg: "
                   "{from: 0, to: 1}}|sample: {low_discrepancy: 0}\naxes: {yaw_deg: [0]}|sample: {seed: 1}\naxes: {yaw_deg: [0]}"},
              {"compare", "[]|[{new: a}]|[{new: b, against: a}]"},
              {"", "decide: []"},
              {"limits", "[{at_least: 1}]|[{reading: x_m, at_least: 1}]"},
              {"pictured_moments", "0|13"},
              {"resolution_px", "[64]|[64, 48]"},
              {"lamp_noise_percent", "-1|1"},
              {"measure", "{visibility: true}|{visibilityy: true}"},
              {"", "nonsense: 1"}})) {
        const std::string yaml = lamps + ending + "\n", by_reader = refusal(yaml), by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << ending << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
    for (const char* lamp :
         {"source: xenon", "source: arc", "temperature_k: 30", "temperature_k: 3000", "file_aim_percent: 11", "file_aim_percent: -1.5",
          "aim: auto", "aim: as-is", "aim: atuo", "aim: {rule: auto, yaw_deg: 0.1}", "aim: {pitch_deg: 0.2}", "aim: {cut_off_percent: -1}",
          "file_aim_percent: 0, aim: auto", "aim: {rule: auto}, file_aim_percent: -1", "aim: {rule: as-is}, file_aim_percent: 0",
          "mirrors: false", "mirrors: maybe", "left: low.ies", "beam: low.ies"}) {
        const std::string yaml = study + fmt::format("lamps: {{a: {{low: {}, {}}}}}\n", low, lamp), by_reader = refusal(yaml),
                          by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << lamp << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
}

} // namespace
} // namespace fernlicht
