// Reading drive files: what the keys come to, defaults, inheritance.
#include "tests/scenarios/drives/drive_fixture.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ElementsAre;
using DriveFile = DriveFixture;

TEST_F(DriveFile, SixLinesAreADrive) {
    const Drive drive = read(minimal);
    EXPECT_EQ(drive.name, "drive");
    EXPECT_EQ(drive.road_file, folder / "road.xodr");
    EXPECT_THAT(drive.speed, ElementsAre(SpeedPoint{0.0, 20.0}));
    EXPECT_EQ(drive.duration_s, 3.0);
    EXPECT_EQ(drive.step_s, 1.0 / 30.0);
    EXPECT_EQ(drive.daylight, Daylight{});
    ASSERT_EQ(drive.views.size(), 2U);
    EXPECT_EQ(drive.views[0].name, "driver");
    EXPECT_EQ(drive.views[1].projection, Projection::map);
    EXPECT_EQ(drive.extent, ExtentParameters{});
    ASSERT_EQ(drive.lamp_sets.size(), 1U);
    ASSERT_EQ(drive.lamp_sets[0].lamps.size(), 2U);
    const MountedLamp& left = drive.lamp_sets[0].lamps[0];
    EXPECT_EQ(left.name, "left");
    EXPECT_EQ(left.position_m, glm::dvec3(3.4, 0.6, 0.65));
    EXPECT_EQ(left.pitch_rad, 0.0);
    EXPECT_EQ(left.intensity_factor(), 1.0);
    EXPECT_EQ(left.colour.cct_k, 3200.0);
    EXPECT_DOUBLE_EQ(intensity_cd(left.file->table, 0.0, 0.0), 1000.0);
}

TEST_F(DriveFile, EachLampFileIsReadOnceAndRecorded) {
    const Drive drive = read("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 3\nlamp_sets:\n  a: {file: low.ies}\n"
                             "  b: {lamps: {left: low.ies, right: {file: ./low.ies, between_samples: log_cd}}}\n");
    EXPECT_EQ(drive.lamp_sets[0].lamps[0].file, drive.lamp_sets[0].lamps[1].file);
    EXPECT_EQ(drive.lamp_sets[0].lamps[0].file, drive.lamp_sets[1].lamps[0].file);
    EXPECT_NE(drive.lamp_sets[0].lamps[0].file, drive.lamp_sets[1].lamps[1].file) << "another rule between samples is another table";
    EXPECT_EQ(drive.lamp_sets[1].lamps[1].file->table.rule, BetweenSamples::log_cd);
    ASSERT_EQ(drive.opened.size(), 3U);
    EXPECT_EQ(drive.opened[0].path, folder / "drive.yaml");
    EXPECT_EQ(drive.opened[1].path, folder / "low.ies");
    EXPECT_EQ(drive.opened[1].bytes, ies_text(1000.0).size());
}

TEST_F(DriveFile, TextGridsAreReadByTheRecipeThatStandsBesideThem) {
    write_file(folder / "a.txt", "V;-1,5;2\n0;100;200\n1;300;400\n");
    write_file(folder / "b.txt", "V;-1,5;2\n0;1;2\n1;3;4\n");
    write_file(folder / "ours.yaml", "fernlicht_recipe: 1\nlayout: matrix\ndelimiter: semicolon\ndecimal: comma\nunit: cd\n");
    const std::string head = "fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 3\nlamp_sets:\n  a:\n    recipe: ours.yaml\n";
    const Drive drive = read(head + "    lamps: {left: a.txt, right: b.txt, third: {file: low.ies, position_m: [1, 2, 3]}}\n");
    const std::vector<MountedLamp>& lamps = drive.lamp_sets[0].lamps;
    EXPECT_EQ(lamps[0].file->table.cd, (std::vector<double>{100, 200, 300, 400}));
    EXPECT_EQ(lamps[1].file->table.cd, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_DOUBLE_EQ(intensity_cd(lamps[2].file->table, 0.0, 0.0), 1000.0) << "an IES file says itself how it is laid out";
    EXPECT_EQ(std::ranges::count(drive.opened, folder / "ours.yaml", &FileRead::path), 1);
    write_file(folder / "resolved.yaml", write_drive(drive));
    const Drive again = read_drive(folder / "resolved.yaml");
    ASSERT_EQ(again.lamp_sources.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(again.lamp_sources[i].options.recipe, folder / "ours.yaml");
        EXPECT_EQ(again.lamp_sources[i].file->table, drive.lamp_sources[i].file->table);
    }
    EXPECT_THAT(refusal(head + "    lamps: {left: a.txt}\n    changes: [{at_s: 1, recipe: ours.yaml}]\n"),
                testing::HasSubstr("a way to read a file without a file"));
    EXPECT_THAT(refusal(minimal.substr(0, minimal.find("  one")) + "  one: {file: a.txt, recipe: speos-tipe-a}\n"),
                testing::AllOf(
                    testing::StartsWith("drive.yaml:6:30: lamp_sets.one.recipe: there is no file speos-tipe-a and no recipe of that name"),
                    testing::HasSubstr("(nearest: 'speos-type-a')")));
    EXPECT_THAT(refusal(minimal.substr(0, minimal.find("  one")) + "  one: {file: a.txt}\n"),
                testing::HasSubstr("other text grids need a recipe"));
}

TEST_F(DriveFile, ALampsOwnKeysComeBeforeItsLampSets) {
    const Drive drive =
        read("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 3\nlamp_sets:\n  a:\n    file: low.ies\n    source: arc\n"
             "    voltage_v: 12.5\n    aim: {percent_down: 1}\n    lamps:\n      left: {level: 0.5}\n      right: other.ies\n"
             "      third: {source: filament, temperature_k: 3000, position_m: [1, 2, 3], aim: {yaw_deg: 90}}\n"
             "      fourth: {mount: left, spectrum: spectrum.csv}\n");
    const std::vector<MountedLamp>& lamps = drive.lamp_sets[0].lamps;
    ASSERT_EQ(lamps.size(), 4U);
    EXPECT_EQ(lamps[0].level, 0.5);
    EXPECT_EQ(lamps[0].source, SourceKind::arc);
    EXPECT_EQ(lamps[0].colour.cct_k, 4300.0);
    EXPECT_EQ(lamps[0].intensity_factor(), 0.5) << "an arc lamp's flux does not go with the voltage";
    EXPECT_DOUBLE_EQ(lamps[0].pitch_rad, -std::atan(0.01));
    EXPECT_DOUBLE_EQ(intensity_cd(lamps[1].file->table, 0.0, 0.0), 2000.0);
    EXPECT_EQ(lamps[2].colour.cct_k, 3000.0);
    EXPECT_DOUBLE_EQ(lamps[2].yaw_rad, pi / 2.0);
    EXPECT_EQ(lamps[2].pitch_rad, 0.0) << "an aim replaces the lamp set's whole aim";
    EXPECT_EQ(lamps[2].position_m, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_DOUBLE_EQ(lamps[2].intensity_factor(), std::pow(12.5 / 13.2, 3.4));
    EXPECT_EQ(lamps[3].position_m, lamps[0].position_m);
    EXPECT_GT(lamps[3].colour.sp_ratio, 0.0);
}

TEST_F(DriveFile, LampsOnTheCarAreOneLampSet) {
    const Drive drive =
        read("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 3\ncar:\n  bumper_x_m: 4\n  mounts: {middle: [4, 0, 1]}\n"
             "  lamps: {middle: low.ies}\n");
    ASSERT_EQ(drive.lamp_sets.size(), 1U);
    ASSERT_EQ(drive.lamp_sets[0].lamps.size(), 1U);
    EXPECT_EQ(drive.lamp_sets[0].lamps[0].position_m, glm::dvec3(4.0, 0.0, 1.0));
    EXPECT_EQ(drive.bumper_m, 4.0);
}

TEST_F(DriveFile, ChangesAreSortedAndNameTheirLamps) {
    const Drive drive =
        read("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 3\nlamp_sets:\n  a:\n    file: low.ies\n"
             "    changes:\n      - {at_s: 1, lamp: left, level: 0.25}\n      - {at_s: 2, lamp: left, file: other.ies, source: arc}\n"
             "changes:\n  - {at_s: 1.5, aim: {pitch_deg: -1}}\n  - {at_s: 1, lamps: [left, right], level: 0}\n");
    const std::vector<LampChange>& changes = drive.lamp_sets[0].changes;
    ASSERT_EQ(changes.size(), 6U);
    EXPECT_EQ(changes[0].lamp + changes[1].lamp + changes[2].lamp, "leftrightleft") << "the lamp set's own come after the drive's";
    EXPECT_EQ(changes[2].level, 0.25);
    EXPECT_EQ(changes[3].time_s, 1.5);
    EXPECT_DOUBLE_EQ(*changes[3].pitch_rad, radians(-1.0));
    EXPECT_FALSE(changes[3].yaw_rad);
    EXPECT_EQ(changes[5].colour->cct_k, 4300.0) << "the colour goes with the source";
    EXPECT_DOUBLE_EQ(intensity_cd(changes[5].file->table, 0.0, 0.0), 2000.0);
}

TEST_F(DriveFile, SixViewsAndMore) {
    std::string yaml = minimal + "views:\n";
    for (int i = 0; i < 8; ++i)
        yaml += fmt::format("  mirror-{}: {{yaw_deg: {}, vertical_fov_deg: 30, resolution_px: [64, 48], position_m: [1, {}, 1.2]}}\n", i,
                            i * 45, i);
    const Drive drive = read(yaml + "  map: {map: {ahead_m: 30, behind_m: 10, left_m: 5, right_m: 5}}\n");
    ASSERT_EQ(drive.views.size(), 9U);
    EXPECT_EQ(drive.views[3].name, "mirror-3");
    EXPECT_DOUBLE_EQ(drive.views[3].yaw_rad, radians(135.0));
    EXPECT_EQ(drive.views[3].width_px, 64);
    EXPECT_EQ(drive.views[8].width_px, 40) << "four pixels a metre";
    EXPECT_EQ(drive.views[8].height_px, 160);
}

TEST_F(DriveFile, DaylightStepSpeedAndTheRest) {
    EXPECT_EQ(read(minimal + "daylight: twilight").daylight.horizontal_illuminance_lx, 3.4);
    EXPECT_EQ(read(minimal + "daylight: day").daylight.horizontal_illuminance_lx, 27000.0);
    EXPECT_EQ(read(minimal + "daylight: {name: moon, horizontal_illuminance_lx: 0.2}").daylight, (Daylight{"moon", 0.2}));
    const Daylight noon =
        read(minimal + "daylight: {date: 2026-06-21, time: 13:14, utc_offset_h: 2, latitude_deg: 48.14, longitude_deg: 11.58, rate: 2}")
            .daylight;
    EXPECT_NEAR(degrees(noon.sun.elevation_rad), 65.3, 0.1);
    EXPECT_EQ(noon.clock->rate, 2.0);
    EXPECT_EQ(read(minimal + "weather: {fog: {visibility_m: 100, contrast: 0.02}}").weather.extinction_per_m,
              extinction_of_range_per_m(100.0, 0.02));
    EXPECT_EQ(read(minimal + "weather: {rain: heavy, wetness: 0.2}").weather.wetness, 0.2);
    EXPECT_EQ(read(minimal + "rate_hz: 60").step_s, 1.0 / 60.0);
    EXPECT_EQ(read(minimal + "step_s: 0.25").step_s, 0.25);
    EXPECT_EQ(read(minimal).road_surface, RoadSurface{});
    EXPECT_EQ(read(minimal + "road_surface: {pavement: asphalt-worn, wheel_tracks: true, markings: type-1}").road_surface,
              (RoadSurface{Pavement::asphalt_worn, true, {MarkingType::type_1}}));
    EXPECT_EQ(read(minimal + "road_surface: {markings: {type: type-2, r_class: 5, rw_class: 6, q_class: 1}}").road_surface.markings,
              (Markings{MarkingType::type_2, 5, 6, 1}));
    EXPECT_THROW(read(minimal + "road_surface: {markings: {type: type-1, rw_class: 2}}"), InputError);
    EXPECT_THROW(read(minimal + "road_surface: {markings: {type: type-2, r_class: 6}}"), InputError);
    EXPECT_THROW(read(minimal + "road_surface: {pavement: gravel}"), InputError);
    EXPECT_TRUE(read(minimal).textured);
    EXPECT_TRUE(read(minimal + "textures: shipped").textured);
    EXPECT_FALSE(read(minimal + "textures: none").textured);
    EXPECT_FALSE(read(minimal).beams);
    EXPECT_EQ(read(minimal + "beams: eight-bit").beams, eight_bit_texels);
    EXPECT_EQ(read(minimal + "beams: {width: 64, height: 32, bits: 16}").beams, (BeamTexels{64, 32, 16}));
    EXPECT_THROW(read(minimal + "beams: {width: 64, height: 32, bits: 12}"), InputError);
    EXPECT_THROW(read(minimal + "beams: {width: 1, height: 32, bits: 8}"), InputError);
    EXPECT_THROW(read(minimal + "beams: {width: 64, bits: 8}"), InputError);
    EXPECT_FALSE(read(minimal + "beams: float").beams);
    const Drive drive =
        read(minimal + "route: {road: 17, lane: -2, s_m: 5.5, via: [3, x]}\ncapture: {all: true, exr: false, per_second: 4}\n"
                       "tone_mapper: {kind: logarithmic, s: 10, l_max_cdm2: 100}\ntechnique: as-published\nshadows: false\n"
                       "measure: {extent: false, probes: {p: {ahead_m: 7}}}\nlimits: [{reading: p_lx, at_most: 3}]\nseed: 7\n");
    EXPECT_EQ(drive.start.road, "17");
    EXPECT_EQ(drive.start.lane, -2);
    EXPECT_EQ(drive.start.s_m, 5.5);
    EXPECT_THAT(drive.via, ElementsAre("3", "x"));
    EXPECT_EQ(drive.capture, (Capture{4.0, true, false, true}));
    EXPECT_EQ(drive.tone_mapper, (ToneMapper{ToneMapperKind::logarithmic, 10.0, 100.0, {}}));
    EXPECT_EQ(drive.technique, "as-published");
    EXPECT_EQ(drive.shadows.method, ShadowMethod::none);
    EXPECT_FALSE(drive.extent);
    EXPECT_THAT(drive.probes, ElementsAre(Probe{"p", 7.0, 0.0, 0.0}));
    EXPECT_THAT(drive.limits, ElementsAre(Limit{"p_lx", std::nullopt, 3.0}));
    EXPECT_EQ(drive.limits.front().line, 13U);
    EXPECT_EQ(drive.seed, 7U);
}

TEST_F(DriveFile, ANameThatIsNoneBecomesOne) {
    write_file(folder / "my drive!.yaml", minimal);
    EXPECT_EQ(read_drive(folder / "my drive!.yaml").name, "my-drive-");
}

} // namespace
} // namespace fernlicht
