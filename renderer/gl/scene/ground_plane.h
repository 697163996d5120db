// The one plane that ground lies in, where it does.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace fernlicht::gl {

/// Sums for the plane z = a x + b y + c of least squares through places, each with the same weight. Places within some kilometres of 0.
class PlaneFit {
  public:
    void add(const glm::dvec3& place_m);
    /// (unit normal upwards, -normal . place); a level plane through the places' mean where they lie in one line; nullopt without places.
    std::optional<glm::dvec4> plane() const;

  private:
    double count_ = 0.0;
    glm::dvec3 sum_{0.0};
    double xx_ = 0.0, xy_ = 0.0, yy_ = 0.0, xz_ = 0.0, yz_ = 0.0;
};

} // namespace fernlicht::gl
