#include "metrics/folds/glare_fold.h"

#include "metrics/folds/place_fold.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

const char* const no_moment = "no moment of the drive was measured";

/// The figure over the drive, or why some moment lacks it: an extreme over the rest could be another.
Value over_drive(const std::optional<double>& extreme, const std::string& missing, const std::string& why_none) {
    if (!missing.empty())
        return Value::not_measured("in some moment: " + missing);
    return Value::of(extreme, why_none);
}

} // namespace

GlareFigures glare_figures(const std::vector<GlareSource>& sources, double facing, const GlareParameters& parameters) {
    GlareFigures figures;
    figures.facing_lx = facing;
    for (const GlareSource& source : sources)
        figures.eye_lx += source.eye_lx;
    figures.veiling_cdm2 = veiling_luminance_cdm2(parameters.equation, sources, {parameters.age_years, parameters.pigmentation});
    figures.increment_percent = figures.veiling_cdm2.measured()
                                    ? threshold_increment_percent(*figures.veiling_cdm2.number(), parameters.adaptation_cdm2)
                                    : figures.veiling_cdm2;
    figures.de_boer = de_boer_rating(sources, parameters.adaptation_cdm2);
    return figures;
}

void GlareFollowed::add(const Moment& moment, double to_go_m, const std::vector<GlareSource>& sources, const GlareFigures& figures) {
    ticks.push_back(moment.tick);
    facing.push_back({moment.time_s, to_go_m, figures.facing_lx});
    eye_lx.push_back({moment.time_s, to_go_m, figures.eye_lx});
    veiling.push_back({moment.time_s, to_go_m, figures.veiling_cdm2.number()});
    increment.push_back({moment.time_s, to_go_m, figures.increment_percent.number()});
    de_boer.push_back({moment.time_s, to_go_m, figures.de_boer.number()});
    theta_deg.resize(sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i)
        theta_deg[i].push_back(sources[i].theta_deg);
    if (no_veiling.empty())
        no_veiling = figures.veiling_cdm2.reason();
    if (no_increment.empty())
        no_increment = figures.increment_percent.reason();
    if (no_de_boer.empty() && figures.eye_lx > 0.0) // in the dark nothing is rated, and nothing glares
        no_de_boer = figures.de_boer.reason();
}

void GlareFollowed::say(Readings& readings, const ReadingKey& eye, const std::string& where, const std::string& why_none,
                        const GlareParameters& parameters) const {
    const auto add = [&](Quantity quantity, Statistic statistic, const Threshold& threshold, const std::string& what, const Value& found) {
        ReadingKey key = eye;
        key.quantity = quantity;
        key.threshold = threshold;
        key.statistic = statistic;
        readings.push_back({key, found, where + ", " + what});
    };
    const std::string none = why_none.empty() ? no_moment : why_none;
    const auto most = [&](Quantity quantity, const std::string& what, const Approach& figure, const std::string& missing) {
        add(quantity, Statistic::maximum, {}, what, over_drive(largest(figure), missing, none));
    };
    most(Quantity::glare_facing, "facing the lamps, largest", facing, "");
    most(Quantity::glare_eye, "across the line of sight, largest", eye_lx, "");
    most(Quantity::glare_veiling, fmt::format("veiling luminance, {}, largest", name(parameters.equation)), veiling, no_veiling);
    most(Quantity::glare_increment, fmt::format("adapted to {} cd/m2, largest", parameters.adaptation_cdm2), increment, no_increment);
    const bool dark = !facing.empty() && no_de_boer.empty() && !smallest(de_boer);
    add(Quantity::glare_de_boer, Statistic::minimum, {},
        fmt::format("adapted to {} cd/m2, smallest; 9 unnoticeable, 5 just acceptable, 1 unbearable", parameters.adaptation_cdm2),
        over_drive(smallest(de_boer), no_de_boer, dark ? "no light reaches the eye" : none));
    const auto limits = [&](const std::vector<double>& values, const Approach& figure, const std::string& missing, ThresholdUnit unit,
                            const std::string& what) {
        for (const double limit : values) {
            const Stretch stretch = unit == ThresholdUnit::de_boer ? below(figure, limit) : at_or_above(figure, limit);
            const bool measured = missing.empty() && !figure.empty();
            const auto figure_of = [&](double found) { return over_drive(measured ? std::optional(found) : std::nullopt, missing, none); };
            add(Quantity::glare_time, Statistic::none, {limit, unit}, what, figure_of(stretch.time_s));
            add(Quantity::glare_length, Statistic::none, {limit, unit}, what, figure_of(stretch.length_m));
        }
    };
    limits(parameters.thresholds_lx, facing, "", ThresholdUnit::lx, "facing the lamps");
    limits(parameters.thresholds_percent, increment, no_increment, ThresholdUnit::percent, "threshold increment");
    limits(parameters.thresholds_de_boer, de_boer, no_de_boer, ThresholdUnit::de_boer, "de Boer's rating");
}

SeeingSeries GlareFollowed::series(const ReadingKey& eye, const std::string& title, const std::string& over,
                                   const std::vector<std::string>& lamps) const {
    SeeingSeries series{eye_name(eye), title, over, ticks};
    for (const ApproachSample& sample : facing)
        series.at_m.push_back(sample.distance_m);
    const auto column = [&](const char* name, const char* label, const char* unit, bool logarithmic, const Approach& figure) {
        series.add({name, label, unit, logarithmic}, figure,
                   [](const ApproachSample& sample) { return Value::of(sample.value, "not measured at this place"); });
    };
    column("facing_lx", "facing illuminance", "lx", true, facing);
    column("eye_lx", "illuminance across the line of sight", "lx", true, eye_lx);
    series.columns.back().drawn = false;
    column("veiling_cdm2", "veiling luminance", "cd/m2", true, veiling);
    column("threshold_increment_percent", "threshold increment", "%", true, increment);
    column("de_boer", "de Boer's rating", "", false, de_boer);
    for (std::size_t i = 0; i < theta_deg.size(); ++i)
        series.add({"theta_" + lamps.at(i) + "_deg", "angle of " + lamps.at(i), "deg", false, false}, theta_deg[i], std::identity());
    return series;
}

OncomingFold::OncomingFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {
    for (const GlareObserver& observer : drive.seeing.glare->oncoming) {
        Eye& eye = eyes_.emplace_back();
        const std::optional<double> left_m = offset_across_m(route.cross_section(observer.at_m), Across::oncoming_centre);
        if (!left_m)
            continue;
        const Pose surface = route.pose(observer.at_m, *left_m);
        eye.place_m = surface.position_m + observer.eye_height_m * surface.up();
        eye.gaze = -surface.forward();
        if (observer.look_ahead_m > 0.0) {
            const Pose ahead = route.pose(std::max(observer.at_m - observer.look_ahead_m, 0.0), *left_m);
            const glm::dvec3 looked_at = ahead.position_m + observer.eye_height_m * ahead.up();
            if (glm::distance(looked_at, *eye.place_m) > 0.1) // not at the route's very start
                eye.gaze = glm::normalize(looked_at - *eye.place_m);
        }
    }
}

void OncomingFold::add(const Moment& moment) {
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
        eye.followed.add(moment, to_go_m, sources, glare_figures(sources, facing, parameters));
    }
}

Readings OncomingFold::readings() const {
    Readings readings;
    const GlareParameters& parameters = *drive_.seeing.glare;
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
        const GlareObserver& observer = parameters.oncoming[i];
        const ReadingKey eye{.quantity = Quantity::glare_facing, .subject = observer.name};
        const std::string cut = cut_short(eyes_[i].followed.facing, eyes_[i].passed);
        const std::string where = fmt::format("oncoming driver {} m along the route, eyes {} m above the road{}", observer.at_m,
                                              observer.eye_height_m, cut.empty() ? "" : " (" + cut + ")");
        const std::string none = eyes_[i].place_m ? "" : fmt::format("there is no oncoming lane at {} m", observer.at_m);
        eyes_[i].followed.say(readings, eye, where, none, parameters);
        for (const double distance_m : parameters.distances_m) {
            const Value lx = none.empty() ? value_at(eyes_[i].followed.facing, distance_m) : Value::not_measured(none);
            readings.push_back({eye, lx, fmt::format("{}, the bumper {} m before it, facing the lamps", where, distance_m)});
            readings.back().key.distance_m = distance_m;
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

MirrorFold::MirrorFold(const Drive& drive, const Route& route)
    : drive_(drive), route_(route), gaps_(drive.seeing.glare->mirrors->gaps_m.size()) {
    for (Gap& gap : gaps_)
        gap.mirror_lx.resize(drive.seeing.glare->mirrors->mirrors.size());
}

void MirrorFold::add(const Moment& moment) {
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
        std::vector<GlareSource> sources;
        double facing = 0.0;
        for (std::size_t k = 0; k < mirrors.mirrors.size(); ++k) {
            const glm::dvec3 mirror_m = to_parent(car, mirrors.mirrors[k].position_m);
            double on_mirror = 0.0;
            for (const SeenLamp& lamp : lamps_over_road(moment, route_, ahead_m, mirror_m)) {
                on_mirror += lamp.facing_lx;
                sources.push_back(mirrored_source(lamp, mirror_m, mirrors.reflectance, eye_m, car.forward()));
            }
            gaps_[i].mirror_lx[k].push_back(on_mirror);
            facing = std::max(facing, on_mirror);
        }
        gaps_[i].eye.add(moment, moment.distance_m, sources, glare_figures(sources, facing, parameters));
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
            const auto say = [&](Statistic statistic, const char* what, double Spread::*figure) {
                readings.push_back({{.quantity = Quantity::mirror_illuminance,
                                     .subject = mirrors.mirrors[k].name,
                                     .distance_m = mirrors.gaps_m[i],
                                     .statistic = statistic},
                                    spread ? Value(*spread.*figure) : Value::not_measured(none),
                                    fmt::format("{}, {} mirror, facing the lamps, {}", where, mirrors.mirrors[k].name, what)});
            };
            say(Statistic::median, "median", &Spread::median);
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

TrafficFold::TrafficFold(const Drive& drive) : drive_(drive) {
    for (const RoadUser& user : drive.traffic)
        boxes_.push_back({user.size_m, user.rear_m});
}

void TrafficFold::add(const Moment& moment) {
    const std::vector<GlareSource> sources =
        traffic_glare(moment, to_parent(moment.ego, driver_eye_m(drive_)), moment.ego.forward(), boxes_);
    double facing = 0.0;
    for (const GlareSource& source : sources)
        facing += source.eye_lx / std::cos(radians(source.theta_deg));
    // How many lamps are seen changes from moment to moment: their angles are not followed.
    eye_.add(moment, moment.distance_m, {}, glare_figures(sources, facing, *drive_.seeing.glare));
}

Readings TrafficFold::readings() const {
    Readings readings;
    eye_.say(readings, {.quantity = Quantity::glare_facing, .place = ReadingPlace::own_eyes}, "own driver's eye, other lamps", "",
             *drive_.seeing.glare);
    return readings;
}

} // namespace fernlicht
