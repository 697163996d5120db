// drive.schema.json says the same as the reader: editors that use it must neither refuse good drives nor pass misspelt keys.
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/yaml_schema_check.h"

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

TEST_F(Schema, PassesTheExampleAndEveryShippedDrive) {
    EXPECT_EQ(violation(content(scenarios / "drive.example.yaml")), "");
    int drives = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenarios / "library/drives")) {
        EXPECT_EQ(violation(content(entry.path())), "") << entry.path();
        ++drives;
    }
    EXPECT_GE(drives, 6);
}

TEST_F(Schema, PassesResolvedDrives) {
    const Drive drive =
        read(minimal + "changes: [{at_s: 1, file: other.ies, source: arc, aim: {pitch_rad: 0.1}}]\nlimits: [{reading: x, at_most: 1}]\n"
                       "measure: {probes: {p: {ahead_m: 7}}}\n");
    EXPECT_EQ(violation(write_drive(drive)), "");
}

/// Good or bad, schema and reader must agree.
TEST_F(Schema, AgreesWithTheReader) {
    write_file(folder / "bus.dbc", "VERSION \"\"\n");
    const std::vector<std::string> endings = {
        "",
        "rate_hz: 60",
        "rate_hz: 0",
        "step_s: 0",
        "step_s: 1\nrate_hz: 2",
        "speed_mps: 1",
        "daylight: night",
        "daylight: dawn",
        "daylight: {horizontal_illuminance_lx: 3}",
        "daylight: {name: x}",
        "daylight: {horizontal_illuminance_lx: 3, sun: {azimuth_deg: 90, elevation_deg: 5, illuminance_lx: 9}}",
        "daylight: {horizontal_illuminance_lx: 3, moon: {azimuth_rad: 1, elevation_rad: 1, illuminance_lx: 1}}",
        "daylight: {horizontal_illuminance_lx: 3, sun: {azimuth_deg: 90, illuminance_lx: 9}}",
        "daylight: {horizontal_illuminance_lx: 3, sun: {azimuth_deg: 9, elevation_deg: 91, illuminance_lx: 9}}",
        "daylight: {horizontal_illuminance_lx: 3, sky: clear}",
        "daylight: {date: 2026-06-21, time: 21:30, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11}",
        "daylight: {date: 2026-06-21, time: '21:30:15', utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11, "
        "sky: overcast, runs: true}",
        "daylight: {date: 2026-06-21, time: 21:30, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11, "
        "runs: true, rate: 60}",
        "daylight: {date: 21.6.2026, time: 21:30, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11}",
        "daylight: {date: 2026-06-21, time: 24:00, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11}",
        "daylight: {date: 2026-06-21, time: 12:00, utc_offset_h: 2, latitude_deg: 48}",
        "daylight: {date: 2026-06-21, time: 12:00, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 181}",
        "daylight: {date: 2026-06-21, time: 12:00, utc_offset_h: 2, latitude_deg: 48, longitude_deg: 11, "
        "sky: foggy}",
        "weather: {fog: {visibility_m: 100}}",
        "weather: {fog: {visibility_m: 100, contrast: 0.02}, rain: light, wetness: 0.3}",
        "street_lamps: {a: {file: low.ies}}",
        "street_lamps: {a: {file: low.ies, every_m: 25, tilt_deg: 5, level: 0.5, temperature_k: 4000}}",
        "street_lamps: {a: {file: low.ies, on_objects: [streetlamp, lamp post], arm_m: 0}}",
        "street_lamps: {a: {file: low.ies, on_objects: []}}",
        "street_lamps: {a: {file: low.ies, on_objects: streetlamp}}",
        "street_lamps: {a: {every_m: 25}}",
        "street_lamps: {a: {file: low.ies, every_m: 0}}",
        "street_lamps: [low.ies]",
        "weather: {fog: {visibility_m: 0}}",
        "weather: {fog: {visibility_m: 9}, extinction_per_m: 0.1}",
        "weather: {fog: thick}",
        "weather: {snow: heavy}",
        "weather: {snow: deep}",
        "weather: {extinction_per_m: 0.01, scattering_albedo: 0.9, asymmetry: 0.5}",
        "weather: {asymmetry: 1}",
        "weather: {wetness: 1.5}",
        "car: {bumper_x_m: 3, wheelbase_m: 2.5}",
        "car: {bumper: 3}",
        "car: {wheelbase_m: 0}",
        "car: {mounts: {left: [1, 2]}}",
        "car: {mounts: {left: [1, 2, 3]}}",
        "car: {mounts: {}}",
        "changes: [{at_s: 1, level: 0}]",
        "changes: [{at_s: 1, level: 2}]",
        "changes: [{level: 1}]",
        "changes: [{at_s: 1, lamp: left, lamps: [left], level: 1}]",
        "views: {a: {}}",
        "views: {}",
        "views: {../a: {}}",
        "views: {a: {fov: 3}}",
        "views: {a: {vertical_fov_deg: 180}}",
        "views: {a: {pitch_deg: -90}}",
        "views: {a: {pitch_deg: -91}}",
        "views: {a: {resolution_px: [10, 10]}}",
        "views: {a: {resolution_px: [10, 0]}}",
        "views: {a: {resolution_px: [10]}}",
        "views: {a: {map: {ahead_m: 30}}}",
        "views: {a: {map: {up_m: 30}}}",
        "capture: {all: true}",
        "capture: {all: 1}",
        "capture: {every: 1}",
        "tone_mapper: {kind: rational}",
        "tone_mapper: {kind: urqv}",
        "tone_mapper: linear",
        "tone_mapper: histogram",
        "tone_mapper: urqv",
        "tone_mapper: [linear]",
        "tone_mapper: {s: fitted, l_max_cdm2: all}",
        "tone_mapper: {kind: rational, s: 3}",
        "tone_mapper: {kind: linear, l_max_cdm2: surfaces}",
        "tone_mapper: {kind: linear, s: 3}",
        "tone_mapper: {kind: logarithmic, s: 3, l_max_cdm2: all}",
        "tone_mapper: {kind: logarithmic, s: fitted}",
        "tone_mapper: {kind: histogram, s: 3}",
        "tone_mapper: {kind: histogram, l_max_cdm2: all}",
        "tone_mapper: {kind: histogram, curve: [[0, -1], [3, 0]]}",
        "tone_mapper: {kind: histogram, l_max_cdm2: 20, curve: [[0, -1], [3, 0]]}",
        "tone_mapper: {kind: histogram, l_max_cdm2: all, curve: [[0, -1], [3, 0]]}",
        "tone_mapper: {kind: rational, curve: [[0, -1], [3, 0]]}",
        "tone_mapper: {s: 0.9}",
        "tone_mapper: {l_max_cdm2: 0}",
        "tone_mapper: {l_max_cdm2: 1.0e-42}",
        "technique: a/b",
        "technique: photometric",
        "measure: {extent: true}",
        "measure: {extent: 3}",
        "measure: {extent: {cell_m: 0.5}}",
        "measure: {extent: {cell_m: 0}}",
        "measure: {extent: {limits_lx: []}}",
        "measure: {probes: {a: {left_m: 3}}}",
        "measure: {probes: {a: {ahead_m: 3}}}",
        "measure: {visibility: true}",
        "measure: {visibility: false}",
        "measure: {visibility: 1}",
        "measure: {visibility: {size_m: 0.2}}",
        "measure: {visibility: {targets: [card, pedestrian-dark], age_years: 23}}",
        "measure: {visibility: {targets: []}}",
        "measure: {visibility: {targets: [carton]}}",
        "measure: {visibility: {targets: {card: true, own: {reflectance: 0.1, level: 7, squares: 3}}}}",
        "measure: {visibility: {targets: {card: {reflectance: 0.1, level: 7}}}}",
        "measure: {visibility: {targets: {own: {reflectance: 0.1}}}}",
        "measure: {visibility: {targets: {own: {reflectance: 0.1, level: 7, squares: 0.5}}}}",
        "measure: {visibility: {age_years: 22}}",
        "measure: {homogeneity: true}",
        "measure: {homogeneity: {patch_factor: 1}}",
        "measure: {homogeneity: {least_lx: 2}}",
        "measure: {places: [kerb]}",
        "measure: {places: []}",
        "measure: {places: [kerbs]}",
        "measure: {places: {what: [boards, markings], distances_m: [30]}}",
        "measure: {places: {distances_m: [30]}}",
        "measure: {places: {what: [boards], distances_m: []}}",
        "measure: {sensors: {}}",
        "measure: {sensors: {points: {}}}",
        "measure: {sensors: {points: {a: {at_m: 3}}}}",
        "measure: {sensors: {points: {a: {at_m: 3, across: kerb}}}}",
        "measure: {sensors: {points: {a: {at_m: 3, across: left-edge, above_m: 51}}}}",
        "measure: {sensors: {points: {a: {}}, limits_lx: []}}",
        "measure: {sensors: {points: {a: {at_m: 1}}, limits_lx: [0]}}",
        "measure: {glare: {}}",
        "measure: {glare: {mirrors: true}}",
        "measure: {glare: {mirrors: false}}",
        "measure: {glare: {mirrors: {gaps_m: []}}}",
        "measure: {glare: {mirrors: {places: {m: [1, 2, 3]}}}}",
        "measure: {glare: {oncoming: {a: {at_m: 1}}, mirrors: false}}",
        "measure: {glare: {oncoming: {}}}",
        "measure: {glare: {oncoming: {a: {eye_height_m: 1}}}}",
        "measure: {glare: {mirrors: true, equation: cie-general, age_years: 101}}",
        "measure: {glare: {mirrors: true, limits_de_boer: [10]}}",
        "measure: {glare: {mirrors: true, pigmentation: 1.2, adaptation_cdm2: 0}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: A.B}}",
        "can: {databases: [bus.dbc, bus.dbc], outputs: {A.B: ego.speed_mps}}",
        "can: {databases: bus.dbc}",
        "can: {inputs: {ego.speed_mps: A.B}}",
        "can: {databases: bus.dbc, inputs: {}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: A}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: A.B.C}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, stale: hold, missing: fail, out_of_range: lost}}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, stale: keep}}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: {stale: hold}}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, stale_after_s: 0}}}",
        "can: {databases: bus.dbc, inputs: {ego.speed_mps: {signal: A.B, factor: 0}}}",
        "can: {databases: bus.dbc, inputs: {ego.indicator: {signal: A.B, values: {left: 1, none: 0}}}}",
        "can: {databases: bus.dbc, outputs: {A: ego.speed_mps}}",
        "can: {databases: bus.dbc, outputs: {A.B: {signal: ego.speed_mps, cycle_s: 0.1, offset: 1}}}",
        "can: {databases: bus.dbc, outputs: {A.B: {signal: ego.speed_mps, cycle_s: 0}}}",
        "can: {databases: bus.dbc, log: none, inputs: {ego.speed_mps: A.B}}",
        "can: {databases: bus.dbc, log: low.ies, start: 12.5, inputs: {ego.speed_mps: A.B}}",
        "can: {databases: bus.dbc, log: low.ies, start: -1, inputs: {ego.speed_mps: A.B}}",
        "can: {databases: bus.dbc, log: low.ies, start: '1436509052.249713', channel: can0, inputs: {ego.speed_mps: A.B}}",
        "can: {database: bus.dbc, inputs: {ego.speed_mps: A.B}}",
        "limits: []",
        "limits: [{reading: x}]",
        "limits: [{reading: x, at_least: 3}]",
        "limits: [{at_least: 3}]",
        "shadows: true",
        "shadows: 1",
        "shadows: {method: none}",
        "shadows: {method: none, map_texels: [64, 64]}",
        "shadows: {method: volumes, tolerance_m: 0.01}",
        "shadows: {method: volumes, redraw_texels: 1}",
        "shadows: {method: one-map, redraw_texels: 1}",
        "shadows: {method: map, lamp_places: 4}",
        "shadows: {method: soft-map, lamp_places: 4, lamp_radius_m: 0.1}",
        "shadows: {method: soft-map, error_bound: 0.1}",
        "shadows: {method: auto, error_bound: 0.1, lamp_places: 4}",
        "shadows: {method: auto, error_bound: 0}",
        "shadows: {method: auto, error_bound: 1}",
        "shadows: {error_bound: 0.1}",
        "beams: float",
        "beams: eight-bit",
        "beams: 8",
        "textures: none",
        "textures: shipped",
        "textures: true",
        "textures: [none]",
        "seed: 3",
        "seed: -1",
        "seed: 1.5",
        "route: {lane: 1}",
        "route: {lane: 1.5}",
        "route: {road: 3, s_m: 1, via: [a]}",
        "route: {s: 1}",
        "name: a b",
        "name: a-b",
        "title: any text",
        "nonsense: 1"};
    for (const std::string& ending : endings) {
        const std::string yaml = minimal + ending + "\n";
        const std::string by_reader = refusal(yaml), by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << ending << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
    for (const char* lamp : {"level: 0.5",
                             "level: 2",
                             "voltage_v: 11",
                             "source: arc",
                             "source: xenon",
                             "temperature_k: 3000",
                             "temperature_k: 30",
                             "aim: {percent_down: 1}",
                             "aim: {down: 1}",
                             "aim: {yaw_rad: 3.2}",
                             "type_c_axis: nadir",
                             "type_c_axis: up",
                             "between_samples: log_cd",
                             "texture: {scale_lx: 1}",
                             "texture: {scale: 1}",
                             "photometric_distance_m: -1",
                             "colour: {linear_srgb: [1, 1, 1], sp_ratio: 1}",
                             "colour: {linear_srgb: [1, 1], sp_ratio: 1}",
                             "lamps: {left: low.ies}",
                             "lamps: {left: {mount: right}}",
                             "lamps: {left: {pos: 3}}",
                             "lamps: []",
                             "changes: []"}) {
        const std::string yaml =
            fmt::format("fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 1\nvariants: {{a: {{file: low.ies, {}}}}}\n", lamp);
        const std::string by_reader = refusal(yaml), by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << lamp << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
}

TEST_F(Schema, EveryKeyOfTheExampleMisspeltIsRefusedByBoth) {
    std::filesystem::create_directories(folder / "library/roads");
    std::filesystem::create_directories(folder / "library/lamps");
    write_file(folder / "library/roads/country.xodr", "<OpenDRIVE/>");
    for (const char* lamp : {"halogen-low", "halogen-high", "xenon-low", "xenon-high", "street-6000lm"})
        write_file(folder / "library/lamps" / (std::string(lamp) + ".ies"), ies_text(1.0));
    std::filesystem::create_directories(folder / "library/models");
    std::filesystem::copy_file(scenarios / "library/models/shelter.gltf", folder / "library/models/shelter.gltf",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::create_directories(folder / "library/displays");
    std::filesystem::copy_file(scenarios / "library/displays/projector.yaml", folder / "library/displays/projector.yaml",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::create_directories(folder / "library/can");
    for (const char* const file : {"mock-up.dbc", "s-bend.log"})
        std::filesystem::copy_file(scenarios / "library/can" / file, folder / "library/can" / file,
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
