// Those without a roof: two wheels, or two legs.
#include "scenarios/models/body_parts.h"

#include <algorithm>

namespace fernlicht {
namespace {

void wheel(BodyBuilder& body, double x_m, double radius_m, double width_m, double rim) {
    append_wheel(body.soup(), {x_m, 0.0, radius_m}, radius_m, width_m, rim, 24, index_of(BodyMaterial::tyre), index_of(BodyMaterial::rim));
}

void limb(BodyBuilder& body, const glm::dvec3& from, const glm::dvec3& to, double radius_m, double end_radius_m, BodyMaterial material,
          int sides = 8) {
    append_limb(body.soup(), from, to, radius_m, end_radius_m, sides, index_of(material));
}

/// A rider on a saddle, hands on a bar, up to the height.
void rider(BodyBuilder& body, const glm::dvec3& saddle, const glm::dvec3& bar, double height_m) {
    const double head = 0.12, shoulder_z = height_m - 2.0 * head - 0.12;
    const glm::dvec3 shoulders(saddle.x + 0.45 * (bar.x - saddle.x), 0.0, shoulder_z);
    limb(body, {saddle.x, 0.0, saddle.z + 0.12}, shoulders - glm::dvec3(0, 0, 0.08), 0.15, 0.17, BodyMaterial::cloth, 10);
    limb(body, {shoulders.x + 0.06, 0.0, height_m - head - 0.03}, {shoulders.x + 0.06, 0.0, height_m - head}, head, head,
         BodyMaterial::skin, 10);
    for (const double side : {-1.0, 1.0}) {
        limb(body, shoulders + glm::dvec3(0.0, side * 0.18, 0.0), {bar.x, side * 0.25, bar.z}, 0.055, 0.04, BodyMaterial::cloth);
        const glm::dvec3 knee(saddle.x + 0.42, side * 0.13, 0.5 * saddle.z + 0.18), foot(saddle.x + 0.20, side * 0.12, 0.28);
        limb(body, {saddle.x, side * 0.10, saddle.z + 0.05}, knee, 0.08, 0.065, BodyMaterial::cloth);
        limb(body, knee, foot, 0.06, 0.045, BodyMaterial::cloth);
    }
}

} // namespace

Model motorcycle_body(const BodySize& size) {
    BodyBuilder body("motorcycle", size);
    const double radius = std::min(0.31, 0.2 * size.size_m.z), front_axle = body.front_m() - radius;
    const double saddle_z = std::min(0.8, 0.55 * size.size_m.z);
    wheel(body, 0.0, radius, 0.15, 0.6);
    wheel(body, front_axle, radius, 0.12, 0.6);
    limb(body, {0.15, 0.0, 0.45}, {front_axle - 0.35, 0.0, 0.5}, 0.16, 0.19, BodyMaterial::trim, 10); // engine
    limb(body, {-0.2, 0.0, saddle_z}, {front_axle - 0.45, 0.0, saddle_z + 0.08}, 0.10, 0.15, BodyMaterial::paint, 10);
    limb(body, {front_axle, 0.0, radius}, {front_axle - 0.30, 0.0, saddle_z + 0.2}, 0.06, 0.06, BodyMaterial::rim);
    limb(body, {front_axle - 0.3, -0.36, saddle_z + 0.25}, {front_axle - 0.3, 0.36, saddle_z + 0.25}, 0.025, 0.025, BodyMaterial::trim);
    rider(body, {0.3, 0.0, saddle_z}, {front_axle - 0.3, 0.0, saddle_z + 0.27}, size.size_m.z);
    const double lamp_x = front_axle - 0.05, rear = body.rear_m();
    limb(body, {lamp_x - 0.12, 0.0, saddle_z + 0.1}, {lamp_x - 0.04, 0.0, saddle_z + 0.1}, 0.10, 0.10, BodyMaterial::trim, 12);
    body.plate(lamp_x + 0.06, saddle_z + 0.1, 0.16, 0.14, true, BodyMaterial::lens);
    limb(body, {-0.15, 0.0, saddle_z - 0.05}, {rear + 0.08, 0.0, saddle_z - 0.02}, 0.07, 0.06, BodyMaterial::paint);
    body.plate(rear + 0.01, saddle_z - 0.02, 0.14, 0.07, false, BodyMaterial::red_lens);
    body.plate(rear + 0.01, saddle_z - 0.26, 0.20, 0.18, false, BodyMaterial::plate);
    body.plate(rear + 0.01, saddle_z - 0.13, 0.08, 0.05, false, BodyMaterial::reflector);
    for (const char* function : {"low", "high", "position"})
        body.mounts(function, lamp_x + 0.07, 0.0, saddle_z + 0.1, true);
    for (const char* function : {"tail", "brake"})
        body.mounts(function, rear, 0.0, saddle_z - 0.02, false);
    return std::move(body).take();
}

Model bicycle_body(const BodySize& size) {
    BodyBuilder body("bicycle", size);
    const double radius = std::min(0.34, 0.22 * size.size_m.z), front_axle = std::max(body.front_m() - radius, 0.5);
    const double saddle_z = std::min(0.95, 0.55 * size.size_m.z);
    const glm::dvec3 rear(0.0, 0.0, radius), front(front_axle, 0.0, radius), crank(0.42 * front_axle, 0.0, 0.28);
    const glm::dvec3 saddle(0.28 * front_axle, 0.0, saddle_z), head(front_axle - 0.22, 0.0, saddle_z - 0.05);
    wheel(body, rear.x, radius, 0.04, 0.88);
    wheel(body, front.x, radius, 0.04, 0.88);
    for (const auto& [from, to] : {std::pair(rear, crank), std::pair(rear, saddle), std::pair(crank, saddle), std::pair(crank, head),
                                   std::pair(saddle - glm::dvec3(0, 0, 0.15), head), std::pair(head, front)})
        limb(body, from, to, 0.018, 0.018, BodyMaterial::paint, 6);
    const glm::dvec3 bar(head.x + 0.05, 0.0, saddle_z + 0.1);
    limb(body, head, bar, 0.015, 0.015, BodyMaterial::trim, 6);
    limb(body, bar - glm::dvec3(0, 0.28, 0), bar + glm::dvec3(0, 0.28, 0), 0.015, 0.015, BodyMaterial::trim, 6);
    rider(body, saddle, bar, size.size_m.z);
    body.plate(bar.x + 0.06, bar.z - 0.12, 0.06, 0.06, true, BodyMaterial::lens);
    body.plate(body.rear_m() + 0.01, 0.6, 0.06, 0.06, false, BodyMaterial::reflector);
    limb(body, rear + glm::dvec3(0, 0, 0.02), {body.rear_m() + 0.03, 0.0, 0.6}, 0.012, 0.012, BodyMaterial::trim, 6);
    body.mounts("low", bar.x + 0.07, 0.0, bar.z - 0.12, true);
    body.mounts("tail", body.rear_m(), 0.0, 0.66, false);
    return std::move(body).take();
}

Model pedestrian_body(const BodySize& size) {
    BodyBuilder body("pedestrian", size);
    const double h = size.size_m.z, x = body.x(0.5), half = std::min(0.5 * size.size_m.y, 0.16 * h),
                 step = std::min(0.18, 0.3 * size.size_m.x);
    limb(body, {x, 0.0, 0.90 * h}, {x, 0.0, 0.935 * h}, 0.062 * h, 0.062 * h, BodyMaterial::skin, 10);
    limb(body, {x, 0.0, 0.82 * h}, {x, 0.0, 0.86 * h}, 0.03 * h, 0.03 * h, BodyMaterial::skin);
    for (const double beside : {-0.05, -0.025, 0.0, 0.025, 0.05}) // trunk
        limb(body, {x, beside * h, 0.54 * h}, {x, 1.5 * beside * h, 0.765 * h}, 0.07 * h, 0.068 * h, BodyMaterial::paint, 10);
    for (const double side : {-1.0, 1.0}) {
        limb(body, {x, side * (half - 0.03 * h), 0.78 * h}, {x - side * 0.5 * step, side * (half - 0.02 * h), 0.46 * h}, 0.034 * h,
             0.026 * h, BodyMaterial::paint);
        const glm::dvec3 foot(x + side * step, side * 0.055 * h, 0.035 * h);
        limb(body, {x, side * 0.055 * h, 0.50 * h}, {x + side * 0.6 * step, side * 0.055 * h, 0.28 * h}, 0.058 * h, 0.042 * h,
             BodyMaterial::cloth);
        limb(body, {x + side * 0.6 * step, side * 0.055 * h, 0.28 * h}, foot, 0.042 * h, 0.03 * h, BodyMaterial::cloth);
        limb(body, foot - glm::dvec3(0.03 * h, 0, 0.005 * h), foot + glm::dvec3(0.06 * h, 0, -0.008 * h), 0.028 * h, 0.025 * h,
             BodyMaterial::trim);
    }
    return std::move(body).take();
}

Model plain_body(const BodySize& size) {
    BodyBuilder body("body", size);
    body.box({body.rear_m(), -body.y(1.0), 0.0}, {body.front_m(), body.y(1.0), body.z(1.0)}, BodyMaterial::paint);
    return std::move(body).take();
}

} // namespace fernlicht
