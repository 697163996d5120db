#include "metrics/folds/visibility_fold.h"

#include "metrics/folds/place_fold.h"
#include "metrics/glare/wet_road.h"
#include "metrics/readings/value.h"
#include "metrics/road/lit_line.h"
#include "metrics/seeing/visibility.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// The road behind a target is known so much farther than targets stand: from an eye of 1.2 m, a target's middle of 0.1 m hides what lies
/// an eleventh farther.
constexpr double known_behind_m = 100.0;
constexpr double background_above_m = 0.1;
constexpr double far_m = 1000.0;      ///< where the line of sight ends that meets no road: in fog all light of the lamps comes from nearer
constexpr double added_spacing = 1.2; ///< from one place at which what the weather adds is integrated to the next

ReadingKey detection_of(const VisibilityTarget& target, Across across) {
    return {.quantity = Quantity::detection,
            .subject = target.name,
            .lane = across == Across::own_centre        ? "own"
                    : across == Across::oncoming_centre ? "oncoming"
                                                        : "",
            .place = across == Across::right_edge  ? ReadingPlace::right
                     : across == Across::left_edge ? ReadingPlace::left
                                                   : ReadingPlace::none};
}

/// Lamps that are off cost time alone.
Moment with_lamps_that_shine(Moment moment) {
    std::erase_if(moment.lamps, [](const LitLamp& lamp) { return lamp.intensity_factor == 0.0; });
    return moment;
}

} // namespace

VisibilityFold::VisibilityFold(const Drive& drive, const Route& route) : drive_(drive), route_(route), road_(material_named("asphalt")) {
    const VisibilityParameters& asked = *drive.seeing.visibility;
    backgrounds_.resize(asked.distances_m.size());
    for (const VisibilityTarget& target : asked.targets)
        for (const Across across : target.places) {
            auto stand = std::ranges::find_if(stands_, [&](const Stand& other) {
                return other.across == across && other.size_m == target.size_m && other.squares == target.squares;
            });
            if (stand == stands_.end())
                stand = stands_.insert(stands_.end(), {across, target.size_m, target.squares, {}});
            stand->sights.push_back({&target, detection_of(target, across), {}, {}});
            stand->sights.back().at.resize(asked.distances_m.size());
        }
}

/// What is not road behind a target shines as the sky does: diffusely, where there is daylight. In fog it is the same: what the air takes
/// of the sky's light it gives back.
double VisibilityFold::dark_cdm2(const Moment& moment) const {
    return std::max(drive_.seeing.visibility->dark_cdm2, moment.daylight.horizontal_illuminance_lx / pi);
}

std::vector<VisibilityFold::Square> VisibilityFold::squares(const Moment& moment, const Ahead& ahead, double along_m,
                                                            const Stand& stand) const {
    const glm::dvec3& eye_m = ahead.eye.at_m;
    std::vector<Square> all;
    const std::optional<Pose> foot = place_on_road(route_, stand.across, along_m);
    if (!foot)
        return all;
    const std::string no_mirror = why_no_mirror(moment.weather, road_plane(moment.ego, *foot));
    double adaptation_cdm2 = 0.0; // of the road behind the lowest square
    for (int i = 0; i < stand.squares; ++i) {
        const glm::dvec3 middle = foot->position_m + (i + 0.5) * stand.size_m * foot->up();
        Square square;
        square.middle_m = middle;
        square.face = -foot->forward();
        square.size_arcmin = arc_minutes_of(stand.size_m, glm::distance(eye_m, middle));
        square.hidden = ahead.lane.hides(ahead.eye, middle);
        square.no_mirror = no_mirror;
        if (const std::optional<Pose> road = ahead.lane.behind(ahead.eye, middle)) {
            square.on_road = true;
            square.behind_m = road->position_m;
            square.background_cdm2 = surface_luminance(moment, road->position_m, road->up(), road_, eye_m).photopic_cdm2;
            if (adaptation_cdm2 == 0.0)
                adaptation_cdm2 = square.background_cdm2;
            square.adaptation_cdm2 = square.background_cdm2;
        } else if (i > 0) {
            square.behind_m = eye_m + far_m * glm::normalize(middle - eye_m);
            square.background_cdm2 = dark_cdm2(moment);
            square.adaptation_cdm2 = std::max(adaptation_cdm2, square.background_cdm2);
        } else
            square.unknown = "the line of sight does not meet the road behind the target";
        if (square.unknown.empty())
            square.unknown = square.no_mirror;
        if (!square.hidden && square.unknown.empty()) {
            const auto hidden = [&](const LaneAhead::Origin& lamp) { return ahead.lane.hides(lamp, middle); };
            if (std::ranges::none_of(ahead.lamps, hidden)) // as nearly everywhere, without a copy
                square.illuminance_lx = surface_illuminance_lx(moment, middle, square.face);
            else
                square.illuminance_lx = surface_illuminance_lx(reaching(moment, ahead, middle), middle, square.face);
        }
        all.push_back(square);
        if (!all.front().unknown.empty())
            return all; // without a road behind its foot nothing tells what the eye is adapted to
    }
    return all;
}

/// The moment without lamps that the lane hides from a point.
Moment VisibilityFold::reaching(const Moment& moment, const Ahead& ahead, const glm::dvec3& point_m) {
    Moment lit = moment;
    lit.lamps.clear();
    for (std::size_t i = 0; i < moment.lamps.size(); ++i)
        if (!ahead.lane.hides(ahead.lamps[i], point_m))
            lit.lamps.push_back(moment.lamps[i]);
    return lit;
}

VisibilityFold::Added VisibilityFold::added(const Moment& moment, const Ahead& ahead, double along_m, const Square& square) const {
    const auto air = [&](const glm::dvec3& to_m) { return lamps_airlight(moment, to_m, ahead.eye.at_m).photopic_cdm2; };
    Added added{air(square.middle_m), air(square.behind_m), 0.0};
    if (moment.weather.wetness > 0.0 && !square.hidden) {
        const Moment lit = reaching(moment, ahead, square.middle_m);
        added[2] = illuminance_by_road_lx(light_by_road(lit, route_, along_m, square.middle_m).patches, square.middle_m, square.face);
    }
    return added;
}

void VisibilityFold::add_weather(const Moment& moment, const Ahead& ahead, std::vector<Place>& places) const {
    if (!(moment.weather.extinction_per_m > 0.0) && !(moment.weather.wetness > 0.0))
        return;
    const auto squares_of = [](const Place& place) { return place.squares.size(); };
    const std::size_t most = places.empty() ? 0 : squares_of(*std::ranges::max_element(places, {}, squares_of));
    std::vector<double> adaptation_cdm2(places.size()); // of the road behind the lowest square
    for (std::size_t i = 0; i < most; ++i) {
        const auto fill = [&](std::size_t place, const Added& added) {
            Square& square = places[place].squares.at(i);
            const double way_m = glm::distance(ahead.eye.at_m, square.middle_m), far = glm::distance(ahead.eye.at_m, square.behind_m);
            square.left = air_transmittance(moment.weather, way_m);
            square.veil_cdm2 = added[0] + sky_airlight_cdm2(moment.daylight, moment.weather, way_m);
            square.background_cdm2 = square.on_road
                                         ? seen_through_air(moment, {square.background_cdm2, 0.0}, {added[1], 0.0}, far).photopic_cdm2
                                         : square.background_cdm2 + added[1];
            square.illuminance_lx += added[2];
            if (adaptation_cdm2[place] == 0.0)
                adaptation_cdm2[place] = square.background_cdm2;
            square.adaptation_cdm2 = square.on_road ? square.background_cdm2 : std::max(adaptation_cdm2[place], square.background_cdm2);
        };
        const auto alike = [&](std::size_t a, std::size_t b) {
            return a < places.size() && b < places.size() && i < squares_of(places[a]) && i < squares_of(places[b]) &&
                   places[a].squares[i].on_road == places[b].squares[i].on_road &&
                   places[a].squares[i].hidden == places[b].squares[i].hidden &&
                   places[a].squares[i].unknown.empty() == places[b].squares[i].unknown.empty();
        };
        // What is added is integrated at some places and runs straight in the logarithm between them.
        std::size_t from = places.size();
        Added before{};
        for (std::size_t k = 0; k < places.size(); ++k) {
            const bool goes_on = from < k && alike(from, k);
            if (i >= squares_of(places[k]) || !places[k].squares[i].unknown.empty() ||
                (goes_on && alike(k, k + 1) && places[k].ahead_m < added_spacing * places[from].ahead_m))
                continue;
            const Added here = added(moment, ahead, places[k].along_m, places[k].squares[i]);
            for (std::size_t between = from + 1; goes_on && between < k; ++between) {
                if (i >= squares_of(places[between])) // where a wet road bends, all but the lowest are missing
                    continue;
                const double share = (places[between].ahead_m - places[from].ahead_m) / (places[k].ahead_m - places[from].ahead_m);
                Added there{};
                for (std::size_t n = 0; n < there.size(); ++n)
                    there[n] = between_samples(before[n], here[n], share);
                fill(between, there);
            }
            fill(k, here);
            from = k;
            before = here;
        }
    }
}

/// Of the clearest square that has one; 0 where the lane hides all.
Value VisibilityFold::level(const std::vector<Square>& squares, const VisibilityTarget& target) const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    std::optional<double> clearest;
    std::string reason;
    for (const Square& square : squares) {
        const Value value =
            square.hidden ? Value(0.0)
            : square.unknown.empty()
                ? visibility_level(square.left * target.reflectance * square.illuminance_lx / pi + square.veil_cdm2, square.background_cdm2,
                                   square.adaptation_cdm2, square.size_arcmin, {asked.age_years, asked.time_s, asked.k})
                : Value::not_measured(square.unknown);
        if (const auto number = value.number())
            clearest = std::max(clearest.value_or(0.0), *number);
        else if (reason.empty())
            reason = value.reason();
    }
    return clearest ? Value(*clearest) : Value::not_measured(reason);
}

void VisibilityFold::add_stand(const Moment& lit, const Ahead& ahead, double bumper_m, Stand& stand) const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    const double room_m = std::min(asked.ahead_m, route_.length_m() - bumper_m);
    std::vector<Place> places;
    for (std::size_t k = 1; static_cast<double>(k) * asked.step_m <= room_m; ++k) {
        const double ahead_m = static_cast<double>(k) * asked.step_m;
        places.push_back({ahead_m, bumper_m + ahead_m, squares(lit, ahead, bumper_m + ahead_m, stand)});
    }
    add_weather(lit, ahead, places);
    std::vector<std::vector<LineSample>> lines(stand.sights.size());
    for (const Place& place : places)
        for (std::size_t i = 0; i < lines.size(); ++i)
            lines[i].push_back(
                {place.ahead_m, place.squares.empty() ? std::nullopt : level(place.squares, *stand.sights[i].target).number()});
    const auto bent =
        std::ranges::find_if(places, [](const Place& place) { return !place.squares.empty() && !place.squares.front().no_mirror.empty(); });
    for (std::size_t i = 0; i < lines.size(); ++i) {
        // Where the route's end comes into sight, backgrounds of the last places are missing: the detection is cut off by it.
        const double wanted = stand.sights[i].target->level;
        const LitLine detected = lit_line(lines[i], wanted);
        const bool to_the_end = room_m < asked.ahead_m;
        const auto known = std::find_if(lines[i].rbegin(), lines[i].rend(), [](const LineSample& sample) { return sample.lx.has_value(); });
        const bool beyond = known != lines[i].rend() && *known->lx >= wanted;
        const auto found = [&](double metres) {
            return bent != places.end() ? Value::not_measured(bent->squares.front().no_mirror)
                   : !beyond            ? Value(metres)
                   : to_the_end         ? Value::not_measured("cut off by the end of the road or lane")
                                        : Value::at_least(metres);
        };
        stand.sights[i].detections.push_back({found(detected.last_m), found(detected.unlit_before_last_m)});
    }
    for (std::size_t d = 0; d < asked.distances_m.size(); ++d) {
        const double along_m = bumper_m + asked.distances_m[d];
        const bool ends = along_m > route_.length_m();
        std::vector<Place> there{{asked.distances_m[d], along_m, ends ? std::vector<Square>{} : squares(lit, ahead, along_m, stand)}};
        add_weather(lit, ahead, there);
        const std::vector<Square>& seen = there.front().squares;
        for (Sight& sight : stand.sights) {
            const Value now = !seen.empty() ? level(seen, *sight.target)
                                            : Value::not_measured(ends ? "the route ends nearer than this in some moment"
                                                                       : "the road has no such lane there");
            sight.at[d].series.push_back(now);
            if (const auto number = now.number())
                sight.at[d].level.push_back(*number);
            else
                sight.at[d].no_level = now.reason();
        }
    }
}

/// The road that the driver sees behind a place a hand above the own lane's centre.
void VisibilityFold::add_background(const Moment& lit, const Ahead& ahead, double along_m, Background& background) const {
    if (along_m > route_.length_m()) {
        background.missing = "the route ends nearer than this in some moment";
        return;
    }
    const Pose place = route_.pose(along_m);
    const std::optional<Pose> road = ahead.lane.behind(ahead.eye, place.position_m + background_above_m * place.up());
    if (!road) {
        background.missing = "the line of sight does not meet the road in some moment";
        return;
    }
    const SurfaceLuminance seen = seen_luminance(lit, road->position_m, road->up(), road_, ahead.eye.at_m);
    background.photopic.push_back(seen.photopic_cdm2);
    if (seen.photopic_cdm2 > 0.0 && lit.daylight.horizontal_illuminance_lx == 0.0)
        background.mesopic.push_back(mesopic_luminance(seen.photopic_cdm2, seen.scotopic_cdm2 / seen.photopic_cdm2).luminance_cdm2);
}

VisibilityFold::Ahead VisibilityFold::ahead_of(const Moment& lit) const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    Ahead ahead{LaneAhead(route_, lit.distance_m + drive_.bumper_m, asked.ahead_m + known_behind_m, asked.step_m), {}, {}};
    ahead.eye = ahead.lane.origin(to_parent(lit.ego, driver_eye_m(drive_)));
    for (const LitLamp& lamp : lit.lamps)
        ahead.lamps.push_back(ahead.lane.origin(lamp.pose.position_m));
    return ahead;
}

Value VisibilityFold::level_at(const Moment& moment, const VisibilityTarget& target, Across across, double ahead_m,
                               const Value& veil_cdm2) const {
    const Moment lit = with_lamps_that_shine(moment);
    const double along_m = lit.distance_m + drive_.bumper_m + ahead_m;
    if (along_m > route_.length_m())
        return Value::not_measured("the route ends nearer than this");
    if (!veil_cdm2.number())
        return veil_cdm2;
    const Ahead ahead = ahead_of(lit);
    std::vector<Place> there{{ahead_m, along_m, squares(lit, ahead, along_m, {across, target.size_m, target.squares, {}})}};
    add_weather(lit, ahead, there);
    for (Square& square : there.front().squares)
        if (square.adaptation_cdm2 >
            0.0) // before a road without light its level stays unknown: an eye adapted to the veil alone would see more
            square.adaptation_cdm2 += *veil_cdm2.number();
    return there.front().squares.empty() ? Value::not_measured("the road has no such lane there") : level(there.front().squares, target);
}

void VisibilityFold::add(const Moment& moment) {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    const Moment lit = with_lamps_that_shine(moment);
    const double bumper_m = moment.distance_m + drive_.bumper_m;
    const Ahead ahead = ahead_of(lit);
    ticks_.push_back(moment.tick);
    along_m_.push_back(moment.distance_m);
    for (Stand& stand : stands_)
        add_stand(lit, ahead, bumper_m, stand);
    for (std::size_t d = 0; d < backgrounds_.size(); ++d)
        add_background(lit, ahead, bumper_m + asked.distances_m[d], backgrounds_[d]);
}

Readings VisibilityFold::readings() const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    Readings readings;
    const auto median = [&](const ReadingKey& key, const std::string& conditions, const std::vector<double>& values,
                            const std::string& missing) {
        readings.push_back({key, missing.empty() ? median_value(values, "no moment was measured") : Value::not_measured(missing),
                            conditions + ", median"});
    };
    for (const Stand& stand : stands_)
        for (const Sight& sight : stand.sights) {
            const VisibilityTarget& target = *sight.target;
            const std::string where = fmt::format("{}, {}{} m with {} % reflectance, {}, visibility level {}", target.name,
                                                  target.squares > 1 ? fmt::format("{} squares of ", target.squares) : "a square of ",
                                                  target.size_m, 100.0 * target.reflectance, place_name(stand.across), target.level);
            CensoredSamples reach, undetected;
            for (const Detection& detection : sight.detections) {
                reach.add(detection.from_m);
                undetected.add(detection.undetected_m);
            }
            ReadingKey key = sight.key;
            const auto quantile = [&](Statistic statistic, const CensoredSamples& moments, double share, const char* what) {
                key.statistic = statistic;
                readings.push_back({key, moments.quantile(share), fmt::format("{}, {}; {}", where, what, moments.account())});
            };
            quantile(Statistic::median, reach, 0.5, "farthest place, median");
            quantile(Statistic::minimum, reach, 0.0, "farthest place, smallest");
            quantile(Statistic::p05, reach, 0.05, "farthest place, 5th percentile");
            key.quantity = Quantity::undetected;
            quantile(Statistic::median, undetected, 0.5, "nearer places where it is not, median");
            key.quantity = Quantity::visibility_level;
            for (std::size_t d = 0; d < sight.at.size(); ++d) {
                key.distance_m = asked.distances_m[d];
                median(key, fmt::format("{}, {} m ahead, level", where, asked.distances_m[d]), sight.at[d].level, sight.at[d].no_level);
            }
        }
    for (std::size_t d = 0; d < backgrounds_.size(); ++d) {
        const Background& seen = backgrounds_[d];
        const std::string where =
            fmt::format("own lane, road seen behind a place {} m ahead, {} m up", asked.distances_m[d], background_above_m);
        ReadingKey key{
            .quantity = Quantity::background_luminance, .lane = "own", .distance_m = asked.distances_m[d], .statistic = Statistic::median};
        median(key, where + ", luminance", seen.photopic, seen.missing);
        key.quantity = Quantity::mesopic_luminance;
        median(key, where + ", mesopic luminance (CIE 191)", seen.mesopic,
               !seen.missing.empty()                         ? seen.missing
               : seen.mesopic.size() == seen.photopic.size() ? ""
                                                             : "dark in some moment, or lit by a sky whose ratio S/P is not known");
    }
    return readings;
}

/// A figure of all detection distances; the levels are for those who read the file.
std::vector<SeeingSeries> VisibilityFold::series() const {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    std::vector<SeeingSeries> all;
    for (const Stand& stand : stands_)
        for (const Sight& sight : stand.sights) {
            SeeingSeries series{
                fmt::format("detection_{}_{}", sight.key.subject, sight.key.lane.empty() ? name_of(sight.key.place) : sight.key.lane),
                fmt::format("{}, {}", sight.target->name, place_name(stand.across)), "distance along the route", ticks_, along_m_};
            series.add({"detection_m", fmt::format("detection distance, level {}", sight.target->level), "m"}, sight.detections,
                       [](const Detection& detection) { return detection.from_m; });
            for (std::size_t d = 0; d < sight.at.size(); ++d)
                series.columns.push_back({fmt::format("visibility_level_at_{}m", asked.distances_m[d]),
                                          fmt::format("visibility level {} m ahead", asked.distances_m[d]), "", false, false,
                                          sight.at[d].series});
            all.push_back(std::move(series));
        }
    return all;
}

} // namespace fernlicht
