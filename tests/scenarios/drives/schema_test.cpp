// drive.schema.json says the same as the reader: editors that use it must neither refuse good drives nor pass misspelt keys.
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/yaml_schema_check.h"
#include "tests/trial.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <regex>

namespace fernlicht {
namespace {

using nlohmann::json;

class Schema : public DriveFixture {
  protected:
    Schema() : check(json::parse(std::ifstream(scenarios / "drive.schema.json"))) {}

    std::string violation(const std::string& yaml) { return check.violation(to_json(parse_yaml(yaml, "test.yaml"))); }
    static std::string content(const std::filesystem::path& file) {
        FilesRead opened;
        return read_file(file, opened);
    }

    const std::filesystem::path scenarios = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios";
    SchemaCheck check;
};

TEST_F(Schema, PassesTheExampleEveryShippedDriveAndResolvedOnes) {
    EXPECT_EQ(violation(content(scenarios / "drive.example.yaml")), "");
    int drives = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenarios / "library/drives")) {
        EXPECT_EQ(violation(content(entry.path())), "") << entry.path();
        ++drives;
    }
    EXPECT_GE(drives, 6);
    const Drive drive =
        read(minimal + "changes: [{at_s: 1, file: other.ies, source: arc, aim: {pitch_rad: 0.1}}]\nlimits: [{reading: x, at_most: 1}]\n"
                       "measure: {probes: {p: {ahead_m: 7}}}\n");
    EXPECT_EQ(violation(write_drive(drive)), "");
}

/// Good or bad, schema and reader must agree.
TEST_F(Schema, AgreesWithTheReader) {
    write_file(folder / "bus.dbc", "VERSION \"\"\n");
    for (const std::string& ending : tests::each_of(
             {{"", ""},
              {"rate_hz", "60|0"},
              {"", "step_s: 0|step_s: 1\nrate_hz: 2|speed_mps: 1"},
              {"daylight",
               "night|dawn|{horizontal_illuminance_lx: 3}|{name: x}|"
               "{horizontal_illuminance_lx: 3, sun: {azimuth_deg: 90, elevation_deg: 5, illuminance_lx: 9}}|"
               "{horizontal_illuminance_lx: 3, moon: {azimuth_rad: 1, elevation_rad: 1, illuminance_lx: 1}}|"
               "{horizontal_illuminance_lx: 3, sun: {azimuth_deg: 90, illuminance_lx: 9}}|"
               "{horizontal_illuminance_lx: 3, sun: {azimuth_deg: 9, elevation_deg: 91, illuminance_lx: 9}}|"
               "{horizontal_illuminance_lx: 3, sky: clear}|"
               "{date: 2026-06-21, time: 21:30, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11}|"
               "{date: 2026-06-21, time: '21:30:15', utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11, sky: overcast, runs: true}|"
               "{date: 2026-06-21, time: 21:30, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11, runs: true, rate: 60}|"
               "{date: 21.6.2026, time: 21:30, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11}|"
               "{date: 2026-06-21, time: 24:00, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11}|"
               "{date: 2026-06-21, time: 12:00, utc_offset_h: 2, latitude_deg: 48}|"
               "{date: 2026-06-21, time: 12:00, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 181}|"
               "{date: 2026-06-21, time: 12:00, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11, sky: foggy}"},
              {"road_surface", "{}|{pavement: concrete}|{pavement: gravel}|{wheel_tracks: true}|{markings: type-2}|{markings: type-3}|"
                               "{markings: {type: type-2, rw_class: 6}}|{markings: {type: type-2, rw_class: 7}}|"
                               "{markings: {type: type-1, q_class: 1}}"},
              {"weather", "{fog: {visibility_m: 100}}|{fog: {visibility_m: 100, contrast: 0.02}, rain: light, wetness: 0.3}"},
              {"street_lamps",
               "{a: {file: low.ies}}|{a: {file: low.ies, every_m: 25, tilt_deg: 5, level: 0.5, temperature_k: 4000}}|"
               "{a: {file: low.ies, on_objects: [streetlamp, lamp post], arm_m: 0}}|{a: {file: low.ies, on_objects: []}}|"
               "{a: {file: low.ies, on_objects: streetlamp}}|{a: {every_m: 25}}|{a: {file: low.ies, every_m: 0}}|[low.ies]"},
              {"weather",
               "{fog: {visibility_m: 0}}|{fog: {visibility_m: 9}, extinction_per_m: 0.1}|{fog: thick}|{snow: heavy}|{snow: deep}|"
               "{extinction_per_m: 0.01, scattering_albedo: 0.9, asymmetry: 0.5}|{asymmetry: 1}|{wetness: 1.5}"},
              {"car", "{bumper_x_m: 3, wheelbase_m: 2.5}|{bumper: 3}|{wheelbase_m: 0}|{mounts: {left: [1, 2]}}|{mounts: {left: [1, 2, 3]}}|"
                      "{mounts: {}}"},
              {"changes", "[{at_s: 1, level: 0}]|[{at_s: 1, level: 2}]|[{level: 1}]|[{at_s: 1, lamp: left, lamps: [left], level: 1}]"},
              {"views", "{a: {}}|{}|{../a: {}}|{a: {fov: 3}}|{a: {vertical_fov_deg: 180}}|{a: {pitch_deg: -90}}|{a: {pitch_deg: -91}}|"
                        "{a: {resolution_px: [10, 10]}}|{a: {resolution_px: [10, 0]}}|{a: {resolution_px: [10]}}|{a: {map: {ahead_m: 30}}}|"
                        "{a: {map: {up_m: 30}}}"},
              {"capture", "{all: true}|{all: 1}|{every: 1}"},
              {"tone_mapper",
               "{kind: rational}|{kind: urqv}|linear|histogram|urqv|[linear]|{s: fitted, l_max_cdm2: all}|{kind: rational, s: 3}|"
               "{kind: linear, l_max_cdm2: surfaces}|{kind: linear, s: 3}|{kind: logarithmic, s: 3, l_max_cdm2: all}|"
               "{kind: logarithmic, s: fitted}|{kind: histogram, s: 3}|{kind: histogram, l_max_cdm2: all}|"
               "{kind: histogram, curve: [[0, -1], [3, 0]]}|{kind: histogram, l_max_cdm2: 20, curve: [[0, -1], [3, 0]]}|"
               "{kind: histogram, l_max_cdm2: all, curve: [[0, -1], [3, 0]]}|{kind: rational, curve: [[0, -1], [3, 0]]}|{s: 0.9}|"
               "{l_max_cdm2: 0}|{l_max_cdm2: 1.0e-42}"},
              {"technique", "a/b|photometric"},
              {"measure",
               "{extent: true}|{extent: 3}|{extent: {cell_m: 0.5}}|{extent: {cell_m: 0}}|{extent: {thresholds_lx: []}}|"
               "{probes: {a: {left_m: 3}}}|{probes: {a: {ahead_m: 3}}}|{visibility: true}|{visibility: false}|{visibility: 1}|"
               "{visibility: {size_m: 0.2}}|{visibility: {targets: [card, pedestrian-dark], age_years: 23}}|"
               "{visibility: {targets: []}}|{visibility: {targets: [carton]}}|"
               "{visibility: {targets: {card: true, own: {reflectance: 0.1, level: 7, squares: 3}}}}|"
               "{visibility: {targets: {card: {reflectance: 0.1, level: 7}}}}|{visibility: {targets: {own: {reflectance: 0.1}}}}|"
               "{visibility: {targets: {own: {reflectance: 0.1, level: 7, squares: 0.5}}}}|{visibility: {age_years: 22}}|"
               "{homogeneity: true}|{homogeneity: {patch_factor: 1}}|{homogeneity: {min_lx: 2}}|{places: [kerb]}|{places: []}|"
               "{places: [kerbs]}|{places: {what: [boards, markings], distances_m: [30]}}|{places: {distances_m: [30]}}|"
               "{places: {what: [boards], distances_m: []}}|{sensors: {}}|{sensors: {points: {}}}|"
               "{sensors: {points: {a: {at_m: 3}}}}|{sensors: {points: {a: {at_m: 3, across: kerb}}}}|"
               "{sensors: {points: {a: {at_m: 3, across: left-edge, above_m: 51}}}}|{sensors: {points: {a: {}}, thresholds_lx: []}}|"
               "{sensors: {points: {a: {at_m: 1}}, thresholds_lx: [0]}}|{glare: {}}|{glare: {mirrors: true}}|{glare: {mirrors: false}}|"
               "{glare: {mirrors: {gaps_m: []}}}|{glare: {mirrors: {places: {m: [1, 2, 3]}}}}|"
               "{glare: {oncoming: {a: {at_m: 1}}, mirrors: false}}|{glare: {oncoming: {}}}|"
               "{glare: {oncoming: {a: {eye_height_m: 1}}}}|{glare: {mirrors: true, equation: cie-general, age_years: 101}}|"
               "{glare: {mirrors: true, thresholds_de_boer: [10]}}|{glare: {mirrors: true, pigmentation: 1.2, adaptation_cdm2: 0}}"},
              {"can", "{databases: bus.dbc, inputs: {ego.speed_mps: A.B}}|{databases: [bus.dbc, bus.dbc], outputs: {A.B: ego.speed_mps}}|"
                      "{databases: bus.dbc}|{inputs: {ego.speed_mps: A.B}}|{databases: bus.dbc, inputs: {}}|"
                      "{databases: bus.dbc, inputs: {ego.speed_mps: A}}|{databases: bus.dbc, inputs: {ego.speed_mps: A.B.C}}|"
                      "{databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, stale: hold, missing: fail, out_of_range: lost}}}|"
                      "{databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, stale: keep}}}|"
                      "{databases: bus.dbc, inputs: {ego.speed_mps: {stale: hold}}}|"
                      "{databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, stale_after_s: 0}}}|"
                      "{databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, factor: 0}}}|"
                      "{databases: bus.dbc, inputs: {ego.indicator: {signal: A.B, values: {left: 1, none: 0}}}}|"
                      "{databases: bus.dbc, outputs: {A: ego.speed_mps}}|"
                      "{databases: bus.dbc, outputs: {A.B: {signal: ego.speed_mps, cycle_s: 0.1, offset: 1}}}|"
                      "{databases: bus.dbc, outputs: {A.B: {signal: ego.speed_mps, cycle_s: 0}}}|"
                      "{databases: bus.dbc, log: none, inputs: {ego.speed_mps: A.B}}|"
                      "{databases: bus.dbc, log: low.ies, start: 12.5, inputs: {ego.speed_mps: A.B}}|"
                      "{databases: bus.dbc, log: low.ies, start: -1, inputs: {ego.speed_mps: A.B}}|"
                      "{databases: bus.dbc, log: low.ies, start: '1436509052.249713', channel: can0, inputs: {ego.speed_mps: A.B}}|"
                      "{database: bus.dbc, inputs: {ego.speed_mps: A.B}}"},
              {"limits", "[]|[{reading: x}]|[{reading: x, at_least: 3}]|[{at_least: 3}]"},
              {"shadows", "true|1|{method: none}|{method: none, map_texels: [64, 64]}|{method: volumes, tolerance_m: 0.01}|"
                          "{method: volumes, redraw_texels: 1}|{method: one-map, redraw_texels: 1}|{method: map, lamp_places: 4}|"
                          "{method: soft-map, lamp_places: 4, lamp_radius_m: 0.1}|{method: soft-map, error_bound: 0.1}|"
                          "{method: auto, error_bound: 0.1, lamp_places: 4}|{method: auto, error_bound: 0}|{method: auto, error_bound: 1}|"
                          "{error_bound: 0.1}"},
              {"beams", "float|eight-bit|8"},
              {"textures", "none|shipped|true|[none]"},
              {"seed", "3|-1|1.5"},
              {"route", "{lane: 1}|{lane: 1.5}|{road: 3, s_m: 1, via: [a]}|{s: 1}"},
              {"name", "a b|a-b"},
              {"", "title: any text|nonsense: 1"}})) {
        const std::string yaml = minimal + ending + "\n";
        const std::string by_reader = refusal(yaml), by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << ending << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
    for (const std::string& lamp : tests::each_of({{"level", "0.5|2"},
                                                   {"", "voltage_v: 11"},
                                                   {"flux_factor", "1.07|0|2000"},
                                                   {"source", "arc|xenon"},
                                                   {"temperature_k", "3000|30"},
                                                   {"aim", "{percent_down: 1}|{down: 1}|{yaw_rad: 3.2}"},
                                                   {"type_c_axis", "nadir|up"},
                                                   {"", "between_samples: log_cd"},
                                                   {"texture", "{scale_lx: 1}|{scale: 1}"},
                                                   {"", "photometric_distance_m: -1"},
                                                   {"colour", "{linear_srgb: [1, 1, 1], sp_ratio: 1}|{linear_srgb: [1, 1], sp_ratio: 1}"},
                                                   {"lamps", "{left: low.ies}|{left: {mount: right}}|{left: {pos: 3}}|[]"},
                                                   {"", "changes: []"}})) {
        const std::string yaml =
            fmt::format("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nlamp_sets: {{a: {{file: low.ies, {}}}}}\n", lamp);
        const std::string by_reader = refusal(yaml), by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << lamp << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
}

TEST_F(Schema, EveryKeyOfTheExampleMisspeltIsRefusedByBoth) {
    for (const char* part : {"roads", "lamps", "models", "displays", "can"})
        std::filesystem::create_directories(folder / "library" / part);
    write_file(folder / "library/roads/country.xodr", "<OpenDRIVE/>");
    for (const char* file : {"halogen-low", "halogen-high", "xenon-low", "xenon-high", "street-6000lm"})
        write_file(folder / "library/lamps" / (std::string(file) + ".ies"), ies_text(1.0));
    for (const char* file : {"models/shelter.gltf", "displays/projector.yaml", "can/mock-up.dbc", "can/s-bend.log"})
        std::filesystem::copy_file(scenarios / "library" / file, folder / "library" / file,
                                   std::filesystem::copy_options::overwrite_existing);
    const std::string example = content(scenarios / "drive.example.yaml");
    ASSERT_EQ(refusal(example), "not refused");
    const std::regex key(R"(\b([a-z_]{4,})(: ))");
    std::size_t tried = 0;
    for (std::sregex_iterator match(example.begin(), example.end(), key), end; match != end; ++match) {
        const auto at = static_cast<std::size_t>(match->position(1));
        const std::size_t line = example.rfind('\n', at) + 1;
        if (example.substr(line, at - line).find('#') != std::string::npos)
            continue; // a comment
        const std::string name = match->str(1);
        if (name == "left" || name == "right" || name == "halogen" || name == "xenon" || name == "driver" || name == "opposite" ||
            name == "inside" || name == "rear" || name == "card" || name == "sign")
            continue; // names are the user's
        std::string misspelt = example;
        misspelt.insert(at + 2, "q");
        EXPECT_NE(violation(misspelt), "") << name;
        EXPECT_THAT(refusal(misspelt), testing::AnyOf(testing::HasSubstr("unknown key"), testing::HasSubstr("no mount"))) << name;
        ++tried;
    }
    EXPECT_GT(tried, 40U);
}

} // namespace
} // namespace fernlicht
