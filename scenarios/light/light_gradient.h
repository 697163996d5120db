// How light at a point answers to each sample of the lamps' candela tables: E is linear in the light that a table has, so its gradient is
// a handful of weights, by the same angles and cells that light.h takes E from.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fernlicht {

/// d figure / d cd, sample by sample.
struct LampGradient {
    std::string lamp;
    std::shared_ptr<const LampFile> file;
    std::vector<double> per_cd; ///< as CandelaTable::cd; the figure's unit per cd
};
/// A lamp that changes its file over a drive has one for each.
using BeamGradient = std::vector<LampGradient>;

/// What a place's illuminance is on.
enum class Facing {
    lamps,   ///< E = sum of I / d^2
    surface, ///< E = sum of I cos(alpha) / d^2 and light of sky, sun and moon
    eye      ///< E = sum of I cos(theta) / d^2: as surface, without sky
};

struct LightPlace {
    glm::dvec3 point_m{0.0};
    Facing facing = Facing::lamps;
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< unit: the surface's, or where the eye looks
    std::vector<bool> hidden = {};    ///< by lamp of the moment: something stands before it; empty: none is
};

/// As surface_illuminance_lx() and target_illuminance_lx() have it. lx.
double light_lx(const Moment& moment, const LightPlace& place);
/// Adds d E / d cd times `per_lx`.
void add_gradient(BeamGradient& gradient, const Moment& moment, const LightPlace& place, double per_lx);
/// Adds what a figure answers that answers to each lamp's intensity towards a point by so much: `per_cd` by lamp of the moment.
void add_gradient(BeamGradient& gradient, const Moment& moment, const glm::dvec3& point_m, std::span<const double> per_cd);

} // namespace fernlicht
