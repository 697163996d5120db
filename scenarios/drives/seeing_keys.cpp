#include "scenarios/drives/seeing_keys.h"

#include "scenarios/drives/drive_keys.h"

namespace fernlicht {
namespace {

constexpr double longest_route_m = 1.0e6, farthest_m = 2000.0;

std::vector<double> numbers_or(const YamlMap& keys, std::string_view key, std::vector<double> otherwise, double least, double greatest) {
    const auto given = keys.find(key);
    return given ? given->numbers(0, 16, least, greatest) : std::move(otherwise);
}

Sensor read_sensor(const std::string& name, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"at_m", "across", "above_m"});
    static constexpr Across places[] = {Across::own_centre, Across::oncoming_centre, Across::right_edge, Across::left_edge};
    Sensor sensor;
    sensor.name = name;
    sensor.at_m = keys.require("at_m").number(0.0, longest_route_m);
    if (const auto across = keys.find("across"))
        sensor.across = places[across->choice({"own-centre", "oncoming-centre", "right-edge", "left-edge"})];
    sensor.above_m = keys.number_or("above_m", sensor.above_m, 0.0, 50.0);
    return sensor;
}

SensorParameters read_sensors(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"limits_lx", "distances_m", "points"});
    SensorParameters sensors;
    sensors.limits_lx = numbers_or(keys, "limits_lx", sensors.limits_lx, 1.0e-6, 1.0e6);
    sensors.distances_m = numbers_or(keys, "distances_m", sensors.distances_m, 0.0, farthest_m);
    for (const auto& [name, point] : keys.require("points").named(100))
        sensors.points.push_back(read_sensor(name, point));
    return sensors;
}

GlareObserver read_observer(const std::string& name, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"at_m", "eye_height_m"});
    GlareObserver observer;
    observer.name = name;
    observer.at_m = keys.require("at_m").number(0.0, longest_route_m);
    observer.eye_height_m = keys.number_or("eye_height_m", observer.eye_height_m, 0.1, 10.0);
    return observer;
}

MirrorParameters read_mirrors(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"gaps_m", "eye_m", "reflectance", "places"});
    MirrorParameters mirrors;
    if (const auto gaps = keys.find("gaps_m"))
        mirrors.gaps_m = gaps->numbers(1, 16, 1.0, farthest_m);
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
    glare.distances_m = numbers_or(keys, "distances_m", glare.distances_m, 0.0, farthest_m);
    glare.limits_lx = numbers_or(keys, "limits_lx", glare.limits_lx, 1.0e-6, 1.0e6);
    glare.limits_percent = numbers_or(keys, "limits_percent", glare.limits_percent, 1.0e-6, 1.0e6);
    glare.limits_de_boer = numbers_or(keys, "limits_de_boer", glare.limits_de_boer, 1.0, 9.0);
    return glare;
}

} // namespace

SeeingParameters read_seeing(const YamlMap& measure) {
    SeeingParameters seeing;
    if (const auto sensors = measure.find("sensors"))
        seeing.sensors = read_sensors(*sensors);
    if (const auto glare = measure.find("glare"))
        seeing.glare = read_glare(*glare);
    return seeing;
}

} // namespace fernlicht
