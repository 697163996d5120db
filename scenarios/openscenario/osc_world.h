// The storyboard's world at one moment: where every entity is, how positions of the file become places, and distances between them.
#pragma once

#include "scenarios/openscenario/storyboard.h"
#include "scenarios/roads/road_finder.h"
#include "scenarios/values/errors.h"

namespace fernlicht::osc {

/// Seconds, metres, metres per second: what is no nearer than this counts as the same.
inline constexpr double small = 1e-6;

/// A position of the file that is nowhere on the network; who asked for it knows the line. Fragments as InputError takes them.
struct PlaceError {
    std::string found, expected;
};
/// A position relative to an entity that never had a place so far.
struct NoPlaceYet : PlaceError {
    std::string entity;
};

/// What `call` gives; where it cannot be placed, an InputError at this element.
template <class Call> auto placed(const std::filesystem::path& file, std::size_t line, const std::string& element, const Call& call) {
    try {
        return call();
    } catch (const PlaceError& error) {
        throw InputError({file, line, 0, element}, error.found, error.expected);
    }
}

/// Where something stands, in the world and on the network.
struct Spot {
    Pose pose; ///< x forward, z the surface's normal
    bool on_network = false;
    std::size_t road = 0;                        ///< the nearest one
    int lane = 0;                                ///< the lane that offset counts from; 0: the reference line with its lane offset
    double s_m = 0.0, t_m = 0.0, offset_m = 0.0; ///< offset from the lane's centre, to the left of the reference line
    double relative_heading_rad = 0.0;           ///< to the reference line's direction

    double heading_rad() const;
    /// Looks towards growing s.
    bool with_s() const;
};

/// Roads to follow, each with the direction of travel and the lane to leave it on; from where the entity was when it was planned.
struct RoadPath {
    struct Step {
        std::size_t road;
        bool with_s;
        int lane;
        double length_m;
    };
    std::vector<Step> steps;
    std::size_t at = 0; ///< step that the entity is on
    Spot goal;
};

struct EntityState {
    const Entity* entity = nullptr;
    bool present = false, visible = true;
    bool placed = false; ///< ever; one that was deleted keeps its last place for what is relative to it
    Spot spot;
    double speed_mps = 0.0; ///< along its heading; negative backwards
    double travelled_m = 0.0;
    glm::dvec3 velocity_mps{0.0}, acceleration{0.0}; ///< over the step before
    bool end_of_road = false;
    std::optional<double> end_of_road_since_s, offroad_since_s, still_since_s;
    std::optional<RoadPath> path;      ///< of AssignRoute or AcquirePosition
    std::optional<double> settle_to_m; ///< offset that it glides to beside its way: a lane left for its route's sake

    void stand_at(const Spot& at) {
        spot = at;
        present = placed = true;
    }
};

class World {
  public:
    World(const Storyboard& storyboard, const RoadNetwork& network);

    const std::filesystem::path& file() const { return storyboard_->file; }
    const RoadNetwork& network() const { return *network_; }
    std::vector<EntityState>& entities() { return entities_; }
    const std::vector<EntityState>& entities() const { return entities_; }
    EntityState& entity(const std::string& name);
    const EntityState& entity(const std::string& name) const;
    std::size_t index_of(const std::string& name) const;

    /// On a lane, heading relative to the reference line. Throws PlaceError where the road has no such lane. s is clamped to the road.
    Spot on_lane(std::size_t road, int lane, double s_m, double offset_m, double relative_heading_rad) const;
    /// At a point of the world; without z on the road's surface, without pitch and roll as it lies there.
    Spot at_point(const glm::dvec3& position_m, bool has_z, double heading_rad, std::optional<double> pitch_rad = {},
                  std::optional<double> roll_rad = {}, std::optional<std::size_t> preferred = {}) const;
    /// A position of the file. `self`: whose position it becomes, for what is relative to it. Throws PlaceError.
    Spot spot(const Position& position) const;

    std::map<std::string, std::string> parameters, variables, signals, phases;
    double time_s = 0.0;
    std::optional<Environment> environment;
    double environment_since_s = 0.0; ///< when its time of day was given
    double day_rate = 1.0;            ///< seconds of an animated time of day for one of the story

  private:
    const Storyboard* storyboard_;
    const RoadNetwork* network_;
    RoadFinder finder_;
    std::vector<EntityState> entities_;
    std::map<std::string, std::size_t> index_;
};

const Lane* lane_of(const Road& road, int id, double s_m); ///< nullptr: the road has none of this id there
/// The lane nearest to t that has width, on either side; 0 where there is none.
int nearest_lane(const Road& road, double s_m, double t_m);
/// Heading of travel of a lane, relative to the reference line: 0 or pi.
double lane_direction_rad(const Road& road, int lane, double s_m);

/// By the measure; nullopt where no road leads from one to the other. Longitudinal and lateral ones have a sign: ahead and left of the
/// first are positive; straight ones have none.
std::optional<double> distance(const World& world, const EntityState& from, const EntityState& to, const Measure& measure);
std::optional<double> distance(const World& world, const EntityState& from, const Spot& to, const Measure& measure);

/// Along the road, where none leads there along the first one's axis; ahead positive.
double longitudinal_gap(const World& world, const EntityState& from, const EntityState& to, bool freespace);
/// How far an entity still has to go to a place: along the road, else straight; below 0 beyond it.
double way_to(const World& world, const EntityState& from, const Spot& to);
/// The boxes overlap, seen from above.
bool touching(const EntityState& a, const EntityState& b);

struct Moved {
    Spot spot;
    bool end_of_road = false; ///< the lane leads nowhere: the spot lies at its end
};

/// Moves along the lane that the spot is on (its offset kept), the way it looks; backwards for a distance below zero. `actual`: the
/// distance is that on the spot's own path; where the reference line bends with curvature k and the spot lies t beside it, s grows by
/// distance / (1 - k t). At junctions `path` decides, else the least turn.
Moved move_along(const World& world, const Spot& from, double distance_m, bool actual, RoadPath* path);

/// The shortest way over lanes (changes of lane count as `lane_change_m`) from a spot, the way it looks, through all goals in order. A
/// first goal that already lies behind is left out. nullopt: there is no way.
std::optional<RoadPath> plan_path(const World& world, const Spot& from, const std::vector<Spot>& goals);
inline constexpr double lane_change_m = 30.0;

/// Signed distance along reference lines from one spot to another, ahead of the first positive; nullopt where no road leads there within
/// `max_m` either way.
std::optional<double> distance_along(const World& world, const Spot& from, const Spot& to, double max_m = 2000.0);

} // namespace fernlicht::osc
