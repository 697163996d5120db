// The shapes of dressed scenery, each in its object's own frame: x along its heading, y to the left, z up from its foot.
#pragma once

#include "scenarios/dressing/dressing_materials.h"
#include "scenarios/models/triangle_soup.h"
#include "scenarios/roads/signal_faces.h"

namespace fernlicht {

/// Levels of detail. `far` leaves the silhouette of `near` by at most the error that stands with each shape.
enum class Detail { near, far };

/// Triangles by Stuff that lie within the box of the object they stand for. `high` is what begins so far above the ground that no lamp of a
/// car is shaded on the road by it: a mesh of its own.
struct DressedObject {
    TriangleSoup low, high;
    bool closed = false;     ///< closed bodies and what stands before them: from outside no face shows its back
    bool has_places = false; ///< texture coordinates are set; else they follow from place and normal
};

/// What the plain object's box leaves: length along x and width along y, both about the middle, height from the foot.
struct HouseSize {
    double length_m = 12.0, width_m = 10.0, height_m = 7.0;
    double ground_m = 0.0; ///< of the ground above the foot, at least lowest_house_m below height_m
    bool road_left = true; ///< the front looks to +y
};

inline constexpr double smallest_house_m = 4.0;   ///< length, width and height; smaller boxes stay boxes
inline constexpr double lowest_house_m = 4.5;     ///< above the ground: a storey, a roof and its chimney
inline constexpr double far_house_error_m = 0.14; ///< reveals, sills and plinth
inline constexpr double far_tree_error = 0.35;    ///< of the crown's radius: sprigs, and lumps that are cut coarser

/// Walls on a plinth under a gable roof with its eaves and verges, windows in their reveals, some lit, a door in the front, a chimney.
DressedObject dressed_house(const HouseSize& size, Dice dice, Detail detail);

/// A trunk with boughs, and leaves in clusters and sprigs; one in four is a spruce. Fills height and crown radius, free below a quarter of
/// the height.
DressedObject dressed_tree(double height_m, double radius_m, Dice dice, Detail detail);
/// Clusters of leaves down to the ground.
DressedObject dressed_bush(double height_m, double radius_m, Dice dice);
/// A clipped hedge along x, centred, on ground at z = 0 that may fall by `fall_m` below it.
DressedObject dressed_hedge(double length_m, double width_m, double height_m, double fall_m, Dice dice);
/// Blades of grass about a place, up to a height.
DressedObject dressed_tuft(double height_m, Dice dice);
/// Two rails on posts along x, one post at each end but the last.
DressedObject dressed_field_fence(double length_m);
/// A picket fence along x.
DressedObject dressed_fence(double length_m, double height_m, double fall_m);
/// A W-beam of a crash barrier along x, `width_m` deep and `height_m` high, its bulges towards the road.
DressedObject dressed_guard_rail(double length_m, double width_m, double height_m, bool road_left);
/// A sign's plate about its middle, its face at x = 0, read by who looks along -x. Films of one colour each, as EN 12899-1's class RA2
/// returns light. `dice`: for names of places, where the road's file has none.
TriangleSoup dressed_sign(double width_m, double height_m, const SignalFace& face, Dice dice);
/// A traffic light, out: housing and three lenses under visors, its face at x = 0.
TriangleSoup dressed_traffic_light(double width_m, double height_m);

/// A bollard with a reflecting band.
DressedObject dressed_bollard(double height_m);

} // namespace fernlicht
