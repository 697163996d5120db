// Which ground the roads cover, seen from above: asked before terrain or paint is laid where another road may lie.
#pragma once

#include "scenarios/roads/mesh/mesh_surface.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace fernlicht {

/// A convex quadrilateral in plan, corners in order, with the heights it spans.
struct PlanQuad {
    std::array<glm::dvec2, 4> corners_m;
    double lowest_m = 0.0, highest_m = 0.0;
};

/// The quadrilateral under four points in space.
PlanQuad ground_between(const std::array<glm::dvec3, 4>& points);

/// True where the insides meet by more than `margin_m`: neighbours that only touch do not overlap.
bool overlap(const PlanQuad& a, const PlanQuad& b, double margin_m);

/// One stretch of one road, from its right edge to its left.
struct RoadFootprint {
    PlanQuad all;
    PlanQuad paved; ///< the part that vehicles may use; of no extent if there is none
    std::size_t road = 0;
    double from_s_m = 0.0, to_s_m = 0.0;
};

class Footprints {
  public:
    Footprints(const RoadNetwork& network, const std::vector<SurfacePlan>& plans);

    /// Each footprint whose bounding box meets that of `ground`, once.
    void near(const PlanQuad& ground, const std::function<void(const RoadFootprint&)>& visit) const;

    /// Whether a stretch of a road goes over into `other` there: the same road within 5 m, or one linked to its end.
    bool continues(std::size_t road, double from_s_m, double to_s_m, const RoadFootprint& other) const;

  private:
    struct Joint {
        std::size_t other;
        bool at_start, other_at_start;
    };
    void add(const RoadNetwork& network, const SurfacePlan& plan, std::size_t road);
    void add_joints(const RoadNetwork& network);

    std::vector<RoadFootprint> all_;
    std::vector<double> lengths_m_;
    std::vector<std::vector<Joint>> joints_; ///< of each road
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> tiles_;
};

} // namespace fernlicht
