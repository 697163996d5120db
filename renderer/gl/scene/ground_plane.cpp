#include "renderer/gl/scene/ground_plane.h"

#include <glm/geometric.hpp>

namespace fernlicht::gl {

void PlaneFit::add(const glm::dvec3& p) {
    count_ += 1.0;
    sum_ += p;
    xx_ += p.x * p.x;
    xy_ += p.x * p.y;
    yy_ += p.y * p.y;
    xz_ += p.x * p.z;
    yz_ += p.y * p.z;
}

std::optional<glm::dvec4> PlaneFit::plane() const {
    if (count_ == 0.0)
        return std::nullopt;
    const glm::dvec3 mean = sum_ / count_;
    const double xx = xx_ / count_ - mean.x * mean.x, xy = xy_ / count_ - mean.x * mean.y, yy = yy_ / count_ - mean.y * mean.y,
                 xz = xz_ / count_ - mean.x * mean.z, yz = yz_ / count_ - mean.y * mean.z;
    const double determinant = xx * yy - xy * xy;
    double a = 0.0, b = 0.0;
    if (determinant > 1e-9 * xx * yy) { // else all in one line
        a = (xz * yy - yz * xy) / determinant;
        b = (yz * xx - xz * xy) / determinant;
    }
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-a, -b, 1.0));
    return glm::dvec4(normal, -glm::dot(normal, mean));
}

} // namespace fernlicht::gl
