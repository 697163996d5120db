#include "metrics/glare/glare.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

constexpr double arc_minutes = 60.0; // in a degree

struct Domain {
    double min_deg, max_deg;
};

Domain domain_of(VeilingEquation equation) { return equation == VeilingEquation::cie_general ? Domain{0.1, 100.0} : Domain{1.0, 30.0}; }

double fourth_power(double x) { return x * x * x * x; }

/// Lv / E, in cd/(m2 lx).
double veil_per_lx(VeilingEquation equation, double theta, const GlareEye& eye) {
    const double square = theta * theta;
    switch (equation) {
    case VeilingEquation::stiles_holladay:
        return 10.0 / square;
    case VeilingEquation::age_adjusted:
        return 10.0 * (1.0 + fourth_power(eye.age_years / 70.0)) / square;
    case VeilingEquation::cie_general:
        break;
    }
    return 10.0 / (square * theta) + (5.0 / square + 0.1 * eye.pigmentation / theta) * (1.0 + fourth_power(eye.age_years / 62.5)) +
           0.0025 * eye.pigmentation;
}

void check(const std::vector<GlareSource>& sources) {
    for (const GlareSource& source : sources)
        if (!(source.eye_lx >= 0.0) || !std::isfinite(source.eye_lx) || !(source.theta_deg >= 0.0 && source.theta_deg <= 180.0))
            throw std::invalid_argument(fmt::format("a glare source of {} lx at {} degrees", source.eye_lx, source.theta_deg));
}

constexpr double step_m = 2.0;

/// `lx` on a plane that faces the source, turned to the plane across the gaze.
GlareSource across_gaze(double lx, const glm::dvec3& towards, const glm::dvec3& gaze) {
    const double theta_deg = angle_between_deg(towards, gaze);
    return {theta_deg < 90.0 ? lx * std::cos(radians(theta_deg)) : 0.0, theta_deg};
}

} // namespace

std::string_view name(VeilingEquation equation) {
    return equation == VeilingEquation::stiles_holladay ? "stiles-holladay"
           : equation == VeilingEquation::age_adjusted  ? "age-adjusted"
                                                        : "cie-general";
}

Value veiling_luminance_cdm2(VeilingEquation equation, const std::vector<GlareSource>& sources, const GlareEye& eye) {
    check(sources);
    const Domain domain = domain_of(equation);
    double veil = 0.0;
    for (const GlareSource& source : sources) {
        if (source.eye_lx == 0.0)
            continue;
        if (source.theta_deg < domain.min_deg || source.theta_deg > domain.max_deg)
            return Value::not_measured(fmt::format("a source {:.3g} degrees from the line of sight: {} holds from {} to {} degrees",
                                                   source.theta_deg, name(equation), domain.min_deg, domain.max_deg));
        veil += source.eye_lx * veil_per_lx(equation, source.theta_deg, eye);
    }
    return veil;
}

Value threshold_increment_percent(double veiling_cdm2, double adaptation_cdm2) {
    if (!(adaptation_cdm2 > 0.05))
        return Value::not_measured(
            fmt::format("an adaptation luminance of {:.3g} cd/m2: the threshold increment is defined above 0.05", adaptation_cdm2));
    return adaptation_cdm2 <= 5.0 ? 65.0 * veiling_cdm2 / std::pow(adaptation_cdm2, 0.8)
                                  : 95.0 * veiling_cdm2 / std::pow(adaptation_cdm2, 1.05);
}

Value de_boer_rating(const std::vector<GlareSource>& sources, double adaptation_cdm2) {
    check(sources);
    const double surround = 0.003 * (1.0 + std::sqrt(adaptation_cdm2 / 0.04));
    double glare = 0.0;
    for (const GlareSource& source : sources) {
        if (source.eye_lx == 0.0)
            continue;
        if (source.theta_deg == 0.0)
            return Value::not_measured("a source on the line of sight, where de Boer's rating has no value");
        glare += source.eye_lx / (surround * std::pow(arc_minutes * source.theta_deg, 0.46));
    }
    if (glare == 0.0)
        return Value::not_measured("no light reaches the eye");
    return 5.0 - 2.0 * std::log10(glare);
}

std::vector<SeenLamp> seen_lamps(const Moment& moment, const glm::dvec3& point_m) {
    std::vector<SeenLamp> seen;
    for (const LitLamp& lamp : moment.lamps) {
        const double distance_m = glm::distance(lamp.pose.position_m, point_m), cd = intensity_towards_cd(lamp, point_m);
        seen.push_back({lamp.name, lamp.pose.position_m,
                        cd > 0.0 ? cd / (distance_m * distance_m) * air_transmittance(moment.weather, distance_m) : 0.0, distance_m});
    }
    return seen;
}

double facing_lx(const std::vector<SeenLamp>& lamps) {
    double lx = 0.0;
    for (const SeenLamp& lamp : lamps)
        lx += lamp.facing_lx;
    return lx;
}

GlareSource glare_source(const SeenLamp& lamp, const glm::dvec3& eye_m, const glm::dvec3& gaze) {
    return across_gaze(lamp.facing_lx, lamp.position_m - eye_m, gaze);
}

GlareSource mirrored_source(const SeenLamp& lamp, const glm::dvec3& mirror_m, double reflectance, const glm::dvec3& eye_m,
                            const glm::dvec3& gaze) {
    const double shrunk = lamp.distance_m / (lamp.distance_m + glm::distance(mirror_m, eye_m));
    return across_gaze(reflectance * lamp.facing_lx * shrunk * shrunk, mirror_m - eye_m, gaze);
}

double angle_between_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

RoadBetween::RoadBetween(const Route& route, double from_m, double to_m) : route_(route) {
    const int steps = static_cast<int>(std::ceil((to_m - from_m) / step_m));
    for (int k = 1; k < steps; ++k) {
        const double at_m = from_m + k * (to_m - from_m) / steps;
        const Route::Cut across = route.cut(at_m);
        cuts_.push_back({at_m, across, Route::pose(across, 0.0)});
    }
}

bool RoadBetween::hides(const glm::dvec3& from, const glm::dvec3& to) const {
    return std::ranges::any_of(cuts_, [&](const Cut& cut) {
        const Pose& centre = cut.centre;
        const double along = glm::dot(to - from, centre.forward());
        const double share = glm::dot(centre.position_m - from, centre.forward()) / along;
        if (!(share > 0.0 && share < 1.0))
            return false; // the line does not pass this cross-section between its ends
        const glm::dvec3 passing = from + share * (to - from);
        const double left_m = glm::dot(passing - centre.position_m, centre.left());
        const Pose below = Route::pose(cut.across, left_m);
        if (glm::dot(passing - below.position_m, below.up()) >= 0.0)
            return false;
        const CrossSection section = route_.cross_section(cut.at_m);
        return left_m <= section.paved_left_m && left_m >= section.paved_right_m;
    });
}

std::vector<SeenLamp> lamps_over_road(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point_m) {
    std::vector<SeenLamp> seen = seen_lamps(moment, point_m);
    std::optional<RoadBetween> road;
    for (SeenLamp& lamp : seen) {
        if (!(lamp.facing_lx > 0.0))
            continue;
        if (!road)
            road.emplace(route, moment.distance_m, to_m);
        if (road->hides(lamp.position_m, point_m))
            lamp.facing_lx = 0.0;
    }
    return seen;
}

std::optional<double> along_route_m(const Route& route, const glm::dvec3& point_m, double near_m) {
    constexpr double beside_route_m = 20.0, close_m = 1e-3;
    double at_m = std::clamp(near_m, 0.0, route.length_m());
    for (int k = 0; k < 50; ++k) {
        const Pose pose = route.pose(at_m);
        const double on_m = std::clamp(at_m + glm::dot(point_m - pose.position_m, pose.forward()), 0.0, route.length_m());
        if (std::abs(std::exchange(at_m, on_m) - on_m) < close_m)
            break;
    }
    const glm::dvec3 beside = to_local(route.pose(at_m), point_m);
    return std::hypot(beside.x, beside.y) < beside_route_m ? std::optional(at_m) : std::nullopt;
}

bool box_hides(const BodyBox& box, const Pose& pose, const glm::dvec3& from_m, const glm::dvec3& to_m) {
    const glm::dvec3 low(box.rear_m, -0.5 * box.size_m.y, 0.0), high(box.rear_m + box.size_m.x, 0.5 * box.size_m.y, box.size_m.z);
    const glm::dvec3 from = to_local(pose, from_m), way = to_local(pose, to_m) - from;
    double enter = 0.0, leave = 1.0; // Kay and Kajiya's slabs
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0) {
            if (from[axis] < low[axis] || from[axis] > high[axis])
                return false;
            continue;
        }
        const double a = (low[axis] - from[axis]) / way[axis], b = (high[axis] - from[axis]) / way[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

std::vector<GlareSource> traffic_glare(const Moment& moment, const glm::dvec3& eye_m, const glm::dvec3& gaze,
                                       const std::vector<BodyBox>& boxes) {
    std::vector<GlareSource> sources;
    for (const LitLamp& lamp : moment.other_lamps) {
        const glm::dvec3 at_m = lamp.pose.position_m, to = at_m - eye_m;
        const double cd = intensity_towards_cd(lamp, eye_m), d2 = glm::dot(to, to);
        if (!(cd > 0.0) || !(d2 > 0.0))
            continue;
        bool hidden = false;
        for (std::size_t i = 0; i < moment.bodies.size() && i < boxes.size() && !hidden; ++i)
            hidden =
                moment.bodies[i].visible && static_cast<int>(i) != lamp.body && box_hides(boxes[i], moment.bodies[i].pose, eye_m, at_m);
        const GlareSource source =
            glare_source({lamp.name, at_m, cd / d2 * air_transmittance(moment.weather, std::sqrt(d2)), std::sqrt(d2)}, eye_m, gaze);
        if (!hidden && source.eye_lx > 0.0)
            sources.push_back(source);
    }
    return sources;
}

} // namespace fernlicht
