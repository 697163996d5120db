// The materials of a road scene, and which one a lane, a mark or an object has.
#pragma once

#include "scenarios/roads/road_network.h"
#include "scenarios/values/scene.h"

#include <cstdint>

namespace fernlicht {

/// Positions in road_materials().
enum class RoadMaterial : std::uint32_t {
    asphalt,
    concrete,
    kerb,
    marking_white,
    marking_yellow,
    verge,
    terrain,
    board,
    board_back,
    post,
    delineator,
    object,
    trunk,
    leaves,
    count
};

constexpr std::uint32_t index_of(RoadMaterial material) { return static_cast<std::uint32_t>(material); }

/// What a lane of this OpenDRIVE type is made of. Types that are not known are asphalt: something to drive on.
RoadMaterial lane_material(const std::string& lane_type);
/// Yellow and orange paint is yellow, all other colours are white: no other mark has a coefficient of its own in EN 1436.
RoadMaterial marking_material(const std::string& colour);

} // namespace fernlicht
