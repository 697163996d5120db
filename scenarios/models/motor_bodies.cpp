#include "scenarios/models/body_parts.h"

#include <algorithm>

namespace fernlicht {
namespace {

bool is_window(std::size_t strip) { return strip == 4; }
bool is_roof(std::size_t strip) { return strip == 6; }

BodyMaterial below_windows(std::size_t strip) { return strip <= 1 ? BodyMaterial::trim : BodyMaterial::paint; }

} // namespace

Model car_body(const BodySize& size) {
    BodyBuilder body("car", size);
    const double radius = std::min(0.235 * size.size_m.z, 0.33);
    //                                  along  width bottom belt   top  roof
    const std::vector<BodySection> sections{
        {0.000, 0.80, 0.27, 0.600, 0.610, 0.70}, {0.015, 0.93, 0.20, 0.640, 0.655, 0.74}, {0.050, 0.97, 0.14, 0.655, 0.740, 0.70},
        {0.140, 1.00, 0.12, 0.660, 0.955, 0.65}, {0.200, 1.00, 0.12, 0.658, 0.985, 0.66}, {0.330, 1.00, 0.12, 0.650, 1.000, 0.67},
        {0.355, 1.00, 0.12, 0.648, 1.000, 0.67}, {0.520, 1.00, 0.12, 0.638, 0.985, 0.66}, {0.560, 1.00, 0.12, 0.635, 0.960, 0.65},
        {0.730, 1.00, 0.12, 0.620, 0.672, 0.72}, {0.800, 0.99, 0.12, 0.605, 0.642, 0.75}, {0.940, 0.96, 0.14, 0.540, 0.570, 0.76},
        {0.985, 0.90, 0.17, 0.480, 0.505, 0.72}, {1.000, 0.80, 0.21, 0.440, 0.455, 0.66}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        const bool side_window = is_window(strip) && ((i >= 3 && i < 5) || (i >= 6 && i < 8));
        const bool rear_window = is_roof(strip) && i == 2, windscreen = is_roof(strip) && i == 8;
        return side_window || rear_window || windscreen ? BodyMaterial::glass : below_windows(strip);
    });
    body.axle(0.0, radius, 0.21);
    body.axle(0.6 * size.size_m.x, radius, 0.21);
    body.lights(body.z(0.405), body.z(0.545), body.y(0.62), 0.26, 0.10);
    for (const double side : {-1.0, 1.0}) // outside mirrors
        body.box({body.x(0.635), side > 0.0 ? body.y(0.89) : -body.y(1.0), body.z(0.64)},
                 {body.x(0.655), side > 0.0 ? body.y(1.0) : -body.y(0.89), body.z(0.72)}, BodyMaterial::trim);
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
        return side_window || windscreen ? BodyMaterial::glass : below_windows(strip);
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
        return is_window(strip) && i >= 2 && i < 4 ? BodyMaterial::glass : below_windows(strip);
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
    const double cab_rear = std::max(body.front_m() - 2.2, body.x(0.5)), half = body.y(1.0), top = body.z(1.0);
    const double cab = (cab_rear - body.rear_m()) / size.size_m.x, step = 1.0 - cab;
    const std::vector<BodySection> sections{{cab, 0.96, 0.22, 0.52, 0.86, 0.84},
                                            {cab + 0.35 * step, 0.98, 0.20, 0.52, 0.88, 0.86},
                                            {cab + 0.85 * step, 0.98, 0.14, 0.50, 0.86, 0.85},
                                            {cab + 0.97 * step, 0.96, 0.13, 0.48, 0.80, 0.82},
                                            {1.0, 0.90, 0.13, 0.46, 0.74, 0.78}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        return is_window(strip) && (i == 1 || i == 2) ? BodyMaterial::glass : below_windows(strip);
    });
    body.plate(body.front_m(), body.z(0.60), body.y(1.5), body.z(0.20), true, BodyMaterial::glass);
    body.box({body.rear_m(), -half, 1.1}, {cab_rear - 0.25, half, top}, BodyMaterial::paint);                     // what it carries
    body.box({body.rear_m(), -0.45, 0.75}, {cab_rear + 0.3, 0.45, 1.1}, BodyMaterial::trim);                      // frame
    body.box({body.rear_m(), -0.95 * half, 0.45}, {body.rear_m() + 0.12, 0.95 * half, 0.75}, BodyMaterial::trim); // bar under its end
    body.axle(0.0, 0.5, 0.5);
    body.axle(cab_rear + 0.8, 0.5, 0.3);
    body.lights(0.75, 0.62, body.y(0.74), 0.28, 0.14);
    return std::move(body).take();
}

} // namespace fernlicht
