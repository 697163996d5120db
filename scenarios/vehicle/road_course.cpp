#include "scenarios/vehicle/road_course.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

double RoadCourse::at(const std::vector<double>& table, double distance_m, double& derivative) {
    derivative = 0.0;
    if (table.empty())
        return 0.0;
    const double place = distance_m / cell_m + 1.0; // knot 0 lies at -1 cells
    const double last = static_cast<double>(table.size() - 1);
    if (!(place > 1.0) || place >= last - 1.0)
        return place > 1.0 ? table.back() : table.front();
    const auto knot = static_cast<std::size_t>(place);
    const double u = place - static_cast<double>(knot), v = 1.0 - u;
    const double* c = &table[knot - 1];
    derivative = (-0.5 * v * v * c[0] + (1.5 * u * u - 2.0 * u) * c[1] + (-1.5 * u * u + u + 0.5) * c[2] + 0.5 * u * u * c[3]) / cell_m;
    return (v * v * v * c[0] + (3.0 * u * u * u - 6.0 * u * u + 4.0) * c[1] + (3.0 * v * v * v - 6.0 * v * v + 4.0) * c[2] +
            u * u * u * c[3]) /
           6.0;
}

RoadCourse road_course(const Route& route, double length_m) {
    RoadCourse course;
    const double used_m = std::min(length_m, route.length_m());
    const auto cells = static_cast<std::size_t>(std::ceil(used_m / RoadCourse::cell_m));
    const auto heading = [](const Pose& pose) { return std::atan2(pose.forward().y, pose.forward().x); };
    Pose before = route.pose(0.0);
    double before_m = 0.0;
    course.slope.push_back(before.forward().z);
    course.curvature_per_m.push_back(0.0);
    for (std::size_t k = 0; k <= cells; ++k) {
        const double end_m = std::min((static_cast<double>(k) + 0.5) * RoadCourse::cell_m, route.length_m());
        const Pose pose = route.pose(end_m);
        const double length = end_m - before_m;
        if (!(length > 1.0e-6)) {
            course.slope.push_back(course.slope.back());
            course.curvature_per_m.push_back(0.0);
            continue;
        }
        course.slope.push_back((pose.position_m.z - before.position_m.z) / length);
        course.curvature_per_m.push_back(std::remainder(heading(pose) - heading(before), 2.0 * pi) / length);
        before = pose;
        before_m = end_m;
    }
    course.slope.front() = course.slope[1];
    course.curvature_per_m.front() = course.curvature_per_m[1];
    for (int beyond = 0; beyond < 3; ++beyond) {
        course.slope.push_back(course.slope.back());
        course.curvature_per_m.push_back(used_m < route.length_m() ? course.curvature_per_m.back() : 0.0);
    }
    return course;
}

} // namespace fernlicht
