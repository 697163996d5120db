#include "scenarios/drives/shadow_keys.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int least_texels = 16, most_texels = 8192;

ShadowMethod method_of(const YamlEntry& entry) {
    std::vector<std::string_view> names;
    for (const ShadowMethodName& row : shadow_method_names())
        names.push_back(row.name);
    names.emplace_back("auto");
    const std::size_t chosen = entry.choice(names);
    return chosen + 1 == names.size() ? ShadowMethod::automatic : shadow_method_names()[chosen].method;
}

} // namespace

ShadowSettings read_shadows(const YamlMap& drive) {
    ShadowSettings shadows;
    const auto given = drive.find("shadows");
    if (!given)
        return shadows;
    if (given->is_scalar()) {
        if (given->value().text == "true" || given->value().text == "false")
            shadows.method = given->flag() ? ShadowMethod::map : ShadowMethod::none;
        else
            shadows.method = method_of(*given);
        return shadows;
    }
    const YamlMap keys =
        given->map({"method", "map_texels", "tolerance_m", "redraw_texels", "lamp_radius_m", "lamp_places", "error_bound"});
    shadows.method = method_of(keys.require("method"));
    if (const auto texels = keys.find("map_texels")) {
        const std::vector<YamlEntry> sides = texels->list(2, 2);
        shadows.width = sides[0].whole(least_texels, most_texels);
        shadows.height = sides[1].whole(least_texels, most_texels);
    }
    shadows.tolerance_m = keys.number_or("tolerance_m", shadows.tolerance_m, 1.0e-4, 1.0);
    shadows.redraw_texels = keys.number_or("redraw_texels", shadows.redraw_texels, 0.0, 16.0);
    shadows.lamp_radius_m = keys.number_or("lamp_radius_m", shadows.lamp_radius_m, 0.001, 0.5);
    if (const auto places = keys.find("lamp_places"))
        shadows.lamp_places = places->whole(1, 64);
    shadows.error_bound = keys.number_or("error_bound", shadows.error_bound, 0.0, 1.0);
    return shadows;
}

std::string write_shadows(const ShadowSettings& shadows) {
    return fmt::format("shadows: {{method: {}, map_texels: [{}, {}], tolerance_m: {}, redraw_texels: {}, lamp_radius_m: {}, lamp_places: "
                       "{}, error_bound: {}}}\n",
                       name(shadows.method), shadows.width, shadows.height, shadows.tolerance_m, shadows.redraw_texels,
                       shadows.lamp_radius_m, shadows.lamp_places, shadows.error_bound);
}

} // namespace fernlicht
