#include "scenarios/roads/gauss_legendre.h"
#include "scenarios/roads/plan_curves.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// On so much five points of Gauss leave an error below 1e-14 of the step (four leave 5e-12 where the curvature starts at zero).
constexpr double step_turn_rad = 0.25;

/// cos and sin for |x| up to a third of a radian; first term left out: 0.33^10/10! = 4e-12 * 1e-3.
void small_cos_sin(double x, double& c, double& s) {
    const double x2 = x * x;
    c = 1.0 - x2 / 2.0 * (1.0 - x2 / 12.0 * (1.0 - x2 / 30.0 * (1.0 - x2 / 56.0 * (1.0 - x2 / 90.0))));
    s = x * (1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0))));
}

/// The piece of clothoid of length `h` that begins with heading 0 and curvature `k`; `c` is the change of curvature per metre.
glm::dvec2 piece(double k, double c, double h) {
    glm::dvec2 sum{0.0};
    for (std::size_t i = 0; i < gauss_node.size(); ++i) {
        const double u = gauss_node[i] * h;
        double cosine = 1.0, sine = 0.0;
        small_cos_sin(u * (k + 0.5 * c * u), cosine, sine);
        sum += gauss_weight[i] * glm::dvec2(cosine, sine);
    }
    return h * sum;
}

struct Winding {
    double change_per_m2; ///< of curvature
    double step_m;
    std::size_t steps;
};

Winding winding(const Spiral& spiral, double length_m) {
    if (!(length_m > 0.0))
        return {0.0, 0.0, 1};
    const double turn = std::max(std::abs(spiral.start_per_m), std::abs(spiral.end_per_m)) * length_m;
    const double steps = std::max(1.0, std::ceil(std::min(turn, max_spiral_turn_rad) / step_turn_rad));
    return {(spiral.end_per_m - spiral.start_per_m) / length_m, length_m / steps, static_cast<std::size_t>(steps)};
}

double heading(const Spiral& spiral, const Winding& w, double u) { return u * (spiral.start_per_m + 0.5 * w.change_per_m2 * u); }

/// From the beginning of a step at `u0`, `du` further, into `position`.
void advance(glm::dvec2& position, const Spiral& spiral, const Winding& w, double u0, double du) {
    const double turned = heading(spiral, w, u0), c = std::cos(turned), s = std::sin(turned);
    const glm::dvec2 local = piece(spiral.start_per_m + w.change_per_m2 * u0, w.change_per_m2, du);
    position += glm::dvec2(c * local.x - s * local.y, s * local.x + c * local.y);
}

} // namespace

std::vector<glm::dvec2> spiral_steps(const Spiral& spiral, double length_m) {
    const Winding w = winding(spiral, length_m);
    std::vector<glm::dvec2> steps(w.steps, glm::dvec2(0.0));
    for (std::size_t i = 1; i < w.steps; ++i) {
        steps[i] = steps[i - 1];
        advance(steps[i], spiral, w, static_cast<double>(i - 1) * w.step_m, w.step_m);
    }
    return steps;
}

PlanPoint spiral_point(const Spiral& spiral, double length_m, double ds_m) {
    const Winding w = winding(spiral, length_m);
    const double last = static_cast<double>(w.steps - 1);
    const double index = w.step_m > 0.0 ? std::clamp(std::floor(ds_m / w.step_m), 0.0, last) : 0.0;
    const auto step = static_cast<std::size_t>(index);
    glm::dvec2 position{0.0};
    if (spiral.steps_m.size() == w.steps)
        position = spiral.steps_m[step];
    else
        for (std::size_t i = 0; i < step; ++i)
            advance(position, spiral, w, static_cast<double>(i) * w.step_m, w.step_m);
    const double u0 = index * w.step_m;
    advance(position, spiral, w, u0, ds_m - u0);
    return {position.x, position.y, heading(spiral, w, ds_m), spiral.start_per_m + w.change_per_m2 * ds_m, 1.0};
}

} // namespace fernlicht
