#include "metrics/folds/control_fold.h"

#include "metrics/folds/place_fold.h"
#include "metrics/glare/wet_road.h"
#include "metrics/road/lit_line.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/motion.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tuple>

namespace fernlicht {
namespace {

constexpr double bend_per_m = 1.0 / 1500.0; ///< gentler is no bend
constexpr double look_m = 50.0;             ///< ahead of the bumper: light inside the bend, eyes of an oncoming driver
constexpr double target_m = 0.25, eye_height_m = 1.1;
constexpr double reach_lx = 5.0, farthest_m = 200.0, line_step_m = 1.0;

/// Of the route about a place, over 10 m; left bends positive.
double curvature_per_m(const Route& route, double at_m) {
    const double from_m = std::max(at_m - 5.0, 0.0), to_m = std::min(at_m + 5.0, route.length_m());
    if (!(to_m > from_m))
        return 0.0;
    const glm::dvec3 a = route.pose(from_m).forward(), b = route.pose(to_m).forward();
    return std::remainder(std::atan2(b.y, b.x) - std::atan2(a.y, a.x), 2.0 * pi) / (to_m - from_m);
}

/// The most that any driver who comes towards the car gets, 1.1 m above the rear axle of the other car and 1.5 m before it. nullopt: nobody
/// comes, or light by way of a wet road is not known. A crest of the road hides lamps.
std::optional<double> others_lx(const Moment& moment, const Route& route, Pavement pavement) {
    std::optional<double> most;
    for (const Body& body : moment.bodies) {
        const glm::dvec3 eye = to_parent(body.pose, {1.5, 0.0, eye_height_m}), in_car = to_local(moment.ego, eye);
        if (!body.visible || body.own || in_car.x < 5.0 || glm::dot(body.pose.forward(), moment.ego.forward()) > 0.0)
            continue;
        const RoadPlane plane = road_plane(moment.ego, body.pose);
        if (!why_no_mirror(moment.weather, plane).empty())
            return std::nullopt;
        const double by_road = facing_lx(lamps_in_road(moment.lamps, moment.weather, plane, eye, pavement));
        const std::optional<double> at_m = along_route_m(route, eye, moment.distance_m + in_car.x);
        const double straight = facing_lx(at_m ? lamps_over_road(moment, route, *at_m, eye) : seen_lamps(moment, eye));
        most = std::max(most.value_or(0.0), straight + by_road);
    }
    return most;
}

/// By way of a wet road, too; nullopt where that is not known.
std::optional<double> lit_lx(const Moment& moment, const Route& route, Pavement pavement, double along_m, double left_m, double above_m) {
    const Pose surface = route.pose(along_m, left_m);
    const glm::dvec3 point = surface.position_m + above_m * surface.up();
    const RoadLight by_film = light_by_road(moment, route, along_m, point, pavement);
    return by_film.unknown.empty() ? std::optional(facing_lx(seen_lamps(moment, point)) + facing_lx(by_film.patches)) : std::nullopt;
}

} // namespace

LampSet without_control(const LampSet& lamp_set) {
    LampSet still = lamp_set;
    if (!lamp_set.motion || !lamp_set.motion->control)
        return still;
    Motion motion = *lamp_set.motion;
    ControlRun& run = *motion.control;
    run.masks.clear();
    for (LampRun& lamp : run.runs) {
        lamp.swivel.reset();
        lamp.pitch.reset();
        lamp.pixels.reset();
    }
    if (const auto& cornering = lamp_set.control->cornering)
        for (std::size_t i = 0; i < run.lamps.size(); ++i)
            if (std::ranges::find(cornering->left, run.lamps[i]) != cornering->left.end() ||
                std::ranges::find(cornering->right, run.lamps[i]) != cornering->right.end())
                run.runs[i].levels = {{0.0, 0.0}};
    still.motion = std::make_shared<const Motion>(std::move(motion));
    return still;
}

ControlFold::ControlFold(const Drive& drive, const Route& route, const Nudge& nudge) : drive_(drive), route_(route), nudge_(nudge) {
    for (const LampSet& lamp_set : drive.lamp_sets)
        for (const MountedLamp& lamp : lamp_set.lamps)
            if (std::ranges::find(lamps_, lamp.name) == lamps_.end())
                lamps_.push_back(lamp.name);
}

auto ControlFold::change(std::optional<double> Light::*figure) {
    return [figure](const Row& row) -> std::optional<double> {
        return row.moved.*figure && row.still.*figure ? std::optional(*(row.moved.*figure) - *(row.still.*figure)) : std::nullopt;
    };
}

ControlFold::Light ControlFold::light(const Moment& moment, double curvature) const {
    Light light;
    light.others_lx = others_lx(moment, route_, drive_.road_surface.pavement);
    const double bumper_m = moment.distance_m + drive_.bumper_m, there_m = bumper_m + look_m;
    std::vector<LineSample> line;
    for (double ahead_m = 0.0; ahead_m <= farthest_m && bumper_m + ahead_m <= route_.length_m(); ahead_m += line_step_m)
        line.push_back({ahead_m, facing_lx(seen_lamps(moment, to_parent(route_.pose(bumper_m + ahead_m), {0.0, 0.0, target_m})))});
    if (const LitLine lit = lit_line(line, reach_lx); !line.empty())
        light.reach_m = lit.last_m;
    if (there_m > route_.length_m())
        return light;
    const CrossSection section = route_.cross_section(there_m);
    for (const RouteLane& lane : section.lanes)
        if (lane.name == "own")
            light.inside_lx =
                lit_lx(moment, route_, drive_.road_surface.pavement, there_m, curvature > 0.0 ? lane.left_m : lane.right_m, target_m);
    if (const std::optional<double> oncoming_m = offset_across_m(section, Across::oncoming_centre))
        light.glare_lx = lit_lx(moment, route_, drive_.road_surface.pavement, there_m, *oncoming_m, eye_height_m);
    return light;
}

void ControlFold::add(const Moment& moment, const LampSet& lamp_set) {
    if (!still_)
        still_ = std::make_shared<const LampSet>(without_control(lamp_set));
    Row row;
    row.tick = moment.tick;
    row.along_m = moment.distance_m;
    const double curvature = curvature_per_m(route_, moment.distance_m + drive_.bumper_m + 0.5 * look_m);
    row.bend = curvature > bend_per_m ? 1 : curvature < -bend_per_m ? -1 : 0;
    row.moved = row.still = light(moment, curvature);
    row.swivel_deg.resize(lamps_.size());
    row.pitch_deg.resize(lamps_.size());
    row.level.resize(lamps_.size());
    if (const ControlRun* const run = lamp_set.motion && lamp_set.motion->control ? &*lamp_set.motion->control : nullptr) {
        const State state{moment.tick, moment.time_s, moment.distance_m, moment.speed_mps};
        row.still = light(nudged(moment_at(state, drive_, route_, *still_), nudge_), curvature);
        for (std::size_t i = 0; i < lamps_.size(); ++i) {
            const std::size_t lamp = run->lamp(lamps_[i]);
            if (lamp == run->lamps.size())
                continue;
            if (run->runs[lamp].swivel)
                row.swivel_deg[i] = degrees(run->swivel_rad(lamp, moment.time_s));
            if (run->runs[lamp].pitch)
                row.pitch_deg[i] = degrees(run->pitch_rad(lamp, moment.time_s));
            if (!run->runs[lamp].levels.empty())
                row.level[i] = run->level(lamp, moment.time_s);
        }
        if (static_cast<std::size_t>(moment.tick) < run->rows.size()) {
            const std::vector<double>& signals = run->rows[static_cast<std::size_t>(moment.tick)];
            if (lamp_set.control->modes)
                row.mode = signals[signal::control_mode];
            if (lamp_set.control->high_beam)
                row.high_beam = signals[signal::control_high_beam];
        }
    }
    rows_.push_back(std::move(row));
}

Readings ControlFold::readings() const {
    Readings readings;
    const auto say = [&](const ReadingKey& key, const std::string& where, std::optional<double> value, const std::string& why_not) {
        readings.push_back({key, Value::of(value, why_not), where});
    };
    double max_deg = 0.0;
    for (const Row& row : rows_)
        for (const std::optional<double>& swivel : row.swivel_deg)
            max_deg = std::max(max_deg, std::abs(swivel.value_or(0.0)));
    say({.quantity = Quantity::control_swivel, .statistic = Statistic::maximum}, "largest swivel of any lamp",
        rows_.empty() ? std::nullopt : std::optional(max_deg), "no moment was played");
    const auto in_bends = [&](int side, const std::string& none, auto&& value) {
        std::vector<double> values;
        for (const Row& row : rows_)
            if (const std::optional<double> found = row.bend == side ? value(row) : std::nullopt)
                values.push_back(*found);
        return median_value(values, none);
    };
    const auto pair = [&](ReadingKey key, const std::string& where, std::optional<double> Light::*figure) {
        key.statistic = Statistic::median;
        for (const auto& [side, place, word] :
             {std::tuple(1, ReadingPlace::left_bends, "left"), std::tuple(-1, ReadingPlace::right_bends, "right")}) {
            const std::string none = fmt::format("no moment in a {} bend of less than 1500 m radius has such a place", word);
            key.place = place;
            key.aspect = Aspect::value;
            readings.push_back({key, in_bends(side, none, [&](const Row& row) { return row.moved.*figure; }),
                                fmt::format("{}, median in {} bends", where, word)});
            key.aspect = Aspect::by_control;
            readings.push_back({key, in_bends(side, none, change(figure)),
                                fmt::format("{}, against the same lamps held still, median in {} bends", where, word)});
        }
    };
    pair({.quantity = Quantity::control_inside, .distance_m = look_m},
         "own lane's edge inside the bend, 50 m ahead, facing target at 0.25 m", &Light::inside_lx);
    pair({.quantity = Quantity::control_reach, .threshold = {reach_lx, ThresholdUnit::lx}}, "own lane's centre, facing target at 0.25 m",
         &Light::reach_m);
    pair({.quantity = Quantity::control_glare, .distance_m = look_m}, "eyes at 1.1 m, oncoming lane's centre, 50 m ahead, facing the lamps",
         &Light::glare_lx);
    if (!drive_.traffic.empty())
        for (const auto& [aspect, where, of] :
             {std::tuple(Aspect::value, "eyes of oncoming road users, largest of the drive", &Row::moved),
              std::tuple(Aspect::held_still, "the same with lamps held still and no window dark", &Row::still)}) {
            std::optional<double> most;
            for (const Row& row : rows_)
                if (const std::optional<double> lx = (row.*of).others_lx)
                    most = std::max(most.value_or(0.0), *lx);
            say({.quantity = Quantity::control_others, .aspect = aspect, .statistic = Statistic::maximum}, where, most,
                "nobody came towards the car");
        }
    const bool any_mode = std::ranges::any_of(drive_.lamp_sets, [](const LampSet& v) { return v.control && v.control->modes; });
    const bool any_high = std::ranges::any_of(drive_.lamp_sets, [](const LampSet& v) { return v.control && v.control->high_beam; });
    const auto share = [&](Quantity quantity, const std::string& subject, const std::string& where, const auto& holds) {
        double sum = 0.0;
        std::size_t count = 0;
        for (const Row& row : rows_)
            if (const std::optional<double> part = holds(row)) {
                sum += *part;
                ++count;
            }
        say({.quantity = quantity, .subject = subject, .statistic = Statistic::mean}, where,
            count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt, "the lamp set has no such law");
    };
    if (any_high)
        share(Quantity::control_high_beam, "", "of the moments, mean level", [](const Row& row) { return row.high_beam; });
    for (const auto& [name, mode] : {std::pair{"c", 0.0}, {"v", 1.0}, {"e", 2.0}, {"w", 3.0}})
        if (any_mode)
            share(Quantity::control_class, name, "of the moments", [mode = mode](const Row& row) -> std::optional<double> {
                return row.mode ? std::optional(*row.mode == mode ? 1.0 : 0.0) : std::nullopt;
            });
    return readings;
}

std::vector<SeeingSeries> ControlFold::series() const {
    SeeingSeries series{"control", "Lamps", "distance along the route"};
    const auto column = [&](const std::string& name, const std::string& label, const std::string& unit, const auto& value) {
        series.add({name, label, unit}, rows_, [&](const Row& row) { return Value::of(value(row), "not there in this moment"); });
    };
    for (const Row& row : rows_) {
        series.ticks.push_back(row.tick);
        series.at_m.push_back(row.along_m);
    }
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        column("swivel_" + lamps_[i] + "_deg", lamps_[i] + ", swivel to the left", "deg",
               [&](const Row& row) { return row.swivel_deg[i]; });
        column("pitch_" + lamps_[i] + "_deg", lamps_[i] + ", levelling upwards", "deg", [&](const Row& row) { return row.pitch_deg[i]; });
        column("level_" + lamps_[i] + "_1", lamps_[i] + ", level", "", [&](const Row& row) { return row.level[i]; });
    }
    column("inside_at_50m_lx", "light inside the bend, 50 m ahead", "lx",
           [](const Row& row) { return row.bend != 0 ? row.moved.inside_lx : std::nullopt; });
    column("reach_gain_5lx_m", "reach at 5 lx gained by control", "m", change(&Light::reach_m));
    column("glare_at_50m_lx", "light in oncoming eyes, 50 m ahead", "lx", [](const Row& row) { return row.moved.glare_lx; });
    column("glare_cost_at_50m_lx", "of it by control", "lx", change(&Light::glare_lx));
    column("others_lx", "light in eyes of road users that come", "lx", [](const Row& row) { return row.moved.others_lx; });
    column("class_1", "class of the beam: 0 C, 1 V, 2 E, 3 W", "", [](const Row& row) { return row.mode; });
    return {series};
}

} // namespace fernlicht
