// A storyboard of OpenSCENARIO XML as plain values: what is on the road, and what shall happen when. Parameters are already put in.
#pragma once

#include "scenarios/values/files.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace fernlicht::osc {

enum class Shape { linear, cubic, sinusoidal, step };
enum class Dimension { rate, time, distance };
/// How a value gets from where it is to its target.
struct Dynamics {
    Shape shape = Shape::step;
    Dimension dimension = Dimension::time;
    double value = 0.0; ///< s, m, or the largest rate per second
};

struct Orientation {
    bool relative = false; ///< to the driving direction, or to the entity that the position leans on
    double h_rad = 0.0, p_rad = 0.0, r_rad = 0.0;
};

struct Route;
struct Trajectory;

struct WorldPosition {
    double x_m = 0.0, y_m = 0.0;
    std::optional<double> z_m, h_rad, p_rad, r_rad;
};
struct LanePosition {
    std::string road;
    int lane = 0;
    double s_m = 0.0, offset_m = 0.0;
};
struct RoadPosition {
    std::string road;
    double s_m = 0.0, t_m = 0.0;
};
struct RelativeLanePosition {
    std::string entity;
    int lanes = 0;
    double ds_m = 0.0, offset_m = 0.0;
};
struct RelativeRoadPosition {
    std::string entity;
    double ds_m = 0.0, dt_m = 0.0;
};
/// In the entity's own axes, or with `in_world` in the world's.
struct RelativePosition {
    std::string entity;
    double dx_m = 0.0, dy_m = 0.0, dz_m = 0.0;
    bool in_world = false;
};
struct RoutePosition {
    std::shared_ptr<const Route> route;
    double s_m = 0.0;        ///< along the route
    std::optional<int> lane; ///< in lane coordinates, with `offset_m`
    double offset_m = 0.0;
    std::optional<double> t_m;  ///< in road coordinates
    std::string current_entity; ///< where this entity is on the route
};
struct TrajectoryPosition {
    std::shared_ptr<const Trajectory> trajectory;
    double s_m = 0.0, t_m = 0.0;
};
struct Position {
    std::variant<WorldPosition, LanePosition, RoadPosition, RelativeLanePosition, RelativeRoadPosition, RelativePosition, RoutePosition,
                 TrajectoryPosition>
        place;
    std::optional<Orientation> orientation;
};

struct Route {
    std::vector<Position> waypoints;
};

struct Vertex {
    std::optional<double> time_s;
    Position position;
    double weight = 1.0; ///< of a control point
};
using Polyline = std::vector<Vertex>;
/// One piece: curvature grows by `dot_per_m2` over `length_m`.
struct ClothoidSegment {
    double curvature_per_m = 0.0, end_curvature_per_m = 0.0, length_m = 0.0, h_offset_rad = 0.0;
    std::optional<double> time_start_s, time_end_s;
    std::optional<Position> start;
};
/// Clothoid: one segment that begins at `start`. ClothoidSpline: several, each at the end of the one before.
using ClothoidPath = std::vector<ClothoidSegment>;
struct Nurbs {
    int order = 2; ///< degree + 1
    std::vector<Vertex> points;
    std::vector<double> knots; ///< points + order of them, never falling
};
struct Trajectory {
    bool closed = false;
    std::variant<Polyline, ClothoidPath, Nurbs> shape;
};

// ---- actions of one entity ----
struct RelativeSpeed {
    std::string entity;
    double value = 0.0;
    bool factor = false, continuous = false;
};
struct SpeedAction {
    Dynamics dynamics;
    std::variant<double, RelativeSpeed> target; ///< m/s
};
struct SpeedEntry {
    std::optional<double> duration_s; ///< since the entry before; without: as quick as the limits let
    double speed_mps = 0.0;
};
struct SpeedLimits {
    std::optional<double> acceleration, deceleration, speed_mps; ///< m/s2, positive
};
struct SpeedProfileAction {
    std::string relative_to; ///< "": absolute
    std::vector<SpeedEntry> entries;
    SpeedLimits limits;
};
struct RelativeLane {
    std::string entity;
    int lanes = 0;
};
struct LaneChangeAction {
    Dynamics dynamics;
    std::variant<int, RelativeLane> target; ///< lane
    double target_offset_m = 0.0;
};
struct RelativeOffset {
    std::string entity;
    double offset_m = 0.0;
};
struct LaneOffsetAction {
    Shape shape = Shape::step;
    std::optional<double> max_lateral_acceleration;
    bool continuous = false;
    std::variant<double, RelativeOffset> target;
};
struct LateralDistanceAction {
    std::string entity;
    double distance_m = 0.0;
    bool freespace = false, continuous = false;
    std::optional<double> max_speed_mps;
};
struct LongitudinalDistanceAction {
    std::string entity;
    std::optional<double> distance_m, time_gap_s;
    bool freespace = false, continuous = false;
    bool ahead = false, any_side = false; ///< the actor keeps ahead of the entity; either side
    SpeedLimits limits;
};
struct TeleportAction {
    Position position;
};
struct VisibilityAction {
    bool graphics = true;
};
enum class LightMode { off, on, flashing };
struct LightStateAction {
    std::string light; ///< OpenSCENARIO's name (lowBeam, highBeam, fogLights, ...), or the name of a user-defined light
    LightMode mode = LightMode::off;
    double transition_s = 0.0;
    double flash_on_s = 0.5, flash_off_s = 0.5;
};
struct FollowTrajectoryAction {
    std::shared_ptr<const Trajectory> trajectory;
    double initial_offset_m = 0.0;
    bool timed = false, time_absolute = false; ///< else at the entity's own speed
    double time_scale = 1.0, time_offset_s = 0.0;
};
struct AssignRouteAction {
    std::shared_ptr<const Route> route;
};
struct AcquirePositionAction {
    Position position;
};
struct FinalSpeed {
    bool relative = false; ///< to the master's
    double value = 0.0;
    std::optional<double> steady_distance_m, steady_time_s; ///< driven at the final speed before the target
};
struct SynchronizeAction {
    std::string master;
    Position master_target, target;
    std::optional<FinalSpeed> final_speed;
    double master_tolerance_m = 0.0, tolerance_m = 0.0;
};
/// Activating, assigning and overriding controllers: the storyboard's own motion goes on.
struct ControllerAction {};
using PrivateAction = std::variant<SpeedAction, SpeedProfileAction, LaneChangeAction, LaneOffsetAction, LateralDistanceAction,
                                   LongitudinalDistanceAction, TeleportAction, VisibilityAction, LightStateAction, FollowTrajectoryAction,
                                   AssignRouteAction, AcquirePositionAction, SynchronizeAction, ControllerAction>;

// ---- actions of the world ----
/// What is not given stays as it is.
struct Environment {
    std::optional<std::string> date_time; ///< ISO 8601
    bool time_runs = false;
    std::optional<std::string> cloud_state;                                       ///< free, cloudy, overcast, rainy; or "3 oktas" ...
    std::optional<double> sun_azimuth_rad, sun_elevation_rad, sun_illuminance_lx; ///< azimuth from north through east, as the file has it
    std::optional<double> fog_visual_range_m;
    std::optional<std::string> precipitation; ///< dry, rain, snow
    std::optional<double> precipitation_mm_per_h;
    std::optional<std::string> wetness; ///< dry, moist, wetWithPuddles, lowFlooded, highFlooded
};
struct EnvironmentAction {
    Environment environment;
};
struct EntityAction {
    std::string entity;
    std::optional<Position> add_at; ///< else it is deleted
};
struct SetValueAction {
    bool variable = false; ///< else a parameter
    std::string name, value;
    enum class How { set, add, multiply } how = How::set;
};
struct TrafficSignalAction {
    std::string name, state; ///< state of a signal, or phase of a controller
    bool controller = false;
};
using GlobalAction = std::variant<EnvironmentAction, EntityAction, SetValueAction, TrafficSignalAction>;

struct Action {
    std::string name;
    std::variant<PrivateAction, GlobalAction> what;
    std::size_t line = 0;
};

// ---- conditions ----
enum class Rule { greater, less, equal, greater_or_equal, less_or_equal, not_equal };
enum class Edge { none, rising, falling, either };
enum class Frame { entity, lane, road, trajectory, world };
enum class Span { straight, longitudinal, lateral };

struct LastingCondition {
    enum class State { end_of_road, offroad, standing } state = State::end_of_road;
    double duration_s = 0.0;
};
struct CollisionCondition {
    std::string entity, type; ///< one of the two
};
/// How a distance is measured.
struct Measure {
    Frame frame = Frame::entity;
    Span span = Span::straight;
    bool freespace = false;
};
struct TimeHeadwayCondition {
    std::string entity;
    double value_s = 0.0;
    Rule rule = Rule::greater;
    Measure measure;
};
using Target = std::variant<std::string, Position>; ///< an entity, or a place
struct TimeToCollisionCondition {
    Target target;
    double value_s = 0.0;
    Rule rule = Rule::greater;
    Measure measure;
};
enum class Direction { total, longitudinal, lateral, vertical };
struct AccelerationCondition {
    double value = 0.0;
    Rule rule = Rule::greater;
    Direction direction = Direction::total;
};
struct SpeedCondition {
    double value_mps = 0.0;
    Rule rule = Rule::greater;
    Direction direction = Direction::total;
    std::string relative_to; ///< RelativeSpeedCondition
};
struct TraveledDistanceCondition {
    double value_m = 0.0;
};
struct ReachPositionCondition {
    Position position;
    double tolerance_m = 0.0;
};
struct DistanceCondition {
    Target target;
    double value_m = 0.0;
    Rule rule = Rule::greater;
    Measure measure;
};
struct LaneRange {
    std::optional<int> from, to;
};
struct RelativeClearanceCondition {
    std::vector<std::string> entities; ///< empty: all others
    std::vector<LaneRange> lanes;      ///< empty: all
    double ahead_m = 0.0, behind_m = 0.0;
    bool freespace = false, opposite = false;
};
struct AngleCondition {
    bool pitch = false, roll = false; ///< else the heading
    bool to_lane = false;             ///< else to the world
    double angle_rad = 0.0, tolerance_rad = 0.0;
    std::string relative_to; ///< RelativeAngleCondition
};
using EntityCondition = std::variant<LastingCondition, CollisionCondition, TimeHeadwayCondition, TimeToCollisionCondition,
                                     AccelerationCondition, SpeedCondition, TraveledDistanceCondition, ReachPositionCondition,
                                     DistanceCondition, RelativeClearanceCondition, AngleCondition>;
struct ByEntity {
    bool all = false; ///< else any
    std::vector<std::string> entities;
    EntityCondition condition;
};

struct SimulationTimeCondition {
    double value_s = 0.0;
    Rule rule = Rule::greater;
};
struct TimeOfDayCondition {
    std::string date_time;
    Rule rule = Rule::greater;
};
struct NamedValueCondition {
    bool variable = false; ///< else a parameter
    std::string name, value;
    Rule rule = Rule::equal;
};
struct TrafficSignalCondition {
    std::string name, state;
    bool controller = false;
};
struct ElementStateCondition {
    std::string type, element, state; ///< act, name or path, completeState
};
using Condition =
    std::variant<ByEntity, SimulationTimeCondition, TimeOfDayCondition, NamedValueCondition, TrafficSignalCondition, ElementStateCondition>;
struct TimedCondition {
    double delay_s = 0.0;
    Edge edge = Edge::none;
    Condition condition;
    std::size_t line = 0;
};
/// True when all conditions of any group are. Without groups never.
struct Trigger {
    std::vector<std::vector<TimedCondition>> groups;
};

// ---- the tree ----
enum class Priority { overwrite, skip, parallel };
struct Event {
    std::string name;
    Priority priority = Priority::overwrite;
    int executions = 1;
    std::vector<Action> actions;
    std::optional<Trigger> start;
};
struct Maneuver {
    std::string name;
    std::vector<Event> events;
};
struct ManeuverGroup {
    std::string name;
    int executions = 1;
    bool select_triggering = false;
    std::vector<std::string> actors;
    std::vector<Maneuver> maneuvers;
};
struct Act {
    std::string name;
    std::vector<ManeuverGroup> groups;
    std::optional<Trigger> start, stop;
};
struct Story {
    std::string name;
    std::vector<Act> acts;
};

struct BoundingBox {
    double x_m = 1.4, y_m = 0.0, z_m = 0.75; ///< centre, in the entity's frame
    double length_m = 4.5, width_m = 1.8, height_m = 1.5;
};
enum class EntityKind { vehicle, pedestrian, object };
/// As conditions and selections of the file name it.
constexpr std::string_view type_of(EntityKind kind) {
    return kind == EntityKind::vehicle ? "vehicle" : kind == EntityKind::pedestrian ? "pedestrian" : "miscellaneous";
}
struct Entity {
    std::string name;
    EntityKind kind = EntityKind::vehicle;
    std::string category; ///< car, truck, bicycle, pedestrian, ...
    std::string model;    ///< the file of a 3D model, as written
    BoundingBox box;
    SpeedLimits limits; ///< Performance
};

struct InitAction {
    std::string entity; ///< "": an action of the world
    Action action;
};

struct TrafficPhase {
    std::string name;
    double duration_s = 0.0;
    std::vector<std::pair<std::string, std::string>> states; ///< signal, state
};
struct TrafficController {
    std::string name;
    double delay_s = 0.0;
    std::string reference;
    std::vector<TrafficPhase> phases;
};

struct Storyboard {
    std::filesystem::path file;
    int major = 1, minor = 0;
    std::string description;
    std::filesystem::path road_file; ///< "" where the file names none
    std::vector<Entity> entities;
    std::vector<TrafficController> signals;
    std::map<std::string, std::string> parameters, variables;
    std::vector<InitAction> init;
    std::vector<Story> stories;
    std::optional<Trigger> stop;
    std::vector<std::string> notes; ///< what was read otherwise than a reader of the file may think, one sentence each, with file and line
    FilesRead opened;
};

} // namespace fernlicht::osc
