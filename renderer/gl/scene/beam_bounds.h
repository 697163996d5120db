// How bright a beam can be at most within a cone of directions: what decides, without looking at a triangle, that no light can arrive.
#pragma once

#include "renderer/beam_texture.h"

#include <glm/vec3.hpp>

namespace fernlicht::gl {

class BeamBounds {
  public:
    BeamBounds() = default;
    explicit BeamBounds(const BeamTexture& beam);

    /// No direction towards the sphere has more, in cd. `centre` in lamp space. 0 only where the beam is exactly dark.
    double most_towards(const glm::dvec3& centre, double radius) const;

    double most() const { return most_; } ///< cd, in any direction

  private:
    double h_first_ = 0.0, v_first_ = 0.0, h_cell_ = 1.0, v_cell_ = 1.0, most_ = 0.0;
    int columns_ = 0, rows_ = 0;
    std::vector<float> most_of_cell_;
};

} // namespace fernlicht::gl
