#include "scenarios/drives/play/control_world.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/storyboard_timeline.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double road_ahead_m = 200.0, road_step_m = 5.0; ///< what plug-ins are shown (fernlicht_control.h)
constexpr double beside_route_m = 20.0;                   ///< farther from its route a track is somewhere else
constexpr double seen_lamp_m = 0.65;                      ///< above the road
constexpr double shortest_bearing_m = 5.0;                ///< nearer, the direction to a place on the lane says nothing of the bend

} // namespace

struct ControlWorld::Parts {
    Parts(const Drive& drive, const Route& route, const CarRun* car)
        : drive_(drive), route_(route), car_(car),
          course_(road_course(route, std::min(route.length_m(), farthest_m(drive, route) + 320.0))) {}

    ControlInputs at(double time_s, const ControlParameters& control) const {
        ControlInputs in;
        in.time_s = time_s;
        drive_.ego_track ? on_track(in, control) : car_ ? on_springs(in) : on_rails(in);
        in.acceleration_mps2 = acceleration_mps2(time_s, control.period_s);
        const bool on_lane = is_on_lane(time_s);
        if (on_lane)
            see_lane(in, control);
        if (on_lane && !control.plugins.empty())
            in.surroundings.road = road_ahead(in);
        if (!drive_.traffic.empty() && (control.high_beam || !control.plugins.empty()))
            see_others(in);
        if (control.camera && control.camera->hides)
            hide(in);
        in.load_pitch_rad = load_on_springs(control.load).spring_pitch_rad;
        in.illuminance_lx = horizontal_lx(time_s);
        in.wetness = weather_of(drive_, time_s).wetness;
        return in;
    }

    Resting load_on_springs(const AxleLoad& load) const {
        const VehicleParameters car = drive_.vehicle.value_or(VehicleParameters{});
        const auto springs_m = [](double n, const AxleParameters& axle) { return -n / axle.spring_n_per_m; };
        const auto tyres_m = [](double n, const AxleParameters& axle) { return -n / axle.tyre_spring_n_per_m; };
        const double front_m = springs_m(load.front_n, car.front), rear_m = springs_m(load.rear_n, car.rear);
        const double front_tyre_m = tyres_m(load.front_n, car.front), rear_tyre_m = tyres_m(load.rear_n, car.rear);
        return {(front_m - rear_m) / drive_.wheelbase_m, (front_m + front_tyre_m - rear_m - rear_tyre_m) / drive_.wheelbase_m,
                rear_m + rear_tyre_m};
    }

    static double farthest_m(const Drive& drive, const Route& route) {
        if (drive.live || drive.bus_motion)
            return route.length_m();
        if (!drive.ego_track || !drive.timeline)
            return distance_m(drive.speed, drive.duration_s);
        double farthest = 0.0;
        for (const TrackPlace& place : drive.timeline->places)
            farthest = std::max(farthest, place.distance_m);
        return farthest;
    }

    /// On its route, or on a track that runs along it: then the lane ahead is the road's.
    bool is_on_lane(double time_s) const {
        if (!drive_.ego_track)
            return true;
        const auto place = track_place(drive_, time_s);
        return place && std::abs(place->offset_left_m) < beside_route_m;
    }

    /// The lane that the car is on lies so far to the left of the route's: cars that a track moves change lanes.
    double lane_left_m(double time_s) const {
        const auto place = track_place(drive_, time_s);
        return place ? place->lane_left_m : 0.0;
    }

    /// Of a line beside the route's lane (parallel curves: 1 / (R - offset)).
    double curvature_per_m(double distance_m, double left_m = 0.0) const {
        double derivative = 0.0;
        const double k = RoadCourse::at(course_.curvature_per_m, distance_m, derivative);
        return left_m == 0.0 ? k : k / (1.0 - k * left_m);
    }

    /// The rear axle follows the lane's centre: it turns by the lane's curvature, and the front wheels stand as the lane's bend asks.
    void on_rails(ControlInputs& in) const {
        in.distance_m = route_distance_m(drive_, in.time_s);
        in.speed_mps = own_speed_mps(drive_, in.time_s);
        const double k = curvature_per_m(in.distance_m);
        in.yaw_rate_rad_s = k * in.speed_mps;
        in.steering_rad = std::atan(k * drive_.wheelbase_m);
    }

    void on_springs(ControlInputs& in) const {
        const CarPlace place = car_->at(in.time_s);
        in.distance_m = std::max(place.distance_m, 0.0);
        in.speed_mps = place.speed_mps;
        in.yaw_rate_rad_s = place.yaw_rate_rad_s;
        in.steering_rad = place.steering_rad;
        in.spring_pitch_rad = place.spring_pitch_rad;
    }

    /// Far from its route a track is the only thing that knows the lane ahead: where the car will be. Rates are differences over 10 ms to
    /// each side.
    void on_track(ControlInputs& in, const ControlParameters& control) const {
        const double t_s = in.time_s;
        in.distance_m = route_distance_m(drive_, t_s);
        in.speed_mps = drive_.ego_track->at(t_s).speed_mps;
        in.yaw_rate_rad_s = track_yaw_rate_rad_s(t_s);
        in.curvature_per_m = track_curvature_per_m(t_s);
        in.steering_rad = std::atan(in.curvature_per_m * drive_.wheelbase_m);
        const double v = std::max(in.speed_mps, 1.0);
        in.curvature_25m_per_m = track_curvature_per_m(t_s + 25.0 / v);
        in.curvature_50m_per_m = track_curvature_per_m(t_s + 50.0 / v);
        in.curvature_100m_per_m = track_curvature_per_m(t_s + 100.0 / v);
        const double preview_s = control.bend ? control.bend->preview_s : 0.0;
        const glm::dvec3 there = to_local(ego(in), drive_.ego_track->at(t_s + preview_s).pose.position_m);
        in.bearing_ahead_rad = std::hypot(there.x, there.y) > 1.0 ? std::atan2(there.y, there.x) : 0.0;
    }

    double track_yaw_rate_rad_s(double time_s) const {
        constexpr double beside_s = 0.01;
        const glm::dvec3 before = drive_.ego_track->at(time_s - beside_s).pose.forward();
        const glm::dvec3 after = drive_.ego_track->at(time_s + beside_s).pose.forward();
        return std::remainder(std::atan2(after.y, after.x) - std::atan2(before.y, before.x), 2.0 * pi) / (2.0 * beside_s);
    }

    double track_curvature_per_m(double time_s) const {
        const double v = drive_.ego_track->at(time_s).speed_mps;
        return std::abs(v) > 0.5 ? std::clamp(track_yaw_rate_rad_s(time_s) / v, -1.0, 1.0) : 0.0;
    }

    void see_lane(ControlInputs& in, const ControlParameters& control) const {
        const double left_m = lane_left_m(in.time_s);
        in.curvature_per_m = curvature_per_m(in.distance_m, left_m);
        in.curvature_25m_per_m = curvature_per_m(in.distance_m + 25.0, left_m);
        in.curvature_50m_per_m = curvature_per_m(in.distance_m + 50.0, left_m);
        in.curvature_100m_per_m = curvature_per_m(in.distance_m + 100.0, left_m);
        if (control.bend && control.bend->law == BendLaw::route)
            in.bearing_ahead_rad = bearing_rad(in, std::max(in.speed_mps * control.bend->preview_s, shortest_bearing_m));
    }

    /// Road users as a camera without faults has them: those ahead, nothing hides them.
    void see_others(ControlInputs& in) const {
        const Pose from = ego(in);
        for (const RoadUser& user : drive_.traffic) {
            if (!user.track || !user.visible_at(in.time_s))
                continue;
            const TrackPoint at = user.track->at(in.time_s);
            const glm::dvec3 forward = at.pose.forward() * from.axes; // in the car's frame
            OtherUser other;
            other.name = user.name;
            other.heading_rad = std::atan2(forward.y, forward.x);
            const double near_x_m = other.oncoming() ? user.rear_m + user.size_m.x : user.rear_m;
            const glm::dvec3 near_end = to_local(from, to_parent(at.pose, {near_x_m, 0.0, 0.0}));
            other.ahead_m = near_end.x;
            other.left_m = near_end.y;
            other.up_m = near_end.z;
            other.speed_mps = at.speed_mps;
            other.width_m = user.size_m.y;
            other.height_m = user.size_m.z;
            other.lamps_on = shines(user, in.time_s);
            other.bicycle = user.kind == RoadUserKind::bicycle;
            if (other.ahead_m > 0.0)
                in.surroundings.others.push_back(std::move(other));
        }
    }

    /// From the camera to the middle of each other's lamps: what of the road, and which other vehicles, stand in between. A vehicle is a
    /// wall of its width and height where its nearer end is.
    void hide(ControlInputs& in) const {
        const auto height_m = [](const glm::dvec2& to, double z_m, double ahead_m) {
            return camera_z_m + (z_m - camera_z_m) * (ahead_m - camera_x_m) / (to.x - camera_x_m);
        };
        const Pose from = ego(in);
        std::vector<OtherUser>& others = in.surroundings.others;
        for (OtherUser& other : others) {
            const glm::dvec2 to(other.ahead_m, other.left_m);
            const double lamps_z_m = other.up_m + seen_lamp_m;
            for (double along_m = road_step_m; !other.hidden && along_m < to.x && in.distance_m + along_m < route_.length_m();
                 along_m += road_step_m) {
                const glm::dvec3 road = to_local(from, to_parent(route_.pose(in.distance_m + along_m), {}));
                other.hidden = road.x > camera_x_m && road.x < to.x && road.z > height_m(to, lamps_z_m, road.x);
            }
            for (const OtherUser& between : others)
                if (between.ahead_m > camera_x_m && between.ahead_m < to.x && &between != &other) {
                    const double left_m = to.y * (between.ahead_m - camera_x_m) / (to.x - camera_x_m);
                    other.hidden = other.hidden || (std::abs(left_m - between.left_m) < 0.5 * between.width_m &&
                                                    between.up_m + between.height_m > height_m(to, lamps_z_m, between.ahead_m));
                }
        }
    }

    static bool shines(const RoadUser& user, double time_s) {
        return std::ranges::any_of(user.lamps,
                                   [&](const TrafficLamp& mounted) { return user.lamp_at(mounted, time_s).intensity_factor() > 0.0; });
    }

    /// Diffuse, and of the sun or the moon on a level plane.
    double horizontal_lx(double time_s) const {
        const Daylight daylight = daylight_of(drive_, time_s);
        const DirectLight* const direct = daylight.direct();
        return daylight.horizontal_illuminance_lx +
               (direct ? direct->illuminance_lx * std::max(std::sin(direct->elevation_rad), 0.0) : 0.0);
    }

    double acceleration_mps2(double time_s, double period_s) const {
        const double before_s = std::max(time_s - period_s, 0.0), span_s = time_s - before_s;
        const auto speed = [&](double t_s) {
            return drive_.ego_track ? drive_.ego_track->at(t_s).speed_mps : car_ ? car_->at(t_s).speed_mps : own_speed_mps(drive_, t_s);
        };
        return span_s > 0.0 ? (speed(time_s) - speed(before_s)) / span_s : 0.0;
    }

    /// Without pitch and roll.
    Pose ego(const ControlInputs& in) const {
        if (drive_.ego_track)
            return drive_.ego_track->at(in.time_s).pose;
        const CarPlace place = car_ ? car_->at(in.time_s) : CarPlace{};
        Pose pose = route_.pose(std::min(in.distance_m, route_.length_m()), place.offset_left_m);
        pose.axes = pose.axes * axes_from_angles(place.heading_rad, 0.0, 0.0);
        return pose;
    }

    /// A place on the centre of the car's lane; beyond the route's end the lane goes on straight.
    glm::dvec3 lane_m(double at_m, double left_m) const {
        const Pose pose = route_.pose(std::min(at_m, route_.length_m()), left_m);
        return pose.position_m + std::max(at_m - route_.length_m(), 0.0) * pose.forward();
    }

    double bearing_rad(const ControlInputs& in, double ahead_m) const {
        const glm::dvec3 there = to_local(ego(in), lane_m(in.distance_m + ahead_m, lane_left_m(in.time_s)));
        return std::atan2(there.y, there.x);
    }

    std::vector<RoadPoint> road_ahead(const ControlInputs& in) const {
        const Pose from = ego(in);
        const double left_m = lane_left_m(in.time_s);
        std::vector<RoadPoint> road;
        for (double along_m = 0.0; along_m <= road_ahead_m; along_m += road_step_m) {
            const glm::dvec3 there = to_local(from, lane_m(in.distance_m + along_m, left_m));
            road.push_back({along_m, there.x, there.y, curvature_per_m(in.distance_m + along_m, left_m)});
        }
        return road;
    }

    const Drive& drive_;
    const Route& route_;
    const CarRun* car_;
    RoadCourse course_;
};

ControlWorld::ControlWorld(const Drive& drive, const Route& route, const CarRun* car)
    : parts_(std::make_unique<const Parts>(drive, route, car)) {}
ControlWorld::~ControlWorld() = default;

ControlInputs ControlWorld::at(double time_s, const ControlParameters& control) const { return parts_->at(time_s, control); }
ControlWorld::Resting ControlWorld::load_on_springs(const AxleLoad& load) const { return parts_->load_on_springs(load); }

} // namespace fernlicht
