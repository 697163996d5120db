// The YAML tree and its typed reading: places, refusals, bounds.
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/yaml_entry.h"
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/trial.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tuple>

namespace fernlicht {
namespace {

using DriveRefusal = DriveFixture;
using testing::AllOf, testing::HasSubstr, testing::StartsWith;

const std::filesystem::path file = "/tmp/some.yaml";

std::string refusal(const auto& action) { return tests::refusal_of(action); }

std::string parse_refusal(const std::string& content) {
    return refusal([&] { parse_yaml(content, file); });
}

TEST(YamlTree, KeepsKindsOrderPlacesAndWhatAliasesName) {
    const YamlValue root = parse_yaml("b: 1\na:\n  - x\n  - 'y'\nn: ~\n", file);
    ASSERT_EQ(root.kind, YamlValue::Kind::map);
    ASSERT_EQ(root.members.size(), 3U);
    EXPECT_EQ(root.members[0].key, "b");
    EXPECT_EQ(std::tuple(root.members[0].value.line, root.members[0].value.column), std::tuple(1U, 4U));
    const YamlValue& list = root.members[1].value;
    ASSERT_EQ(list.items.size(), 2U);
    EXPECT_FALSE(list.items[0].quoted);
    EXPECT_TRUE(list.items[1].quoted);
    EXPECT_EQ(list.items[1].line, 4U);
    EXPECT_EQ(root.members[2].value.kind, YamlValue::Kind::null);
    const YamlValue other_root = parse_yaml("a: &lamp {file: x}\nb: *lamp\n", file);
    ASSERT_EQ(other_root.members[1].value.members.size(), 1U);
    EXPECT_EQ(other_root.members[1].value.members[0].value.text, "x");
}

TEST(YamlTree, RefusesWithLine) {
    EXPECT_THAT(parse_refusal("a: 1\na: 2\n"), HasSubstr("some.yaml:2:1: found the key 'a' a second time"));
    EXPECT_THAT(parse_refusal("a: [1, 2\nb: 3\n"), HasSubstr("some.yaml:2"));
    EXPECT_THAT(parse_refusal("a: 1\n---\nb: 2\n"), HasSubstr("second YAML document"));
    EXPECT_THAT(parse_refusal("? [1, 2]\n: 3\n"), HasSubstr("as a key"));
    EXPECT_THAT(parse_refusal("~: 3\n"), HasSubstr("key without text"));
    EXPECT_THAT(parse_refusal("a: &x [*x]\n"), HasSubstr("alias"));
    EXPECT_THAT(parse_refusal("a: *nowhere\n"), HasSubstr("some.yaml:1"));
    EXPECT_THAT(parse_refusal(std::string("a: \0 1", 6)), HasSubstr("zero byte"));
    EXPECT_THAT(parse_refusal("# nothing but a comment\n"), HasSubstr("no content"));
    for (const auto& [low, high] : {std::pair{1, 0}, std::pair{0, 1}}) // either order of bytes, with a mark and without
        for (const bool mark : {true, false}) {
            std::string wide = mark ? (low != 0 ? "\xff\xfe" : "\xfe\xff") : "";
            for (const char c : std::string("fernlicht: 1\nname: wide\n"))
                wide += high != 0 ? std::string{'\0', c} : std::string{c, '\0'};
            EXPECT_EQ(parse_refusal(wide), "/tmp/some.yaml: is encoded in UTF-16: save it as UTF-8");
            EXPECT_EQ(parse_refusal(to_utf8(wide)), "/tmp/some.yaml: is encoded in UTF-16: save it as UTF-8");
        }
}

TEST(YamlTree, IsBounded) {
    std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 20; ++i) {
        bomb += fmt::format("a{0}: &a{0} [", i);
        for (int k = 0; k < 10; ++k)
            bomb += fmt::format("*a{}{}", i - 1, k < 9 ? ", " : "]\n");
    }
    EXPECT_THAT(parse_refusal(bomb), HasSubstr("more than 100000 values"));
    EXPECT_THAT(parse_refusal("a: " + std::string(40, '[') + std::string(40, ']')), HasSubstr("levels of nesting"));
    EXPECT_NE(parse_refusal("a: " + std::string(100'000, '[')), "not refused");
    EXPECT_NE(parse_refusal(std::string(100'000, '{')), "not refused");
}

TEST(YamlTree, SurvivesEveryTruncationAndByteFlip) {
    const std::string good = "fernlicht: 1\nroute: {road: \"1\", via: [a, 'b']}\nspeed: &s\n  - {at_s: 0, kmh: 3}\nx: *s\nt: |\n  text\n";
    ASSERT_NO_THROW(parse_yaml(good, file));
    for (std::size_t length = 0; length < good.size(); ++length)
        parse_refusal(good.substr(0, length)); // must return: either a tree or one InputError
    for (std::size_t at = 0; at < good.size(); ++at)
        for (const char byte : {'\0', '\xff', '{', '[', '&', '*', '!', '"', '\n', '\t', '%', '@', ':', '-'}) {
            std::string changed = good;
            changed[at] = byte;
            parse_refusal(changed);
        }
}

class YamlEntryTest : public testing::Test {
  protected:
    /// `text` as the value of key `k`.
    YamlEntry entry(const std::string& text) {
        root = parse_yaml("k: " + text, file);
        return {root.members.at(0).value, file, "k"};
    }
    YamlValue root;
};

TEST_F(YamlEntryTest, NumbersAreFiniteInRangeAndUnquoted) {
    EXPECT_EQ(entry("0.1").number(0.0, 1.0), 0.1);
    EXPECT_EQ(entry("-1e-3").number(-1.0, 1.0), -1e-3);
    EXPECT_EQ(entry("+2").number(0.0, 3.0), 2.0);
    for (const char* bad : {"'1'", "1 km", "'0,5'", "0,5,5", "nan", ".nan", "inf", "-.inf", "1e999", "0x10", "1_000", "~", "[1]", "{a: 1}",
                            "1.5.2", "+-1", "4"})
        EXPECT_THAT(refusal([&] { entry(bad).number(0.0, 3.0); }), HasSubstr("some.yaml:1:4: k: found ")) << bad;
    EXPECT_EQ(refusal([&] { entry("64,4").number(0.0, 300.0); }), "/tmp/some.yaml:1:4: k: has a decimal comma: write 64.4");
    EXPECT_EQ(refusal([&] { entry("-0,5e1").number_above(0.0, 300.0); }), "/tmp/some.yaml:1:4: k: has a decimal comma: write -0.5e1");
}

TEST_F(YamlEntryTest, WholesFlagsNamesAndChoices) {
    EXPECT_EQ(entry("7").whole(0, 9), 7);
    EXPECT_EQ(entry("18446744073709551615").count(), 18446744073709551615U);
    EXPECT_TRUE(entry("true").flag());
    EXPECT_EQ(entry("rational").choice({"linear", "rational"}), 1U);
    EXPECT_EQ(entry("a-b_c.9").name(), "a-b_c.9");
    EXPECT_THAT(refusal([&] { entry("7.0").whole(0, 9); }), HasSubstr("whole number"));
    EXPECT_THAT(refusal([&] { entry("-1").count(); }), HasSubstr("whole number"));
    EXPECT_THAT(refusal([&] { entry("yes").flag(); }), HasSubstr("true or false"));
    EXPECT_THAT(refusal([&] { entry("ratinal").choice({"linear", "rational"}); }), HasSubstr("nearest: 'rational'"));
    for (const char* bad : {"../up", ".hidden", "a/b", "'a b'", "''", "ä", "a\"b"})
        EXPECT_NE(refusal([&] { entry(bad).name(); }), "not refused") << bad;
    EXPECT_NE(refusal([&] { entry(std::string(65, 'a')).name(); }), "not refused");
}

TEST_F(YamlEntryTest, PathsAndUnknownKeys) {
    EXPECT_EQ(entry("../lamps/a.ies").path(), "/lamps/a.ies");
    EXPECT_EQ(entry("b.ies").path(), "/tmp/b.ies");
    EXPECT_EQ(entry("/abs/c.ies").path(), "/abs/c.ies");
    EXPECT_THAT(refusal([&] {
                    entry("{ahead: 3}").map({"ahead_m", "left_m"});
                }),
                HasSubstr("some.yaml:1:5: k.ahead: unknown key, expected 'ahead_m', the nearest known key"));
    EXPECT_THAT(refusal([&] { entry("{zzzzzzzzz: 3}").map({"ahead_m", "left_m"}); }), HasSubstr("one of ahead_m, left_m"));
    EXPECT_THAT(refusal([&] { entry("{left_m: 3}").map({"ahead_m", "left_m"}).require("ahead_m"); }), HasSubstr("k.ahead_m: missing"));
    EXPECT_THAT(refusal([&] { entry("3").map({"ahead_m"}); }), HasSubstr("found '3', expected a map"));
    const YamlValue values = parse_yaml("near: {a: 1}\nfar: {a: 2, b: 3, c: 4}", file);
    const YamlMap far = YamlEntry(values.members[1].value, file, "far").map({"a", "b", "c"}),
                  near = YamlEntry(values.members[0].value, file, "near").map({"a", "b"}).before(&far);
    EXPECT_EQ(near.require("a").number(0.0, 9.0), 1.0);
    EXPECT_EQ(near.find("b")->key_path(), "far.b");
    EXPECT_EQ(near.one_of({"a", "c"})->first, "a") << "the nearest map that has one";
}

// Drive files that must not be read: one sentence each, with file, line, column and key path.

TEST_F(DriveRefusal, UnknownKeysNameTheNearestAtEveryLevel) {
    EXPECT_EQ(refusal(minimal + "durations_s: 3\n"),
              "drive.yaml:7:1: durations_s: unknown key, expected 'duration_s', the nearest known key");
    EXPECT_EQ(refusal(minimal + "views: {driver: {fov_deg: 3}}\n").substr(0, 50), "drive.yaml:7:18: views.driver.fov_deg: unknown key");
    EXPECT_THAT(refusal(minimal + "measure: {probes: {p: {ahead: 3}}}\n"),
                HasSubstr("measure.probes.p.ahead: unknown key, expected 'ahead_m'"));
    EXPECT_THAT(refusal(minimal + "changes: [{at: 3}]\n"), HasSubstr("changes[0].at: unknown key, expected 'at_s'"));
    EXPECT_THAT(refusal(minimal + "car: {mount: 3}\n"), HasSubstr("car.mount: unknown key, expected 'mounts'"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_kmh: 1\nduration_s: 1\nlamp_sets: {a: {lamps: {left: {flie: low.ies}}}}\n"),
                HasSubstr("drive.yaml:5:32: lamp_sets.a.lamps.left.flie: unknown key, expected 'file'"));
    for (const char* value : {"null", "[map]"})
        EXPECT_THAT(refusal(minimal + "shadows: " + value + "\n"), AllOf(HasSubstr("shadows: found"), HasSubstr("one of none, under-car"),
                                                                         HasSubstr("auto, or a map with keys such as method")));
}

TEST_F(DriveRefusal, MissingKeysAndOtherVersions) {
    EXPECT_THAT(refusal("road: road.xodr\n"), HasSubstr("fernlicht: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\n"), HasSubstr("road: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\n"), HasSubstr("speed_kmh: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\n"), HasSubstr("duration_s: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\n"), HasSubstr("lamp_sets: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nlamp_sets: {a: {source: arc}}\n"),
                HasSubstr("a lamp without a file"));
    EXPECT_EQ(refusal("fernlicht: 1\nroad: road.xodr\nspeed: 60\n"),
              "drive.yaml:3:8: speed: found '60', expected a list of {at_s, speed_kmh}; one speed for all of the drive is speed_kmh or "
              "speed_mps");
    EXPECT_THAT(refusal("fernlicht: 2\n"), HasSubstr("found '2', expected 1"));
}

TEST_F(DriveRefusal, MissingFilesAreNamedWithTheLineThatAsks) {
    EXPECT_EQ(refusal("fernlicht: 1\nroad: none.xodr\n"),
              "drive.yaml:2:7: road: there is no file none.xodr, expected a file (relative paths start at this file's folder)");
    EXPECT_THAT(refusal("fernlicht: 1\nroad: .\n"), HasSubstr("is not a regular file"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nlamp_sets:\n  a: {lamps: {left: none.ies}}\n"),
                StartsWith("drive.yaml:6:21: lamp_sets.a.lamps.left.file: there is no file none.ies"));
    EXPECT_THAT(
        refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nlamp_sets:\n  a: {file: low.ies, spectrum: none.csv}\n"),
        StartsWith("drive.yaml:6:32: lamp_sets.a.spectrum: there is no file none.csv"));
    EXPECT_THAT(refusal(minimal + "changes: [{at_s: 1, file: none.ies}]\n"), HasSubstr("changes[0].file: there is no file none.ies"));
}

TEST_F(DriveRefusal, FieldsOfViewHaveOneRange) {
    for (const char* bad : {"180", "0", "-40"})
        EXPECT_THAT(refusal(minimal + fmt::format("views: {{v: {{vertical_fov_deg: {}}}}}\n", bad)),
                    HasSubstr(fmt::format("views.v.vertical_fov_deg: found '{}', expected a number from 0.01 to 179", bad)));
}

TEST_F(DriveRefusal, NumbersOutOfRange) {
    const auto with_duration = [&](const std::string& keys) {
        return refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nlamp_sets: {a: {file: low.ies}}\n" + keys);
    };
    for (const char* bad : {"0", "-1", "nan", ".inf", "1e7", "'3'", "three", "3 s", "[3]", "~"})
        EXPECT_THAT(with_duration(fmt::format("duration_s: {}\n", bad)), StartsWith("drive.yaml:5:13: duration_s: found")) << bad;
    EXPECT_THAT(with_duration("duration_s: 100\nstep_s: 1e-6\n"), HasSubstr("100000000 steps"));
    for (const char* bad : {"1.0e-7", "1.0e-320", ".nan"})
        EXPECT_NE(with_duration(fmt::format("duration_s: 10\nstep_s: {}\n", bad)), "not refused") << bad;
    for (const char* good :
         {"duration_s: 10\nstep_s: 1.0e-6\n", "duration_s: 10\nstep_s: 10\n", "duration_s: 1.0e-300\nstep_s: 1.0e-300\n"})
        EXPECT_EQ(with_duration(good), "not refused") << good;
    EXPECT_NE(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1.0e+9\nduration_s: 1\nlamp_sets: {a: {file: low.ies}}\n"), "not refused");
    for (const std::string& good : tests::each_of({{"tone_mapper", "{s: 1.0e+6}|{s: 1}|{l_max_cdm2: 1.0e-6}|{l_max_cdm2: 1.0e+9}"},
                                                   {"views", "{v: {resolution_px: [1, 1]}}|{v: {resolution_px: [16384, 16]}}|"
                                                             "{v: {vertical_fov_deg: 0.1}}|{v: {vertical_fov_deg: 179}}"}}))
        EXPECT_EQ(refusal(minimal + good + "\n"), "not refused") << good;
    for (const std::string& bad : tests::each_of(
             {{"step_s", "0|-0.1"},
              {"", "rate_hz: 0|speed_mps: 3|step_s: 1\nrate_hz: 1"},
              {"views",
               "{v: {vertical_fov_deg: 180}}|{v: {vertical_fov_deg: 0}}|{v: {resolution_px: [0, 10]}}|"
               "{v: {resolution_px: [16385, 10]}}|{v: {resolution_px: [10.5, 10]}}|{v: {resolution_px: [10]}}|"
               "{v: {position_m: [0, 0, nan]}}|{v: {position_m: [1.0e+300, 0, 0]}}|{v: {pitch_deg: .inf}}|{v: {vertical_fov_deg: .nan}}|"
               "{v: {map: {}, yaw_deg: 3}}|{v: {map: {ahead_m: 5, behind_m: -5}}}|{}|[]"},
              {"daylight", "dawn|{horizontal_illuminance_lx: -1}|{horizontal_illuminance_lx: .nan}|{horizontal_illuminance_lx: -.inf}|"
                           "{horizontal_illuminance_lx: 1.0e+999}|"
                           "{date: 2026-02-29, time: 12:00, utc_offset_h: 0, latitude_deg: 0, longitude_deg: 0}|"
                           "{date: 2026-02-28, time: 12:00, utc_offset_h: 0, latitude_deg: 0, longitude_deg: 0, sun: {}}|"
                           "{date: 2026-02-28, time: -1:00, utc_offset_h: 0, latitude_deg: 0, longitude_deg: 0}|"
                           "{horizontal_illuminance_lx: 1, sun: {azimuth_deg: 1, elevation_deg: 1, illuminance_lx: 1}, moon: {azimuth_deg: "
                           "1, elevation_deg: 1, illuminance_lx: 1}}|"
                           "{horizontal_illuminance_lx: 1, sun: {azimuth_deg: 1, elevation_deg: -5, illuminance_lx: 1}}"},
              {"", "traffic: {others: {entities: all}}"},
              {"weather", "{fog: {visibility_m: 100}, extinction_per_m: 1}|{extinction_per_m: 11}|{mist: true}"},
              {"seed", "-1|18446744073709551616"},
              {"", "shadows: yes|beams: 8"},
              {"textures", "true|mine.png"},
              {"tone_mapper", "{s: 0.5}|{s: 0}|{s: 0.999}|{s: .inf}|{s: .nan}|{s: 1.0e+39}|{l_max_cdm2: 0}|{l_max_cdm2: "
                              "1.0e-42}|{l_max_cdm2: 1.0e+300}|{l_max_cdm2: .nan}|"
                              "{kind: linear, s: 3}|{kind: histogram, s: 20}|"
                              "{kind: logarithmic, s: fitted}|{curve: [[0, -1], [1, 0]]}|"
                              "{kind: histogram, l_max_cdm2: 100, curve: [[-4.6, -5.3], [0, -1.6], [3.0, 0]]}|"
                              "{kind: histogram, l_max_cdm2: all, curve: [[-4.6, -5.3], [3.0, 0]]}|"
                              "{kind: histogram, curve: [[-4.6, -5.3], [30.0, 0]]}|"
                              "{kind: histogram, l_max_cdm2: 19.95, curve: [[2.995, -1.6], [3.0, 0]]}|square|[linear]"},
              {"", "capture: {per_second: -1}"},
              {"measure",
               "{extent: {thresholds_lx: []}}|{extent: {thresholds_lx: [0]}}|{extent: {cell_m: 0.02, ahead_m: 2000, beside_m: 200}}"},
              {"limits", "[{reading: x}]|[{reading: x, at_least: 2, at_most: 1}]"},
              {"changes", "[{at_s: -1, level: 1}]|[{at_s: 1}]|[{at_s: 1, level: 1.5}]|[{at_s: 1, level: 1, between_samples: log_cd}]"},
              {"", "name: ../up"},
              {"route", "{s_m: -1}|{lane: 1.5}"},
              {"", "technique: ''|car: {lamps: {left: low.ies}}"}}))
        EXPECT_NE(refusal(minimal + bad + "\n"), "not refused") << bad;
}

TEST_F(DriveRefusal, LampKeysOutOfRange) {
    for (const char* bad :
         {"level: 1.01", "level: -0.1", "voltage_v: 11.9", "voltage_v: 13.9", "source: halogen", "source: led", "temperature_k: 999",
          "temperature_k: 3000, spectrum: spectrum.csv", "aim: {pitch_deg: 1, percent_down: 1}", "aim: {pitch_deg: 91}", "aim: down",
          "type_c_axis: up", "texture: {h_extent_deg: [3, -3]}", "lamps: {middle: low.ies}", "lamps: {left: {mount: lfet}}",
          "lamps: {left: {mount: left, position_m: [1, 1, 1]}}", "lamps: {}", "lamps: [low.ies]",
          "colour: {linear_srgb: [1, 1], sp_ratio: 1}"})
        EXPECT_THAT(refusal(fmt::format(
                        "fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nlamp_sets:\n  a: {{file: low.ies, {}}}\n", bad)),
                    StartsWith("drive.yaml:6:"))
            << bad;
}

TEST_F(DriveRefusal, NamesGivenTwiceOrUnknownAndSpeedProfiles) {
    EXPECT_THAT(refusal(minimal + "views:\n  a: {}\n  a: {}\n"), HasSubstr("drive.yaml:9:3: found the key 'a' a second time"));
    EXPECT_THAT(refusal(minimal + "  one: {file: low.ies}\n"), HasSubstr("'one' a second time"));
    EXPECT_THAT(refusal(minimal + "changes: [{at_s: 1, lamp: lift, level: 1}]\n"),
                AllOf(StartsWith("drive.yaml:7:27: changes[0].lamp: no lamp 'lift' in lamp set 'one'"), HasSubstr("nearest: 'left'")));
    const std::string head = "fernlicht: 1\nroad: road.xodr\nduration_s: 1\nlamp_sets: {a: {file: low.ies}}\n";
    for (const char* bad : {"speed: []", "speed: [{at_s: 0}]", "speed: [{at_s: 0, speed_kmh: 1, speed_mps: 1}]",
                            "speed: [{at_s: 1, speed_kmh: 1}, {at_s: 1, speed_kmh: 2}]", "speed: [{speed_kmh: 1}]", "speed: 80",
                            "speed_kmh: -1", "speed_kmh: 541", "speed_mps: 1\nspeed_kmh: 1"})
        EXPECT_THAT(refusal(head + bad + "\n"), StartsWith("drive.yaml:")) << bad;
}

TEST_F(DriveRefusal, BadBytes) {
    EXPECT_THAT(refusal(""), HasSubstr("is empty"));
    EXPECT_THAT(refusal("just text"), HasSubstr("expected a map"));
    EXPECT_THAT(refusal(std::string("\x7f"
                                    "ELF\0\1\2",
                                    7)),
                HasSubstr("zero byte"));
    EXPECT_THAT(refusal(std::string((std::size_t{4} << 20) + 1, '#')), HasSubstr("at most"));
    EXPECT_THAT(refusal(std::string(std::size_t{3} << 20, '-')), StartsWith("drive.yaml:"));
    for (std::size_t length = 0; length + 1 < minimal.size(); ++length)
        EXPECT_NE(refusal(minimal.substr(0, length)), "not refused") << length;
    write_file(folder / "low.ies", "rubbish");
    EXPECT_THAT(refusal(minimal), StartsWith("low.ies:"));
}

} // namespace
} // namespace fernlicht
