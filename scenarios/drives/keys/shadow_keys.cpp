#include "scenarios/drives/keys/shadow_keys.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <initializer_list>

namespace fernlicht {
namespace {

constexpr int least_texels = 16, most_texels = 8192;

std::vector<std::string_view> words_for_methods() {
    std::vector<std::string_view> names;
    for (const ShadowMethodName& row : shadow_method_names())
        names.push_back(row.name);
    names.push_back(name(ShadowMethod::automatic));
    return names;
}

ShadowMethod method_of(const YamlEntry& entry) {
    const std::vector<std::string_view> names = words_for_methods();
    const std::size_t chosen = entry.choice(names);
    return chosen + 1 == names.size() ? ShadowMethod::automatic : shadow_method_names()[chosen].method;
}

bool is_one_of(ShadowMethod method, std::initializer_list<ShadowMethod> methods) {
    return std::ranges::find(methods, method) != methods.end();
}

bool shadows_anything(ShadowMethod method) { return method != ShadowMethod::none; }
bool draws_own_maps(ShadowMethod method) {
    return !is_one_of(method, {ShadowMethod::none, ShadowMethod::under_car, ShadowMethod::planar, ShadowMethod::volumes});
}
bool has_discs(ShadowMethod method) { return is_one_of(method, {ShadowMethod::soft_map, ShadowMethod::automatic}); }
bool is_to_be_chosen(ShadowMethod method) { return method == ShadowMethod::automatic; }

/// A key, the methods that hear it, and its value as text. The first two are those of the maps of others' lamps, whatever the method.
struct ShadowKey {
    std::string_view key;
    bool (*heard_by)(ShadowMethod);
    std::string (*text)(const ShadowSettings&);
};
constexpr ShadowKey shadow_keys[] = {
    {"map_texels", shadows_anything, [](const ShadowSettings& s) { return fmt::format("[{}, {}]", s.width, s.height); }},
    {"tolerance_m", shadows_anything, [](const ShadowSettings& s) { return fmt::format("{}", s.tolerance_m); }},
    {"redraw_texels", draws_own_maps, [](const ShadowSettings& s) { return fmt::format("{}", s.redraw_texels); }},
    {"lamp_radius_m", has_discs, [](const ShadowSettings& s) { return fmt::format("{}", s.lamp_radius_m); }},
    {"lamp_places", has_discs, [](const ShadowSettings& s) { return fmt::format("{}", s.lamp_places); }},
    {"error_bound", is_to_be_chosen, [](const ShadowSettings& s) { return fmt::format("{}", s.error_bound); }},
};

void refuse_keys_without_effect(const YamlMap& keys, ShadowMethod method) {
    std::string heard = "method";
    for (const ShadowKey& row : shadow_keys)
        if (row.heard_by(method))
            heard += fmt::format(", {}", row.key);
    for (const ShadowKey& row : shadow_keys)
        if (const auto given = keys.find(row.key); given && !row.heard_by(method))
            given->refuse(fmt::format("a key that method '{}' does not use", name(method)), fmt::format("none but {}", heard));
}

} // namespace

ShadowSettings read_shadows(const YamlMap& drive) {
    ShadowSettings shadows;
    const auto given = drive.find("shadows");
    if (!given)
        return shadows;
    if (given->is_scalar()) {
        if (given->value().text == "true" || given->value().text == "false") {
            shadows.things_cast = given->flag();
            shadows.method = shadows.things_cast ? ShadowMethod::map : ShadowMethod::none;
        } else
            shadows.method = method_of(*given);
        return shadows;
    }
    if (given->value().kind != YamlValue::Kind::map)
        given->refuse(fmt::format("true, false, one of {}, or a map with keys such as method", fmt::join(words_for_methods(), ", ")));
    const YamlMap keys =
        given->map({"method", "map_texels", "tolerance_m", "redraw_texels", "lamp_radius_m", "lamp_places", "error_bound"});
    shadows.method = method_of(keys.require("method"));
    refuse_keys_without_effect(keys, shadows.method);
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
    if (const auto bound = keys.find("error_bound")) {
        shadows.error_bound = bound->number(-HUGE_VAL, HUGE_VAL);
        if (!(shadows.error_bound >= 0.0 && shadows.error_bound < 1.0)) // 1 would bind nothing
            bound->refuse("a share from 0 to below 1 (0.01 is 1 %)");
    }
    return shadows;
}

std::vector<std::pair<std::string_view, std::string>> used_shadow_keys(const ShadowSettings& shadows) {
    std::vector<std::pair<std::string_view, std::string>> used;
    for (const ShadowKey& row : shadow_keys)
        if (row.heard_by(shadows.method))
            used.emplace_back(row.key, row.text(shadows));
    return used;
}

std::string write_shadows(const ShadowSettings& shadows) {
    if (!shadows.any())
        return shadows.things_cast ? "shadows: none\n" : "shadows: false\n";
    const ShadowSettings usual;
    std::string keys;
    bool all_usual = shadows.method == usual.method;
    for (const ShadowKey& row : shadow_keys)
        if (row.heard_by(shadows.method)) {
            keys += fmt::format(", {}: {}", row.key, row.text(shadows));
            all_usual &= row.text(shadows) == row.text(usual);
        }
    return all_usual ? "shadows: true\n" : fmt::format("shadows: {{method: {}{}}}\n", name(shadows.method), keys);
}

} // namespace fernlicht
