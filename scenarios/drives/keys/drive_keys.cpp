#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/can/bus_mapping.h"
#include "scenarios/drives/keys/bus_keys.h"
#include "scenarios/drives/keys/control_fields.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/drives/keys/shadow_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/field_bits.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/write_fields.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double longest_s = 1.0e6;

bool has_no_storyboard(const void* drive) { return !static_cast<const Drive*>(drive)->storyboard; }
bool says_daylight(const void* drive) { return has_no_storyboard(drive) || static_cast<const Drive*>(drive)->storyboard->own_daylight; }
bool says_weather(const void* drive) { return has_no_storyboard(drive) || static_cast<const Drive*>(drive)->storyboard->own_weather; }
bool has_traffic(const void* drive) { return !static_cast<const Drive*>(drive)->traffic_rows.empty(); }

/// Dry weather goes without saying, unless it is there against a storyboard's.
std::string weather_text(const Drive& drive) {
    if (drive.weather == Weather{})
        return drive.storyboard ? "{wetness: 0}" : "";
    return "{" + flow_text(weather_fields(), &drive.weather) + "}";
}

std::string storyboard_bits(const Drive& drive) {
    if (!drive.storyboard)
        return "";
    return fmt::format("there {} {}\n", drive.storyboard->own_daylight, drive.storyboard->own_weather) +
           field_bits(storyboard_fields(), &*drive.storyboard);
}

void check_speed_point(const YamlMap& keys, const SpeedPoint&) {
    if (!keys.find("speed_kmh") && !keys.find("speed_mps"))
        keys.refuse_missing("speed_kmh", "speed_kmh or speed_mps");
}

const Fields<BeamTexels>& beam_fields() {
    const FieldRule sides = range(min_beam_texels, max_beam_texels);
    static const Fields<BeamTexels> fields{
        field("width", 1, &BeamTexels::width, sides, "texels").required(),
        field("height", 2, &BeamTexels::height, sides, "texels").required(),
        field("bits", 3, &BeamTexels::bits, range(0.0, 1000.0), "of a texel: 8, 16 or 32").required(),
    };
    return fields;
}

/// float, eight-bit, or size and depth.
void read_beams(const YamlEntry& given, Drive& drive) {
    if (given.is_scalar()) {
        drive.beams = given.choice({"float", "eight-bit"}) == 1 ? std::optional(eight_bit_texels) : std::nullopt;
        return;
    }
    drive.beams = read_fields(beam_fields(), given);
    if (const int bits = drive.beams->bits; bits != 8 && bits != 16 && bits != 32)
        given.map(keys_of(beam_fields())).require("bits").refuse("8, 16 or 32");
}

std::string beams_text(const Drive& drive) {
    if (!drive.beams || *drive.beams == eight_bit_texels)
        return drive.beams ? "eight-bit" : "float";
    return "{" + flow_text(beam_fields(), &*drive.beams) + "}";
}

void check_extent(const YamlMap& keys, const ExtentParameters& extent) {
    const double cells = extent.ahead_m / extent.cell_m * (8.0 * extent.beside_m / extent.cell_m);
    if (cells > 4.0e6)
        keys.entry().refuse(fmt::format("a grid of {:.0f} points", cells), "at most 4000000 (larger cell_m, less ahead_m or beside_m)");
}

} // namespace

const Fields<SpeedPoint>& speed_point_fields() {
    static const Fields<SpeedPoint> fields =
        Fields<SpeedPoint>{
            field("at_s", 1, &SpeedPoint::time_s, range(0.0, longest_s), "times ascend").required(),
            field("speed", 2, &SpeedPoint::speed_mps, speed("speed"), "linear between points, constant before and after"),
        }
            .checked(check_speed_point)
            .in_schema(R"({"oneOf": [{"required": ["speed_kmh"]}, {"required": ["speed_mps"]}]})");
    return fields;
}

const Fields<Route::Start>& start_fields() {
    using Start = Route::Start;
    static const Fields<Start> fields{
        field("road", 1, &Start::road, any(), "its id; the first with driving lanes by default").written_off_default(),
        field("lane", 2, &Start::lane, range(-1000.0, 1000.0), "0: outermost driving lane in the direction of traffic"),
        field("s_m", 3, &Start::s_m, range(0.0, 1.0e6), "along the road"),
    };
    return fields;
}

std::string name_from(const std::filesystem::path& path) {
    std::string name = path == "-" ? "stdin" : path.stem().string().substr(0, 64);
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
    std::vector<SpeedPoint> points;
    if (given->first != "speed") {
        read_field(speed_point_fields(), "speed", drive, &points.emplace_back());
        return points;
    }
    if (given->second.is_scalar())
        given->second.refuse("a list of {at_s, speed_kmh}; one speed for all of the drive is speed_kmh or speed_mps");
    for (const YamlEntry& entry : given->second.list(1, max_speed_points)) {
        const SpeedPoint point = read_fields(speed_point_fields(), entry);
        if (!points.empty() && point.time_s <= points.back().time_s)
            entry.refuse(fmt::format("at_s {} after {}", point.time_s, points.back().time_s), "times that ascend");
        points.push_back(point);
    }
    return points;
}

double read_step_s(const YamlMap& drive) {
    const auto given = drive.one_of({"step_s", "rate_hz"});
    if (!given)
        return 1.0 / 30.0;
    return given->first == "step_s" ? given->second.number_above(0.0, 3600.0) : 1.0 / given->second.number_above(0.0, 1.0e6);
}

const Fields<Drive>& drive_fields() {
    static const Fields<Drive> fields =
        Fields<Drive>{
            form<Drive>("fernlicht", FieldKind::own, {}, "version of this schema").schema_by(R"({"const": 1})"),
            field("name", 1, &Drive::name, a_name(), "of the drive, in reports and names of files; the file's by default"),
            field("title", 2, &Drive::title, any(), "for people; the name by default"),
            field("road", 3, &Drive::road_file, any(), "OpenDRIVE file; relative to the drive file"),
            field("mirrored_road", 4, &Drive::mirrored_road, any(), "the road in a mirror: left-hand traffic from a right-hand road")
                .written_off_default(),
            field("storyboard", 5, &Drive::storyboard, storyboard_fields(), "an OpenSCENARIO file in place of route and speed")
                .short_for("file")
                .bits_by(storyboard_bits),
            section("route", 6, Fields<Drive>{
            inlined(1, &Drive::start, start_fields()),
            field("via", 2, &Drive::via, texts(0, 10'000), "road ids in order"),
        }
            .block(), "where the drive begins, and by which roads it goes").heard_if(has_no_storyboard),
            list("speed", 7, &Drive::speed, 1, max_speed_points, speed_point_fields(), "or speed_kmh or speed_mps for all of the drive")
                .heard_if(has_no_storyboard),
            form<Drive>("speed_kmh", FieldKind::number, range(0.0, 540.0), "for all of the drive"),
            form<Drive>("speed_mps", FieldKind::number, range(0.0, 150.0), "for all of the drive"),
            field("step_s", 8, &Drive::step_s, above(0.0, 3600.0), "from one moment to the next, or rate_hz; 1/30 by default"),
            form<Drive>("rate_hz", FieldKind::number, above(0.0, 1.0e6), "moments a second"),
            field("duration_s", 9, &Drive::duration_s, above(0.0, longest_s), "of the drive; must be given without a storyboard"),
            field("daylight", 10, &Drive::daylight, daylight_fields(), "night, twilight, day; figures; or date, time and place")
                .read_by(read_daylight)
                .schema_by(daylight_schema())
                .heard_if(says_daylight),
            field("weather", 11, &Drive::weather, weather_fields(), "clear and dry by default; fog, rain and snow by name, too")
                .text_by(weather_text)
                .heard_if(says_weather),
            named("street_lamps", 12, &Drive::street_lamps, max_street_lamp_rows, street_lamp_fields(),
                  "rows of lamps on poles beside the route"),
            section("car", 13, car_fields(), "the own car: its size, body, lamps and their places"),
            field("vehicle", 17, &Drive::vehicle, vehicle_fields(),
                  "a car on springs and tyres instead of one that follows its lane as on rails; docs/vehicle.md")
                .or_word("single-track"),
            form<Drive>("actuators", FieldKind::group, {}, "of all lamp sets without their own").of(actuators_fields()),
            form<Drive>("control", FieldKind::group, {}, "of all lamp sets without their own").of(law_fields()).schema_by(control_schema),
            named("lamp_sets", 18, &Drive::lamp_sets, max_lamp_sets, lamp_set_fields(), "lamp sets; the drive is played with each"),
            form<Drive>("changes", FieldKind::list, names(0, max_lamp_changes), "of the lamps of all lamp sets").of(change_fields()),
            field("can", 19, &Drive::can, can_fields(), "signals from and to a bus; docs/can.md"),
            section("traffic_light", 20, Fields<Drive>{
        field("min_lx", 1, &Drive::min_traffic_lx, range(1.0e-6, 1.0e3), "from one lamp; less is left out, on a wet road its reflection too"),
    }, "of other road users").heard_if(has_traffic),
            named("traffic", 21, &Drive::traffic_rows, max_traffic_rows, traffic_fields(), "other road users; docs/traffic.md"),
            form<Drive>("view_set", FieldKind::path, any(), "a file of views that come before these"),
            named("views", 22, &Drive::views, max_views, view_fields(), "what is rendered; the driver's view and a map by default"),
            list("scenery", 23, &Drive::scenery, 0, max_models, scenery_fields(), "models with their places")
                .read_by(read_scenery)
                .written_off_default(),
            field("capture", 28, &Drive::capture, Fields<Capture>{
        field("per_second", 1, &Capture::per_second, range(0.0, 1.0e6), "how many moments are stored"),
        field("all", 2, &Capture::all, any(), "every moment is stored"),
        field("exr", 3, &Capture::exr, any(), "with linear values"),
        field("png", 4, &Capture::png, any(), "for eyes"),
    }, "which moments are stored; every moment is measured"),
            field("tone_mapper", 29, &Drive::tone_mapper, tone_mapper_fields(), "from luminances to what a display can show")
                .read_by([](const YamlEntry& entry, Drive& drive) { read_tone_mapper(entry, drive.tone_mapper); })
                .schema_by(tone_mapper_schema()),
            field("display", 30, &Drive::display, display_fields(), "windscreen, eye and display between the light and its pictures")
                .read_by(read_display)
                .short_for("profile")
                .written_off_default(),
            field("technique", 31, &Drive::technique, a_name(), "how it is rendered"),
            section("measure", 36, Fields<Drive>{
            field("extent", 1, &Drive::extent, Fields<ExtentParameters>{
            field("thresholds_lx", 1, &ExtentParameters::thresholds_lx, numbers(1, 16, 1.0e-6, 1.0e6), "what counts as illuminated"),
            field("target_height_m", 2, &ExtentParameters::target_height_m, range(0.0, 10.0), "of the target that faces the car"),
            field("ahead_m", 3, &ExtentParameters::ahead_m, range(1.0, 2000.0), "how far is looked"),
            field("beside_m", 4, &ExtentParameters::beside_m, range(0.5, 200.0), "how far to each side"),
            field("cell_m", 5, &ExtentParameters::cell_m, range(0.02, 10.0), "grid along the road; across it is a quarter of this"),
            field("width_at_m", 6, &ExtentParameters::width_at_m, numbers(0, 16, 0.0, 2000.0),
                  "from the front bumper, where the width is told"),
        }
            .block()
            .checked(check_extent), "illuminated road extent").or_flag().or_absent("false"),
            named("probes", 2, &Drive::probes, 1000, Fields<Probe>{
        field("ahead_m", 1, &Probe::ahead_m, range(-2000.0, 2000.0), "from the car's origin along the route").required(),
        field("left_m", 2, &Probe::left_m, range(-200.0, 200.0), "of the route"),
        field("above_m", 3, &Probe::above_m, range(0.0, 50.0), "above the surface"),
    }, "lux at single points, from the car's origin along the route"),
            inlined(3, &Drive::seeing, seeing_fields()),
        }
            .block(), "what is measured"),
            list("limits", 37, &Drive::limits, 0, 1000, limit_fields(), "beyond these the run fails"),
            field("shadows", 38, &Drive::shadows, shadow_fields(),
                  "how they are rendered (docs/shadows.md): on or off, the method alone, or it and what it uses")
                .read_by([](const YamlEntry& entry, Drive& drive) { read_shadows(entry, drive.shadows); })
                .text_by([](const Drive& drive) { return shadows_text(drive.shadows); })
                .schema_by(shadows_schema())
                .bits_by([](const Drive& drive) {
                    return (drive.shadows.objects_cast ? "" : "nothing casts\n") + field_bits(shadow_fields(), &drive.shadows);
                }),
            own<Drive>("beams", 39, read_beams, beams_text, R"({"oneOf": [{"enum": ["float", "eight-bit"]}, {"type": "object",
                "additionalProperties": false, "required": ["width", "height", "bits"], "properties": {
                "width": {"type": "integer", "minimum": 2, "maximum": 8192}, "height": {"type": "integer", "minimum": 2, "maximum": 8192},
                "bits": {"enum": [8, 16, 32]}}}]})",
                       "how fine beam textures are: float, eight-bit, or size and depth")
                .bits_by([](const Drive& drive) { return drive.beams ? "there\n" + field_bits(beam_fields(), &*drive.beams) : ""; }),
            own<Drive>(
                "textures", 40,
                [](const YamlEntry& entry, Drive& drive) {
                    drive.textured = entry.choice({"none", "shipped"}) == 1;
                },
                [](const Drive& drive) { return std::string(drive.textured ? "shipped" : "none"); }, R"({"enum": ["none", "shipped"]})",
                "pictures on surfaces"),
            own<Drive>(
                "dressing", 42,
                [](const YamlEntry& entry, Drive& drive) {
                    drive.dressing = static_cast<Dressing>(entry.choice({"none", "plain", "dressed"}));
                },
                [](const Drive& drive) {
                    static constexpr const char* words[]{"none", "plain", "dressed"};
                    return std::string(drive.dressing == Dressing::plain ? "" : words[static_cast<std::size_t>(drive.dressing)]);
                },
                R"({"enum": ["none", "plain", "dressed"]})", "how the road's objects look: left out, plain shapes, or houses, trees and cars (default: plain)"),
            field("road_surface", 43, &Drive::road_surface, road_surface_fields(),
                  "what roads are paved and marked with (docs/roads.md)").written_off_default(),
            own<Drive>(
                "seed", 41, [](const YamlEntry& entry, Drive& drive) { drive.seed = entry.count(); },
                [](const Drive& drive) { return fmt::format("{}", drive.seed); }, R"({"type": "integer", "minimum": 0})",
                "of all that is random"),
        }
            .in_schema(R"({"required": ["fernlicht"], "allOf": [{"not": {"required": ["step_s", "rate_hz"]}}, {"oneOf": [
                {"required": ["road", "duration_s", "speed_kmh"]}, {"required": ["road", "duration_s", "speed_mps"]},
                {"required": ["road", "duration_s", "speed"]}, {"required": ["storyboard"], "not": {"anyOf": [
                    {"required": ["route"]}, {"required": ["speed"]}, {"required": ["speed_kmh"]}, {"required": ["speed_mps"]},
                    {"required": ["vehicle"]}]}}]}]})");
    return fields;
}

} // namespace fernlicht
