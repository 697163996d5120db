// Ground beside the roads, for light to fall on, and beyond it, so that by day no sky is seen below the horizon.
// Which ground the roads cover, seen from above: asked before terrain or paint is laid where another road may lie.
// What stands beside and over a road: objects and signals.
#pragma once

#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/mesh_surface.h"

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

/// Verge (1.5 m) and terrain on both sides of a road, `options.verge_width_m` wide, narrower on the inside of bends so that it
/// does not fold. It starts on the road's outermost vertices and follows their height. Where it would cover another road it is
/// lowered to 5 cm below that road, loose from its own edge if need be: seen from above there is no hole. Over roads that lie
/// more than 4 m lower (bridges) it is left out.
void append_terrain(Scene& scene, const SurfacePlan& plan, std::size_t road_index, const SurfaceRows& surface, const Footprints& footprints,
                    const RoadMeshOptions& options);

/// Adds level tiles of terrain's reflectance below all that the scene has, half a metre under its lowest point and 2.5 km farther than it
/// reaches. They are seen and lit, stand in no light's way and in no map. Nothing for an empty scene.
void add_far_ground(Scene& scene);

/// Objects of one road: trees, posts, delineators, extruded outlines and boxes. All stand upright (world z) at their heading, turned
/// by their own pitch and roll; a size of 0 gets a default for trees and posts, 0.1 m for a box's length or width.
/// Left out: what lies flat on the road (crosswalks, parking spaces, painted marks, patches: they would lie in the surface and
/// flicker), boxes without height, and bridges and tunnels, whose own surfaces OpenDRIVE does not describe.
/// One mesh for each kind of object and chunk: "tree, road 12 s 120-180".
void append_objects(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const RoadMeshOptions& options);

/// Signals of one road, one mesh each ("signal 44"): a retroreflecting board with a dull back, facing the traffic it is for, on a post
/// of 76 mm behind it; over paved lanes without post. The bottom edge is at zOffset, or 2 m up where that is not above 0;
/// boards without size are 0.6 m square. Traffic lights are dark housings, 0.3 m by 0.9 m, without light of their own.
void append_signals(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan);

/// Corner indices of the triangles of a simple polygon in plan, by clipping ears; empty if it crosses itself.
std::vector<std::array<std::size_t, 3>> triangulated(const std::vector<glm::dvec3>& polygon);

} // namespace fernlicht
