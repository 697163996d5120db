#include "scenarios/drives/keys/control_keys.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/signals.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/drives/keys/vehicle_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_lamps = 64, most_failures = 1000, most_inputs = 100, most_input_values = 100'000, most_plugins = 16,
                      most_windows = 256;
constexpr double shortest_period_s = 1.0e-4;

std::vector<std::string> names_of(const Variant& variant) {
    std::vector<std::string> names;
    for (const MountedLamp& lamp : variant.lamps)
        names.push_back(lamp.name);
    return names;
}

std::string lamp_name(const YamlEntry& entry, const Variant& variant) {
    const std::vector<std::string> known = names_of(variant);
    const std::string name = entry.name();
    if (std::ranges::find(known, name) == known.end()) {
        const std::string near = nearest_name(name, known);
        entry.refuse(fmt::format("no lamp '{}' in variant '{}'", name, variant.name),
                     fmt::format("one of {}{}", fmt::join(known, ", "), near.empty() ? "" : fmt::format(" (nearest: '{}')", near)));
    }
    return name;
}

std::vector<std::string> lamp_names(const YamlMap& keys, std::string_view key, const Variant& variant) {
    std::vector<std::string> names;
    if (const auto given = keys.find(key))
        for (const YamlEntry& entry : given->list(1, most_lamps))
            names.push_back(lamp_name(entry, variant));
    return names;
}

std::string signal_name(const YamlEntry& entry, const std::string& name, const SignalTable& signals) {
    try {
        signals.find(name);
    } catch (const std::invalid_argument& error) {
        entry.refuse(fmt::format("no signal '{}'", printable(name)), error.what());
    }
    return name;
}

double speed_or(const YamlMap& keys, const std::string& key, double otherwise_mps) {
    const std::string in_kmh = key + "_kmh", in_mps = key + "_mps";
    const auto given = keys.one_of({in_kmh, in_mps});
    if (!given)
        return otherwise_mps;
    return given->first == in_kmh ? given->second.number(0.0, 540.0) / 3.6 : given->second.number(0.0, 150.0);
}

bool is_cornering_lamp(const std::string& name) { return name.find("corner") != std::string::npos; }

BendParameters read_bend(const YamlEntry& given, const Variant& variant) {
    static constexpr BendLaw laws[] = {BendLaw::steering, BendLaw::yaw_rate, BendLaw::route};
    const auto law_of = [](const YamlEntry& entry) { return laws[entry.choice({"steering", "yaw-rate", "route"})]; };
    BendParameters bend;
    if (given.is_scalar()) {
        bend.law = law_of(given);
    } else {
        const YamlMap of = given.map({"law", "lamps", "preview_s", "gain", "filter_s", "dead_band_deg", "dead_band_rad", "from_speed_kmh",
                                      "from_speed_mps", "outer_share", "natural_frequency_hz", "damping", "rate_limit_deg_s",
                                      "rate_limit_rad_s", "least_deg", "least_rad", "greatest_deg", "greatest_rad", "dead_time_s"});
        if (const auto law = of.find("law"))
            bend.law = law_of(*law);
        bend.lamps = lamp_names(of, "lamps", variant);
        bend.preview_s = of.number_or("preview_s", bend.preview_s, 0.0, 10.0);
        bend.gain = of.number_or("gain", bend.gain, 0.0, 10.0);
        bend.filter_s = of.number_or("filter_s", bend.filter_s, 0.0, 100.0);
        bend.dead_band_rad = of.angle_rad("dead_band", 45.0).value_or(bend.dead_band_rad);
        if (bend.dead_band_rad < 0.0)
            given.refuse("a dead band below 0", "an angle of 0 or more");
        bend.from_speed_mps = speed_or(of, "from_speed", bend.from_speed_mps);
        bend.outer_share = of.number_or("outer_share", bend.outer_share, 0.0, 1.0);
        read_group(actuator_fields(), of, &bend.actuator);
    }
    if (bend.lamps.empty())
        for (const std::string& name : names_of(variant))
            if (!is_cornering_lamp(name))
                bend.lamps.push_back(name);
    return bend;
}

CorneringParameters read_cornering(const YamlEntry& given, const Variant& variant) {
    const YamlMap of = given.map({"left", "right", "until_kmh", "until_mps", "again_below_kmh", "again_below_mps", "on_deg", "on_rad",
                                  "off_deg", "off_rad", "fade_s"});
    CorneringParameters cornering;
    cornering.left = lamp_names(of, "left", variant);
    cornering.right = lamp_names(of, "right", variant);
    if (cornering.left.empty() && cornering.right.empty())
        given.refuse("cornering light without lamps", "left, right or both: lists of lamps");
    cornering.until_speed_mps = speed_or(of, "until", cornering.until_speed_mps);
    cornering.again_below_mps = speed_or(of, "again_below", std::min(cornering.again_below_mps, cornering.until_speed_mps));
    cornering.on_rad = of.angle_rad("on", 60.0).value_or(cornering.on_rad);
    cornering.off_rad = of.angle_rad("off", 60.0).value_or(std::min(cornering.off_rad, cornering.on_rad));
    if (cornering.again_below_mps > cornering.until_speed_mps || cornering.off_rad > cornering.on_rad || cornering.off_rad < 0.0)
        given.refuse("a hysteresis upside down", "again_below at most until, and off from 0 to on");
    cornering.fade_s = of.number_or("fade_s", cornering.fade_s, 0.0, 100.0);
    return cornering;
}

BeamModeSettings read_mode(const YamlEntry& given, LampShelf& shelf) {
    const YamlMap of = given.map({"level", "pitch_deg", "pitch_rad", "file"});
    BeamModeSettings mode;
    mode.level = of.number_or("level", mode.level, 0.0, 1.0);
    mode.pitch_rad = of.angle_rad("pitch", 10.0).value_or(mode.pitch_rad);
    if (const auto file = of.find("file"))
        mode.file = shelf.lamp(file->path(), {}, &*file);
    return mode;
}

ModeParameters read_modes(const YamlEntry& given, const Variant& variant, LampShelf& shelf) {
    const YamlMap of = given.map({"lamps", "c", "v", "e", "w", "v_below_kmh", "v_below_mps", "v_lit_below_kmh", "v_lit_below_mps",
                                  "v_lit_lx", "e_above_kmh", "e_above_mps", "e_motorway_above_kmh", "e_motorway_above_mps", "w_wetness",
                                  "w_wipers_s", "hysteresis_kmh", "hysteresis_mps", "delay_s"});
    ModeParameters modes;
    modes.lamps = lamp_names(of, "lamps", variant);
    if (modes.lamps.empty())
        for (const std::string& name : names_of(variant))
            if (!is_cornering_lamp(name) && !is_high_beam(name))
                modes.lamps.push_back(name);
    static constexpr std::string_view classes[] = {"c", "v", "e", "w"};
    for (std::size_t i = 0; i < modes.settings.size(); ++i)
        if (const auto mode = of.find(classes[i]))
            modes.settings[i] = read_mode(*mode, shelf);
    modes.v_below_mps = speed_or(of, "v_below", modes.v_below_mps);
    modes.v_lit_below_mps = speed_or(of, "v_lit_below", modes.v_lit_below_mps);
    modes.v_lit_lx = of.number_or("v_lit_lx", modes.v_lit_lx, 0.0, 2.0e5);
    modes.e_above_mps = speed_or(of, "e_above", modes.e_above_mps);
    modes.e_motorway_above_mps = speed_or(of, "e_motorway_above", modes.e_motorway_above_mps);
    modes.w_wetness = of.number_or("w_wetness", modes.w_wetness, 1.0e-6, 1.0);
    modes.w_wipers_s = of.number_or("w_wipers_s", modes.w_wipers_s, 0.0, 1.0e6);
    modes.hysteresis_mps = speed_or(of, "hysteresis", modes.hysteresis_mps);
    modes.delay_s = of.number_or("delay_s", modes.delay_s, 0.0, 1000.0);
    return modes;
}

HighBeamParameters read_high_beam(const YamlEntry& given, const Variant& variant) {
    HighBeamParameters high;
    if (given.is_scalar()) {
        given.choice({"automatic"});
    } else {
        const YamlMap of = given.map({"lamps", "on_above_kmh", "on_above_mps", "off_below_kmh", "off_below_mps", "dark_below_lx",
                                      "lit_above_lx", "oncoming_m", "preceding_m", "on_delay_s", "dip_delay_s", "fade_s"});
        high.lamps = lamp_names(of, "lamps", variant);
        high.on_above_mps = speed_or(of, "on_above", high.on_above_mps);
        high.off_below_mps = speed_or(of, "off_below", std::min(high.off_below_mps, high.on_above_mps));
        high.dark_below_lx = of.number_or("dark_below_lx", high.dark_below_lx, 0.0, 2.0e5);
        high.lit_above_lx = of.number_or("lit_above_lx", std::max(high.lit_above_lx, high.dark_below_lx), 0.0, 2.0e5);
        if (high.off_below_mps > high.on_above_mps || high.lit_above_lx < high.dark_below_lx)
            given.refuse("a hysteresis upside down", "off_below at most on_above, and dark_below_lx at most lit_above_lx");
        high.oncoming_m = of.number_or("oncoming_m", high.oncoming_m, 0.0, 5000.0);
        high.preceding_m = of.number_or("preceding_m", high.preceding_m, 0.0, 5000.0);
        high.on_delay_s = of.number_or("on_delay_s", high.on_delay_s, 0.0, 100.0);
        high.dip_delay_s = of.number_or("dip_delay_s", high.dip_delay_s, 0.0, 100.0);
        high.fade_s = of.number_or("fade_s", high.fade_s, 0.0, 100.0);
    }
    if (high.lamps.empty())
        for (const std::string& name : names_of(variant))
            if (is_high_beam(name))
                high.lamps.push_back(name);
    if (high.lamps.empty())
        given.refuse(fmt::format("no lamp of variant '{}' has a name with 'high'", variant.name), "high_beam.lamps");
    return high;
}

/// [a, b, c]: edges of two windows; {windows_deg: [[a, b], ...]}: windows that may leave gaps.
std::vector<std::pair<double, double>> read_windows(const YamlEntry& given) {
    std::vector<std::pair<double, double>> windows;
    const std::vector<YamlEntry> items = given.list(1, most_windows + 1);
    if (items.front().is_list()) {
        for (const YamlEntry& item : items) {
            const std::vector<double> edges = item.numbers(2, 2, -180.0, 180.0);
            if (edges[0] >= edges[1] || (!windows.empty() && edges[0] < windows.back().second))
                item.refuse("windows that overlap or do not ascend", "[from, to], one after the other");
            windows.emplace_back(edges[0], edges[1]);
        }
        return windows;
    }
    const std::vector<double> edges = given.numbers(2, most_windows + 1, -180.0, 180.0);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (edges[i] >= edges[i + 1])
            given.refuse("edges that do not ascend", "degrees from left to right");
        windows.emplace_back(edges[i], edges[i + 1]);
    }
    return windows;
}

GlareFreeParameters read_glare_free(const YamlEntry& given, const Variant& variant) {
    const YamlMap of = given.map({"windows_deg", "margin_deg", "margin_rad", "mask_delay_s", "relight_delay_s"});
    GlareFreeParameters glare_free;
    for (const auto& [name, entry] : of.require("windows_deg").named(most_lamps)) {
        YamlValue key;
        key.kind = YamlValue::Kind::scalar;
        key.text = name;
        key.line = entry.value().line;
        key.column = entry.value().column;
        glare_free.lamps.push_back({lamp_name(YamlEntry(key, entry.file(), entry.key_path()), variant), read_windows(entry)});
    }
    glare_free.margin_rad = of.angle_rad("margin", 20.0).value_or(glare_free.margin_rad);
    glare_free.mask_delay_s = of.number_or("mask_delay_s", glare_free.mask_delay_s, 0.0, 100.0);
    glare_free.relight_delay_s = of.number_or("relight_delay_s", glare_free.relight_delay_s, 0.0, 100.0);
    return glare_free;
}

PluginParameters read_plugin(const YamlEntry& given, const Variant& variant) {
    const YamlMap of = given.map({"library", "parameters", "lamps", "period_s", "budget_s", "give_up_s"});
    PluginParameters plugin;
    const YamlEntry library = of.require("library");
    plugin.library = library.path();
    check_file(plugin.library, library);
    if (const auto parameters = of.find("parameters"))
        plugin.parameters = parameters->text();
    plugin.lamps = lamp_names(of, "lamps", variant);
    if (plugin.lamps.empty())
        plugin.lamps = names_of(variant);
    plugin.period_s = of.number_or("period_s", plugin.period_s, shortest_period_s, 100.0);
    plugin.budget_s = of.number_or("budget_s", plugin.budget_s, 1.0e-6, 100.0);
    plugin.give_up_s = of.number_or("give_up_s", plugin.give_up_s, 0.01, 3600.0);
    return plugin;
}

ControlFailure read_failure(const YamlEntry& entry, const Variant& variant, const SignalTable& signals) {
    using Kind = ControlFailure::Kind;
    const YamlMap keys = entry.map({"at_s", "until_s", "stuck_swivel", "stuck_levelling", "lost_signal"});
    ControlFailure failure;
    failure.at_s = keys.require("at_s").number(0.0, 1.0e6);
    failure.until_s = keys.number_or("until_s", failure.until_s, failure.at_s, 1.0e6);
    const auto what = keys.one_of({"stuck_swivel", "stuck_levelling", "lost_signal"});
    if (!what)
        keys.refuse_missing("lost_signal", "stuck_swivel, stuck_levelling (a lamp) or lost_signal (a signal)");
    failure.kind = what->first == "stuck_swivel"      ? Kind::stuck_swivel
                   : what->first == "stuck_levelling" ? Kind::stuck_levelling
                                                      : Kind::lost_signal;
    failure.what =
        failure.kind == Kind::lost_signal ? signal_name(what->second, what->second.text(), signals) : lamp_name(what->second, variant);
    return failure;
}

ScriptedSignal read_input(const std::string& name, const YamlEntry& entry, const SignalTable& signals) {
    ScriptedSignal input;
    input.name = signal_name(entry, name, signals);
    const SignalKind& kind = signals.kind(signals.find(name));
    if (kind.writer == "laws" || kind.writer == "actuators")
        entry.refuse(fmt::format("{}, which the {} write", name, kind.writer), "a signal that the laws read");
    const double least = std::max(kind.least, -1.0e12), greatest = std::min(kind.greatest, 1.0e12);
    if (entry.is_scalar()) {
        input.values.emplace_back(0.0, entry.number(least, greatest));
        return input;
    }
    for (const YamlEntry& point : entry.list(1, most_input_values)) {
        const YamlMap keys = point.map({"at_s", "value"});
        const double at_s = keys.require("at_s").number(0.0, 1.0e6);
        if (!input.values.empty() && at_s <= input.values.back().first)
            point.refuse(fmt::format("at_s {} after {}", at_s, input.values.back().first), "times that ascend");
        input.values.emplace_back(at_s, keys.require("value").number(least, greatest));
    }
    return input;
}

std::optional<StuckSwivelParameters> read_stuck_swivel(const YamlEntry& given) {
    if (given.is_scalar()) {
        given.choice({"none"});
        return std::nullopt;
    }
    const YamlMap of = given.map({"off_deg", "off_rad", "after_s", "pitch_deg", "pitch_rad", "level"});
    StuckSwivelParameters stuck;
    stuck.off_rad = of.angle_rad("off", 45.0).value_or(stuck.off_rad);
    if (!(stuck.off_rad > 0.0))
        given.refuse("an angle off that is not above 0", "off_deg above 0");
    stuck.after_s = of.number_or("after_s", stuck.after_s, 0.0, 100.0);
    stuck.pitch_rad = of.angle_rad("pitch", 10.0).value_or(stuck.pitch_rad);
    stuck.level = of.number_or("level", stuck.level, 0.0, 1.0);
    return stuck;
}

void read_load(const YamlEntry& given, AxleLoad& load) {
    constexpr double n_per_kg = 9.81;
    const YamlMap of = given.map({"front_kg", "front_n", "rear_kg", "rear_n"});
    const auto force_n = [&](const std::string& axle) {
        const std::string in_kg = axle + "_kg", in_n = axle + "_n";
        const auto found = of.one_of({in_kg, in_n});
        if (!found)
            return 0.0;
        return found->first == in_kg ? n_per_kg * found->second.number(-2000.0, 5000.0) : found->second.number(-2.0e4, 5.0e4);
    };
    load = {force_n("front"), force_n("rear")};
}

ControlParameters read_laws(const YamlEntry& given, const Variant& variant, LampShelf& shelf) {
    const YamlMap keys = given.map({"period_s", "bend", "cornering", "levelling", "load", "modes", "high_beam", "glare_free", "plugins",
                                    "failures", "stuck_swivel", "safe_pitch_deg", "safe_pitch_rad", "inputs"});
    const SignalTable signals(names_of(variant));
    ControlParameters control;
    control.period_s = keys.number_or("period_s", control.period_s, shortest_period_s, 10.0);
    if (const auto bend = keys.find("bend"))
        control.bend = read_bend(*bend, variant);
    if (const auto cornering = keys.find("cornering"))
        control.cornering = read_cornering(*cornering, variant);
    if (const auto levelling = keys.find("levelling"))
        control.levelling = read_levelling(*levelling, false);
    if (const auto load = keys.find("load"))
        read_load(*load, control.load);
    if (const auto modes = keys.find("modes"))
        control.modes = read_modes(*modes, variant, shelf);
    if (const auto high_beam = keys.find("high_beam"))
        control.high_beam = read_high_beam(*high_beam, variant);
    if (const auto glare_free = keys.find("glare_free")) {
        if (!control.high_beam)
            glare_free->refuse("a glare-free high beam without an automatic one", "high_beam beside it, which says when it is on");
        control.glare_free = read_glare_free(*glare_free, variant);
    }
    if (const auto plugins = keys.find("plugins"))
        for (const YamlEntry& plugin : plugins->list(0, most_plugins))
            control.plugins.push_back(read_plugin(plugin, variant));
    control.safe_pitch_rad = keys.angle_rad("safe_pitch", 10.0).value_or(control.safe_pitch_rad);
    if (const auto stuck = keys.find("stuck_swivel"))
        control.stuck_swivel = read_stuck_swivel(*stuck);
    if (const auto failures = keys.find("failures"))
        for (const YamlEntry& failure : failures->list(0, most_failures))
            control.failures.push_back(read_failure(failure, variant, signals));
    if (const auto inputs = keys.find("inputs"))
        for (const auto& [name, entry] : inputs->named(most_inputs))
            control.inputs.push_back(read_input(name, entry, signals));
    return control;
}

} // namespace

void read_control(const YamlMap& drive, const YamlMap* keys, Variant& variant, LampShelf& shelf) {
    auto given = keys ? keys->find("control") : std::nullopt;
    if (!given)
        given = drive.find("control");
    if (!given)
        return;
    if (given->is_scalar()) {
        given->choice({"none"});
        return;
    }
    variant.control = std::make_shared<const ControlParameters>(read_laws(*given, variant, shelf));
    for (const ControlFailure& failure : variant.control->failures)
        if (failure.kind == ControlFailure::Kind::stuck_swivel && !variant.control->bend && !variant.swivel &&
            variant.control->plugins.empty())
            given->refuse(fmt::format("control.failures: stuck_swivel of '{}', which nothing turns", printable(failure.what)),
                          "a bend law or a plug-in beside it");
    if (variant.control->bend && variant.swivel)
        given->refuse("control.bend beside actuators.swivel", "one of them");
    if (variant.control->levelling && variant.levelling)
        given->refuse("control.levelling beside actuators.levelling", "one of them");
}

} // namespace fernlicht
