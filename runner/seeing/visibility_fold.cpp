#include "runner/seeing/visibility_fold.h"

#include "metrics/lit_line.h"
#include "metrics/many_moments.h"
#include "metrics/mesopic.h"
#include "metrics/statistics.h"
#include "runner/stage.h"
#include "scenarios/light.h"
#include "scenarios/roads/road_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// The road behind a target is known so much farther than targets stand: from an eye of 1.2 m, a target's middle of 0.09 m hides what lies
/// a twelfth farther.
constexpr double known_behind_m = 100.0;
const glm::dvec3 usual_eye_m{1.3, 0.35, 1.2};

Material asphalt() {
    for (const Material& material : road_materials())
        if (material.name == "asphalt")
            return material;
    throw std::logic_error("there is no asphalt among the road's materials");
}

} // namespace

VisibilityFold::VisibilityFold(const Drive& drive, const Route& route) : drive_(drive), route_(route), road_(asphalt()) {
    const View* const view = driver_view(drive);
    eye_m_ = view ? view->position_m : usual_eye_m;
    at_.resize(drive.seeing.visibility->distances_m.size());
    level_series_.resize(at_.size());
}

SeenTarget VisibilityFold::target(const Moment& moment, const LaneAhead& lane, const Pose& place, double ahead_m,
                                  const glm::dvec3& eye_m) const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    const glm::dvec3 middle = place.position_m + 0.5 * asked.size_m * place.up();
    SeenTarget seen{ahead_m, {}, std::nullopt};
    if (const std::optional<Pose> road = lane.behind(eye_m, middle))
        seen.background = surface_luminance(moment, road->position_m, road->up(), road_, eye_m);
    if (lane.hides(eye_m, middle)) {
        seen.level = 0.0;
        return seen;
    }
    if (!seen.background) {
        seen.level = Value::not_measured("the line of sight does not meet the road behind the target");
        return seen;
    }
    Moment reaching = moment;
    std::erase_if(reaching.lamps, [&](const LitLamp& lamp) { return lane.hides(lamp.pose.position_m, middle); });
    const double e = surface_illuminance_lx(reaching, middle, -place.forward());
    seen.level = visibility_level(asked.reflectance * e / pi, seen.background->photopic_cdm2,
                                  arc_minutes_of(asked.size_m, glm::distance(eye_m, middle)), {asked.age_years, asked.time_s, asked.k});
    return seen;
}

void VisibilityFold::add(const Moment& moment) {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    Moment lit = moment;
    std::erase_if(lit.lamps, [](const LitLamp& lamp) { return lamp.intensity_factor == 0.0; });
    const double bumper_m = moment.distance_m + drive_.bumper_m;
    const LaneAhead lane(route_, bumper_m, asked.ahead_m + known_behind_m, asked.step_m);
    const glm::dvec3 eye_m = to_parent(moment.ego, eye_m_);
    const double room_m = std::min(asked.ahead_m, route_.length_m() - bumper_m);
    std::vector<LineSample> line;
    for (std::size_t k = 1; static_cast<double>(k) * asked.step_m <= room_m; ++k) {
        const double ahead_m = static_cast<double>(k) * asked.step_m;
        line.push_back({ahead_m, target(lit, lane, lane.surface()[k], ahead_m, eye_m).level.number()});
    }
    // Where the route's end comes into sight, backgrounds of the last places are missing: the detection is cut off by it.
    const LitLine detected = lit_line(line, asked.level);
    const bool to_the_end = room_m < asked.ahead_m;
    const auto last_known = std::find_if(line.rbegin(), line.rend(), [](const LineSample& sample) { return sample.lx.has_value(); });
    const bool beyond = last_known != line.rend() && *last_known->lx >= asked.level;
    const auto found = [&](double metres) {
        return !beyond      ? Value(metres)
               : to_the_end ? Value::not_measured("cut off by the end of the road or lane")
                            : Value::at_least(metres);
    };
    detections_.push_back({found(detected.last_m), found(detected.unlit_before_last_m)});
    ticks_.push_back(moment.tick);
    along_m_.push_back(moment.distance_m);
    for (std::size_t i = 0; i < at_.size(); ++i) {
        const double ahead_m = asked.distances_m[i];
        if (bumper_m + ahead_m > route_.length_m()) {
            level_series_[i].emplace_back();
            at_[i].no_level = at_[i].no_background = "the route ends nearer than this in some moment";
            continue;
        }
        const SeenTarget seen = target(lit, lane, route_.pose(bumper_m + ahead_m), ahead_m, eye_m);
        level_series_[i].push_back(seen.level.number());
        if (const auto level = seen.level.number())
            at_[i].level.push_back(*level);
        else
            at_[i].no_level = seen.level.reason();
        if (!seen.background) {
            at_[i].no_background = "the line of sight does not meet the road in some moment";
            continue;
        }
        at_[i].photopic.push_back(seen.background->photopic_cdm2);
        if (seen.background->photopic_cdm2 > 0.0 && moment.daylight.horizontal_illuminance_lx == 0.0)
            at_[i].mesopic.push_back(
                mesopic_luminance(seen.background->photopic_cdm2, seen.background->scotopic_cdm2 / seen.background->photopic_cdm2)
                    .luminance_cdm2);
    }
}

Readings VisibilityFold::readings() const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    const std::string where = fmt::format("own lane, square target of {} m and {} % reflectance, visibility level {}", asked.size_m,
                                          100.0 * asked.reflectance, asked.level);
    ManyMoments reach, undetected;
    for (const Detection& detection : detections_) {
        reach.add(detection.from_m);
        undetected.add(detection.undetected_m);
    }
    Readings readings;
    const auto quantile = [&](const char* name, const ManyMoments& moments, double share, const char* what) {
        readings.push_back({name, moments.quantile(share), "m", fmt::format("{}, {}; {}", where, what, moments.account())});
    };
    quantile("detection_own_m", reach, 0.5, "farthest place, median");
    quantile("detection_own_min_m", reach, 0.0, "farthest place, smallest");
    quantile("detection_own_p05_m", reach, 0.05, "farthest place, 5th percentile");
    quantile("undetected_before_detection_own_m", undetected, 0.5, "nearer places where it is not, median");
    for (std::size_t i = 0; i < at_.size(); ++i) {
        const auto say = [&](const std::string& name, const char* unit, const char* what, const std::vector<double>& values,
                             const std::string& missing) {
            const std::optional<Spread> spread = missing.empty() ? spread_of(values) : std::nullopt;
            readings.push_back({name,
                                spread ? Value(spread->median) : Value::not_measured(missing.empty() ? "no moment was measured" : missing),
                                unit, fmt::format("{}, {} m ahead, {}, median", where, asked.distances_m[i], what)});
        };
        const std::string at = fmt::format("own_at_{}m", asked.distances_m[i]);
        say("visibility_level_" + at, "1", "level", at_[i].level, at_[i].no_level);
        say("background_luminance_" + at + "_cdm2", "cd/m2", "luminance of the road behind it", at_[i].photopic, at_[i].no_background);
        const bool all_mesopic = at_[i].mesopic.size() == at_[i].photopic.size();
        say("mesopic_luminance_" + at + "_cdm2", "cd/m2", "mesopic luminance of the road behind it (CIE 191)", at_[i].mesopic,
            !at_[i].no_background.empty() ? at_[i].no_background
            : all_mesopic                 ? ""
                                          : "dark in some moment, or lit by a sky whose ratio S/P is not known");
    }
    return readings;
}

std::vector<SeeingSeries> VisibilityFold::series() const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    SeeingSeries series{"detection_own",
                        fmt::format("Target of {} m, {} %", asked.size_m, 100.0 * asked.reflectance),
                        "distance along the route",
                        ticks_,
                        along_m_,
                        {}};
    SeeingSeries::Column from{"detection_m", fmt::format("detection distance, level {}", asked.level), "m", false, true, {}};
    for (const Detection& detection : detections_)
        from.values.push_back(detection.from_m.number());
    series.columns.push_back(std::move(from));
    for (std::size_t i = 0; i < at_.size(); ++i)
        series.columns.push_back({fmt::format("visibility_level_at_{}m", asked.distances_m[i]),
                                  fmt::format("visibility level {} m ahead", asked.distances_m[i]), "", false, true, level_series_[i]});
    return {series};
}

} // namespace fernlicht
