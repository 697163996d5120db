// Automatic high beam, and its glare-free form: which windows meet others, told in the frame of the own car (x forward, y left, on the road
// under the rear axle).
// Bend light: where the lamps look, by steering angle, by yaw rate and speed, or by the lane ahead; and static cornering light: lamps that
// shine beside the car while it turns slowly. Filters are stepped exactly: how a time is cut into steps does not matter while the input
// holds.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/signals.h"
#include "scenarios/lamps/pixel_lamp.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// y' = (input - y) / time_constant_s; starts at the first input. A time constant of 0 follows at once.
struct FirstOrder {
    double time_constant_s = 0.0;
    double value = 0.0;
    bool started = false;

    double step(double input, double dt_s) {
        const double share = started && time_constant_s > 0.0 ? -std::expm1(-dt_s / time_constant_s) : 1.0;
        value += share * (input - value);
        started = true;
        return value;
    }
};

/// Moves towards `target` by at most `per_s` a second. `per_s` infinite: at once.
inline double moved_towards(double value, double target, double per_s, double dt_s) {
    const double most = per_s * dt_s;
    return std::isfinite(most) ? value + std::clamp(target - value, -most, most) : target;
}

/// What the laws know of the car.
struct ControlledCar {
    double wheelbase_m = 2.7;
    double self_steering_s2_per_m = 0.0; ///< steering for a bend of curvature k: (wheelbase + this * v^2) k
};

class BendLight {
  public:
    BendLight(const BendParameters& parameters, const ControlledCar& car);

    /// Angle in rad, left positive, inside the actuator's limits. A car on a circle of curvature k comes, after a way of v T, to a place at
    /// the angle k v T / 2 from where it points now: steering gives k = steering / (l + EG v^2), the yaw rate r gives k v = r, the lane
    /// ahead gives the angle itself. A signal that is lost, or a car that stands or reverses, has the lamps look straight ahead.
    double step(const SignalTable& table, double dt_s);
    /// Whether the last step had the signals that it needs.
    bool lost() const { return lost_; }

  private:
    double wanted_rad(const SignalTable& table) const;

    BendParameters parameters_;
    ControlledCar car_;
    FirstOrder filter_;
    bool lost_ = false;
};

/// The lamp's own angle: the lamp outside of the bend takes `outer_share`. `left_m`: where the lamp sits.
double bend_of_lamp_rad(const BendParameters& parameters, double bend_rad, double left_m);

class CorneringLight {
  public:
    explicit CorneringLight(const CorneringParameters& parameters) : parameters_(parameters) {}

    struct Levels {
        double left = 0.0, right = 0.0;
    };
    /// On by steering beyond `on_rad` until it is below `off_rad`, or by the indicator; never from `until_speed_mps` on until slower than
    /// `again_below_mps`. Fades in `fade_s`. A signal that is lost turns them off.
    Levels step(const SignalTable& table, double dt_s);

  private:
    CorneringParameters parameters_;
    bool slow_ = true, left_ = false, right_ = false;
    Levels levels_;
};

struct OtherUser {
    std::string name;
    double ahead_m = 0.0, left_m = 0.0; ///< of the middle of its nearer end
    double heading_rad = 0.0;           ///< against the own car's; 0: drives the same way
    double speed_mps = 0.0;
    double width_m = 1.8, height_m = 1.5;
    bool lamps_on = true;
    double up_m = 0.0; ///< of the road under it, against the road under the own car
    bool bicycle = false;
    bool hidden = false; ///< its lamps, from the own car's camera, by the road or by other vehicles
    bool told = false;   ///< by another's camera: a mask for it whatever its distance, and nothing is known of how it moves

    bool oncoming() const { return heading_rad > 1.5707963267948966 || heading_rad < -1.5707963267948966; }
    bool operator==(const OtherUser&) const = default;
};

/// A place on the own lane's centre ahead.
struct RoadPoint {
    double along_m = 0.0; ///< from the rear axle along the lane
    double ahead_m = 0.0, left_m = 0.0;
    double curvature_per_m = 0.0; ///< left bends positive

    bool operator==(const RoadPoint&) const = default;
};

struct Surroundings {
    std::vector<OtherUser> others;
    std::vector<RoadPoint> road; ///< only where a plug-in asks for it
};

/// On when the car is fast enough, the road dark and nobody near; each with a hysteresis of its own. Dips after `dip_delay_s`, comes after
/// `on_delay_s`, fades in `fade_s`. A lost signal dips.
class HighBeam {
  public:
    /// `dips`: others have it dipped; false where windows go dark instead.
    HighBeam(const HighBeamParameters& parameters, bool dips) : parameters_(parameters), dips_(dips) {}
    /// Its level, 0 to 1.
    double step(const SignalTable& table, double dt_s);

  private:
    bool wanted(const SignalTable& table);

    HighBeamParameters parameters_;
    bool dips_, fast_ = false, dark_ = false, on_ = false, started_ = false;
    double other_s_ = 0.0, level_ = 0.0;
};

/// Where a lamp is in the car's frame, and where it points: left and up positive.
struct LampPlace {
    glm::dvec3 position_m{0.0};
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0; ///< as axes_from_angles has them
};

struct OwnMotion {
    double speed_mps = 0.0, yaw_rate_rad_s = 0.0;
};

/// Where the other will be in the car's frame then: straight on at his speed, the car on its circle.
OtherUser seen_later(OtherUser other, const OwnMotion& own, double after_s);

/// The own car's camera, behind the windscreen: ahead of the rear axle, above the road.
inline constexpr double camera_x_m = 1.9, camera_z_m = 1.3;

/// A road user as another's camera at the same place tells of him: edges in the car's frame without its pitch, left and up positive.
struct SeenBox {
    double left_rad = 3.14, right_rad = -3.14, bottom_rad = -1.57, top_rad = 1.57;
    double distance_m = std::numeric_limits<double>::infinity(); ///< along the car's axis
};
/// Of the road user's near end; nullopt: it is not before the camera.
std::optional<SeenBox> box_from_camera(const OtherUser& other);
/// The inverse: who takes up this box. Infinitely far is farther than a lamp is from the camera.
OtherUser user_in_box(const SeenBox& box);

/// Dark windows, or pixels, of one lamp.
class LampWindows {
  public:
    LampWindows(std::vector<AngleBox> windows, const GlareFreeParameters& parameters)
        : windows_(std::move(windows)), parameters_(parameters), levels_(windows_.size(), 1.0), since_s_(levels_.size(), 0.0) {}

    /// Level of each window. A window goes dark `mask_delay_s` after some other user, with the margin to each side, is in it or between
    /// where he is and where he will be `foresee_s` later, and lights up `relight_delay_s` after the last.
    const std::vector<double>& step(const std::vector<OtherUser>& others, const HighBeamParameters& reach, const LampPlace& lamp,
                                    const OwnMotion& own, double dt_s);

  private:
    std::vector<AngleBox> windows_;
    GlareFreeParameters parameters_;
    std::vector<double> levels_;
    std::vector<double> since_s_; ///< how long each has been asked to be otherwise
    bool started_ = false;
};

/// The angles that a road user takes up, seen from a lamp, from the road under it to its top; nullopt: it is not before the lamp.
std::optional<AngleBox> seen_box(const OtherUser& other, const LampPlace& lamp);

/// Between a dark window and its lit neighbour the light rises over this angle, inside the neighbour.
inline constexpr double window_edge_deg = 0.1;

/// The table with the intensity of each window of H times its level; where windows meet, the darker one holds. Outside the windows nothing
/// changes. `windows_deg`: from, to, ascending; `levels`: one each, 0 to 1. Throws std::invalid_argument for a wrong number of levels.
CandelaTable masked(const CandelaTable& table, const std::vector<std::pair<double, double>>& windows_deg,
                    const std::vector<double>& levels);

} // namespace fernlicht
