#include "metrics/folds/place_fold.h"

#include "metrics/glare/eye_light.h"
#include "metrics/seeing/visibility.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/light/light.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double kerb_target_m = 0.25;

/// Where boards stand: beside or over the road, and how high. Places usual on country roads, ours.
struct BoardPlace {
    ReadingPlace place;
    Across from;
    double left_m, above_m;
};
constexpr BoardPlace boards[] = {{ReadingPlace::right, Across::right_edge, -2.0, 2.0},
                                 {ReadingPlace::left, Across::left_edge, 2.0, 2.0},
                                 {ReadingPlace::overhead, Across::own_centre, 0.0, 5.5}};

Material material_named(const std::string& name) {
    for (const Material& material : road_materials())
        if (material.name == name)
            return material;
    throw std::logic_error("no material " + name);
}

/// The moment without lamps that a crest of the road hides from a point.
Moment reaching(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point) {
    Moment lit = moment;
    std::erase_if(lit.lamps, [&](const LitLamp& lamp) {
        return lamp.intensity_factor == 0.0 || road_hides(route, moment.distance_m, to_m, lamp.pose.position_m, point);
    });
    return lit;
}

} // namespace

PlaceFold::PlaceFold(const Drive& drive, const Route& route)
    : drive_(drive), route_(route), board_(material_named("board")), marking_(material_named("marking-white")) {
    const View* const view = driver_view(drive);
    eye_m_ = view ? view->position_m : glm::dvec3(1.3, 0.35, 1.2);
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
    const glm::dvec3 eye_m = to_parent(moment.ego, eye_m_);
    std::size_t next = 0;
    const auto say = [&](std::optional<double> value, const char* missing) {
        Figure& figure = figures_[next++];
        if (value)
            figure.values.push_back(*value);
        else if (figure.missing.empty())
            figure.missing = missing;
    };
    for (const double distance_m : asked.distances_m) {
        const double at_m = moment.distance_m + drive_.bumper_m + distance_m;
        const bool on_route = at_m <= route_.length_m();
        const char* const missing = on_route ? "there is no such lane in some moment" : "beyond the route's end in some moment";
        const CrossSection section = route_.cross_section(at_m);
        if (asked.kerb) {
            const std::optional<double> edge_m = on_route ? offset_across_m(section, Across::right_edge) : std::nullopt;
            const Pose surface = route_.pose(at_m, edge_m.value_or(0.0));
            const glm::dvec3 above = surface.position_m + kerb_target_m * surface.up();
            const Moment low = reaching(moment, route_, at_m, surface.position_m), high = reaching(moment, route_, at_m, above);
            say(edge_m ? std::optional(surface_illuminance_lx(low, surface.position_m, surface.up())) : std::nullopt, missing);
            say(edge_m ? std::optional(target_illuminance_lx(high, above)) : std::nullopt, missing);
        }
        for (const BoardPlace& place : boards) {
            if (!asked.boards)
                break;
            const std::optional<double> from_m = on_route ? offset_across_m(section, place.from) : std::nullopt;
            const Pose surface = route_.pose(at_m, from_m.value_or(0.0) + place.left_m);
            const glm::dvec3 point = surface.position_m + place.above_m * surface.up(), face = -surface.forward();
            const Moment lit = reaching(moment, route_, at_m, point);
            say(from_m ? std::optional(surface_illuminance_lx(lit, point, face)) : std::nullopt, missing);
            say(from_m ? std::optional(surface_luminance(lit, point, face, board_, eye_m).photopic_cdm2) : std::nullopt, missing);
        }
        if (!asked.markings)
            continue;
        const auto own = std::ranges::find(section.lanes, "own", &RouteLane::name);
        for (const double RouteLane::*side : {&RouteLane::right_m, &RouteLane::left_m}) {
            const bool there = on_route && own != section.lanes.end();
            const Pose surface = route_.pose(at_m, there ? *own.*side : 0.0);
            const Moment lit = reaching(moment, route_, at_m, surface.position_m);
            say(there ? std::optional(surface_luminance(lit, surface.position_m, surface.up(), marking_, eye_m).photopic_cdm2)
                      : std::nullopt,
                missing);
        }
    }
}

Readings PlaceFold::readings() const {
    Readings readings;
    for (const Figure& figure : figures_) {
        const std::optional<Spread> spread = figure.missing.empty() ? spread_of(figure.values) : std::nullopt;
        readings.push_back(
            {figure.key,
             spread ? Value(spread->median) : Value::not_measured(figure.missing.empty() ? "no moment was played" : figure.missing),
             figure.where});
    }
    return readings;
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

std::string place_name(Across across) {
    switch (across) {
    case Across::own_centre:
        return "centre of the own lane";
    case Across::oncoming_centre:
        return "centre of the nearest oncoming lane";
    case Across::right_edge:
        return "right edge of the lanes";
    case Across::left_edge:
        break;
    }
    return "left edge of the lanes";
}

} // namespace fernlicht
