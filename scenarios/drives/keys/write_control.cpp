#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/keys/control_keys.h"
#include "scenarios/yaml/yaml_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

/// Names of lamps and signals need no escapes (YamlEntry::name).
std::string list(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
    return "[" + text + "]";
}

std::string actuator(const ActuatorParameters& of) {
    return fmt::format("natural_frequency_hz: {}, damping: {}, rate_limit_rad_s: {}, least_rad: {}, greatest_rad: {}, dead_time_s: {}",
                       of.natural_frequency_hz, of.damping, of.rate_limit_rad_s, of.least_rad, of.greatest_rad, of.dead_time_s);
}

std::string bend_line(const BendParameters& bend) {
    static constexpr const char* laws[] = {"steering", "yaw-rate", "route"};
    return fmt::format("      bend: {{law: {}, lamps: {}, preview_s: {}, gain: {}, filter_s: {}, dead_band_rad: {}, from_speed_mps: {}, "
                       "outer_share: {}, {}}}\n",
                       laws[static_cast<std::size_t>(bend.law)], list(bend.lamps), bend.preview_s, bend.gain, bend.filter_s,
                       bend.dead_band_rad, bend.from_speed_mps, bend.outer_share, actuator(bend.actuator));
}

std::string cornering_line(const CorneringParameters& of) {
    std::string lamps = of.left.empty() ? "" : fmt::format("left: {}, ", list(of.left));
    lamps += of.right.empty() ? "" : fmt::format("right: {}, ", list(of.right));
    return fmt::format("      cornering: {{{}until_mps: {}, again_below_mps: {}, on_rad: {}, off_rad: {}, fade_s: {}}}\n", lamps,
                       of.until_speed_mps, of.again_below_mps, of.on_rad, of.off_rad, of.fade_s);
}

std::string mode_lines(const Drive& drive, const ModeParameters& of) {
    static constexpr const char* classes[] = {"c", "v", "e", "w"};
    std::string text = fmt::format("      modes:\n        lamps: {}\n", list(of.lamps));
    for (std::size_t i = 0; i < of.settings.size(); ++i) {
        const BeamModeSettings& mode = of.settings[i];
        std::string file;
        for (const LampSource& source : drive.lamp_sources)
            if (mode.file && source.file == mode.file)
                file = ", file: " + quoted(source.path.string());
        text += fmt::format("        {}: {{level: {}, pitch_rad: {}{}}}\n", classes[i], mode.level, mode.pitch_rad, file);
    }
    for (const auto& [key, value] : std::initializer_list<std::pair<const char*, double>>{{"v_below_mps", of.v_below_mps},
                                                                                          {"v_lit_below_mps", of.v_lit_below_mps},
                                                                                          {"v_lit_lx", of.v_lit_lx},
                                                                                          {"e_above_mps", of.e_above_mps},
                                                                                          {"e_motorway_above_mps", of.e_motorway_above_mps},
                                                                                          {"w_wetness", of.w_wetness},
                                                                                          {"w_wipers_s", of.w_wipers_s},
                                                                                          {"hysteresis_mps", of.hysteresis_mps},
                                                                                          {"delay_s", of.delay_s}})
        text += fmt::format("        {}: {}\n", key, value);
    return text;
}

std::string high_beam_line(const HighBeamParameters& of) {
    return fmt::format(
        "      high_beam: {{lamps: {}, on_above_mps: {}, off_below_mps: {}, dark_below_lx: {}, lit_above_lx: {}, oncoming_m: {}, "
        "preceding_m: {}, on_delay_s: {}, dip_delay_s: {}, fade_s: {}}}\n",
        list(of.lamps), of.on_above_mps, of.off_below_mps, of.dark_below_lx, of.lit_above_lx, of.oncoming_m, of.preceding_m, of.on_delay_s,
        of.dip_delay_s, of.fade_s);
}

std::string glare_free_lines(const GlareFreeParameters& of) {
    std::string text = "      glare_free:\n        windows_deg:\n";
    for (const SegmentedLamp& lamp : of.lamps) {
        std::vector<std::string> windows;
        for (const auto& [from, to] : lamp.windows_deg)
            windows.push_back(fmt::format("[{}, {}]", from, to));
        text += fmt::format("          \"{}\": [{}]\n", lamp.name, fmt::join(windows, ", "));
    }
    return text + fmt::format("        margin_rad: {}\n        mask_delay_s: {}\n        relight_delay_s: {}\n", of.margin_rad,
                              of.mask_delay_s, of.relight_delay_s);
}

std::string plugin_lines(const std::vector<PluginParameters>& plugins) {
    std::string text = plugins.empty() ? "" : "      plugins:\n";
    for (const PluginParameters& of : plugins)
        text +=
            fmt::format("        - {{library: {}, {}lamps: {}, period_s: {}, budget_s: {}, give_up_s: {}}}\n", quoted(of.library.string()),
                        of.parameters.empty() ? "" : fmt::format("parameters: {}, ", quoted(of.parameters)), list(of.lamps), of.period_s,
                        of.budget_s, of.give_up_s);
    return text;
}

std::string failure_lines(const std::vector<ControlFailure>& failures) {
    static constexpr const char* kinds[] = {"stuck_swivel", "stuck_levelling", "lost_signal"};
    std::string text = failures.empty() ? "" : "      failures:\n";
    for (const ControlFailure& failure : failures)
        text += fmt::format("        - {{at_s: {}{}, {}: \"{}\"}}\n", failure.at_s,
                            failure.until_s < 1.0e7 ? fmt::format(", until_s: {}", failure.until_s) : "",
                            kinds[static_cast<std::size_t>(failure.kind)], failure.what);
    return text;
}

std::string input_lines(const std::vector<ScriptedSignal>& inputs) {
    std::string text = inputs.empty() ? "" : "      inputs:\n";
    for (const ScriptedSignal& input : inputs) {
        std::vector<std::string> values;
        for (const auto& [at_s, value] : input.values)
            values.push_back(fmt::format("{{at_s: {}, value: {}}}", at_s, value));
        text += fmt::format("        \"{}\": [{}]\n", input.name, fmt::join(values, ", "));
    }
    return text;
}

} // namespace

std::string write_control(const Drive& drive, const Variant& variant) {
    if (!variant.control)
        return {};
    const ControlParameters& control = *variant.control;
    std::string text = "    control:\n";
    text += fmt::format("      period_s: {}\n", control.period_s);
    if (control.bend)
        text += bend_line(*control.bend);
    if (control.levelling)
        text +=
            fmt::format("      levelling: {{control: {}, {}}}\n",
                        control.levelling->control == LevellingControl::slow ? "static" : "dynamic", actuator(control.levelling->actuator));
    if (control.cornering)
        text += cornering_line(*control.cornering);
    if (control.load != AxleLoad{})
        text += fmt::format("      load: {{front_n: {}, rear_n: {}}}\n", control.load.front_n, control.load.rear_n);
    if (control.modes)
        text += mode_lines(drive, *control.modes);
    if (control.high_beam)
        text += high_beam_line(*control.high_beam);
    if (control.glare_free)
        text += glare_free_lines(*control.glare_free);
    text += plugin_lines(control.plugins);
    text += fmt::format("      safe_pitch_rad: {}\n", control.safe_pitch_rad);
    if (const auto& stuck = control.stuck_swivel)
        text += fmt::format("      stuck_swivel: {{off_rad: {}, after_s: {}, pitch_rad: {}, level: {}}}\n", stuck->off_rad, stuck->after_s,
                            stuck->pitch_rad, stuck->level);
    else
        text += "      stuck_swivel: none\n";
    text += failure_lines(control.failures);
    text += input_lines(control.inputs);
    return text;
}

} // namespace fernlicht
