#include "scenarios/drives/keys/seeing_keys.h"

#include "scenarios/drives/keys/drive_keys.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr double longest_route_m = 1.0e6, farthest_seen_m = 2000.0;

std::vector<double> numbers_or(const YamlMap& keys, std::string_view key, std::vector<double> otherwise, double least, double greatest) {
    const auto given = keys.find(key);
    return given ? given->numbers(0, 16, least, greatest) : std::move(otherwise);
}

Across read_across(const YamlEntry& entry) {
    static constexpr Across places[] = {Across::own_centre, Across::oncoming_centre, Across::right_edge, Across::left_edge};
    return places[entry.choice({"own-centre", "oncoming-centre", "right-edge", "left-edge"})];
}

Sensor read_sensor(const std::string& name, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"at_m", "across", "above_m"});
    Sensor sensor;
    sensor.name = name;
    sensor.at_m = keys.require("at_m").number(0.0, longest_route_m);
    if (const auto across = keys.find("across"))
        sensor.across = read_across(*across);
    sensor.above_m = keys.number_or("above_m", sensor.above_m, 0.0, 50.0);
    return sensor;
}

SensorParameters read_sensors(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"limits_lx", "distances_m", "points"});
    SensorParameters sensors;
    sensors.limits_lx = numbers_or(keys, "limits_lx", sensors.limits_lx, 1.0e-6, 1.0e6);
    sensors.distances_m = numbers_or(keys, "distances_m", sensors.distances_m, 0.0, farthest_seen_m);
    for (const auto& [name, point] : keys.require("points").named(100))
        sensors.points.push_back(read_sensor(name, point));
    return sensors;
}

GlareObserver read_observer(const std::string& name, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"at_m", "eye_height_m", "look_ahead_m"});
    GlareObserver observer;
    observer.name = name;
    observer.at_m = keys.require("at_m").number(0.0, longest_route_m);
    observer.eye_height_m = keys.number_or("eye_height_m", observer.eye_height_m, 0.1, 10.0);
    observer.look_ahead_m = keys.number_or("look_ahead_m", observer.look_ahead_m, 0.0, farthest_seen_m);
    return observer;
}

MirrorParameters read_mirrors(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"gaps_m", "eye_m", "reflectance", "places"});
    MirrorParameters mirrors;
    if (const auto gaps = keys.find("gaps_m"))
        mirrors.gaps_m = gaps->numbers(1, 16, 1.0, farthest_seen_m);
    if (const auto eye = keys.find("eye_m"))
        mirrors.eye_m = read_position(*eye);
    mirrors.reflectance = keys.number_or("reflectance", mirrors.reflectance, 0.0, 1.0);
    if (const auto places = keys.find("places")) {
        mirrors.mirrors.clear();
        for (const auto& [name, position] : places->named(16)) {
            mirrors.mirrors.push_back({name, read_position(position)});
            if (mirrors.mirrors.back().position_m == mirrors.eye_m)
                position.refuse("a mirror in the driver's eye", "a place of its own");
        }
    }
    return mirrors;
}

GlareParameters read_glare(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"oncoming", "mirrors", "equation", "age_years", "pigmentation", "adaptation_cdm2", "distances_m",
                                    "limits_lx", "limits_percent", "limits_de_boer"});
    static constexpr VeilingEquation equations[] = {VeilingEquation::stiles_holladay, VeilingEquation::age_adjusted,
                                                    VeilingEquation::cie_general};
    GlareParameters glare;
    if (const auto oncoming = keys.find("oncoming"))
        for (const auto& [name, observer] : oncoming->named(100))
            glare.oncoming.push_back(read_observer(name, observer));
    if (const auto mirrors = keys.find("mirrors")) {
        if (!mirrors->is_scalar())
            glare.mirrors = read_mirrors(*mirrors);
        else if (mirrors->flag())
            glare.mirrors.emplace();
    }
    if (glare.oncoming.empty() && !glare.mirrors)
        entry.refuse("glare without eyes", "oncoming: {NAME: {at_m: ...}}, mirrors: true or both");
    if (const auto equation = keys.find("equation"))
        glare.equation = equations[equation->choice({"stiles-holladay", "age-adjusted", "cie-general"})];
    glare.age_years = keys.number_or("age_years", glare.age_years, 16.0, 100.0);
    glare.pigmentation = keys.number_or("pigmentation", glare.pigmentation, 0.0, 1.2);
    glare.adaptation_cdm2 = keys.number_or("adaptation_cdm2", glare.adaptation_cdm2, 1.0e-4, 1.0e5);
    glare.distances_m = numbers_or(keys, "distances_m", glare.distances_m, 0.0, farthest_seen_m);
    glare.limits_lx = numbers_or(keys, "limits_lx", glare.limits_lx, 1.0e-6, 1.0e6);
    glare.limits_percent = numbers_or(keys, "limits_percent", glare.limits_percent, 1.0e-6, 1.0e6);
    glare.limits_de_boer = numbers_or(keys, "limits_de_boer", glare.limits_de_boer, 1.0, 9.0);
    return glare;
}

VisibilityTarget read_target(const std::string& name, const YamlEntry& entry) {
    const auto usual = std::ranges::find(usual_targets(), name, &VisibilityTarget::name);
    const YamlMap keys = entry.map({"size_m", "squares", "reflectance", "level", "across"});
    if (usual != usual_targets().end())
        entry.refuse("a map", "true, or a name of its own: '" + name + "' is one of the usual targets");
    VisibilityTarget target;
    target.name = name;
    target.size_m = keys.number_or("size_m", target.size_m, 0.01, 5.0);
    if (const auto squares = keys.find("squares"))
        target.squares = squares->whole(1, 20);
    target.reflectance = keys.require("reflectance").number(0.0, 1.0);
    target.level = keys.require("level").number(0.01, 1.0e4);
    if (const auto across = keys.find("across")) {
        target.places.clear();
        for (const YamlEntry& place : across->list(1, 3))
            target.places.push_back(read_across(place));
    }
    return target;
}

/// A list of usual targets, or a map: `true` behind a usual one's name, a map behind a name of the drive's own.
std::vector<VisibilityTarget> read_targets(const YamlEntry& entry) {
    std::vector<std::string_view> names;
    for (const VisibilityTarget& usual : usual_targets())
        names.push_back(usual.name);
    std::vector<VisibilityTarget> targets;
    if (entry.is_list()) {
        for (const YamlEntry& usual : entry.list(1, names.size()))
            targets.push_back(usual_targets()[usual.choice(std::span<const std::string_view>(names))]);
    } else
        for (const auto& [name, target] : entry.named(16)) {
            if (!target.is_scalar()) {
                targets.push_back(read_target(name, target));
                continue;
            }
            const auto usual = std::ranges::find(usual_targets(), name, &VisibilityTarget::name);
            if (usual == usual_targets().end())
                target.refuse(fmt::format("a map with reflectance and level; true stands for {} alone", fmt::join(names, ", ")));
            if (target.flag())
                targets.push_back(*usual);
        }
    for (std::size_t i = 0; i < targets.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (targets[k].name == targets[i].name)
                entry.refuse("'" + targets[i].name + "' twice", "each target once");
    return targets;
}

VisibilityParameters read_visibility(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"targets", "dark_cdm2", "age_years", "time_s", "k", "ahead_m", "step_m", "distances_m"});
    VisibilityParameters visibility;
    if (const auto targets = keys.find("targets"))
        visibility.targets = read_targets(*targets);
    visibility.dark_cdm2 = keys.number_or("dark_cdm2", visibility.dark_cdm2, 0.0, 1.0e3);
    visibility.age_years = keys.number_or("age_years", visibility.age_years, 23.0, 75.0);
    visibility.time_s = keys.number_or("time_s", visibility.time_s, 0.01, 1.0e3);
    visibility.k = keys.number_or("k", visibility.k, 0.1, 100.0);
    visibility.ahead_m = keys.number_or("ahead_m", visibility.ahead_m, 10.0, farthest_seen_m);
    visibility.step_m = keys.number_or("step_m", visibility.step_m, 0.1, 5.0);
    visibility.distances_m = numbers_or(keys, "distances_m", visibility.distances_m, 1.0, farthest_seen_m);
    return visibility;
}

HomogeneityParameters read_homogeneity(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"least_lx", "ahead_m", "patch_factor"});
    HomogeneityParameters homogeneity;
    homogeneity.least_lx = keys.number_or("least_lx", homogeneity.least_lx, 1.0e-6, 1.0e6);
    homogeneity.ahead_m = keys.number_or("ahead_m", homogeneity.ahead_m, 10.0, 500.0);
    homogeneity.patch_factor = keys.number_or("patch_factor", homogeneity.patch_factor, 1.01, 1000.0);
    return homogeneity;
}

/// `true` or a map with keys; `false` as if it were not there.
template <class Parameters> std::optional<Parameters> read_or_default(const YamlEntry& entry, Parameters (*read)(const YamlEntry&)) {
    if (!entry.is_scalar())
        return read(entry);
    return entry.flag() ? std::optional(Parameters{}) : std::nullopt;
}

PlaceParameters read_places(const YamlEntry& entry) {
    PlaceParameters places;
    std::optional<YamlEntry> what = entry;
    if (!entry.is_list()) {
        const YamlMap keys = entry.map({"what", "distances_m"});
        what = keys.require("what");
        if (const auto distances = keys.find("distances_m"))
            places.distances_m = distances->numbers(1, 16, 1.0, farthest_seen_m);
    }
    for (const YamlEntry& place : what->list(1, 3)) {
        bool* const all[] = {&places.kerb, &places.boards, &places.markings};
        *all[place.choice({"kerb", "boards", "markings"})] = true;
    }
    return places;
}

} // namespace

const std::vector<VisibilityTarget>& usual_targets() {
    static const std::vector<Across> edges{Across::right_edge, Across::left_edge};
    static const std::vector<VisibilityTarget> targets{{"card", 0.2, 1, 0.2, 7.0, {Across::own_centre}},
                                                       {"pedestrian-dark", 0.25, 7, 0.05, 10.0, edges},
                                                       {"pedestrian-light", 0.25, 7, 0.4, 10.0, edges}};
    return targets;
}

SeeingParameters read_seeing(const YamlMap& measure) {
    SeeingParameters seeing;
    if (const auto sensors = measure.find("sensors"))
        seeing.sensors = read_sensors(*sensors);
    if (const auto glare = measure.find("glare"))
        seeing.glare = read_glare(*glare);
    if (const auto visibility = measure.find("visibility"))
        seeing.visibility = read_or_default(*visibility, read_visibility);
    if (const auto homogeneity = measure.find("homogeneity"))
        seeing.homogeneity = read_or_default(*homogeneity, read_homogeneity);
    if (const auto places = measure.find("places"))
        seeing.places = read_places(*places);
    return seeing;
}

} // namespace fernlicht
