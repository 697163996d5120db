#include "metrics/folds/place_fold.h"

#include "metrics/glare/wet_road.h"
#include "metrics/seeing/visibility.h"
#include "scenarios/light/light.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

/// Where boards stand: beside or over the road, and how high. Places usual on country roads, ours.
struct BoardPlace {
    ReadingPlace place;
    Across from;
    double left_m, above_m;
};
constexpr BoardPlace boards[] = {{ReadingPlace::right, Across::right_edge, -2.0, 2.0},
                                 {ReadingPlace::left, Across::left_edge, 2.0, 2.0},
                                 {ReadingPlace::overhead, Across::own_centre, 0.0, 5.5}};

/// The moment without lamps that a crest of the road hides from a point.
Moment reaching(const Moment& moment, const RoadBetween& road, const glm::dvec3& point) {
    Moment lit = moment;
    std::erase_if(lit.lamps, [&](const LitLamp& lamp) { return lamp.intensity_factor == 0.0 || road.hides(lamp.pose.position_m, point); });
    return lit;
}

} // namespace

PlaceFold::PlaceFold(const Drive& drive, const Route& route)
    : drive_(drive), route_(route), board_(material_named("board")), marking_(material_named("marking-white", drive.road_surface)) {
    const PlaceParameters& asked = *drive.seeing.places;
    for (const double distance_m : asked.distances_m) {
        const auto figure = [&](Quantity quantity, ReadingSurface surface, ReadingPlace place, const std::string& where) {
            figures_.push_back(
                {{.quantity = quantity, .surface = surface, .place = place, .distance_m = distance_m, .statistic = Statistic::median},
                 fmt::format("{} m ahead of the bumper, {}, median", distance_m, where),
                 {},
                 {}});
        };
        if (asked.kerb) {
            figure(Quantity::kerb_illuminance, ReadingSurface::road, ReadingPlace::none, "right edge of the lanes, on the road");
            figure(Quantity::kerb_illuminance, ReadingSurface::target, ReadingPlace::none,
                   "0.25 m over the right edge of the lanes, facing the lamps");
        }
        for (const BoardPlace& board : boards)
            if (asked.boards) {
                figure(Quantity::board_illuminance, ReadingSurface::none, board.place,
                       fmt::format("board {} m up, on its face", board.above_m));
                figure(Quantity::board_luminance, ReadingSurface::none, board.place,
                       fmt::format("board {} m up, as the driver sees it, class RA2 as pictures have it", board.above_m));
            }
        if (asked.markings)
            for (const ReadingPlace side : {ReadingPlace::right, ReadingPlace::left})
                figure(Quantity::marking_luminance, ReadingSurface::none, side,
                       fmt::format("white marking on the own lane's {} edge, as the driver sees it", name_of(side)));
    }
}

void PlaceFold::add(const Moment& moment) {
    const PlaceParameters& asked = *drive_.seeing.places;
    const glm::dvec3 eye_m = to_parent(moment.ego, driver_eye_m(drive_));
    std::size_t next = 0;
    const auto say = [&](std::optional<double> value, const std::string& missing) {
        Figure& figure = figures_[next++];
        if (value)
            figure.values.push_back(*value);
        else if (figure.missing.empty())
            figure.missing = missing;
    };
    for (const double distance_m : asked.distances_m) {
        const double at_m = moment.distance_m + drive_.bumper_m + distance_m;
        const bool on_route = at_m <= route_.length_m();
        const char* const no_place = on_route ? "there is no such lane in some moment" : "beyond the route's end in some moment";
        const auto say_there = [&](bool there, const std::string& unknown, const auto& value) {
            say(there && unknown.empty() ? std::optional<double>(value()) : std::nullopt, there ? "in some moment: " + unknown : no_place);
        };
        const CrossSection section = route_.cross_section(at_m);
        const RoadBetween road(route_, moment.distance_m, at_m);
        if (asked.kerb) {
            const std::optional<double> edge_m = on_route ? offset_across_m(section, Across::right_edge) : std::nullopt;
            const Pose surface = route_.pose(at_m, edge_m.value_or(0.0));
            const glm::dvec3 above = surface.position_m + kerb_target_m * surface.up();
            const Moment low = reaching(moment, road, surface.position_m), high = reaching(moment, road, above);
            const RoadLight by_film = light_by_road(high, route_, at_m, above, drive_.road_surface.pavement);
            say_there(edge_m.has_value(), "", [&] { return surface_illuminance_lx(low, surface.position_m, surface.up()); });
            say_there(edge_m.has_value(), by_film.unknown, [&] { return target_illuminance_lx(high, above) + facing_lx(by_film.patches); });
        }
        for (const BoardPlace& place : boards) {
            if (!asked.boards)
                break;
            const std::optional<double> from_m = on_route ? offset_across_m(section, place.from) : std::nullopt;
            const Pose surface = route_.pose(at_m, from_m.value_or(0.0) + place.left_m);
            const glm::dvec3 point = surface.position_m + place.above_m * surface.up(), face = -surface.forward();
            const Moment lit = reaching(moment, road, point);
            const RoadLight by_film = light_by_road(lit, route_, at_m, point, drive_.road_surface.pavement);
            say_there(from_m.has_value(), by_film.unknown,
                      [&] { return surface_illuminance_lx(lit, point, face) + illuminance_by_road_lx(by_film.patches, point, face); });
            say_there(from_m.has_value(), by_film.unknown,
                      [&] { return seen_luminance(lit, point, face, board_, eye_m, by_film.patches).photopic_cdm2; });
        }
        if (!asked.markings)
            continue;
        const auto own = std::ranges::find(section.lanes, "own", &RouteLane::name);
        for (const double RouteLane::*side : {&RouteLane::right_m, &RouteLane::left_m}) {
            const bool there = on_route && own != section.lanes.end();
            const Pose surface = route_.pose(at_m, there ? *own.*side : 0.0);
            const Moment lit = reaching(moment, road, surface.position_m);
            say_there(there, "", [&] { return seen_luminance(lit, surface.position_m, surface.up(), marking_, eye_m).photopic_cdm2; });
        }
    }
}

Readings PlaceFold::readings() const {
    Readings readings;
    for (const Figure& figure : figures_)
        readings.push_back(
            {figure.key, figure.missing.empty() ? median_value(figure.values, "no moment was played") : Value::not_measured(figure.missing),
             figure.where});
    return readings;
}

SensorFold::SensorFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {
    for (const Sensor& sensor : drive.seeing.sensors->points) {
        const std::optional<double> left_m = offset_across_m(route.cross_section(sensor.at_m), sensor.across);
        followed_.emplace_back();
        if (!left_m)
            continue;
        const Pose surface = route.pose(sensor.at_m, *left_m);
        followed_.back().point_m = surface.position_m + sensor.above_m * surface.up();
    }
}

void SensorFold::add(const Moment& moment) {
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        Followed& here = followed_[i];
        const Sensor& sensor = drive_.seeing.sensors->points[i];
        const double to_go_m = sensor.at_m - moment.distance_m - drive_.bumper_m;
        here.passed = here.passed || to_go_m < 0.0;
        if (!here.point_m || to_go_m < 0.0)
            continue;
        const RoadLight by_film = light_over_road(moment, route_, sensor.at_m, *here.point_m, drive_.road_surface.pavement);
        if (here.unknown.empty())
            here.unknown = by_film.unknown;
        const double lx = facing_lx(lamps_over_road(moment, route_, sensor.at_m, *here.point_m)) + facing_lx(by_film.patches);
        for (const LitLamp& lamp : moment.lamps)
            here.near_field = here.near_field || glm::distance(lamp.pose.position_m, *here.point_m) < lamp.photometric_distance_m;
        here.approach.push_back({moment.time_s, to_go_m, by_film.unknown.empty() ? std::optional(lx) : std::nullopt});
        here.ticks.push_back(moment.tick);
    }
}

Readings SensorFold::readings() const {
    Readings readings;
    const SensorParameters& parameters = *drive_.seeing.sensors;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        const Sensor& sensor = parameters.points[i];
        const Followed& here = followed_[i];
        const std::string cut = cut_short(here.approach, here.passed);
        const std::string where = fmt::format(
            "{}, {} m along the route, {} m above the road, facing the lamps{}{}", place_name(sensor.across), sensor.at_m, sensor.above_m,
            here.near_field ? ", near-field: nearer than a lamp's photometric distance" : "", cut.empty() ? "" : "; " + cut);
        const auto say = [&](const ReadingKey& key, Value found) {
            if (here.point_m && !here.unknown.empty())
                found = Value::not_measured("in some moment: " + here.unknown);
            if (!here.point_m)
                found = Value::not_measured(fmt::format("there is no {} at {} m", place_name(sensor.across), sensor.at_m));
            readings.push_back({key, found, where});
            readings.back().key.subject = sensor.name;
        };
        for (const double limit : parameters.thresholds_lx)
            say({.quantity = Quantity::sensor_reach, .threshold = {limit, ThresholdUnit::lx}},
                reached_from_m(here.approach, limit, here.passed));
        for (const double distance_m : parameters.distances_m) {
            say({.quantity = Quantity::sensor_illuminance, .distance_m = distance_m}, value_at(here.approach, distance_m));
            if (readings.back().value.measured())
                readings.back().between_moments = unknown_at(here.approach, distance_m);
        }
        say({.quantity = Quantity::sensor_illuminance, .statistic = Statistic::maximum},
            Value::of(largest(here.approach), "no moment of the drive before this place was measured"));
    }
    return readings;
}

std::vector<SeeingSeries> SensorFold::series() const {
    std::vector<SeeingSeries> all;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        const Sensor& sensor = drive_.seeing.sensors->points[i];
        SeeingSeries series{"sensor_" + sensor.name, fmt::format("Sensor \u201c{}\u201d", sensor.name), "distance to the sensor",
                            followed_[i].ticks};
        for (const ApproachSample& sample : followed_[i].approach)
            series.at_m.push_back(sample.distance_m);
        series.add({"facing_lx", "facing illuminance", "lx", true}, followed_[i].approach,
                   [](const ApproachSample& sample) { return Value::of(sample.value, "not measured at this place"); });
        all.push_back(std::move(series));
    }
    return all;
}

std::optional<double> offset_across_m(const CrossSection& section, Across across) {
    if (across == Across::own_centre)
        return 0.0;
    std::optional<double> offset_m;
    for (const RouteLane& lane : section.lanes) {
        if (lane.type != "driving")
            continue;
        const double centre_m = 0.5 * (lane.left_m + lane.right_m);
        if (across == Across::right_edge && (!offset_m || lane.right_m < *offset_m))
            offset_m = lane.right_m;
        if (across == Across::left_edge && (!offset_m || lane.left_m > *offset_m))
            offset_m = lane.left_m;
        if (across == Across::oncoming_centre && !lane.same_direction && (!offset_m || std::abs(centre_m) < std::abs(*offset_m)))
            offset_m = centre_m;
    }
    return offset_m;
}

std::optional<Pose> place_on_road(const Route& route, Across across, double along_m) {
    const std::optional<double> offset_m =
        across == Across::own_centre ? 0.0 : offset_across_m(route.cross_section(along_m), across); // which takes its time
    return offset_m ? std::optional(route.pose(along_m, *offset_m)) : std::nullopt;
}

std::string place_name(Across across) {
    return across == Across::own_centre        ? "centre of the own lane"
           : across == Across::oncoming_centre ? "centre of the nearest oncoming lane"
           : across == Across::right_edge      ? "right edge of the lanes"
                                               : "left edge of the lanes";
}

glm::dvec3 driver_eye_m(const Drive& drive) {
    const View* const view = driver_view(drive);
    return view ? view->position_m : glm::dvec3(1.3, 0.35, 1.2);
}

Material material_named(const std::string& name, const RoadSurface& surface) {
    for (const Material& material : road_materials(surface))
        if (material.name == name)
            return material;
    throw std::logic_error("no material " + name);
}

} // namespace fernlicht
