#include "metrics/folds/visibility_fold.h"

#include "metrics/folds/place_fold.h"
#include "metrics/glare/wet_road.h"
#include "metrics/readings/value.h"
#include "metrics/road/lit_line.h"
#include "metrics/seeing/visibility.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/roads/mesh/mesh_materials.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double background_above_m = 0.1;
constexpr double added_spacing = 1.2; ///< from one place at which what the weather adds is integrated to the next

/// Lamps that are off cost time alone.
Moment with_lamps_that_shine(Moment moment) {
    std::erase_if(moment.lamps, [](const LitLamp& lamp) { return lamp.intensity_factor == 0.0; });
    return moment;
}

} // namespace

VisibilityFold::VisibilityFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {
    const VisibilityParameters& asked = *drive.seeing.visibility;
    backgrounds_.resize(asked.distances_m.size());
    for (const VisibilityTarget& target : asked.targets)
        for (const Across across : target.places) {
            auto stand = std::ranges::find_if(stands_, [&](const Stand& other) {
                return other.across == across && other.size_m == target.size_m && other.squares == target.squares;
            });
            if (stand == stands_.end())
                stand = stands_.insert(stands_.end(), {across, target.size_m, target.squares, {}});
            stand->sights.push_back({&target, detection_key(target, across), {}, {}});
            stand->sights.back().at.resize(asked.distances_m.size());
        }
}

std::vector<TargetSquare> VisibilityFold::squares(const Moment& moment, const SeenLane& ahead, double along_m, const Stand& stand) const {
    std::vector<TargetSquare> all = target_squares(moment, ahead, route_, along_m, stand.across, stand.size_m, stand.squares);
    light_squares(moment, ahead.eye.at_m, *drive_.seeing.visibility, drive_.road_surface.pavement, all);
    return all;
}

VisibilityFold::Added VisibilityFold::added(const Moment& moment, const SeenLane& ahead, double along_m, const TargetSquare& square) const {
    const auto air = [&](const glm::dvec3& to_m) { return lamps_airlight(moment, to_m, ahead.eye.at_m).photopic_cdm2; };
    Added added{air(square.middle_m), air(square.behind_m), 0.0};
    if (mirrors(moment.weather, drive_.road_surface.pavement) && !square.hidden) {
        const Moment lit = lamps_reaching(moment, square);
        added[2] = illuminance_by_road_lx(light_by_road(lit, route_, along_m, square.middle_m, drive_.road_surface.pavement).patches,
                                          square.middle_m, square.face);
    }
    return added;
}

void VisibilityFold::add_weather(const Moment& moment, const SeenLane& ahead, std::vector<Place>& places) const {
    if (!(moment.weather.extinction_per_m > 0.0) && !mirrors(moment.weather, drive_.road_surface.pavement))
        return;
    const auto squares_of = [](const Place& place) { return place.squares.size(); };
    const std::size_t most = places.empty() ? 0 : squares_of(*std::ranges::max_element(places, {}, squares_of));
    std::vector<double> adaptation_cdm2(places.size()); // of the road behind the lowest square
    for (std::size_t i = 0; i < most; ++i) {
        const auto fill = [&](std::size_t place, const Added& added) {
            TargetSquare& square = places[place].squares.at(i);
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

void VisibilityFold::add_stand(const Moment& lit, const SeenLane& ahead, double bumper_m, Stand& stand) const {
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
            lines[i].push_back({place.ahead_m, place.squares.empty()
                                                   ? std::nullopt
                                                   : target_level(place.squares, stand.sights[i].target->reflectance, asked).number()});
    const auto bent =
        std::ranges::find_if(places, [](const Place& place) { return !place.squares.empty() && !place.squares.front().no_mirror.empty(); });
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double wanted = stand.sights[i].target->level;
        const LitLine detected = lit_line(lines[i], wanted);
        const auto found = [&](double metres) {
            return bent != places.end() ? Value::not_measured(bent->squares.front().no_mirror)
                                        : known_detection(metres, lines[i], wanted, room_m < asked.ahead_m);
        };
        stand.sights[i].detections.push_back({found(detected.last_m), found(detected.unlit_before_last_m)});
    }
    for (std::size_t d = 0; d < asked.distances_m.size(); ++d) {
        const double along_m = bumper_m + asked.distances_m[d];
        const bool ends = along_m > route_.length_m();
        std::vector<Place> there{{asked.distances_m[d], along_m, ends ? std::vector<TargetSquare>{} : squares(lit, ahead, along_m, stand)}};
        add_weather(lit, ahead, there);
        const std::vector<TargetSquare>& seen = there.front().squares;
        for (Sight& sight : stand.sights) {
            const Value now = !seen.empty() ? target_level(seen, sight.target->reflectance, asked)
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
void VisibilityFold::add_background(const Moment& lit, const SeenLane& ahead, double along_m, Background& background) const {
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
    const SurfaceLuminance seen =
        seen_luminance(lit, road->position_m, road->up(), pavement_material(drive_.road_surface.pavement), ahead.eye.at_m);
    background.photopic.push_back(seen.photopic_cdm2);
    if (seen.photopic_cdm2 > 0.0 && lit.daylight.horizontal_illuminance_lx == 0.0)
        background.mesopic.push_back(mesopic_luminance(seen.photopic_cdm2, seen.scotopic_cdm2 / seen.photopic_cdm2).luminance_cdm2);
}

Value VisibilityFold::level_at(const Moment& moment, const VisibilityTarget& target, Across across, double ahead_m,
                               const Value& veil_cdm2) const {
    const Moment lit = with_lamps_that_shine(moment);
    const double along_m = lit.distance_m + drive_.bumper_m + ahead_m;
    if (along_m > route_.length_m())
        return Value::not_measured("the route ends nearer than this");
    if (!veil_cdm2.number())
        return veil_cdm2;
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    const SeenLane ahead(drive_, route_, asked, lit);
    std::vector<Place> there{{ahead_m, along_m, squares(lit, ahead, along_m, {across, target.size_m, target.squares, {}})}};
    add_weather(lit, ahead, there);
    for (TargetSquare& square : there.front().squares)
        if (square.adaptation_cdm2 >
            0.0) // before a road without light its level stays unknown: an eye adapted to the veil alone would see more
            square.adaptation_cdm2 += *veil_cdm2.number();
    return there.front().squares.empty() ? Value::not_measured("the road has no such lane there")
                                         : target_level(there.front().squares, target.reflectance, asked);
}

void VisibilityFold::add(const Moment& moment) {
    const VisibilityParameters& asked = *drive_.seeing.visibility;
    const Moment lit = with_lamps_that_shine(moment);
    const double bumper_m = moment.distance_m + drive_.bumper_m;
    const SeenLane ahead(drive_, route_, asked, lit);
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
