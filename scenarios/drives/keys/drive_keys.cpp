#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/drives/keys/seeing_keys.h"
#include "scenarios/drives/keys/shadow_keys.h"
#include "scenarios/drives/keys/vehicle_keys.h"
#include "scenarios/fields/field.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double fastest_mps = 150.0;
constexpr double kmh_in_mps = 1.0 / 3.6;
constexpr double longest_s = 1.0e6;

double speed_mps(std::string_view key, const YamlEntry& entry) {
    return key == "speed_kmh" ? entry.number(0.0, fastest_mps / kmh_in_mps) / 3.6 : entry.number(0.0, fastest_mps);
}

double speed_of_point(const YamlMap& point) {
    const auto given = point.one_of({"speed_kmh", "speed_mps"});
    if (!given)
        point.refuse_missing("speed_kmh", "speed_kmh or speed_mps");
    return speed_mps(given->first, given->second);
}

void check_limit(const YamlMap& keys, const Limit& limit) {
    if (!limit.at_least && !limit.at_most)
        keys.entry().refuse("a limit without a number", "at_least, at_most or both");
    if (limit.at_least && limit.at_most && *limit.at_least > *limit.at_most)
        keys.entry().refuse(fmt::format("at_least {} above at_most {}", *limit.at_least, *limit.at_most), "a range that holds a value");
}

const Fields<Limit>& limit_fields() {
    static const Fields<Limit> fields =
        Fields<Limit>{
            field("reading", 1, &Limit::reading, any(), "its name, as in readings.csv").required(),
            field("at_least", 2, &Limit::at_least, range(-1.0e12, 1.0e12), "in the reading's unit"),
            field("at_most", 3, &Limit::at_most, range(-1.0e12, 1.0e12), "in the reading's unit"),
        }
            .checked(check_limit)
            .in_schema(R"({"anyOf": [{"required": ["at_least"]}, {"required": ["at_most"]}]})");
    return fields;
}

void check_extent(const YamlMap& keys, const ExtentParameters& extent) {
    const double cells = extent.ahead_m / extent.cell_m * (8.0 * extent.beside_m / extent.cell_m);
    if (cells > 4.0e6)
        keys.entry().refuse(fmt::format("a grid of {:.0f} points", cells), "at most 4000000 (larger cell_m, less ahead_m or beside_m)");
}

const Fields<ExtentParameters>& extent_fields() {
    static const Fields<ExtentParameters> fields =
        Fields<ExtentParameters>{
            field("limits_lx", 1, &ExtentParameters::limits_lx, numbers(1, 16, 1.0e-6, 1.0e6), "what counts as illuminated"),
            field("target_height_m", 2, &ExtentParameters::target_height_m, range(0.0, 10.0), "of the target that faces the car"),
            field("ahead_m", 3, &ExtentParameters::ahead_m, range(1.0, 2000.0), "how far is looked"),
            field("beside_m", 4, &ExtentParameters::beside_m, range(0.5, 200.0), "how far to each side"),
            field("cell_m", 5, &ExtentParameters::cell_m, range(0.02, 10.0), "grid along the road; across it is a quarter of this"),
            field("width_at_m", 6, &ExtentParameters::width_at_m, numbers(0, 16, 0.0, 2000.0),
                  "from the front bumper, where the width is told"),
        }
            .block()
            .checked(check_extent);
    return fields;
}

const Fields<Probe>& probe_fields() {
    static const Fields<Probe> fields{
        field("ahead_m", 1, &Probe::ahead_m, range(-2000.0, 2000.0), "from the car's origin along the route").required(),
        field("left_m", 2, &Probe::left_m, range(-200.0, 200.0), "of the route"),
        field("above_m", 3, &Probe::above_m, range(0.0, 50.0), "above the surface"),
    };
    return fields;
}

const Fields<Drive>& measure_fields() {
    static const Fields<Drive> fields =
        Fields<Drive>{
            field("extent", 1, &Drive::extent, extent_fields(), "illuminated road extent").or_flag().or_absent("false"),
            named("probes", 2, &Drive::probes, 1000, probe_fields(), "lux at single points, from the car's origin along the route"),
            inlined(3, &Drive::seeing, seeing_fields()),
        }
            .block();
    return fields;
}

const Fields<Capture>& capture_fields() {
    static const Fields<Capture> fields{
        field("per_second", 1, &Capture::per_second, range(0.0, 1.0e6), "how many moments are stored"),
        field("all", 2, &Capture::all, any(), "every moment is stored"),
        field("exr", 3, &Capture::exr, any(), "with linear values"),
        field("png", 4, &Capture::png, any(), "for eyes"),
    };
    return fields;
}

} // namespace

std::string name_from(const std::filesystem::path& path) {
    std::string name = path.stem().string().substr(0, 64);
    for (char& c : name)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_'))
            c = '-';
    if (name.empty() || name[0] == '.')
        name.insert(0, "lamp");
    return name;
}

std::vector<SpeedPoint> read_speed(const YamlMap& drive) {
    const auto given = drive.one_of({"speed_kmh", "speed_mps", "speed"});
    if (!given)
        drive.refuse_missing("speed_kmh", "speed_kmh, speed_mps or speed (a list of {at_s, speed_kmh})");
    if (given->first != "speed")
        return {{0.0, speed_mps(given->first, given->second)}};
    if (given->second.is_scalar())
        given->second.refuse("a list of {at_s, speed_kmh}; one speed for all of the drive is speed_kmh or speed_mps");
    std::vector<SpeedPoint> points;
    for (const YamlEntry& entry : given->second.list(1, 10'000)) {
        const YamlMap keys = entry.map({"at_s", "speed_kmh", "speed_mps"});
        const double time_s = keys.require("at_s").number(0.0, longest_s);
        if (!points.empty() && time_s <= points.back().time_s)
            entry.refuse(fmt::format("at_s {} after {}", time_s, points.back().time_s), "times that ascend");
        points.push_back({time_s, speed_of_point(keys)});
    }
    return points;
}

double read_step_s(const YamlMap& drive) {
    const auto given = drive.one_of({"step_s", "rate_hz"});
    if (!given)
        return 1.0 / 30.0;
    return given->first == "step_s" ? given->second.number_above(0.0, 3600.0) : 1.0 / given->second.number_above(0.0, 1.0e6);
}

const Group& drive_fields() {
    static const std::string shadows = shadows_schema();
    static const Fields<Drive> fields{
        field("vehicle", 17, &Drive::vehicle, vehicle_fields(),
              "a car on springs and tyres instead of one that follows its lane as on rails; docs/vehicle.md")
            .or_word("single-track"),
        field("capture", 28, &Drive::capture, capture_fields(), "which moments are stored; every moment is measured"),
        section("measure", 36, measure_fields(), "what is measured"),
        list("limits", 37, &Drive::limits, 0, 1000, limit_fields(), "beyond these the run fails"),
        own<Drive>(
            "shadows", 38, [](const YamlEntry& entry, Drive& drive) { read_shadows(entry, drive.shadows); },
            [](const Drive& drive) { return shadows_text(drive.shadows); }, shadows,
            "how they are drawn (docs/shadows.md): on or off, the method alone, or it and what it uses"),
    };
    return fields;
}

} // namespace fernlicht
