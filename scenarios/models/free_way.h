// Streets of a model that comes without a road: where its ground lies, and where a car has the longest free way ahead.
#pragma once

#include "scenarios/values/scene.h"

#include <optional>

namespace fernlicht {

/// The lowest surface that faces up, or what lies on it within 0.3 m, on a grid of half a metre or, where the scene is larger than 1 km, of
/// a two-thousandth of it. Scenes beyond 4 km are taken as far as 2 km about their middle.
class SceneGround {
  public:
    explicit SceneGround(const Scene& scene);

    /// nullopt: nothing faces up there.
    std::optional<double> height_m(double x_m, double y_m) const;
    /// Ground, and nothing between 0.3 and 2.2 m above it.
    bool is_free(double x_m, double y_m) const;

    /// Where a car whose rear axle stands there, looking along `yaw_rad`, comes before something 2.5 m wide meets what stands on the
    /// ground, its edge or a step of 0.2 m; 0 to 200 m.
    double free_way_m(double x_m, double y_m, double yaw_rad) const;
    /// The rear axle on the ground, wheels 2.7 m apart: its height and pitch. nullopt without ground.
    std::optional<Pose> car_at(double x_m, double y_m, double yaw_rad) const;

    /// The place with the longest free way, of several the nearest to the middle. Where materials of the ground are named road, street,
    /// lane or asphalt, on these alone. nullopt where no car can stand.
    std::optional<Pose> longest_free_way() const;

    /// Makes what lies on the ground `terrain`, which stands in maps, in meshes of its own; the rest stays what it is.
    void mark_ground(Scene& scene) const;

  private:
    struct Cell {
        float height_m, lowest_m;
        bool blocked = false, road = false;
    };
    /// Into cells_; nullopt beside the grid.
    std::optional<std::size_t> index(double x_m, double y_m) const;
    template <class Use> void each_point(const glm::dvec3 (&corners)[3], Use use);
    void add_ground(const Scene& scene);
    void add_obstacles(const Scene& scene);

    double low_x_m_ = 0.0, low_y_m_ = 0.0, cell_m_ = 0.5;
    int across_ = 0, along_ = 0;
    std::vector<Cell> cells_; ///< heights are NaN where there is no ground
};

} // namespace fernlicht
