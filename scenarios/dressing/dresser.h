// Builds what stands beside roads, road by road: objects in place of plain ones, and what belongs beside such a road.
#pragma once

#include "scenarios/dressing/dressed_object.h"
#include "scenarios/dressing/dressing.h"
#include "scenarios/roads/road_finder.h"

#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace fernlicht {

struct Model;

enum class DressedKind { house, tree, bush, barrier, car, van, truck, bus };
std::optional<DressedKind> dressed_kind(const RoadObject& object);

/// Texture coordinates from the side on what stands, from above on what lies, along its slope on a roof.
void lay_pictures(TriangleSoup& soup);
void append_placed(TriangleSoup& into, const TriangleSoup& soup, const Pose& pose);

/// Places along the route, to ask how near it comes.
class Nearness {
  public:
    explicit Nearness(const Route& route) {
        for (double at = 0.0; at < route.length_m() + step_m; at += step_m)
            places_.push_back(route.pose(at).position_m);
    }
    /// Not farther than the true distance in plan.
    double nearest_m(const glm::dvec3& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& place : places_)
            least = std::min(least, std::hypot(place.x - p.x, place.y - p.y));
        return least - 0.5 * step_m;
    }

  private:
    static constexpr double step_m = 10.0;
    std::vector<glm::dvec3> places_;
};

/// Where objects stand, in cells.
class Occupied {
  public:
    static constexpr double widest_m = 10.0; ///< of one place of an object, and of what it reaches
    void add(const glm::dvec3& place_m, double reach_m) { cells_[cell(place_m, 0, 0)].emplace_back(place_m.x, place_m.y, reach_m); }
    /// A rectangle around a pose as places of squares, no side longer than `most_m`.
    void add_pieces(const Pose& pose, double length_m, double width_m, double most_m) {
        const auto pieces = [most_m](double side_m) { return static_cast<int>(std::clamp(std::ceil(side_m / most_m), 1.0, 1000.0)); };
        const int columns = pieces(length_m), rows = pieces(width_m);
        const double reach_m = 0.5 * std::hypot(length_m / columns, width_m / rows);
        for (int column = 0; column < columns; ++column)
            for (int row = 0; row < rows; ++row)
                add(to_parent(pose, {((column + 0.5) / columns - 0.5) * length_m, ((row + 0.5) / rows - 0.5) * width_m, 0.0}), reach_m);
    }
    /// `room_m` up to 6 m.
    bool none_within(const glm::dvec3& place_m, double room_m) const {
        for (long x = -1; x <= 1; ++x)
            for (long y = -1; y <= 1; ++y)
                if (const auto there = cells_.find(cell(place_m, x, y)); there != cells_.end())
                    for (const glm::dvec3& other : there->second)
                        if (std::hypot(other.x - place_m.x, other.y - place_m.y) < room_m + other.z)
                            return false;
        return true;
    }

  private:
    static std::pair<long, long> cell(const glm::dvec3& p, long dx, long dy) {
        return {std::lround(std::floor(p.x / 16.0)) + dx, std::lround(std::floor(p.y / 16.0)) + dy};
    }
    std::map<std::pair<long, long>, std::vector<glm::dvec3>> cells_;
};

class Dresser {
  public:
    Dresser(Scene& scene, const RoadNetwork& network, const Route& route, const DressingSettings& settings);
    void dress(const Road& road);

  private:
    static constexpr long stretch_m = 60;
    static constexpr double far_from_route_m = 300.0; ///< beyond it verges stay bare

    void occupy(const Road& road, const RoadObject& object);
    Dice dice(const Road& road, const RoadObject& object) const;
    Detail detail(const Pose& foot, double error_m) const;
    void add_mesh(const TriangleSoup& soup, const Pose& pose, const std::string& name, bool whole, bool closed, bool casts = true);
    void add(DressedObject object, const Pose& pose, const std::string& name);
    void add_body(const Model& model, const Pose& pose, const std::string& name);

    void add(const Road& road, const RoadObject& object, DressedKind look, std::map<long, TriangleSoup>& barriers);
    void add_house(const Road& road, const RoadObject& object, const Pose& foot, const std::string& name);
    void add_vehicle(const Road& road, const RoadObject& object, DressedKind look, const Pose& foot, const std::string& name);
    void add_sign(const Road& road, const RoadSignal& signal);

    void add_garden(const Road& road, const RoadObject& object, Dice drawn, const std::string& name);
    void add_people(const Road& road);
    void add_bollards(const Road& road);
    void add_verge(const Road& road, bool left);
    Pose beside(const Road& road, double s_m, bool left, double out_m) const;
    Pose grown_beside(const Road& road, double s_m, bool left, double out_m) const;
    bool is_free(const Road& road, const glm::dvec3& place_m, double room_m) const;
    bool is_clear(const Road& road, const glm::dvec3& place_m, int lane) const;

    void add_patches(const Road& road);
    void lay(const Road& road, const std::vector<glm::dvec2>& polygon_m, Stuff stuff, TriangleSoup& into) const;

    Scene& scene_;
    const RoadNetwork& network_;
    DressingSettings settings_;
    Nearness route_;
    RoadFinder finder_;
    Occupied objects_, footprints_; ///< roughly, with what sways about them; in pieces of a metre
    std::size_t road_meshes_;       ///< how many meshes there were before
    std::uint32_t first_;           ///< of the scene's materials
    std::size_t cars_ = 0;          ///< parked so far
};

/// The outermost lane on one side at s, lane 0 where there is none.
const Lane& outer_lane(const Road& road, double s_m, bool left);
double outer_edge_m(const Road& road, double s_m, bool left);
/// Of the outermost lane above the road's surface: a sidewalk's.
double edge_height_m(const Road& road, double s_m, bool left);
bool is_walked(const Lane& lane);
constexpr double field_m = 180.0; ///< along the road; its edge may have a ditch and a fence
/// On six of ten fields, beside no sidewalk, where no object or sign stands 1 to 5.5 m out. `mirrored`: of a network
/// seen in a mirror.
bool has_ditch(const Road& road, bool left, std::pair<double, double> s_m, std::uint64_t seed, bool mirrored = false);

} // namespace fernlicht
