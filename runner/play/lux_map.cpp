#include "runner/play/lux_map.h"

#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double edge_step_m = 2.0;

} // namespace

LuxMap lux_map_of(const Frame& frame, const Moment& moment, const View& view, const Route& route, double bumper_m) {
    LuxMap map;
    map.lx = frame.illuminance_lx;
    map.ahead_m = view.map_ahead_m;
    map.behind_m = view.map_behind_m;
    map.left_m = view.map_left_m;
    map.right_m = view.map_right_m;
    map.tick = moment.tick;
    map.time_s = moment.time_s;
    map.edges = edges_on_map(moment, view, route);
    map.edges.push_back(car_outline(bumper_m));
    return map;
}

LuxMap::Polyline car_outline(double bumper_m) {
    constexpr double behind_m = 0.9, half_width_m = 0.9;
    return {"car",
            {{-behind_m, half_width_m},
             {bumper_m, half_width_m},
             {bumper_m, -half_width_m},
             {-behind_m, -half_width_m},
             {-behind_m, half_width_m}}};
}

std::vector<LuxMap::Polyline> edges_on_map(const Moment& moment, const View& view, const Route& route) {
    const Camera axes = camera_of(moment, view);
    const auto place = [&](double distance, double offset) {
        const glm::dvec3 p = route.pose(distance, offset).position_m - moment.ego.position_m;
        return std::pair(glm::dot(p, axes.up), -glm::dot(p, axes.right));
    };
    std::vector<LuxMap::Polyline> edges;
    // One line for each side of each lane, followed while the lane exists.
    std::map<std::string, LuxMap::Polyline> open;
    const double from = std::max(0.0, moment.distance_m - view.map_behind_m),
                 to = std::min(route.length_m(), moment.distance_m + view.map_ahead_m);
    for (double distance = from; distance <= to; distance += edge_step_m) {
        const CrossSection section = route.cross_section(distance);
        std::map<std::string, double> here;
        for (const RouteLane& lane : section.lanes) {
            if (lane.type != "driving" && lane.type != "shoulder")
                continue;
            here[lane.name + " left"] = lane.left_m;
            here[lane.name + " right"] = lane.right_m;
        }
        for (auto it = open.begin(); it != open.end();) {
            if (here.contains(it->first)) {
                ++it;
                continue;
            }
            edges.push_back(std::move(it->second));
            it = open.erase(it);
        }
        for (const auto& [name, offset] : here) {
            LuxMap::Polyline& line = open[name];
            line.kind = offset == section.paved_left_m || offset == section.paved_right_m ? "road edge" : "lane edge";
            line.ahead_left_m.push_back(place(distance, offset));
        }
    }
    for (auto& [name, line] : open)
        edges.push_back(std::move(line));
    return edges;
}

} // namespace fernlicht
