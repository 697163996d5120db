#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/fields/field.h"
#include "scenarios/fields/field_bits.h"
#include "scenarios/fields/key_list.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/schema.h"
#include "scenarios/fields/write_fields.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>

namespace fernlicht {
namespace {

constexpr double longest_route_m = 1.0e6, farthest_seen_m = 2000.0;

FieldRule across() { return words(across_words); }
FieldRule illuminances() { return numbers(0, 16, 1.0e-6, 1.0e6); }
FieldRule distances() { return numbers(0, 16, 0.0, farthest_seen_m); }

const Fields<SensorParameters>& sensors_fields() {
    static const Fields<SensorParameters> fields =
        Fields<SensorParameters>{
            field("thresholds_lx", 1, &SensorParameters::thresholds_lx, illuminances(), "from how far away the sensor has so much"),
            field("distances_m", 2, &SensorParameters::distances_m, distances(), "from the front bumper, where the illuminance is told"),
            named("points", 3, &SensorParameters::points, 100,
                  Fields<Sensor>{
                      field("at_m", 1, &Sensor::at_m, range(0.0, longest_route_m), "along the route from its start").required(),
                      field("across", 2, &Sensor::across, across(), "where across the road: centres of lanes, edges of the driving lanes"),
                      field("above_m", 3, &Sensor::above_m, range(0.0, 50.0), "above the road; 0.25 by default"),
                  },
                  "")
                .required(),
        }
            .block();
    return fields;
}

void check_mirrors(const YamlMap& keys, const MirrorParameters& mirrors) {
    for (std::size_t i = 0; i < mirrors.mirrors.size(); ++i)
        if (mirrors.mirrors[i].position_m == mirrors.eye_m)
            if (const auto places = keys.find("places"))
                places->named(16)[i].second.refuse("a mirror in the driver's eye", "a place of its own");
}

const Fields<MirrorParameters>& mirrors_fields() {
    static const Fields<MirrorParameters> fields =
        Fields<MirrorParameters>{
            field("gaps_m", 1, &MirrorParameters::gaps_m, numbers(1, 16, 1.0, farthest_seen_m),
                  "from the front bumper to the rear axle of the car ahead"),
            field("eye_m", 2, &MirrorParameters::eye_m, range(-100.0, 100.0), "its driver's, in its frame"),
            field("reflectance", 3, &MirrorParameters::reflectance, range(0.0, 1.0), "of the mirrors"),
            named("places", 4, &MirrorParameters::mirrors, 16,
                  Fields<Mirror>{field("position_m", 1, &Mirror::position_m, range(-100.0, 100.0), "in the frame of its car")}.bare(),
                  "of the mirrors in their car's frame"),
        }
            .block()
            .checked(check_mirrors);
    return fields;
}

const Fields<AdaptationLamp>& adaptation_lamp_fields() {
    static const Fields<AdaptationLamp> fields{
        field("file", 1, &AdaptationLamp::file, any(), "of one low beam; relative to the drive file")
            .read_by([](const YamlEntry& entry, AdaptationLamp& lamp) {
                lamp.file = entry.path();
                check_file(lamp.file, entry);
            })
            .required(),
        field("mirrored", 2, &AdaptationLamp::mirrored, any(), "left and right exchanged: a lamp for the other side of the road")
            .written_off_default(),
    };
    return fields;
}

void check_glare(const YamlMap& keys, const GlareParameters& glare) {
    if (const auto ranges = keys.find("ranges_m");
        ranges && (glare.ranges_m.size() == 1 || std::ranges::adjacent_find(glare.ranges_m, std::greater_equal()) != glare.ranges_m.end()))
        ranges->refuse("edges that make no ranges", "distances that ascend, two or more; none for no range");
    if (const auto lamp = keys.find("adaptation_lamp"); lamp && glare.adaptation_cdm2)
        lamp->refuse("adaptation_lamp beside adaptation_cdm2", "one of them");
    if (glare.oncoming.empty() && !glare.mirrors)
        keys.entry().refuse("glare without eyes", "oncoming: {NAME: {at_m: ...}}, mirrors: true or both");
}

const Fields<GlareParameters>& glare_fields() {
    static const Fields<GlareParameters> fields =
        Fields<GlareParameters>{
            named("oncoming", 1, &GlareParameters::oncoming, 100,
                  Fields<GlareObserver>{
                      field("at_m", 1, &GlareObserver::at_m, range(0.0, longest_route_m), "along the route from its start").required(),
                      field("eye_height_m", 2, &GlareObserver::eye_height_m, range(0.1, 10.0), "above the road"),
                      field("look_ahead_m", 3, &GlareObserver::look_ahead_m, range(0.0, farthest_seen_m),
                            "where on the lane the eye looks; 0: along its tangent"),
                  },
                  "drivers who stand on the nearest oncoming lane and look along it"),
            field("mirrors", 2, &GlareParameters::mirrors, mirrors_fields(), "of a car ahead in the own lane").or_flag(),
            field("equation", 3, &GlareParameters::equation, words({"stiles-holladay", "age-adjusted", "cie-general"}),
                  "of veiling luminance"),
            field("age_years", 4, &GlareParameters::age_years, range(16.0, 100.0), "of the observer"),
            field("pigmentation", 5, &GlareParameters::pigmentation, range(0.0, 1.2),
                  "of the eye: 0 black, 0.5 brown, 1 blue-green, 1.2 very light"),
            field(
                "adaptation_cdm2", 6, &GlareParameters::adaptation_cdm2, range(1.0e-4, 1.0e5),
                "what the eye is adapted to, for threshold increment and de Boer's rating; the mean of the dazzled driver's own lane 15 to "
                "60 m ahead in his own low beams by default"),
            field("distances_m", 7, &GlareParameters::distances_m, distances(), "from the front bumper"),
            field("thresholds_lx", 8, &GlareParameters::thresholds_lx, illuminances(), "times and metres above these, facing the lamps"),
            field("thresholds_percent", 9, &GlareParameters::thresholds_percent, numbers(0, 16, 1.0e-6, 1.0e6),
                  "above these threshold increments"),
            field("thresholds_de_boer", 10, &GlareParameters::thresholds_de_boer, numbers(0, 16, 1.0, 9.0), "below these ratings"),
            field("ranges_m", 12, &GlareParameters::ranges_m, distances(),
                  "edges of ranges before an oncoming driver, from the front bumper, each with its own maxima")
                .written_off_default(),
            field("adaptation_lamp", 11, &GlareParameters::adaptation_lamp, adaptation_lamp_fields(),
                  "in place of each low beam of the dazzled driver's car; the drive's own by default")
                .short_for("file"),
        }
            .block()
            .checked(check_glare)
            .in_schema(R"({"not": {"required": ["adaptation_cdm2", "adaptation_lamp"]}, "anyOf": [{"required": ["oncoming"]},
        {"required": ["mirrors"], "properties": {"mirrors": {"anyOf": [{"const": true}, {"type": "object"}]}}}]})");
    return fields;
}

void read_places_across(const YamlEntry& entry, VisibilityTarget& target) {
    target.places.clear();
    for (const YamlEntry& place : entry.list(1, 3))
        target.places.push_back(static_cast<Across>(place.choice(across_words)));
}

std::string places_across(const VisibilityTarget& target) {
    std::vector<std::string_view> places;
    for (const Across place : target.places)
        places.push_back(across_words[static_cast<std::size_t>(place)]);
    return fmt::format("[{}]", fmt::join(places, ", "));
}

const Fields<VisibilityTarget>& target_fields() {
    static const Fields<VisibilityTarget> fields{
        field("size_m", 1, &VisibilityTarget::size_m, range(0.01, 5.0), "edge of a square"),
        field("squares", 2, &VisibilityTarget::squares, range(1.0, 20.0), "one on the other"),
        field("reflectance", 3, &VisibilityTarget::reflectance, range(0.0, 1.0), "diffuse").required(),
        field("level", 4, &VisibilityTarget::level, range(0.01, 1.0e4), "visibility level at which it counts as detected").required(),
        own("across", 5, read_places_across, places_across, R"({"type": "array", "minItems": 1, "maxItems": 3,
            "items": {"enum": ["own-centre", "oncoming-centre", "right-edge", "left-edge"]}})",
            "where across the road: a list of own-centre, oncoming-centre, right-edge, left-edge"),
    };
    return fields;
}

VisibilityTarget read_target(const std::string& name, const YamlEntry& entry) {
    const auto usual = std::ranges::find(default_targets(), name, &VisibilityTarget::name);
    const YamlMap keys = entry.map(keys_of(target_fields()));
    if (usual != default_targets().end())
        entry.refuse("a map", "true, or a name of its own: '" + name + "' is one of the usual targets");
    VisibilityTarget target;
    target.name = name;
    read_group(target_fields(), keys, &target);
    return target;
}

/// A list of usual targets, or a map: `true` behind a usual one's name, a map behind a name of the drive's own.
void read_targets(const YamlEntry& entry, VisibilityParameters& visibility) {
    std::vector<std::string_view> names;
    for (const VisibilityTarget& usual : default_targets())
        names.push_back(usual.name);
    std::vector<VisibilityTarget>& targets = visibility.targets;
    targets.clear();
    if (entry.is_list()) {
        for (const YamlEntry& usual : entry.list(1, names.size()))
            targets.push_back(default_targets()[usual.choice(std::span<const std::string_view>(names))]);
    } else
        for (const auto& [name, target] : entry.named(16)) {
            if (!target.is_scalar()) {
                targets.push_back(read_target(name, target));
                continue;
            }
            const auto usual = std::ranges::find(default_targets(), name, &VisibilityTarget::name);
            if (usual == default_targets().end())
                target.refuse(fmt::format("a map with reflectance and level; true stands for {} alone", fmt::join(names, ", ")));
            if (target.flag())
                targets.push_back(*usual);
        }
    for (std::size_t i = 0; i < targets.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (targets[k].name == targets[i].name)
                entry.refuse("'" + targets[i].name + "' twice", "each target once");
}

std::string targets_text(const VisibilityParameters& visibility) {
    std::string text = visibility.targets.empty() ? "{card: false}" : "";
    for (const VisibilityTarget& target : visibility.targets) {
        const bool usual = std::ranges::find(default_targets(), target) != default_targets().end();
        text += fmt::format("\n      \"{}\": {}", target.name, usual ? "true" : "{" + flow_text(target_fields(), &target) + "}");
    }
    return text;
}

std::string targets_bits(const VisibilityParameters& visibility) {
    std::string bits;
    for (const VisibilityTarget& target : visibility.targets)
        bits += fmt::format("{}\n{}", target.name, field_bits(target_fields(), &target));
    return bits;
}

/// With the keys of a target, which no list below `targets` can have: a usual one's name has none.
std::string targets_meaning() {
    std::vector<std::string> keys;
    const std::vector<KeyList> lists = key_lists("", target_fields(), target_fields().usual.get());
    for (const KeyLine& line : lists.front().lines) {
        std::vector<std::string> said{line.allowed.empty() ? line.meaning : line.allowed};
        if (line.is_required || !line.usual.empty())
            said.push_back(line.is_required ? "required" : line.usual);
        keys.push_back(fmt::format("`{}` ({})", line.names.front(), fmt::join(said, ", ")));
    }
    return fmt::format("a list of usual ones, or a map: behind a usual one's name true, behind one of your own {}", fmt::join(keys, ", "));
}

const Fields<VisibilityParameters>& visibility_fields() {
    static const std::string meaning = targets_meaning();
    static const std::string targets_schema = fmt::format(
        R"({{"anyOf": [{{"type": "array", "minItems": 1, "maxItems": 3, "items": {{"enum": ["card", "pedestrian-dark", "pedestrian-light"]}}}},
            {{"type": "object", "minProperties": 1, "maxProperties": 16, "properties": {{"card": {{"type": "boolean"}},
              "pedestrian-dark": {{"type": "boolean"}}, "pedestrian-light": {{"type": "boolean"}}}},
              "additionalProperties": {}}}]}})",
        schema_of(target_fields()));
    static const Fields<VisibilityParameters> fields =
        Fields<VisibilityParameters>{
            own("targets", 1, read_targets, targets_text, targets_schema, meaning).bits_by(targets_bits),
            field("dark_cdm2", 2, &VisibilityParameters::dark_cdm2, range(0.0, 1.0e3),
                  "luminance of what is not road behind a target, without daylight"),
            field("age_years", 3, &VisibilityParameters::age_years, range(23.0, 75.0), "of who looks"),
            field("time_s", 4, &VisibilityParameters::time_s, range(0.01, 1.0e3), "for which a target shows"),
            field("k", 5, &VisibilityParameters::k, range(0.1, 100.0), "of Adrian's visibility model"),
            field("ahead_m", 6, &VisibilityParameters::ahead_m, range(10.0, farthest_seen_m), "how far is looked, from the front bumper"),
            field("step_m", 7, &VisibilityParameters::step_m, range(0.1, 5.0), "from one place to the next"),
            field("distances_m", 8, &VisibilityParameters::distances_m, numbers(0, 16, 1.0, farthest_seen_m),
                  "from the front bumper, at which level and background are told"),
        }
            .block();
    return fields;
}

constexpr std::string_view place_words[] = {"kerb", "boards", "markings"};

void read_what(const YamlEntry& entry, PlaceParameters& places) {
    for (const YamlEntry& place : entry.list(1, 3)) {
        bool* const all[] = {&places.kerb, &places.boards, &places.markings};
        *all[place.choice(place_words)] = true;
    }
}

std::string what_text(const PlaceParameters& places) {
    std::vector<std::string_view> what;
    for (const auto& [asked, i] : {std::pair(places.kerb, 0), std::pair(places.boards, 1), std::pair(places.markings, 2)})
        if (asked)
            what.push_back(place_words[i]);
    return fmt::format("[{}]", fmt::join(what, ", "));
}

} // namespace

const std::vector<VisibilityTarget>& default_targets() {
    static const std::vector<Across> edges{Across::right_edge, Across::left_edge};
    static const std::vector<VisibilityTarget> targets{{"card", 0.2, 1, 0.2, 7.0, {Across::own_centre}},
                                                       {"pedestrian-dark", 0.25, 7, 0.05, 10.0, edges},
                                                       {"pedestrian-light", 0.25, 7, 0.4, 10.0, edges}};
    return targets;
}

void read_adaptation_lamp(Drive& drive) {
    drive.adaptation_lamp.reset();
    if (!drive.seeing.glare || !drive.seeing.glare->adaptation_lamp)
        return;
    const AdaptationLamp& asked = *drive.seeing.glare->adaptation_lamp;
    LampReadOptions options;
    options.mirrored = asked.mirrored;
    const auto known = std::ranges::find_if(
        drive.lamp_sources, [&](const LampSource& source) { return source.path == asked.file && source.options == options; });
    if (known != drive.lamp_sources.end()) {
        drive.adaptation_lamp = known->file;
        return;
    }
    drive.adaptation_lamp = std::make_shared<const LampFile>(read_lamp(asked.file, options));
    drive.lamp_sources.push_back({asked.file, options, drive.adaptation_lamp});
    drive.opened.insert(drive.opened.end(), drive.adaptation_lamp->opened.begin(), drive.adaptation_lamp->opened.end());
}

const Fields<SeeingParameters>& seeing_fields() {
    static const Fields<SeeingParameters> fields =
        Fields<SeeingParameters>{
            field("sensors", 1, &SeeingParameters::sensors, sensors_fields(), "illuminance at fixed places that the car drives up to"),
            field("glare", 2, &SeeingParameters::glare, glare_fields(), "what the lamps do to other road users' eyes"),
            field("visibility", 3, &SeeingParameters::visibility, visibility_fields(), "how far ahead targets on the road are detected")
                .or_flag(),
            field("homogeneity", 4, &SeeingParameters::homogeneity,
                  Fields<HomogeneityParameters>{
                      field("min_lx", 1, &HomogeneityParameters::min_lx, range(1.0e-6, 1.0e6), "darker ground does not count"),
                      field("ahead_m", 2, &HomogeneityParameters::ahead_m, range(10.0, 500.0), "how far is looked, from the front bumper"),
                      field("patch_factor", 3, &HomogeneityParameters::patch_factor, range(1.01, 1000.0), "what counts as a patch"),
                      field("distances_m", 4, &HomogeneityParameters::distances_m, numbers(0, 16, 1.0, farthest_seen_m),
                            "from the front bumper, where evenness across the lane is told")
                          .written_off_default(),
                  },
                  "how evenly the own lane is lit")
                .or_flag(),
            field("places", 5, &SeeingParameters::places,
                  Fields<PlaceParameters>{
                      own("what", 1, read_what, what_text,
                          R"({"type": "array", "items": {"enum": ["kerb", "boards", "markings"]}, "minItems": 1, "maxItems": 3})",
                          "kerb, boards, markings: some of them")
                          .required(),
                      field("distances_m", 2, &PlaceParameters::distances_m, numbers(1, 16, 1.0, farthest_seen_m), "from the front bumper"),
                  },
                  "light on kerb, boards and markings")
                .short_list_for("what"),
            field("tolerances", 6, &SeeingParameters::tolerances, tolerances_fields(),
                  "what cars of one series read, whose lamps and load differ by these (docs/tolerances.md)")
                .or_flag(),
        }
            .block();
    return fields;
}

} // namespace fernlicht
