#include "scenarios/drives/keys/control_fields.h"

#include "scenarios/control/signals.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string signal_name(const YamlEntry& entry, const std::string& name, const SignalTable& signals) {
    try {
        signals.find(name);
    } catch (const std::invalid_argument& error) {
        entry.refuse(fmt::format("no signal '{}'", printable(name)), error.what());
    }
    return name;
}

/// Refuses names that are no lamps' of the lamp set.
void check_lamps(const YamlEntry& given, std::string_view key, const LampSet& lamp_set) {
    for (const YamlMember& member : given.value().members)
        if (member.key == key)
            for (const YamlEntry& name :
                 YamlEntry(member.value, given.file(), fmt::format("{}.{}", given.key_path(), key)).list(1, max_control_lamps))
                lamp_name(name, lamp_set);
}

bool is_cornering_lamp(const std::string& name) { return name.find("corner") != std::string::npos; }

/// Where none are named: those that the law is for.
void default_lamps(std::vector<std::string>& lamps, const LampSet& lamp_set, bool (*is_for)(const std::string&)) {
    if (lamps.empty())
        for (const std::string& name : lamp_names(lamp_set))
            if (is_for(name))
                lamps.push_back(name);
}

BendParameters read_bend(const YamlEntry& given, const LampSet& lamp_set) {
    BendParameters bend;
    if (given.is_scalar()) {
        bend.law = static_cast<BendLaw>(given.choice(bend_laws));
    } else {
        read_group(bend_fields(), given, &bend);
        if (bend.dead_band_rad < 0.0)
            given.refuse("a dead band below 0", "an angle of 0 or more");
        check_lamps(given, "lamps", lamp_set);
    }
    default_lamps(bend.lamps, lamp_set, [](const std::string& name) { return !is_cornering_lamp(name); });
    return bend;
}

bool gives(const YamlMap& keys, std::string_view key) {
    const std::string start = fmt::format("{}_", key);
    return std::ranges::any_of(keys.entry().value().members, [&](const YamlMember& member) { return member.key.starts_with(start); });
}

CorneringParameters read_cornering(const YamlEntry& given, const LampSet& lamp_set) {
    const YamlMap of = given.map(keys_of(cornering_fields()));
    CorneringParameters cornering;
    read_group(cornering_fields(), of, &cornering);
    check_lamps(given, "left", lamp_set);
    check_lamps(given, "right", lamp_set);
    if (cornering.left.empty() && cornering.right.empty())
        given.refuse("cornering light without lamps", "left, right or both: lists of lamps");
    if (!gives(of, "again_below"))
        cornering.again_below_mps = std::min(cornering.again_below_mps, cornering.until_speed_mps);
    if (!gives(of, "off"))
        cornering.off_rad = std::min(cornering.off_rad, cornering.on_rad);
    if (cornering.again_below_mps > cornering.until_speed_mps || cornering.off_rad > cornering.on_rad || cornering.off_rad < 0.0)
        given.refuse("a hysteresis upside down", "again_below at most until, and off from 0 to on");
    return cornering;
}

ModeParameters read_modes(const YamlEntry& given, const LampSet& lamp_set, LampCache& cache) {
    const YamlMap of = given.map(keys_of(modes_fields()));
    ModeParameters modes;
    check_lamps(given, "lamps", lamp_set);
    read_group(modes_fields(), of, &modes);
    default_lamps(modes.lamps, lamp_set, [](const std::string& name) { return !is_cornering_lamp(name) && !is_high_beam(name); });
    for (const Field& field : modes_fields().fields)
        if (const auto mode = field.group.get() == &mode_fields() ? of.find(field.key) : std::nullopt)
            if (const auto file = mode->map(keys_of(mode_fields())).find("file"))
                static_cast<BeamModeSettings*>(field.member.look(&modes))->file = cache.lamp(file->path(), {}, &*file);
    return modes;
}

HighBeamParameters read_high_beam(const YamlEntry& given, const LampSet& lamp_set) {
    HighBeamParameters high;
    if (given.is_scalar()) {
        given.choice({"automatic"});
    } else {
        const YamlMap of = given.map(keys_of(high_beam_fields()));
        read_group(high_beam_fields(), of, &high);
        check_lamps(given, "lamps", lamp_set);
        if (!gives(of, "off_below"))
            high.off_below_mps = std::min(high.off_below_mps, high.on_above_mps);
        if (!of.find("lit_above_lx"))
            high.lit_above_lx = std::max(high.lit_above_lx, high.dark_below_lx);
        if (high.off_below_mps > high.on_above_mps || high.lit_above_lx < high.dark_below_lx)
            given.refuse("a hysteresis upside down", "off_below at most on_above, and dark_below_lx at most lit_above_lx");
    }
    default_lamps(high.lamps, lamp_set, is_high_beam);
    if (high.lamps.empty())
        given.refuse(fmt::format("no lamp of lamp set '{}' has a name with 'high'", lamp_set.name), "high_beam.lamps");
    return high;
}

GlareFreeParameters read_glare_free(const YamlEntry& given, const LampSet& lamp_set) {
    const YamlMap of = given.map(keys_of(glare_free_fields()));
    GlareFreeParameters glare_free;
    for (const auto& [name, entry] : of.require("windows_deg").named(max_control_lamps)) {
        YamlValue key = entry.value();
        key.kind = YamlValue::Kind::scalar;
        key.text = name;
        lamp_name(YamlEntry(key, entry.file(), entry.key_path()), lamp_set);
    }
    read_group(glare_free_fields(), of, &glare_free);
    for (const SegmentedLamp& segmented : glare_free.lamps) {
        const MountedLamp& lamp = *std::ranges::find(lamp_set.lamps, segmented.name, &MountedLamp::name);
        if (segmented.pixels != (lamp.file->pixels != nullptr))
            of.require("windows_deg")
                .refuse(fmt::format("{} of '{}', {} lamp", segmented.pixels ? "pixels" : "windows", lamp.name,
                                    segmented.pixels ? "no pixel" : "a pixel"),
                        segmented.pixels ? "windows" : "pixels");
        if (lamp.levels)
            given.refuse(fmt::format("a glare-free beam of '{}', whose levels come from a file", lamp.name), "one of them");
    }
    return glare_free;
}

PluginParameters read_plugin(const YamlEntry& given, const LampSet& lamp_set) {
    PluginParameters plugin;
    plugin.places.own = {given.file(), given.value().line, given.value().column, given.key_path()};
    read_group(plugin_fields(), given, &plugin);
    check_lamps(given, "lamps", lamp_set);
    default_lamps(plugin.lamps, lamp_set, [](const std::string&) { return true; });
    return plugin;
}

ControlFailure read_failure(const YamlEntry& entry, const LampSet& lamp_set, const SignalTable& signals) {
    using Kind = ControlFailure::Kind;
    const YamlMap keys = entry.map(keys_of(failure_fields()));
    ControlFailure failure;
    read_field(failure_fields(), "at_s", keys, &failure);
    failure.until_s = keys.number_or("until_s", failure.until_s, failure.at_s, 1.0e6);
    const auto what = keys.one_of({"stuck_swivel", "stuck_levelling", "lost_signal"});
    if (!what)
        keys.refuse_missing("lost_signal", "stuck_swivel, stuck_levelling (a lamp) or lost_signal (a signal)");
    failure.kind = what->first == "stuck_swivel"      ? Kind::stuck_swivel
                   : what->first == "stuck_levelling" ? Kind::stuck_levelling
                                                      : Kind::lost_signal;
    failure.what =
        failure.kind == Kind::lost_signal ? signal_name(what->second, what->second.text(), signals) : lamp_name(what->second, lamp_set);
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
    for (const YamlEntry& point : entry.list(1, max_input_values)) {
        const YamlMap keys = point.map({"at_s", "value"});
        const double at_s = keys.require("at_s").number(0.0, 1.0e6);
        if (!input.values.empty() && at_s <= input.values.back().first)
            point.refuse(fmt::format("at_s {} after {}", at_s, input.values.back().first), "times that ascend");
        input.values.emplace_back(at_s, keys.require("value").number(least, greatest));
    }
    return input;
}

ControlParameters read_laws(const YamlEntry& given, const LampSet& lamp_set, LampCache& cache) {
    const YamlMap keys = given.map(keys_of(law_fields()));
    const SignalTable signals(lamp_names(lamp_set));
    ControlParameters control;
    read_field(law_fields(), "period_s", keys, &control);
    if (const auto bend = keys.find("bend"))
        control.bend = read_bend(*bend, lamp_set);
    if (const auto cornering = keys.find("cornering"))
        control.cornering = read_cornering(*cornering, lamp_set);
    if (const auto levelling = keys.find("levelling"))
        control.levelling = read_levelling(*levelling, false);
    read_field(law_fields(), "load", keys, &control);
    if (const auto modes = keys.find("modes"))
        control.modes = read_modes(*modes, lamp_set, cache);
    if (const auto high_beam = keys.find("high_beam"))
        control.high_beam = read_high_beam(*high_beam, lamp_set);
    if (const auto glare_free = keys.find("glare_free")) {
        if (!control.high_beam)
            glare_free->refuse("a glare-free high beam without an automatic one", "high_beam beside it, which says when it is on");
        control.glare_free = read_glare_free(*glare_free, lamp_set);
    }
    read_field(law_fields(), "camera", keys, &control);
    if (control.camera && !(control.camera->field_rad > 0.0 && control.camera->noise_rad >= 0.0))
        keys.require("camera").refuse("a field or a noise below 0", "field_deg above 0, noise_deg from 0");
    if (control.camera && !control.high_beam && !keys.find("plugins"))
        keys.require("camera").refuse("a camera that nobody asks", "high_beam or plugins beside it");
    if (const auto plugins = keys.find("plugins"))
        for (const YamlEntry& plugin : plugins->list(0, max_plugins))
            control.plugins.push_back(read_plugin(plugin, lamp_set));
    read_field(law_fields(), "safe_pitch", keys, &control);
    read_field(law_fields(), "stuck_swivel", keys, &control);
    if (const auto failures = keys.find("failures"))
        for (const YamlEntry& failure : failures->list(0, max_failures))
            control.failures.push_back(read_failure(failure, lamp_set, signals));
    if (const auto inputs = keys.find("inputs"))
        for (const auto& [name, entry] : inputs->named(max_inputs))
            control.inputs.push_back(read_input(name, entry, signals));
    return control;
}

} // namespace

void read_control(const YamlMap& drive, const YamlMap* keys, LampSet& lamp_set, LampCache& cache) {
    auto given = keys ? keys->find("control") : std::nullopt;
    if (!given)
        given = drive.find("control");
    if (!given)
        return;
    if (given->is_scalar()) {
        given->choice({"none"});
        return;
    }
    lamp_set.control = std::make_shared<const ControlParameters>(read_laws(*given, lamp_set, cache));
    for (const ControlFailure& failure : lamp_set.control->failures)
        if (failure.kind == ControlFailure::Kind::stuck_swivel && !lamp_set.control->bend && !lamp_set.swivel &&
            lamp_set.control->plugins.empty())
            given->refuse(fmt::format("control.failures: stuck_swivel of '{}', which nothing turns", printable(failure.what)),
                          "a bend law or a plug-in beside it");
    if (lamp_set.control->bend && lamp_set.swivel)
        given->refuse("control.bend beside actuators.swivel", "one of them");
    if (lamp_set.control->levelling && lamp_set.levelling)
        given->refuse("control.levelling beside actuators.levelling", "one of them");
}

} // namespace fernlicht
