// Bodies of our own for road users without a model: made by formula from their size, so that they look like what they are at night.
#pragma once

#include "scenarios/models/model.h"

namespace fernlicht {

/// In a road user's frame: on the road under the rear axle (a pedestrian's: the middle), x forward, y left, z up.
struct BodySize {
    glm::dvec3 size_m{4.5, 1.8, 1.45}; ///< length, width, height, each > 0
    double rear_m = -0.9;              ///< x of the rear end
    glm::vec3 paint{0.25F};            ///< linear sRGB reflectance; of a pedestrian the clothing above the waist
    bool dressed = false;              ///< with the details of dressed scenery (docs/scenery.md)
    std::uint32_t draw = 0;            ///< dressed only: which car (draw % 3: hatchback, saloon, estate), whether clothing reflects
};

/// Each closes at its box: from rear_m to rear_m + length, half the width to each side, from the road to its height. Motor vehicles have
/// glass, wheels, faces of lamps, number plates (as EN 12899-1 class RA1 returns light) and red retroreflectors (UN R3 class IA: 300 mcd/lx
/// at 20', 5 mcd/lx at 1.5 degrees), and mounts named lamp.low.left, lamp.tail.right and so on. Some 600 to 1900 triangles.
Model car_body(const BodySize& size);
Model van_body(const BodySize& size);
Model truck_body(const BodySize& size);
Model bus_body(const BodySize& size);
Model motorcycle_body(const BodySize& size);
Model bicycle_body(const BodySize& size);
Model pedestrian_body(const BodySize& size);
/// A box.
Model plain_body(const BodySize& size);

} // namespace fernlicht
