#include "metrics/folds/glare_fold.h"

#include "metrics/folds/place_fold.h"
#include "metrics/glare/wet_road.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_street_lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {

std::optional<OncomingEye> oncoming_eye(const Route& route, const GlareObserver& observer) {
    const std::optional<double> left_m = offset_across_m(route.cross_section(observer.at_m), Across::oncoming_centre);
    if (!left_m)
        return std::nullopt;
    const Pose surface = route.pose(observer.at_m, *left_m);
    OncomingEye eye{surface.position_m + observer.eye_height_m * surface.up(), -surface.forward()};
    if (observer.look_ahead_m > 0.0) {
        const Pose ahead = route.pose(std::max(observer.at_m - observer.look_ahead_m, 0.0), *left_m);
        const glm::dvec3 looked_at = ahead.position_m + observer.eye_height_m * ahead.up();
        if (glm::distance(looked_at, eye.place_m) > 0.1) // not at the route's very start
            eye.gaze = glm::normalize(looked_at - eye.place_m);
    }
    return eye;
}

OncomingFold::OncomingFold(const Drive& drive, const Route& route, const Nudge& nudge) : drive_(drive), route_(route), nudge_(nudge) {
    for (const GlareObserver& observer : drive.seeing.glare->oncoming) {
        Eye& eye = eyes_.emplace_back();
        const std::optional<OncomingEye> found = oncoming_eye(route, observer);
        if (!found)
            continue;
        eye.place_m = found->place_m;
        eye.gaze = found->gaze;
        eye.driver = oncoming_driver(drive, route, observer.at_m, observer.eye_height_m);
    }
}

Value oncoming_adaptation_cdm2(const Drive& drive, const Route& route, const LampSet& lamp_set, const Driver& driver, double at_m,
                               const Moment& moment, const Nudge& nudge) {
    if (drive.seeing.glare->adaptation_cdm2)
        return *drive.seeing.glare->adaptation_cdm2;
    Moment there; // street lamps about the observer, who may be far from the own car
    there.distance_m = at_m;
    there.ego = driver.car;
    there.daylight = moment.daylight;
    there.weather = moment.weather;
    add_street_lamps(drive, route, street_lamps_within_m, there);
    return lane_luminance_cdm2(driver, low_beams(drive, lamp_set, driver.car, nudge), there);
}

Value OncomingFold::adaptation_cdm2(const Moment& moment, const LampSet& lamp_set, double at_m, Eye& eye) const {
    if (!eye.adapted || eye.adapted->daylight != moment.daylight || eye.adapted->weather != moment.weather)
        eye.adapted = {moment.daylight, moment.weather,
                       oncoming_adaptation_cdm2(drive_, route_, lamp_set, eye.driver, at_m, moment, nudge_)};
    return eye.adapted->cdm2;
}

void OncomingFold::add(const Moment& moment, const LampSet& lamp_set) {
    const GlareParameters& parameters = *drive_.seeing.glare;
    if (lamps_.empty())
        for (const LitLamp& lamp : moment.lamps)
            lamps_.push_back(lamp.name);
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        Eye& eye = eyes_[i];
        const GlareObserver& observer = parameters.oncoming[i];
        const double to_go_m = observer.at_m - moment.distance_m - drive_.bumper_m;
        eye.passed = eye.passed || to_go_m < 0.0;
        if (!eye.place_m || to_go_m < 0.0)
            continue;
        std::vector<GlareSource> sources;
        double facing = 0.0;
        for (const SeenLamp& lamp : lamps_over_road(moment, route_, observer.at_m, *eye.place_m)) {
            facing += lamp.facing_lx;
            sources.push_back(glare_source(lamp, *eye.place_m, eye.gaze));
        }
        const RoadLight by_film = light_over_road(moment, route_, observer.at_m, *eye.place_m, drive_.road_surface.pavement);
        for (const SeenLamp& patch : by_film.patches) {
            facing += patch.facing_lx;
            sources.push_back(glare_source(patch, *eye.place_m, eye.gaze));
        }
        const Value adapted = adaptation_cdm2(moment, lamp_set, observer.at_m, eye);
        eye.followed.add(moment, to_go_m, sources, lamps_.size(),
                         by_film.unknown.empty() ? glare_figures(sources, facing, adapted, parameters)
                                                 : no_figures(by_film.unknown, adapted));
    }
}

Readings OncomingFold::readings() const {
    Readings readings;
    const GlareParameters& parameters = *drive_.seeing.glare;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        const GlareObserver& observer = parameters.oncoming[i];
        const ReadingKey eye{.quantity = Quantity::glare_facing, .subject = observer.name};
        const std::string cut = cut_short(eyes_[i].followed.facing.approach, eyes_[i].passed);
        const std::string where = fmt::format("oncoming driver {} m along the route, eyes {} m above the road{}", observer.at_m,
                                              observer.eye_height_m, cut.empty() ? "" : " (" + cut + ")");
        const std::string none = eyes_[i].place_m ? "" : fmt::format("there is no oncoming lane at {} m", observer.at_m);
        eyes_[i].followed.say(readings, eye, where, none, parameters, parameters.ranges_m);
        for (const double distance_m : parameters.distances_m) {
            const Value lx = none.empty() ? value_at(eyes_[i].followed.facing.approach, distance_m) : Value::not_measured(none);
            readings.push_back({eye, lx, fmt::format("{}, the bumper {} m before it, facing the lamps", where, distance_m)});
            readings.back().key.distance_m = distance_m;
            if (lx.measured())
                readings.back().between_moments = unknown_at(eyes_[i].followed.facing.approach, distance_m);
        }
    }
    return readings;
}

std::vector<SeeingSeries> OncomingFold::series() const {
    std::vector<SeeingSeries> all;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        const std::string& name = drive_.seeing.glare->oncoming[i].name;
        all.push_back(eyes_[i].followed.series({.quantity = Quantity::glare_facing, .subject = name},
                                               fmt::format("Oncoming driver \u201c{}\u201d", name),
                                               "distance from the bumper to the observer", lamps_));
    }
    return all;
}

namespace {

/// Of the driver of a car ahead.
ReadingKey eyes_behind(double gap_m) { return {.quantity = Quantity::glare_facing, .place = ReadingPlace::mirrors, .distance_m = gap_m}; }

} // namespace

MirrorFold::MirrorFold(const Drive& drive, const Route& route, const Nudge& nudge)
    : drive_(drive), route_(route), nudge_(nudge), gaps_(drive.seeing.glare->mirrors->gaps_m.size()) {
    for (Gap& gap : gaps_)
        gap.mirror_lx.resize(drive.seeing.glare->mirrors->mirrors.size());
}

void MirrorFold::add(const Moment& moment, const LampSet& lamp_set) {
    const GlareParameters& parameters = *drive_.seeing.glare;
    const MirrorParameters& mirrors = *parameters.mirrors;
    if (sources_.empty())
        for (const Mirror& mirror : mirrors.mirrors)
            for (const LitLamp& lamp : moment.lamps)
                sources_.push_back(fmt::format("{}_in_{}", lamp.name, mirror.name));
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
        const double ahead_m = moment.distance_m + drive_.bumper_m + mirrors.gaps_m[i];
        if (ahead_m + drive_.wheelbase_m > route_.length_m())
            continue; // the car ahead has left the route
        const Pose car = ego_pose(route_, ahead_m, drive_.wheelbase_m);
        const glm::dvec3 eye_m = to_parent(car, mirrors.eye_m);
        std::vector<GlareSource> sources, by_road;
        double facing = 0.0;
        std::string unknown;
        for (std::size_t k = 0; k < mirrors.mirrors.size(); ++k) {
            const glm::dvec3 mirror_m = to_parent(car, mirrors.mirrors[k].position_m);
            double on_mirror = 0.0;
            for (const SeenLamp& lamp : lamps_over_road(moment, route_, ahead_m, mirror_m)) {
                on_mirror += lamp.facing_lx;
                sources.push_back(mirrored_source(lamp, mirror_m, mirrors.reflectance, eye_m, car.forward()));
            }
            const RoadLight by_film = light_over_road(moment, route_, ahead_m, mirror_m, drive_.road_surface.pavement);
            for (const SeenLamp& patch : by_film.patches) {
                on_mirror += patch.facing_lx;
                by_road.push_back(mirrored_source(patch, mirror_m, mirrors.reflectance, eye_m, car.forward()));
            }
            unknown = by_film.unknown;
            gaps_[i].mirror_lx[k].push_back(on_mirror);
            facing = std::max(facing, on_mirror);
        }
        const Value adapted = parameters.adaptation_cdm2 ? Value(*parameters.adaptation_cdm2)
                                                         : lane_luminance_cdm2(driver_ahead(drive_, route_, ahead_m, car, eye_m),
                                                                               low_beams(drive_, lamp_set, car, nudge_), moment);
        const std::size_t followed = sources.size();
        sources.insert(sources.end(), by_road.begin(), by_road.end());
        if (gaps_[i].unknown.empty())
            gaps_[i].unknown = unknown;
        gaps_[i].eye.add(moment, moment.distance_m, sources, followed,
                         unknown.empty() ? glare_figures(sources, facing, adapted, parameters) : no_figures(unknown, adapted));
    }
}

Readings MirrorFold::readings() const {
    Readings readings;
    const MirrorParameters& mirrors = *drive_.seeing.glare->mirrors;
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
        const std::string where = fmt::format("car {} m ahead in the own lane", mirrors.gaps_m[i]);
        const std::string none = "the car ahead is beyond the route's end in every moment";
        for (std::size_t k = 0; k < mirrors.mirrors.size(); ++k) {
            const std::optional<Spread> spread = spread_of(gaps_[i].mirror_lx[k]);
            std::array<std::vector<double>, 2> halves;
            for (std::size_t moment = 0; moment < gaps_[i].mirror_lx[k].size(); ++moment)
                halves[moment % 2].push_back(gaps_[i].mirror_lx[k][moment]);
            const auto say = [&](Statistic statistic, const char* what, double Spread::*figure) {
                readings.push_back({{.quantity = Quantity::mirror_illuminance,
                                     .subject = mirrors.mirrors[k].name,
                                     .distance_m = mirrors.gaps_m[i],
                                     .statistic = statistic},
                                    !gaps_[i].unknown.empty() ? Value::not_measured("in some moment: " + gaps_[i].unknown)
                                    : spread                  ? Value(*spread.*figure)
                                                              : Value::not_measured(none),
                                    fmt::format("{}, {} mirror, facing the lamps, {}", where, mirrors.mirrors[k].name, what)});
                for (const std::vector<double>& half : halves)
                    if (const std::optional<Spread> of_half = spread_of(half); of_half && readings.back().value.measured())
                        readings.back().between_moments =
                            std::max(readings.back().between_moments.value_or(0.0), std::abs((*of_half).*figure - (*spread).*figure));
            };
            say(Statistic::median, "median", &Spread::median);
            say(Statistic::p95, "95th percentile", &Spread::p95);
            say(Statistic::maximum, "largest", &Spread::maximum);
        }
        gaps_[i].eye.say(readings, eyes_behind(mirrors.gaps_m[i]), where + ", its driver's eye through all mirrors", none,
                         *drive_.seeing.glare);
    }
    return readings;
}

std::vector<SeeingSeries> MirrorFold::series() const {
    std::vector<SeeingSeries> all;
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
        const double gap_m = drive_.seeing.glare->mirrors->gaps_m[i];
        all.push_back(gaps_[i].eye.series(eyes_behind(gap_m), fmt::format("Mirrors of a car {} m ahead", gap_m), "distance along the route",
                                          sources_));
    }
    return all;
}

TrafficFold::TrafficFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {
    for (const RoadUser& user : drive.traffic)
        boxes_.push_back({user.size_m, user.rear_m});
}

void TrafficFold::add(const Moment& moment) {
    const GlareParameters& parameters = *drive_.seeing.glare;
    const glm::dvec3 eye_m = to_parent(moment.ego, driver_eye_m(drive_));
    std::vector<GlareSource> sources = traffic_glare(moment, eye_m, moment.ego.forward(), boxes_);
    const TrafficByRoad by_film = traffic_by_road(moment, eye_m, moment.ego.forward(), boxes_, drive_.road_surface.pavement);
    sources.insert(sources.end(), by_film.sources.begin(), by_film.sources.end());
    double facing = 0.0;
    for (const GlareSource& source : sources)
        facing += source.eye_lx / std::cos(radians(source.theta_deg));
    // How many lamps are seen changes from moment to moment: their angles are not followed.
    const Value adapted =
        parameters.adaptation_cdm2
            ? Value(*parameters.adaptation_cdm2)
            : lane_luminance_cdm2(driver_ahead(drive_, route_, moment.distance_m, moment.ego, eye_m), moment.lamps, moment);
    eye_.add(moment, moment.distance_m, sources, 0,
             by_film.unknown.empty() ? glare_figures(sources, facing, adapted, parameters) : no_figures(by_film.unknown, adapted));
}

Readings TrafficFold::readings() const {
    Readings readings;
    eye_.say(readings, {.quantity = Quantity::glare_facing, .place = ReadingPlace::own_eyes}, "own driver's eye, other lamps", "",
             *drive_.seeing.glare);
    return readings;
}

} // namespace fernlicht
