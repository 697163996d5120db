#include "metrics/folds/mirror_fold.h"

#include "metrics/statistics/statistics.h"
#include "scenarios/drives/play/advance.h"

#include <fmt/format.h>

namespace fernlicht {
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
            for (SeenLamp lamp : seen_lamps(moment, mirror_m)) {
                if (lamp.facing_lx > 0.0 && road_hides(route_, moment.distance_m, ahead_m, lamp.position_m, mirror_m))
                    lamp.facing_lx = 0.0;
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

} // namespace fernlicht
