#include "metrics/folds/mask_scene.h"

#include "metrics/folds/place_fold.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {
namespace {

constexpr double lane_step_m = 1.0;    ///< between places at which a crest is looked for
constexpr double nearest_eye_m = 15.0; ///< nearer, a lamp is hardly a point, and no source has limits
constexpr double farthest_walker_m = 200.0;

/// Whether some road user but one, by Drive::traffic, stands between both points.
bool body_hides(const Drive& drive, const Moment& moment, const glm::dvec3& from_m, const glm::dvec3& to_m,
                std::size_t but = std::numeric_limits<std::size_t>::max()) {
    for (std::size_t user = 0; user < drive.traffic.size() && user < moment.bodies.size(); ++user)
        if (user != but && moment.bodies[user].visible &&
            box_hides({drive.traffic[user].size_m, drive.traffic[user].rear_m}, moment.bodies[user].pose, from_m, to_m))
            return true;
    return false;
}

/// Of the first row that names the photometer, at that distance.
std::optional<double> limit_of(const Rating& limits, const Photometer& photometer, double distance_m) {
    for (const RatingRow& row : limits.rows) {
        if (std::ranges::find(row.photometers, photometer.name) == row.photometers.end())
            continue;
        for (const LimitRange& range : limits_named(limits, row.limits)->ranges)
            if (range.at_most_lx && distance_m >= range.from_m && distance_m < range.to_m)
                return range.limit_lx(distance_m);
        return std::nullopt;
    }
    return std::nullopt;
}

} // namespace

glm::dvec3 middle_of_lamps_m(const Moment& moment) {
    glm::dvec3 sum(0.0);
    for (const LitLamp& lamp : moment.lamps)
        sum += lamp.pose.position_m;
    return sum / static_cast<double>(std::max<std::size_t>(1, moment.lamps.size()));
}

MaskScene::MaskScene(const Drive& drive, const Route& route, const Rating& limits, const MaskPlaces& places, const VisibilityTarget& walker,
                     const Moment& moment)
    : walker_(walker) {
    const glm::dvec3 lamps_m = middle_of_lamps_m(moment);
    add_targets(drive, route, places, moment, lamps_m);
    add_eyes(drive, route, limits, moment, lamps_m);
    if (!walkers_.empty())
        add_veils(drive, route, moment);
}

void MaskScene::add_targets(const Drive& drive, const Route& route, const MaskPlaces& places, const Moment& moment,
                            const glm::dvec3& lamps_m) {
    const double bumper_m = moment.distance_m + drive.bumper_m;
    const LaneAhead lane(route, bumper_m, places.to_m, lane_step_m);
    const LaneAhead::Origin from = lane.origin(lamps_m);
    const auto rows = static_cast<int>(std::ceil((places.to_m - places.from_m) / places.row_m - 1e-9));
    const double row_m = (places.to_m - places.from_m) / rows;
    for (int row = 0; row < rows; ++row) {
        const double at_m = bumper_m + places.from_m + (row + 0.5) * row_m;
        if (at_m > route.length_m())
            return;
        const CrossSection section = route.cross_section(at_m);
        const auto own = std::ranges::find(section.lanes, "own", &RouteLane::name);
        if (own == section.lanes.end())
            continue;
        const bool hidden = lane.hides(from, to_parent(route.pose(at_m), {0.0, 0.0, places.above_m}));
        const auto add_strip = [&](double right_m, double left_m, bool verge) {
            const auto columns = std::max(1, static_cast<int>(std::ceil((left_m - right_m) / places.across_m - 1e-9)));
            const double wide_m = (left_m - right_m) / columns;
            (verge ? verge_m2_ : lane_m2_) += row_m * (left_m - right_m);
            for (int column = 0; !hidden && column < columns; ++column) {
                const Pose surface = route.pose(at_m, right_m + (column + 0.5) * wide_m);
                const glm::dvec3 point = surface.position_m + places.above_m * surface.up();
                if (!body_hides(drive, moment, lamps_m, point))
                    targets_.push_back({point, row_m * wide_m, verge});
            }
        };
        add_strip(own->right_m, own->left_m, false);
        if (const std::optional<double> edge_m = offset_across_m(section, places.left_hand ? Across::left_edge : Across::right_edge))
            places.left_hand ? add_strip(*edge_m, *edge_m + places.verge_m, true) : add_strip(*edge_m - places.verge_m, *edge_m, true);
    }
}

void MaskScene::add_eyes(const Drive& drive, const Route& route, const Rating& limits, const Moment& moment, const glm::dvec3& lamps_m) {
    for (std::size_t user = 0; user < drive.traffic.size() && user < moment.bodies.size(); ++user) {
        const Body& body = moment.bodies[user];
        if (!body.visible || drive.traffic[user].kind == RoadUserKind::pedestrian)
            continue;
        const bool oncoming = glm::dot(body.pose.forward(), moment.ego.forward()) < 0.0;
        const glm::dvec3 gaze = oncoming ? body.pose.forward() : -body.pose.forward();
        for (const Photometer& photometer : limits.photometers) {
            if (photometer.on.empty() || photometer.faces != (oncoming ? PhotometerFacing::forward : PhotometerFacing::backward))
                continue;
            const glm::dvec3 point = to_parent(body.pose, photometer.position_m), way = point - lamps_m;
            const double distance_m = std::hypot(way.x, way.y);
            if (glm::dot(way, moment.ego.forward()) <= 0.0 || distance_m < nearest_eye_m || body_hides(drive, moment, lamps_m, point, user))
                continue;
            Place& place = eyes_.emplace_back(Place{user, point, gaze, distance_m, limit_of(limits, photometer, distance_m), {}});
            if (const auto at_m = along_route_m(route, point, moment.distance_m + distance_m))
                place.road.emplace(route, moment.distance_m, *at_m);
        }
        const RoadUser& kind = drive.traffic[user];
        const glm::dvec3 front = to_parent(body.pose, {kind.rear_m + kind.size_m.x, 0.0, 0.0});
        const double straight_m = glm::dot(front - moment.ego.position_m, moment.ego.forward());
        if (const auto at_m = oncoming ? along_route_m(route, front, moment.distance_m + straight_m) : std::nullopt) {
            const double ahead_m = *at_m - moment.distance_m - drive.bumper_m;
            if (ahead_m > 0.0 && ahead_m <= farthest_walker_m)
                walkers_.push_back({user, ahead_m});
        }
    }
}

/// What other lamps veil for a driver who looks at the middle of the walker; those that a crest hides from his eye do not.
void MaskScene::add_veils(const Drive& drive, const Route& route, Moment moment) {
    const glm::dvec3 eye_m = to_parent(moment.ego, driver_eye_m(drive));
    double farthest_m = 0.0;
    for (const LitLamp& lamp : moment.other_lamps)
        farthest_m = std::max(farthest_m, glm::distance(eye_m, lamp.pose.position_m));
    const RoadBetween road(route, moment.distance_m, std::min(moment.distance_m + farthest_m, route.length_m()));
    std::erase_if(moment.other_lamps, [&](const LitLamp& lamp) { return road.hides(lamp.pose.position_m, eye_m); });
    std::vector<BodyBox> boxes;
    for (const RoadUser& user : drive.traffic)
        boxes.push_back({user.size_m, user.rear_m});
    const auto veil = [&](Across across, double ahead_m) {
        const std::optional<Pose> foot = place_on_road(route, across, moment.distance_m + drive.bumper_m + ahead_m);
        if (!foot)
            return Value::not_measured("the road has no such lane there");
        const glm::dvec3 middle = foot->position_m + 0.5 * walker_.squares * walker_.size_m * foot->up();
        const std::vector<GlareSource> sources = traffic_glare(moment, eye_m, glm::normalize(middle - eye_m), boxes);
        return veiling_luminance_cdm2(VeilingEquation::cie_general, sources, {.age_years = drive.seeing.visibility->age_years});
    };
    for (Walker& walker : walkers_) {
        walker.left_veil_cdm2 = veil(Across::left_edge, walker.ahead_m);
        walker.right_veil_cdm2 = veil(Across::right_edge, walker.ahead_m);
    }
}

MaskLight MaskScene::light(const Moment& moment, const VisibilityFold& visibility) const {
    MaskLight light;
    std::vector<double> lx(targets_.size());
    oneapi::tbb::parallel_for(std::size_t{0}, targets_.size(),
                              [&](std::size_t i) { lx[i] = target_illuminance_lx(moment, targets_[i].point_m); });
    double lane = 0.0, verge = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i)
        (targets_[i].verge ? verge : lane) += lx[i] * targets_[i].area_m2;
    const auto mean = [](double sum, double area) { return area > 0.0 ? sum / area : 0.0; };
    light.lane_lx = mean(lane, lane_m2_);
    light.verge_lx = mean(verge, verge_m2_);
    light.both_lx = mean(lane + verge, lane_m2_ + verge_m2_);
    for (const Place& place : eyes_) {
        MaskLight::Eye eye{place.user, place.distance_m, 0.0, place.limit_lx};
        for (const SeenLamp& lamp : seen_lamps(moment, place.point_m))
            if (lamp.facing_lx > 0.0 && !(place.road && place.road->hides(lamp.position_m, place.point_m)))
                eye.lx += glare_source(lamp, place.point_m, place.gaze).eye_lx;
        light.eyes.push_back(eye);
    }
    for (const Walker& at : walkers_)
        light.walkers.push_back({at.user, at.ahead_m,
                                 visibility.level_at(moment, walker_, Across::left_edge, at.ahead_m, at.left_veil_cdm2),
                                 visibility.level_at(moment, walker_, Across::right_edge, at.ahead_m, at.right_veil_cdm2)});
    return light;
}

} // namespace fernlicht
