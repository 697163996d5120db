#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/drives/keys/lamp_sets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double map_px_per_m = 4.0, least_fov_deg = 0.01, most_fov_deg = 179.0;
constexpr std::size_t most_views = 64, most_set_bytes = std::size_t{1} << 20;

View driver_view() {
    View view;
    view.name = "driver";
    // A driver's eye in a left-hand-drive car: 1.2 m above the road, 1.3 m before the rear axle.
    view.position_m = {1.3, 0.35, 1.2};
    view.vertical_fov_rad = radians(40.0);
    return view;
}

int map_pixels(double length_m) { return std::clamp(static_cast<int>(std::lround(length_m * map_px_per_m)), 1, largest_view_px); }

/// Four pixels a metre, so that both axes have one scale.
void fit_map_pixels(View& view) {
    view.width_px = map_pixels(view.map_left_m + view.map_right_m);
    view.height_px = map_pixels(view.map_ahead_m + view.map_behind_m);
}

View map_view() {
    View view;
    view.name = "map";
    view.projection = Projection::map;
    view.map_ahead_m = 150.0;
    view.map_behind_m = 10.0;
    view.map_left_m = view.map_right_m = 25.0;
    fit_map_pixels(view);
    return view;
}

void read_map(View& view, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"ahead_m", "behind_m", "left_m", "right_m"});
    const View standard = map_view();
    view.projection = Projection::map;
    view.map_ahead_m = keys.number_or("ahead_m", standard.map_ahead_m, -2000.0, 2000.0);
    view.map_behind_m = keys.number_or("behind_m", standard.map_behind_m, -2000.0, 2000.0);
    view.map_left_m = keys.number_or("left_m", standard.map_left_m, -500.0, 500.0);
    view.map_right_m = keys.number_or("right_m", standard.map_right_m, -500.0, 500.0);
    if (view.map_ahead_m + view.map_behind_m < 0.1 || view.map_left_m + view.map_right_m < 0.1)
        entry.refuse("a map without area", "ahead_m + behind_m and left_m + right_m of at least 0.1");
    fit_map_pixels(view);
}

void read_perspective(View& view, const YamlMap& keys) {
    const View standard = driver_view();
    const auto position = keys.find("position_m");
    view.position_m = position ? read_position(*position) : standard.position_m;
    view.yaw_rad = keys.angle_rad("yaw", 360.0).value_or(0.0);
    view.pitch_rad = keys.angle_rad("pitch", 90.0).value_or(0.0);
    view.roll_rad = keys.angle_rad("roll", 360.0).value_or(0.0);
    view.mirrored = keys.flag_or("mirrored", false);
    view.vertical_fov_rad = standard.vertical_fov_rad;
    if (const auto given = keys.one_of({"vertical_fov_deg", "vertical_fov_rad"}))
        view.vertical_fov_rad = given->first == "vertical_fov_deg" ? radians(given->second.number(least_fov_deg, most_fov_deg))
                                                                   : given->second.number(radians(least_fov_deg), radians(most_fov_deg));
}

View read_view(const std::string& name, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"position_m", "yaw_deg", "yaw_rad", "pitch_deg", "pitch_rad", "roll_deg", "roll_rad",
                                    "vertical_fov_deg", "vertical_fov_rad", "resolution_px", "map", "mirrored"});
    View view;
    view.name = name;
    if (const auto map = keys.find("map")) {
        for (const std::string_view key : {"position_m", "yaw_deg", "yaw_rad", "pitch_deg", "pitch_rad", "roll_deg", "roll_rad",
                                           "vertical_fov_deg", "vertical_fov_rad", "mirrored"})
            if (const auto camera = keys.find(key))
                camera->refuse("a camera's key in a map", "only map and resolution_px here");
        read_map(view, *map);
    } else {
        read_perspective(view, keys);
    }
    if (const auto resolution = keys.find("resolution_px")) {
        const std::vector<YamlEntry> sides = resolution->list(2, 2);
        view.width_px = sides[0].whole(1, largest_view_px);
        view.height_px = sides[1].whole(1, largest_view_px);
    }
    return view;
}

/// The views of a file that holds nothing else.
std::vector<View> read_view_set(const YamlEntry& set, FilesRead& opened) {
    const std::filesystem::path path = set.path();
    check_file(path, set);
    const YamlValue document = parse_yaml(to_utf8(read_file(path, opened, most_set_bytes)), path);
    const YamlMap keys(YamlEntry(document, path, ""), {"fernlicht_views", "views"});
    keys.require("fernlicht_views").whole(1, 1);
    std::vector<View> views;
    for (const auto& [name, entry] : keys.require("views").named(most_views))
        views.push_back(read_view(name, entry));
    return views;
}

} // namespace

glm::dvec3 read_position(const YamlEntry& entry) {
    const std::vector<double> xyz = entry.numbers(3, 3, -100.0, 100.0);
    return {xyz[0], xyz[1], xyz[2]};
}

std::vector<View> read_views(const YamlMap& drive, FilesRead& opened) {
    const auto given = drive.find("views"), set = drive.find("view_set");
    if (!given && !set)
        return {driver_view(), map_view()};
    std::vector<View> views;
    if (set)
        views = read_view_set(*set, opened);
    if (given)
        for (const auto& [name, entry] : given->named(most_views)) {
            View view = read_view(name, entry);
            const auto known = std::ranges::find(views, view.name, &View::name);
            known == views.end() ? views.push_back(std::move(view)) : void(*known = std::move(view));
        }
    if (set && std::ranges::find(views, Projection::map, &View::projection) == views.end())
        views.push_back(map_view());
    if (views.size() > most_views)
        set->refuse(fmt::format("{} views", views.size()), fmt::format("at most {}", most_views));
    return views;
}

} // namespace fernlicht
