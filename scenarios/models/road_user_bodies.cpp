#include "scenarios/models/road_user_bodies.h"

#include "scenarios/models/body_builder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fernlicht {
namespace {

/// A rider on a saddle, hands on a bar, up to the height.
void rider(BodyBuilder& body, const glm::dvec3& saddle, const glm::dvec3& bar, double height_m) {
    const double head = 0.12, shoulder_z = height_m - 2.0 * head - 0.12;
    const glm::dvec3 shoulders(saddle.x + 0.45 * (bar.x - saddle.x), 0.0, shoulder_z);
    body.limb({saddle.x, 0.0, saddle.z + 0.12}, shoulders - glm::dvec3(0, 0, 0.08), 0.15, 0.17, BodyMaterial::cloth, 10);
    body.limb({shoulders.x + 0.06, 0.0, height_m - head - 0.03}, {shoulders.x + 0.06, 0.0, height_m - head}, head, head, BodyMaterial::skin,
              10);
    for (const double side : {-1.0, 1.0}) {
        body.limb(shoulders + glm::dvec3(0.0, side * 0.18, 0.0), {bar.x, side * 0.25, bar.z}, 0.055, 0.04, BodyMaterial::cloth);
        const glm::dvec3 knee(saddle.x + 0.42, side * 0.13, 0.5 * saddle.z + 0.18), foot(saddle.x + 0.20, side * 0.12, 0.28);
        body.limb({saddle.x, side * 0.10, saddle.z + 0.05}, knee, 0.08, 0.065, BodyMaterial::cloth);
        body.limb(knee, foot, 0.06, 0.045, BodyMaterial::cloth);
    }
}

/// A car's hull, and which parts of it are glass: sections that begin a side window, the rear window, the windscreen.
struct CarShape {
    std::vector<BodySection> sections;
    std::vector<std::size_t> side_windows;
    std::size_t rear_window, windscreen;
};

CarShape car_shape(const BodySize& size) {
    //                                                along  width bottom belt   top  roof
    const std::vector<BodySection> bonnet{{0.730, 1.00, 0.12, 0.620, 0.672, 0.72},
                                          {0.800, 0.99, 0.12, 0.605, 0.642, 0.75},
                                          {0.940, 0.96, 0.14, 0.540, 0.570, 0.76},
                                          {0.985, 0.90, 0.17, 0.480, 0.505, 0.72},
                                          {1.000, 0.80, 0.21, 0.440, 0.455, 0.66}};
    static const std::array<CarShape, 3> shapes{{{{{0.000, 0.80, 0.27, 0.600, 0.610, 0.70},
                                                   {0.015, 0.93, 0.20, 0.640, 0.655, 0.74},
                                                   {0.050, 0.97, 0.14, 0.655, 0.740, 0.70},
                                                   {0.140, 1.00, 0.12, 0.660, 0.955, 0.65},
                                                   {0.200, 1.00, 0.12, 0.658, 0.985, 0.66},
                                                   {0.330, 1.00, 0.12, 0.650, 1.000, 0.67},
                                                   {0.355, 1.00, 0.12, 0.648, 1.000, 0.67},
                                                   {0.520, 1.00, 0.12, 0.638, 0.985, 0.66},
                                                   {0.560, 1.00, 0.12, 0.635, 0.960, 0.65}},
                                                  {3, 4, 6, 7},
                                                  2,
                                                  8},
                                                 {{{0.000, 0.80, 0.27, 0.580, 0.600, 0.70},
                                                   {0.015, 0.93, 0.20, 0.630, 0.660, 0.74},
                                                   {0.030, 0.97, 0.14, 0.655, 0.690, 0.72},
                                                   {0.150, 1.00, 0.12, 0.662, 0.710, 0.70},
                                                   {0.285, 1.00, 0.12, 0.655, 0.965, 0.65},
                                                   {0.340, 1.00, 0.12, 0.650, 0.995, 0.66},
                                                   {0.400, 1.00, 0.12, 0.648, 1.000, 0.67},
                                                   {0.420, 1.00, 0.12, 0.646, 1.000, 0.67},
                                                   {0.535, 1.00, 0.12, 0.638, 0.980, 0.66},
                                                   {0.575, 1.00, 0.12, 0.635, 0.945, 0.65}},
                                                  {4, 5, 7, 8},
                                                  3,
                                                  9},
                                                 {{{0.000, 0.82, 0.27, 0.600, 0.620, 0.70},
                                                   {0.015, 0.94, 0.20, 0.640, 0.700, 0.72},
                                                   {0.045, 0.98, 0.14, 0.652, 0.930, 0.67},
                                                   {0.075, 1.00, 0.12, 0.655, 0.985, 0.67},
                                                   {0.190, 1.00, 0.12, 0.654, 0.995, 0.67},
                                                   {0.210, 1.00, 0.12, 0.652, 1.000, 0.67},
                                                   {0.360, 1.00, 0.12, 0.648, 1.000, 0.67},
                                                   {0.380, 1.00, 0.12, 0.646, 1.000, 0.67},
                                                   {0.530, 1.00, 0.12, 0.638, 0.985, 0.66},
                                                   {0.570, 1.00, 0.12, 0.635, 0.955, 0.65}},
                                                  {3, 5, 7, 8},
                                                  1,
                                                  9}}};
    CarShape shape = shapes[size.dressed ? size.draw % 3 : 0];
    shape.sections.insert(shape.sections.end(), bonnet.begin(), bonnet.end());
    return shape;
}

} // namespace

Model car_body(const BodySize& size) {
    BodyBuilder body("car", size);
    const double radius = std::min(0.235 * size.size_m.z, 0.33);
    const CarShape shape = car_shape(size);
    body.hull(shape.sections, [&](std::size_t i, std::size_t strip) {
        const bool side_window = is_window(strip) && std::ranges::find(shape.side_windows, i) != shape.side_windows.end();
        const bool screen = is_roof(strip) && (i == shape.rear_window || i == shape.windscreen);
        return side_window || screen ? BodyMaterial::glass : under_windows(strip);
    });
    body.axle(0.0, radius, 0.21);
    body.axle(0.6 * size.size_m.x, radius, 0.21);
    body.lights(body.z(0.405), body.z(0.545), body.y(0.62), 0.26, 0.10);
    for (const double side : {-1.0, 1.0}) // outside mirrors
        body.box({body.x(0.635), side > 0.0 ? body.y(0.89) : -body.y(1.0), body.z(0.64)},
                 {body.x(0.655), side > 0.0 ? body.y(1.0) : -body.y(0.89), body.z(0.72)}, BodyMaterial::trim);
    if (size.dressed) {
        body.plate(body.front_m(), body.z(0.40), body.y(0.62), body.z(0.06), true, BodyMaterial::trim); // grille
        body.plate(body.front_m(), body.z(0.25), body.y(1.30), body.z(0.05), true, BodyMaterial::trim); // intake
        body.plate(body.rear_m(), body.z(0.30), body.y(1.50), body.z(0.05), false, BodyMaterial::trim); // bumper's strip
        body.plate(body.rear_m(), body.z(0.62), 0.30, 0.03, false, BodyMaterial::red_lens);             // third brake lamp, out
    }
    return std::move(body).take();
}

Model van_body(const BodySize& size) {
    BodyBuilder body("van", size);
    const std::vector<BodySection> sections{{0.000, 0.94, 0.14, 0.52, 0.970, 0.86}, {0.010, 0.98, 0.12, 0.52, 0.995, 0.90},
                                            {0.600, 1.00, 0.12, 0.52, 1.000, 0.90}, {0.630, 1.00, 0.12, 0.52, 1.000, 0.90},
                                            {0.740, 1.00, 0.12, 0.51, 0.980, 0.88}, {0.880, 0.99, 0.12, 0.47, 0.560, 0.82},
                                            {0.970, 0.94, 0.13, 0.40, 0.440, 0.78}, {1.000, 0.84, 0.15, 0.36, 0.380, 0.72}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        const bool side_window = is_window(strip) && i == 3, windscreen = is_roof(strip) && i == 4;
        return side_window || windscreen ? BodyMaterial::glass : under_windows(strip);
    });
    body.axle(0.0, 0.34, 0.23);
    body.axle(0.6 * size.size_m.x, 0.34, 0.23);
    body.lights(std::min(body.z(0.32), 0.75), std::min(body.z(0.45), 0.95), body.y(0.66), 0.22, 0.14);
    body.pair(body.rear_m(), body.y(0.42), body.z(0.72), body.y(0.74), body.z(0.24), false, BodyMaterial::glass);
    return std::move(body).take();
}

Model bus_body(const BodySize& size) {
    BodyBuilder body("bus", size);
    const std::vector<BodySection> sections{{0.000, 0.96, 0.10, 0.42, 0.97, 0.88}, {0.008, 0.99, 0.09, 0.42, 0.995, 0.92},
                                            {0.030, 1.00, 0.09, 0.42, 1.00, 0.93}, {0.900, 1.00, 0.09, 0.42, 1.00, 0.93},
                                            {0.985, 0.99, 0.09, 0.40, 0.99, 0.92}, {1.000, 0.94, 0.10, 0.36, 0.96, 0.86}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        return is_window(strip) && i >= 2 && i < 4 ? BodyMaterial::glass : under_windows(strip);
    });
    body.plate(body.front_m(), body.z(0.64), body.y(1.7), body.z(0.50), true, BodyMaterial::glass);
    body.plate(body.rear_m(), body.z(0.72), body.y(1.4), body.z(0.28), false, BodyMaterial::glass);
    body.axle(0.0, 0.48, 0.30);
    body.axle(0.52 * size.size_m.x, 0.48, 0.30);
    body.lights(0.75, 1.0, body.y(0.74), 0.24, 0.16);
    return std::move(body).take();
}

Model truck_body(const BodySize& size) {
    BodyBuilder body("truck", size);
    const double cab_rear = std::max(body.front_m() - 2.2, body.x(0.5)), top = body.z(1.0);
    const double half = body.y(1.0) - (size.dressed ? proud_m : 0.0); // its tape fills the box
    const double cab = (cab_rear - body.rear_m()) / size.size_m.x, step = 1.0 - cab;
    const std::vector<BodySection> sections{{cab, 0.96, 0.22, 0.52, 0.86, 0.84},
                                            {cab + 0.35 * step, 0.98, 0.20, 0.52, 0.88, 0.86},
                                            {cab + 0.85 * step, 0.98, 0.14, 0.50, 0.86, 0.85},
                                            {cab + 0.97 * step, 0.96, 0.13, 0.48, 0.80, 0.82},
                                            {1.0, 0.90, 0.13, 0.46, 0.74, 0.78}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        return is_window(strip) && (i == 1 || i == 2) ? BodyMaterial::glass : under_windows(strip);
    });
    body.plate(body.front_m(), body.z(0.60), body.y(1.5), body.z(0.20), true, BodyMaterial::glass);
    body.box({body.rear_m(), -half, 1.1}, {cab_rear - 0.25, half, top}, BodyMaterial::paint);                     // what it carries
    body.box({body.rear_m(), -0.45, 0.75}, {cab_rear + 0.3, 0.45, 1.1}, BodyMaterial::trim);                      // frame
    body.box({body.rear_m(), -0.95 * half, 0.45}, {body.rear_m() + 0.12, 0.95 * half, 0.75}, BodyMaterial::trim); // bar under its end
    body.axle(0.0, 0.5, 0.5);
    body.axle(cab_rear + 0.8, 0.5, 0.3);
    body.lights(0.75, 0.62, body.y(0.74), 0.28, 0.14);
    if (size.dressed)
        body.contour(body.rear_m() + 0.05, cab_rear - 0.3, 1.15, top - 0.05);
    return std::move(body).take();
}

Model motorcycle_body(const BodySize& size) {
    BodyBuilder body("motorcycle", size);
    const double radius = std::min(0.31, 0.2 * size.size_m.z), front_axle = body.front_m() - radius;
    const double saddle_z = std::min(0.8, 0.55 * size.size_m.z);
    body.wheel(0.0, radius, 0.15, 0.6);
    body.wheel(front_axle, radius, 0.12, 0.6);
    body.limb({0.15, 0.0, 0.45}, {front_axle - 0.35, 0.0, 0.5}, 0.16, 0.19, BodyMaterial::trim, 10); // engine
    body.limb({-0.2, 0.0, saddle_z}, {front_axle - 0.45, 0.0, saddle_z + 0.08}, 0.10, 0.15, BodyMaterial::paint, 10);
    body.limb({front_axle, 0.0, radius}, {front_axle - 0.30, 0.0, saddle_z + 0.2}, 0.06, 0.06, BodyMaterial::rim);
    body.limb({front_axle - 0.3, -0.36, saddle_z + 0.25}, {front_axle - 0.3, 0.36, saddle_z + 0.25}, 0.025, 0.025, BodyMaterial::trim);
    rider(body, {0.3, 0.0, saddle_z}, {front_axle - 0.3, 0.0, saddle_z + 0.27}, size.size_m.z);
    const double lamp_x = front_axle - 0.05, rear = body.rear_m();
    body.limb({lamp_x - 0.12, 0.0, saddle_z + 0.1}, {lamp_x - 0.04, 0.0, saddle_z + 0.1}, 0.10, 0.10, BodyMaterial::trim, 12);
    body.plate(lamp_x + 0.06, saddle_z + 0.1, 0.16, 0.14, true, BodyMaterial::lens);
    body.limb({-0.15, 0.0, saddle_z - 0.05}, {rear + 0.08, 0.0, saddle_z - 0.02}, 0.07, 0.06, BodyMaterial::paint);
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
    body.wheel(rear.x, radius, 0.04, 0.88);
    body.wheel(front.x, radius, 0.04, 0.88);
    for (const auto& [from, to] : {std::pair(rear, crank), std::pair(rear, saddle), std::pair(crank, saddle), std::pair(crank, head),
                                   std::pair(saddle - glm::dvec3(0, 0, 0.15), head), std::pair(head, front)})
        body.limb(from, to, 0.018, 0.018, BodyMaterial::paint, 6);
    const glm::dvec3 bar(head.x + 0.05, 0.0, saddle_z + 0.1);
    body.limb(head, bar, 0.015, 0.015, BodyMaterial::trim, 6);
    body.limb(bar - glm::dvec3(0, 0.28, 0), bar + glm::dvec3(0, 0.28, 0), 0.015, 0.015, BodyMaterial::trim, 6);
    rider(body, saddle, bar, size.size_m.z);
    body.plate(bar.x + 0.06, bar.z - 0.12, 0.06, 0.06, true, BodyMaterial::lens);
    body.plate(body.rear_m() + 0.01, 0.6, 0.06, 0.06, false, BodyMaterial::reflector);
    body.limb(rear + glm::dvec3(0, 0, 0.02), {body.rear_m() + 0.03, 0.0, 0.6}, 0.012, 0.012, BodyMaterial::trim, 6);
    if (size.dressed) {
        for (const double axle_x : {rear.x, front.x}) // UN R3 reflectors between the spokes, seen from the side
            for (const double side : {-1.0, 1.0})
                body.box({axle_x - 0.05, side * 0.012 - 0.006, radius + 0.5 * radius},
                         {axle_x + 0.05, side * 0.012 + 0.006, radius + 0.65 * radius}, BodyMaterial::band);
        const glm::dvec3 helmet(saddle.x + 0.45 * (bar.x - saddle.x) + 0.035, 0.0, size.size_m.z - 0.118);
        body.limb(helmet, helmet + glm::dvec3(0.0, 0.0, 0.001), 0.118, 0.118, BodyMaterial::paint, 12);
    }
    body.mounts("low", bar.x + 0.07, 0.0, bar.z - 0.12, true);
    body.mounts("tail", body.rear_m(), 0.0, 0.66, false);
    return std::move(body).take();
}

namespace {

/// Of rings instead of tubes: coat, trousers, hands, hair, shoes; one in two wears a reflecting band about an arm and both ankles.
Model dressed_pedestrian(const BodySize& size) {
    BodyBuilder body("pedestrian", size);
    const double h = size.size_m.z, x = body.x(0.5), half = std::min(0.5 * size.size_m.y, 0.16 * h),
                 step = std::min(0.16, 0.28 * size.size_m.x);
    const bool reflects = size.draw % 2 == 0;
    body.trunk({{0.078 * h, 0.060 * h, x, 0.44 * h},
                {0.092 * h, 0.068 * h, x, 0.50 * h},
                {0.086 * h, 0.064 * h, x, 0.60 * h},
                {0.104 * h, 0.070 * h, x, 0.71 * h},
                {0.112 * h, 0.066 * h, x, 0.775 * h},
                {0.085 * h, 0.050 * h, x, 0.815 * h},
                {0.040 * h, 0.038 * h, x, 0.84 * h}},
               BodyMaterial::paint, 7);
    body.limb({x, 0.0, 0.82 * h}, {x + 0.005 * h, 0.0, 0.87 * h}, 0.031 * h, 0.031 * h, BodyMaterial::skin);
    body.limb({x + 0.012 * h, 0.0, 0.895 * h}, {x + 0.012 * h, 0.0, 0.93 * h}, 0.040 * h, 0.046 * h, BodyMaterial::skin, 8);
    body.limb({x - 0.006 * h, 0.0, 0.925 * h}, {x - 0.004 * h, 0.0, 0.948 * h}, 0.050 * h, 0.050 * h, BodyMaterial::hair, 8);
    for (const double side : {-1.0, 1.0}) {
        const glm::dvec3 shoulder(x, side * 0.105 * h, 0.79 * h), elbow(x - side * 0.25 * step, side * (half - 0.03 * h), 0.62 * h),
            wrist(x - side * 0.8 * step + 0.02 * h, side * (half - 0.035 * h), 0.50 * h), ankle(x + side * step, side * 0.05 * h, 0.05 * h),
            knee(x + side * 0.55 * step + 0.015 * h, side * 0.052 * h, 0.27 * h);
        body.limb(shoulder, elbow, 0.036 * h, 0.029 * h, BodyMaterial::paint, 7);
        body.limb(elbow, wrist, 0.028 * h, 0.021 * h, BodyMaterial::paint, 7);
        body.limb(wrist, wrist + glm::dvec3(0.004 * h, 0, -0.035 * h), 0.017 * h, 0.017 * h, BodyMaterial::skin);
        body.limb({x, side * 0.048 * h, 0.50 * h}, knee, 0.052 * h, 0.037 * h, BodyMaterial::cloth, 7);
        body.limb(knee, ankle, 0.037 * h, 0.026 * h, BodyMaterial::cloth, 7);
        body.limb(ankle - glm::dvec3(0.018 * h, 0, 0.025 * h), ankle + glm::dvec3(0.065 * h, 0, -0.028 * h), 0.024 * h, 0.019 * h,
                  BodyMaterial::trim, 7);
        if (reflects) {
            const glm::dvec3 low = ankle + 0.12 * (knee - ankle), high = ankle + 0.30 * (knee - ankle);
            body.limb(low, high, 0.0295 * h, 0.0315 * h, BodyMaterial::band, 7);
        }
    }
    if (reflects)
        body.limb({x - 0.10 * step, half - 0.035 * h - 0.01 * h, 0.69 * h}, {x - 0.15 * step, half - 0.032 * h, 0.665 * h}, 0.036 * h,
                  0.035 * h, BodyMaterial::band, 7);
    return std::move(body).take();
}

} // namespace

Model pedestrian_body(const BodySize& size) {
    if (size.dressed)
        return dressed_pedestrian(size);
    BodyBuilder body("pedestrian", size);
    const double h = size.size_m.z, x = body.x(0.5), half = std::min(0.5 * size.size_m.y, 0.16 * h),
                 step = std::min(0.18, 0.3 * size.size_m.x);
    body.limb({x, 0.0, 0.90 * h}, {x, 0.0, 0.935 * h}, 0.062 * h, 0.062 * h, BodyMaterial::skin, 10);
    body.limb({x, 0.0, 0.82 * h}, {x, 0.0, 0.86 * h}, 0.03 * h, 0.03 * h, BodyMaterial::skin);
    for (const double beside : {-0.05, -0.025, 0.0, 0.025, 0.05}) // trunk
        body.limb({x, beside * h, 0.54 * h}, {x, 1.5 * beside * h, 0.765 * h}, 0.07 * h, 0.068 * h, BodyMaterial::paint, 10);
    for (const double side : {-1.0, 1.0}) {
        body.limb({x, side * (half - 0.03 * h), 0.78 * h}, {x - side * 0.5 * step, side * (half - 0.02 * h), 0.46 * h}, 0.034 * h,
                  0.026 * h, BodyMaterial::paint);
        const glm::dvec3 foot(x + side * step, side * 0.055 * h, 0.035 * h);
        body.limb({x, side * 0.055 * h, 0.50 * h}, {x + side * 0.6 * step, side * 0.055 * h, 0.28 * h}, 0.058 * h, 0.042 * h,
                  BodyMaterial::cloth);
        body.limb({x + side * 0.6 * step, side * 0.055 * h, 0.28 * h}, foot, 0.042 * h, 0.03 * h, BodyMaterial::cloth);
        body.limb(foot - glm::dvec3(0.03 * h, 0, 0.005 * h), foot + glm::dvec3(0.06 * h, 0, -0.008 * h), 0.028 * h, 0.025 * h,
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
