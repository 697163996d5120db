// Drive files that must not be read: one sentence each, with file, line, column and key path.
#include "tests/scenarios/drives/drive_fixture.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using DriveRefusal = DriveFixture;

TEST_F(DriveRefusal, UnknownKeysNameTheNearestAtEveryLevel) {
    EXPECT_EQ(refusal(minimal + "durations_s: 3\n"),
              "drive.yaml:7:1: durations_s: unknown key, expected 'duration_s', the nearest known key");
    EXPECT_EQ(refusal(minimal + "views: {driver: {fov_deg: 3}}\n").substr(0, 50), "drive.yaml:7:18: views.driver.fov_deg: unknown key");
    EXPECT_THAT(refusal(minimal + "measure: {probes: {p: {ahead: 3}}}\n"),
                HasSubstr("measure.probes.p.ahead: unknown key, expected 'ahead_m'"));
    EXPECT_THAT(refusal(minimal + "changes: [{at: 3}]\n"), HasSubstr("changes[0].at: unknown key, expected 'at_s'"));
    EXPECT_THAT(refusal(minimal + "car: {mount: 3}\n"), HasSubstr("car.mount: unknown key, expected 'mounts'"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_kmh: 1\nduration_s: 1\nvariants: {a: {lamps: {left: {flie: low.ies}}}}\n"),
                HasSubstr("drive.yaml:5:31: variants.a.lamps.left.flie: unknown key, expected 'file'"));
}

TEST_F(DriveRefusal, ShadowsThatAreNeitherMethodNorMap) {
    for (const char* value : {"null", "[map]"})
        EXPECT_THAT(refusal(minimal + "shadows: " + value + "\n"), AllOf(HasSubstr("shadows: found"), HasSubstr("one of none, under-car"),
                                                                         HasSubstr("auto, or a map with keys such as method")));
}

TEST_F(DriveRefusal, MissingKeys) {
    EXPECT_THAT(refusal("road: road.xodr\n"), HasSubstr("fernlicht: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\n"), HasSubstr("road: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\n"), HasSubstr("speed_kmh: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\n"), HasSubstr("duration_s: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\n"), HasSubstr("variants: missing"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nvariants: {a: {source: arc}}\n"),
                HasSubstr("a lamp without a file"));
}

TEST_F(DriveRefusal, ASpeedWithoutItsUnitNamesTheKeysThatHaveOne) {
    EXPECT_EQ(refusal("fernlicht: 1\nroad: road.xodr\nspeed: 60\n"),
              "drive.yaml:3:8: speed: found '60', expected a list of {at_s, speed_kmh}; one speed for all of the drive is speed_kmh or "
              "speed_mps");
}

TEST_F(DriveRefusal, AnotherVersionOfTheFormat) { EXPECT_THAT(refusal("fernlicht: 2\n"), HasSubstr("found '2', expected 1")); }

TEST_F(DriveRefusal, MissingFilesAreNamedWithTheLineThatAsks) {
    EXPECT_EQ(refusal("fernlicht: 1\nroad: none.xodr\n"),
              "drive.yaml:2:7: road: there is no file none.xodr, expected a file (relative paths start at this file's folder)");
    EXPECT_THAT(refusal("fernlicht: 1\nroad: .\n"), HasSubstr("is not a regular file"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nvariants:\n  a: {lamps: {left: none.ies}}\n"),
                StartsWith("drive.yaml:6:21: variants.a.lamps.left.file: there is no file none.ies"));
    EXPECT_THAT(
        refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nvariants:\n  a: {file: low.ies, spectrum: none.csv}\n"),
        StartsWith("drive.yaml:6:32: variants.a.spectrum: there is no file none.csv"));
    EXPECT_THAT(refusal(minimal + "changes: [{at_s: 1, file: none.ies}]\n"), HasSubstr("changes[0].file: there is no file none.ies"));
}

TEST_F(DriveRefusal, FieldsOfViewHaveOneRange) {
    for (const char* bad : {"180", "0", "-40"})
        EXPECT_THAT(refusal(minimal + fmt::format("views: {{v: {{vertical_fov_deg: {}}}}}\n", bad)),
                    HasSubstr(fmt::format("views.v.vertical_fov_deg: found '{}', expected a number from 0.01 to 179", bad)));
}

TEST_F(DriveRefusal, NumbersOutOfRange) {
    const auto with_duration = [&](const std::string& keys) {
        return refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nvariants: {a: {file: low.ies}}\n" + keys);
    };
    for (const char* bad : {"0", "-1", "nan", ".inf", "1e7", "'3'", "three", "3 s", "[3]", "~"})
        EXPECT_THAT(with_duration(fmt::format("duration_s: {}\n", bad)), StartsWith("drive.yaml:5:13: duration_s: found")) << bad;
    EXPECT_THAT(with_duration("duration_s: 100\nstep_s: 1e-6\n"), HasSubstr("100000000 steps"));
    for (const char* bad : {"1.0e-7", "1.0e-320", ".nan"})
        EXPECT_NE(with_duration(fmt::format("duration_s: 10\nstep_s: {}\n", bad)), "not refused") << bad;
    for (const char* good :
         {"duration_s: 10\nstep_s: 1.0e-6\n", "duration_s: 10\nstep_s: 10\n", "duration_s: 1.0e-300\nstep_s: 1.0e-300\n"})
        EXPECT_EQ(with_duration(good), "not refused") << good;
    EXPECT_NE(refusal("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1.0e+9\nduration_s: 1\nvariants: {a: {file: low.ies}}\n"), "not refused");
    for (const char* good :
         {"tone_mapper: {s: 1.0e+6}", "tone_mapper: {s: 1}", "tone_mapper: {l_max_cdm2: 1.0e-6}", "tone_mapper: {l_max_cdm2: 1.0e+9}",
          "views: {v: {resolution_px: [1, 1]}}", "views: {v: {resolution_px: [16384, 16]}}", "views: {v: {vertical_fov_deg: 0.1}}",
          "views: {v: {vertical_fov_deg: 179}}"})
        EXPECT_EQ(refusal(minimal + good + "\n"), "not refused") << good;
    for (const char* bad : {"step_s: 0",
                            "step_s: -0.1",
                            "rate_hz: 0",
                            "speed_mps: 3",
                            "step_s: 1\nrate_hz: 1",
                            "views: {v: {vertical_fov_deg: 180}}",
                            "views: {v: {vertical_fov_deg: 0}}",
                            "views: {v: {resolution_px: [0, 10]}}",
                            "views: {v: {resolution_px: [16385, 10]}}",
                            "views: {v: {resolution_px: [10.5, 10]}}",
                            "views: {v: {resolution_px: [10]}}",
                            "views: {v: {position_m: [0, 0, nan]}}",
                            "views: {v: {position_m: [1.0e+300, 0, 0]}}",
                            "views: {v: {pitch_deg: .inf}}",
                            "views: {v: {vertical_fov_deg: .nan}}",
                            "views: {v: {map: {}, yaw_deg: 3}}",
                            "views: {v: {map: {ahead_m: 5, behind_m: -5}}}",
                            "views: {}",
                            "views: []",
                            "daylight: dawn",
                            "daylight: {horizontal_illuminance_lx: -1}",
                            "daylight: {horizontal_illuminance_lx: .nan}",
                            "daylight: {horizontal_illuminance_lx: -.inf}",
                            "daylight: {horizontal_illuminance_lx: 1.0e+999}",
                            "daylight: {date: 2026-02-29, time: 12:00, utc_offset_h: 0, latitude_deg: 0, longitude_deg: 0}",
                            "daylight: {date: 2026-02-28, time: 12:00, utc_offset_h: 0, latitude_deg: 0, longitude_deg: 0, sun: {}}",
                            "daylight: {date: 2026-02-28, time: -1:00, utc_offset_h: 0, latitude_deg: 0, longitude_deg: 0}",
                            "daylight: {horizontal_illuminance_lx: 1, sun: {azimuth_deg: 1, elevation_deg: 1, illuminance_lx: 1}, "
                            "moon: {azimuth_deg: 1, elevation_deg: 1, illuminance_lx: 1}}",
                            "daylight: {horizontal_illuminance_lx: 1, sun: {azimuth_deg: 1, elevation_deg: -5, illuminance_lx: 1}}",
                            "traffic: {others: {entities: all}}",
                            "weather: {fog: {visibility_m: 100}, extinction_per_m: 1}",
                            "weather: {extinction_per_m: 11}",
                            "weather: {mist: true}",
                            "seed: -1",
                            "seed: 18446744073709551616",
                            "shadows: yes",
                            "beams: 8",
                            "textures: true",
                            "textures: mine.png",
                            "tone_mapper: {s: 0.5}",
                            "tone_mapper: {s: 0}",
                            "tone_mapper: {s: 0.999}",
                            "tone_mapper: {s: .inf}",
                            "tone_mapper: {s: .nan}",
                            "tone_mapper: {s: 1.0e+39}",
                            "tone_mapper: {l_max_cdm2: 0}",
                            "tone_mapper: {l_max_cdm2: 1.0e-42}",
                            "tone_mapper: {l_max_cdm2: 1.0e+300}",
                            "tone_mapper: {l_max_cdm2: .nan}",
                            "tone_mapper: {kind: linear, s: 3}",
                            "tone_mapper: {kind: histogram, s: 20}",
                            "tone_mapper: {kind: logarithmic, s: fitted}",
                            "tone_mapper: {curve: [[0, -1], [1, 0]]}",
                            "tone_mapper: {kind: histogram, l_max_cdm2: 100, curve: [[-4.6, -5.3], [0, -1.6], [3.0, 0]]}",
                            "tone_mapper: {kind: histogram, l_max_cdm2: all, curve: [[-4.6, -5.3], [3.0, 0]]}",
                            "tone_mapper: {kind: histogram, curve: [[-4.6, -5.3], [30.0, 0]]}",
                            "tone_mapper: {kind: histogram, l_max_cdm2: 19.95, curve: [[2.995, -1.6], [3.0, 0]]}",
                            "tone_mapper: square",
                            "tone_mapper: [linear]",
                            "capture: {per_second: -1}",
                            "measure: {extent: {limits_lx: []}}",
                            "measure: {extent: {limits_lx: [0]}}",
                            "measure: {extent: {cell_m: 0.02, ahead_m: 2000, beside_m: 200}}",
                            "limits: [{reading: x}]",
                            "limits: [{reading: x, at_least: 2, at_most: 1}]",
                            "changes: [{at_s: -1, level: 1}]",
                            "changes: [{at_s: 1}]",
                            "changes: [{at_s: 1, level: 1.5}]",
                            "changes: [{at_s: 1, level: 1, between_samples: log_cd}]",
                            "name: ../up",
                            "route: {s_m: -1}",
                            "route: {lane: 1.5}",
                            "technique: ''",
                            "car: {lamps: {left: low.ies}}"})
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
                        "fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nvariants:\n  a: {{file: low.ies, {}}}\n", bad)),
                    StartsWith("drive.yaml:6:"))
            << bad;
}

TEST_F(DriveRefusal, NamesGivenTwiceOrUnknown) {
    EXPECT_THAT(refusal(minimal + "views:\n  a: {}\n  a: {}\n"), HasSubstr("drive.yaml:9:3: found the key 'a' a second time"));
    EXPECT_THAT(refusal(minimal + "  one: {file: low.ies}\n"), HasSubstr("'one' a second time"));
    EXPECT_THAT(refusal(minimal + "changes: [{at_s: 1, lamp: lift, level: 1}]\n"),
                AllOf(StartsWith("drive.yaml:7:27: changes[0].lamp: no lamp 'lift' in variant 'one'"), HasSubstr("nearest: 'left'")));
}

TEST_F(DriveRefusal, SpeedProfiles) {
    const std::string head = "fernlicht: 1\nroad: road.xodr\nduration_s: 1\nvariants: {a: {file: low.ies}}\n";
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
}

TEST_F(DriveRefusal, ALampFileWithRubbishIsRefusedByItsReader) {
    write_file(folder / "low.ies", "rubbish");
    EXPECT_THAT(refusal(minimal), StartsWith("low.ies:"));
}

} // namespace
} // namespace fernlicht
