#include "runner/experiments/rating/rating_play.h"

#include "metrics/folds/place_fold.h"
#include "metrics/folds/seeing_fold.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace fernlicht {

[[noreturn]] void refuse_row(const Rating& rating, const RatingRow& row, const std::string& key, const std::string& found,
                             const std::string& expected) {
    throw InputError({rating.file, row.line, 0, fmt::format("rows.{}.{}", row.name, key)}, found, expected);
}

PlayedRating::PlayedRating(Drive drive)
    : owned(std::make_unique<Stage>(std::move(drive))), stage(*owned), lamp_set(stage.drive.lamp_sets.front()) {
    for (State state = start(stage.drive); state.tick < tick_count(stage.drive); state = advance(state, stage.drive)) {
        if (weather_of(stage.drive, state.time_s).wetness > 0.0)
            throw InputError({stage.drive.file, 0, 0, "weather"}, "a wet road, whose mirrored light a rating does not compute",
                             "a dry one");
        states.push_back(state);
    }
}

namespace {

/// What distance runs from, in the car's frame: the middle of the lamps, or of the bumper.
glm::dvec3 reference_m(const Stage& stage, const LampSet& lamp_set, DistanceFrom from) {
    if (from == DistanceFrom::bumper)
        return {stage.drive.bumper_m, 0.0, 0.0};
    glm::dvec3 sum(0.0);
    for (const MountedLamp& lamp : lamp_set.lamps)
        sum += lamp.position_m;
    return sum / static_cast<double>(std::max<std::size_t>(1, lamp_set.lamps.size()));
}

/// Where a photometer is in a moment, where it faces, and what distance runs to.
struct PlacedPhotometer {
    LightPlace place;
    glm::dvec3 distance_to_m{0.0};
};

class Photometry {
  public:
    Photometry(const Rating& rating, const RatingRow& row, const Photometer& photometer, const PlayedRating& played)
        : rating_(rating), photometer_(photometer), played_(played) {
        if (photometer.on.empty()) {
            const double at_m = *photometer.at_m;
            if (at_m > played.stage.route.length_m())
                refuse_row(
                    rating, row, "photometers",
                    fmt::format("photometer '{}' {:g} m along a route of {:.1f} m", photometer.name, at_m, played.stage.route.length_m()),
                    "a place on the drive's route");
            road_ = place_on_road(played.stage.route, photometer.across, at_m);
            if (!road_)
                refuse_row(rating, row, "photometers", fmt::format("no {} at {:g} m", place_name(photometer.across), at_m),
                           "a place that the drive's road has");
            return;
        }
        const std::vector<RoadUser>& users = played.stage.drive.traffic;
        const auto found = std::ranges::find(users, photometer.on, &RoadUser::name);
        if (found == users.end()) {
            std::vector<std::string> names;
            for (const RoadUser& user : users)
                names.push_back(user.name);
            refuse_row(rating, row, "photometers",
                       fmt::format("photometer '{}' on '{}', a road user that drive {} does not have", photometer.name, photometer.on,
                                   played.stage.drive.name),
                       names.empty() ? "a drive with traffic" : fmt::format("one of {}", fmt::join(names, ", ")));
        }
        user_ = static_cast<std::size_t>(found - users.begin());
    }

    /// nullopt: its road user is not there.
    std::optional<PlacedPhotometer> at(const Moment& moment) const {
        PlacedPhotometer placed;
        glm::dvec3 forward(0.0);
        if (road_) {
            placed.place.point_m = road_->position_m + photometer_.above_m * road_->up();
            placed.distance_to_m = placed.place.point_m;
            forward = road_->forward();
        } else {
            const Body& body = moment.bodies[*user_];
            if (!body.visible)
                return std::nullopt;
            const RoadUser& user = played_.stage.drive.traffic[*user_];
            placed.place.point_m = to_parent(body.pose, photometer_.position_m);
            forward = body.pose.forward();
            const glm::dvec3 rear = to_parent(body.pose, {user.rear_m, 0.0, 0.0}),
                             front = to_parent(body.pose, {user.rear_m + user.size_m.x, 0.0, 0.0});
            const bool faces_us = glm::dot(forward, moment.ego.forward()) < 0.0;
            placed.distance_to_m = rating_.rules.to == DistanceTo::photometer ? placed.place.point_m : faces_us ? front : rear;
        }
        if (photometer_.faces != PhotometerFacing::lamps) {
            placed.place.facing = Facing::eye;
            placed.place.normal = photometer_.faces == PhotometerFacing::forward ? forward : -forward;
        }
        return placed;
    }

  private:
    const Rating& rating_;
    const Photometer& photometer_;
    const PlayedRating& played_;
    std::optional<Pose> road_;
    std::optional<std::size_t> user_;
};

} // namespace

Nudge aimed_higher() {
    Nudge up;
    up.pitch_rad = nudge_aim_deg * std::numbers::pi / 180.0;
    return up;
}

Approaches approaches_of(const Rating& rating, const RatingRow& row, const std::vector<Photometer>& photometers,
                         const PlayedRating& played) {
    std::vector<Photometry> photometry;
    for (const Photometer& photometer : photometers)
        photometry.emplace_back(rating, row, photometer, played);
    const glm::dvec3 from_m = reference_m(played.stage, played.lamp_set, rating.rules.from);
    const std::size_t count = photometers.size();
    Approaches found{std::vector<LightApproach>(count), std::vector<LightApproach>(count), std::vector<std::vector<LightPlace>>(count), {}};
    for (const State& state : played.states) {
        const Moment moment = played.at(state), up = nudged(moment, aimed_higher());
        found.places.push_back({glm::dvec2(moment.ego.position_m), moment.speed_mps});
        const double pitch_deg = std::asin(std::clamp(moment.ego.forward().z, -1.0, 1.0)) * 180.0 / std::numbers::pi;
        for (std::size_t i = 0; i < photometers.size(); ++i) {
            const std::optional<PlacedPhotometer> placed = photometry[i].at(moment);
            if (!placed)
                continue;
            const glm::dvec3 way = placed->distance_to_m - to_parent(moment.ego, from_m);
            if (glm::dot(way, moment.ego.forward()) <= 0.0)
                continue;
            const double distance_m = std::hypot(way.x, way.y);
            found.as_aimed[i].push_back({moment.tick, moment.time_s, distance_m, light_lx(moment, placed->place), pitch_deg});
            found.lit[i].push_back(placed->place);
            found.higher[i].push_back({moment.tick, moment.time_s, distance_m, light_lx(up, placed->place), pitch_deg});
        }
    }
    return found;
}

} // namespace fernlicht
