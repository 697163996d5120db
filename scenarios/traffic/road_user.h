// Another road user: what it is, where it goes, which lamps it has.
// Where something is at any time: time-stamped poses, and what lies between them.
#pragma once

#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/values/pose.h"

#include <filesystem>
#include <glm/vec2.hpp>
#include <vector>

namespace fernlicht {

struct TrackPoint {
    double time_s = 0.0;
    Pose pose; ///< in the world: on the road's surface under the rear axle, x forward, y left, z up
    double speed_mps = 0.0;

    bool operator==(const TrackPoint&) const = default;
};

/// A pure function of time. Between points places follow cubic Hermite curves with the points' velocities (speed along x), axes turn at a
/// constant rate about one axis, speeds are linear. Before the first and after the last point it stands there.
class Track {
  public:
    /// Times ascend strictly. Throws std::invalid_argument for no points or times that do not ascend.
    explicit Track(std::vector<TrackPoint> points);

    TrackPoint at(double time_s) const;
    double first_s() const { return points_.front().time_s; }
    double last_s() const { return points_.back().time_s; }
    const std::vector<TrackPoint>& points() const { return points_; }

  private:
    std::vector<TrackPoint> points_;
};

enum class RoadUserKind { car, van, truck, bus, motorcycle, bicycle, pedestrian, other };

enum class LampFunction { low, high, daytime, position, fog, tail, brake, rear_fog, reverse, indicator_left, indicator_right, other };

struct TrafficLamp {
    MountedLamp lamp; ///< in the road user's frame; always with a file
    LampFunction function = LampFunction::low;
    glm::dvec2 face_m{0.16, 0.12}; ///< width and height of the luminous face, each > 0
};

struct RoadUser {
    std::string name;
    RoadUserKind kind = RoadUserKind::car;
    glm::dvec3 size_m{4.5, 1.8, 1.45}; ///< length, width, height
    double rear_m = -0.9;              ///< x of its rear end in its frame
    std::filesystem::path model;       ///< "": a body of our own by kind and size
    double model_yaw_rad = 0.0, model_scale = 1.0;
    std::vector<TrafficLamp> lamps;
    std::vector<LampChange> changes; ///< of its lamps by name, by time
    std::shared_ptr<const Track> track;
    std::vector<std::pair<double, bool>> visibility; ///< from these times on, ascending; seen before the first

    /// One of its lamps with the changes up to then.
    MountedLamp lamp_at(const TrafficLamp& mounted, double time_s) const;
    bool visible_at(double time_s) const; ///< never before the track's first and after its last point
};

/// Length, width and height of the kind's usual body, and the x of its rear end.
glm::dvec3 default_size_m(RoadUserKind kind);
double default_rear_m(RoadUserKind kind);

/// "car", "van" ...; the index of a word is the kind's.
inline constexpr const char* road_user_kinds[] = {"car", "van", "truck", "bus", "motorcycle", "bicycle", "pedestrian", "other"};

/// By a lamp's name: what contains "high", "fog", "tail", "brake", "position", "daytime", "reverse", "indicator-left" (-right) is that; all
/// else is a low beam.
LampFunction function_of(std::string_view lamp_name);

/// Red lamps at the rear: two tail lamps of tail_cd and two brake lamps of brake_cd on their axes (each >= 0; 0: none), the latter off
/// until a change lights them. Our own beam shape: full on the axis, a half at 15 degrees to the side or 6 degrees up or down.
std::vector<TrafficLamp> rear_lamps(const glm::dvec3& size_m, double rear_m, double tail_cd, double brake_cd);

} // namespace fernlicht
