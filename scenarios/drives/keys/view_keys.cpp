#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/drives/keys/lamp_sets.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/field_bits.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double map_px_per_m = 4.0, min_fov_deg = 0.01, max_fov_deg = 179.0;
constexpr std::size_t max_set_bytes = std::size_t{1} << 20;

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

/// Camera and map at their defaults.
View default_view() {
    View view = driver_view();
    const View map = map_view();
    view.map_ahead_m = map.map_ahead_m, view.map_behind_m = map.map_behind_m;
    view.map_left_m = map.map_left_m, view.map_right_m = map.map_right_m;
    return view;
}

void check_map(const YamlMap& keys, const View& view) {
    if (view.map_ahead_m + view.map_behind_m < 0.1 || view.map_left_m + view.map_right_m < 0.1)
        keys.entry().refuse("a map without area", "ahead_m + behind_m and left_m + right_m of at least 0.1");
}

const Fields<View>& map_fields() {
    static const Fields<View> fields =
        Fields<View>{
            field("ahead_m", 1, &View::map_ahead_m, range(-2000.0, 2000.0), "of the car's origin"),
            field("behind_m", 2, &View::map_behind_m, range(-2000.0, 2000.0), "of the car's origin"),
            field("left_m", 3, &View::map_left_m, range(-500.0, 500.0), "of the car's origin"),
            field("right_m", 4, &View::map_right_m, range(-500.0, 500.0), "of the car's origin"),
        }
            .checked(check_map);
    return fields;
}

bool is_map(const void* view) { return static_cast<const View*>(view)->projection == Projection::map; }
bool is_camera(const void* view) { return !is_map(view); }

void read_resolution(const YamlEntry& entry, View& view) {
    const std::vector<YamlEntry> sides = entry.list(2, 2);
    view.width_px = sides[0].whole(1, largest_view_px);
    view.height_px = sides[1].whole(1, largest_view_px);
}

std::string resolution_text(const View& view) { return fmt::format("[{}, {}]", view.width_px, view.height_px); }

FieldRule field_of_view() {
    FieldRule rule = degrees_within("vertical_fov", max_fov_deg);
    rule.units[0].least = min_fov_deg;
    rule.units[1].least = radians(min_fov_deg);
    return rule;
}

View read_view(const std::string& name, const YamlEntry& entry) {
    const YamlMap keys = entry.map(keys_of(view_fields()));
    const bool map = keys.find("map").has_value();
    if (map)
        for (const std::string_view key : keys_of(view_fields()))
            if (const auto camera = keys.find(key); camera && key != "map" && key != "resolution_px")
                camera->refuse("a camera's key in a map", "only map and resolution_px here");
    View view = map ? map_view() : driver_view();
    view.name = name;
    read_field(view_fields(), "map", keys, &view);
    if (map)
        fit_map_pixels(view);
    read_group(view_fields(), keys, &view);
    return view;
}

/// The views of a file that holds nothing else.
std::vector<View> read_view_set(const YamlEntry& set, FilesRead& opened) {
    const std::filesystem::path path = set.path();
    check_file(path, set);
    const YamlValue document = parse_yaml(to_utf8(read_file(path, opened, max_set_bytes)), path);
    const YamlMap keys(YamlEntry(document, path, ""), {"fernlicht_views", "views"});
    keys.require("fernlicht_views").whole(1, 1);
    std::vector<View> views;
    EachRead each;
    for (const auto& [name, entry] : keys.require("views").named(max_views))
        each([&, &name = name, &entry = entry] { views.push_back(read_view(name, entry)); });
    each.end();
    return views;
}

} // namespace

const Fields<View>& view_fields() {
    static const Fields<View> fields =
        Fields<View>{
            field("position_m", 1, &View::position_m, range(-100.0, 100.0), "x forward, y left, z up from the road under the rear axle")
                .heard_if(is_camera),
            field("yaw", 2, &View::yaw_rad, degrees_within("yaw", 360.0), "to the left").heard_if(is_camera),
            field("pitch", 3, &View::pitch_rad, degrees_within("pitch", 90.0), "upwards").heard_if(is_camera),
            field("roll", 4, &View::roll_rad, degrees_within("roll", 360.0), "lifts the left side").heard_if(is_camera),
            field("vertical_fov", 5, &View::vertical_fov_rad, field_of_view(), "from the picture's lower to its upper edge")
                .heard_if(is_camera),
            field("mirrored", 6, &View::mirrored, any(), "left and right exchanged, as a mirror shows it; of a camera only")
                .written_off_default()
                .heard_if(is_camera),
            section("map", 7, map_fields(), "bird's eye instead of a camera, travel upwards")
                .bits_by([](const View& view) { return is_map(&view) ? "map\n" + field_bits(map_fields(), &view) : ""; })
                .heard_if(is_map),
            own("resolution_px", 8, read_resolution, resolution_text, R"({"type": "array", "minItems": 2, "maxItems": 2,
                "items": {"type": "integer", "minimum": 1, "maximum": 16384}})",
                "width, height; of a map 4 a metre by default"),
        }
            .block()
            .at_defaults(default_view());
    return fields;
}

std::vector<View> read_views(const YamlMap& drive, FilesRead& opened) {
    const auto given = drive.find("views"), set = drive.find("view_set");
    if (!given && !set)
        return {driver_view(), map_view()};
    std::vector<View> views;
    EachRead each;
    if (set)
        each([&] { views = read_view_set(*set, opened); });
    if (given)
        for (const auto& [name, entry] : given->named(max_views))
            each([&, &name = name, &entry = entry] {
                View view = read_view(name, entry);
                const auto known = std::ranges::find(views, view.name, &View::name);
                known == views.end() ? views.push_back(std::move(view)) : void(*known = std::move(view));
            });
    each.end();
    if (set && std::ranges::find(views, Projection::map, &View::projection) == views.end())
        views.push_back(map_view());
    if (views.size() > max_views)
        set->refuse(fmt::format("{} views", views.size()), fmt::format("at most {}", max_views));
    return views;
}

} // namespace fernlicht
