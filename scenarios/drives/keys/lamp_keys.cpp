#include "scenarios/drives/keys/lamp_keys.h"

#include <cmath>

namespace fernlicht {
namespace {

constexpr std::string_view colour_keys[] = {"temperature_k", "spectrum", "colour"};

void read_texture(LampReadOptions& options, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"scale_lx", "distance_m", "h_extent_deg", "v_extent_deg"});
    options.texture_scale_lx = keys.number_or("scale_lx", options.texture_scale_lx, 0.0, 1.0e6);
    options.texture_distance_m = keys.number_or("distance_m", options.texture_distance_m, 0.1, 1000.0);
    const auto extent = [&](std::string_view key, double limit, double(&edges)[2]) {
        const auto given = keys.find(key);
        if (!given)
            return;
        const std::vector<double> values = given->numbers(2, 2, -limit, limit);
        if (values[0] >= values[1])
            given->refuse("edges that do not ascend", "[lower, upper]");
        edges[0] = values[0];
        edges[1] = values[1];
    };
    extent("h_extent_deg", 180.0, options.texture_h_extent_deg);
    extent("v_extent_deg", 90.0, options.texture_v_extent_deg);
}

LampReadOptions read_options(const Layers& layers, TypeCAxis axis_otherwise) {
    static constexpr BetweenSamples rules[] = {BetweenSamples::linear_cd, BetweenSamples::log_cd};
    static constexpr TypeCAxis axes[] = {TypeCAxis::automatic, TypeCAxis::horizontal, TypeCAxis::nadir};
    LampReadOptions options;
    options.type_c_axis = axis_otherwise;
    if (const auto rule = find_in(layers, "between_samples"))
        options.rule = rules[rule->choice({"linear_cd", "log_cd"})];
    if (const auto axis = find_in(layers, "type_c_axis"))
        options.type_c_axis = axes[axis->choice({"automatic", "horizontal", "nadir"})];
    if (const auto texture = find_in(layers, "texture"))
        read_texture(options, *texture);
    if (const auto mirrored = find_in(layers, "mirrored"))
        options.mirrored = mirrored->flag();
    return options;
}

LampColour read_explicit_colour(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"linear_srgb", "sp_ratio", "cct_k"});
    const std::vector<double> rgb = keys.require("linear_srgb").numbers(3, 3, -100.0, 100.0);
    LampColour colour;
    colour.linear_srgb = {rgb[0], rgb[1], rgb[2]};
    colour.sp_ratio = keys.require("sp_ratio").number(0.0, 100.0);
    colour.cct_k = keys.number_or("cct_k", 0.0, 0.0, 1.0e6);
    return colour;
}

} // namespace

std::optional<YamlEntry> find_in(const Layers& layers, std::string_view key) {
    for (const YamlMap& layer : layers)
        if (std::optional<YamlEntry> found = layer.find(key))
            return found;
    return std::nullopt;
}

std::shared_ptr<const LampFile> read_lamp_keys(const Layers& layers, LampShelf& shelf, TypeCAxis axis) {
    const auto file = find_in(layers, "file");
    if (!file)
        return nullptr;
    return shelf.lamp(file->path(), read_options(layers, axis), &*file);
}

AimKeys read_aim(const Layers& layers) {
    const auto given = find_in(layers, "aim");
    if (!given)
        return {};
    const YamlMap keys = given->map({"pitch_deg", "pitch_rad", "percent_down", "yaw_deg", "yaw_rad", "roll_deg", "roll_rad"});
    AimKeys aim{keys.angle_rad("pitch", 90.0), keys.angle_rad("yaw", 180.0), keys.angle_rad("roll", 180.0)};
    if (const auto percent = keys.find("percent_down")) {
        if (aim.pitch_rad)
            percent->refuse("percent_down beside a pitch", "one of them");
        aim.pitch_rad = -std::atan(percent->number(-100.0, 100.0) / 100.0);
    }
    return aim;
}

std::optional<SourceKind> read_source(const Layers& layers) {
    static constexpr SourceKind kinds[] = {SourceKind::filament, SourceKind::arc, SourceKind::led};
    const auto source = find_in(layers, "source");
    if (!source)
        return std::nullopt;
    return kinds[source->choice({"filament", "arc", "led"})];
}

bool gives_colour(const Layers& layers) {
    for (const std::string_view key : colour_keys)
        if (find_in(layers, key))
            return true;
    return false;
}

LampColour read_colour(const Layers& layers, SourceKind source, LampShelf& shelf, const YamlEntry& asked_by) {
    for (const YamlMap& layer : layers) {
        const auto given = layer.one_of({colour_keys[0], colour_keys[1], colour_keys[2]});
        if (!given)
            continue;
        if (given->first == "temperature_k")
            return colour_of_temperature(given->second.number(1000.0, 25'000.0));
        return given->first == "spectrum" ? shelf.spectrum(given->second.path(), given->second) : read_explicit_colour(given->second);
    }
    if (source == SourceKind::led)
        asked_by.refuse("an LED without a colour", "temperature_k or spectrum");
    return colour_of_temperature(source == SourceKind::arc ? 4300.0 : 3200.0);
}

} // namespace fernlicht
