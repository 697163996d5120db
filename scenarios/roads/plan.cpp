#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// sin(x)/x and (1 - cos(x))/x, both smooth through 0: an arc of any curvature, nearly straight ones included.
void unit_arc(double x, double& along, double& across) {
    if (std::abs(x) < 1e-2) {
        const double x2 = x * x; // next terms: x^8/9! and x^9/10!, below 1e-21
        along = 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0));
        across = x / 2.0 * (1.0 - x2 / 12.0 * (1.0 - x2 / 30.0 * (1.0 - x2 / 56.0)));
    } else {
        along = std::sin(x) / x;
        const double half = std::sin(0.5 * x);
        across = 2.0 * half * half / x; // 1 - cos without cancellation
    }
}

PlanPoint curve_point(const Line&, double, double ds) { return {ds, 0.0, 0.0, 0.0, 1.0}; }

PlanPoint curve_point(const Arc& arc, double, double ds) {
    double along = 1.0, across = 0.0;
    unit_arc(arc.curvature_per_m * ds, along, across);
    return {ds * along, ds * across, arc.curvature_per_m * ds, arc.curvature_per_m, 1.0};
}

} // namespace

PlanPoint plan_point(const PlanElement& element, double ds_m) {
    const PlanPoint local = std::visit([&](const auto& shape) { return curve_point(shape, element.length_m, ds_m); }, element.shape);
    const double c = std::cos(element.heading_rad), s = std::sin(element.heading_rad);
    return {element.x_m + c * local.x_m - s * local.y_m, element.y_m + s * local.x_m + c * local.y_m,
            element.heading_rad + local.heading_rad, local.heading_rate_per_m, local.speed};
}

const PlanElement& element_at(const Road& road, double s_m) {
    const auto after = std::ranges::upper_bound(road.plan, s_m, {}, &PlanElement::s_m);
    return after == road.plan.begin() ? *after : *(after - 1);
}

PlanPoint plan_point(const Road& road, double s_m) {
    if (road.plan.empty())
        return {};
    const double s = std::clamp(s_m, 0.0, std::max(road.length_m, 0.0));
    const PlanElement& element = element_at(road, s);
    return plan_point(element, s - element.s_m);
}

Pose plan_pose(const Road& road, double s_m) {
    const PlanPoint point = plan_point(road, s_m);
    return {{point.x_m, point.y_m, 0.0}, axes_from_angles(point.heading_rad, 0.0, 0.0)};
}

void prepare(PlanElement& element) {
    if (auto* spiral = std::get_if<Spiral>(&element.shape))
        spiral->steps_m = spiral_steps(*spiral, element.length_m);
    else if (auto* poly = std::get_if<Poly3>(&element.shape))
        poly->knots = poly3_knots(*poly, element.length_m);
}

double drawn_length_m(const PlanElement& element) {
    const auto* poly = std::get_if<ParamPoly3>(&element.shape);
    return poly ? param_poly3_length(*poly, element.length_m) : element.length_m;
}

namespace {

/// Gauss-Legendre on -1..1 with five points.
constexpr double node[5] = {-0.90617984593866399, -0.53846931010568309, 0.0, 0.53846931010568309, 0.90617984593866399};
constexpr double weight[5] = {0.23692688505618909, 0.47862867049936647, 0.56888888888888889, 0.47862867049936647, 0.23692688505618909};

template <class Function> double gauss(const Function& f, double from, double to) {
    const double half = 0.5 * (to - from), middle = 0.5 * (from + to);
    double sum = 0.0;
    for (int i = 0; i < 5; ++i)
        sum += weight[i] * f(middle + half * node[i]);
    return half * sum;
}

/// Integral of f from `from` to `to`, halved until both halves agree with the whole; at most 2^max_depth pieces.
/// `piece(end, integral of this piece)` is called for each piece in order.
template <class Function, class Piece>
void adaptive(const Function& f, double from, double to, double whole, int depth, const Piece& piece) {
    const double middle = 0.5 * (from + to);
    const double left = gauss(f, from, middle), right = gauss(f, middle, to);
    if (depth == 0 || std::abs(left + right - whole) <= 1e-13 * (std::abs(whole) + 1e-300)) {
        piece(to, left + right);
        return;
    }
    adaptive(f, from, middle, left, depth - 1, piece);
    adaptive(f, middle, to, right, depth - 1, piece);
}

constexpr int max_depth = 12;

double slope(const Poly3& poly, double u) { return poly.b + u * (2.0 * poly.c + u * 3.0 * poly.d); }

auto stretch(const Poly3& poly) {
    return [&poly](double u) { return std::hypot(1.0, slope(poly, u)); };
}

/// u in [low.u_m, high.u_m] where the arc length from low.u_m is `ds`: Newton, kept in the bracket by bisection.
double invert(const Poly3& poly, const Poly3::Knot& low, const Poly3::Knot& high, double ds) {
    const auto f = stretch(poly);
    double from = low.u_m, to = high.u_m;
    const double span = high.s_m - low.s_m;
    double u = span > 0.0 ? from + (to - from) * ds / span : from;
    for (int i = 0; i < 20; ++i) {
        const double error = gauss(f, low.u_m, u) - ds;
        (error > 0.0 ? to : from) = u;
        double next = u - error / f(u);
        if (next < from || next > to)
            next = 0.5 * (from + to);
        if (std::abs(next - u) <= 1e-14 * (1.0 + std::abs(u)))
            return next;
        u = next;
    }
    return u;
}

struct Derivatives {
    double u, v, du, dv, ddu, ddv; ///< by the parameter p
};

Derivatives derivatives(const ParamPoly3& f, double p) {
    return {f.au + p * (f.bu + p * (f.cu + p * f.du)),
            f.av + p * (f.bv + p * (f.cv + p * f.dv)),
            f.bu + p * (2.0 * f.cu + p * 3.0 * f.du),
            f.bv + p * (2.0 * f.cv + p * 3.0 * f.dv),
            2.0 * f.cu + 6.0 * p * f.du,
            2.0 * f.cv + 6.0 * p * f.dv};
}

double parameter_per_m(const ParamPoly3& poly, double length_m) { return poly.normalized ? (length_m > 0.0 ? 1.0 / length_m : 0.0) : 1.0; }

/// Knots over u = 0 .. end. Equal pieces first, so that a sharp bend between the nodes of one long piece cannot hide.
std::vector<Poly3::Knot> knots_over(const Poly3& poly, double end) {
    std::vector<Poly3::Knot> knots{{0.0, 0.0}};
    const auto f = stretch(poly);
    constexpr int pieces = 16;
    for (int i = 0; i < pieces; ++i) {
        const double from = end * i / pieces, to = end * (i + 1) / pieces;
        adaptive(f, from, to, gauss(f, from, to), max_depth - 4, [&](double u, double part) {
            knots.push_back({knots.back().s_m + part, u});
        });
    }
    return knots;
}

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

std::vector<Poly3::Knot> poly3_knots(const Poly3& poly, double length_m) {
    // The arc is at least as long as u, so u never passes the length; a steep curve uses a small part of that: look there more closely.
    const std::vector<Poly3::Knot> coarse = knots_over(poly, std::max(length_m, 0.0));
    const auto last =
        std::lower_bound(coarse.begin(), coarse.end() - 1, length_m, [](const Poly3::Knot& knot, double s) { return knot.s_m < s; });
    return knots_over(poly, last->u_m);
}

PlanPoint curve_point(const Poly3& poly, double length_m, double ds_m) {
    if (poly.knots.empty()) {
        Poly3 prepared = poly;
        prepared.knots = poly3_knots(poly, length_m);
        return curve_point(prepared, length_m, ds_m);
    }
    const auto after = std::upper_bound(poly.knots.begin() + 1, poly.knots.end() - 1, ds_m,
                                        [](double s, const Poly3::Knot& knot) { return s < knot.s_m; });
    const Poly3::Knot& low = *(after - 1);
    const double u = invert(poly, low, *after, ds_m - low.s_m);
    const double b = slope(poly, u), one = 1.0 + b * b;
    return {u, poly.a + u * (poly.b + u * (poly.c + u * poly.d)), std::atan(b), (2.0 * poly.c + 6.0 * poly.d * u) / (one * std::sqrt(one)),
            1.0};
}

PlanPoint curve_point(const ParamPoly3& poly, double length_m, double ds_m) {
    const double per_m = parameter_per_m(poly, length_m);
    const Derivatives at = derivatives(poly, ds_m * per_m);
    const double speed2 = at.du * at.du + at.dv * at.dv;
    // Where the curve stands still (bU = bV = 0) it leaves in the direction of its second derivative.
    const bool still = speed2 <= 1e-24;
    const double heading = still ? std::atan2(at.ddv, at.ddu) : std::atan2(at.dv, at.du);
    const double rate = still ? 0.0 : (at.du * at.ddv - at.dv * at.ddu) / speed2 * per_m;
    return {at.u, at.v, heading, rate, std::sqrt(speed2) * per_m};
}

double param_poly3_length(const ParamPoly3& poly, double length_m) {
    const auto f = [&](double p) {
        const Derivatives at = derivatives(poly, p);
        return std::hypot(at.du, at.dv);
    };
    const double end = length_m * parameter_per_m(poly, length_m);
    double length = 0.0;
    adaptive(f, 0.0, end, gauss(f, 0.0, end), max_depth, [&](double, double part) { length += part; });
    return length;
}

std::vector<glm::dvec2> spiral_steps(const Spiral& spiral, double length_m) {
    const Winding w = winding(spiral, length_m);
    std::vector<glm::dvec2> steps(w.steps, glm::dvec2(0.0));
    for (std::size_t i = 1; i < w.steps; ++i) {
        steps[i] = steps[i - 1];
        advance(steps[i], spiral, w, static_cast<double>(i - 1) * w.step_m, w.step_m);
    }
    return steps;
}

PlanPoint curve_point(const Spiral& spiral, double length_m, double ds_m) {
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
