#include "scenarios/drives/keys/control_fields.h"
#include "scenarios/drives/keys/control_keys.h"
#include "scenarios/fields/write_fields.h"
#include "scenarios/yaml/yaml_tree.h"

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

std::string mode_lines(const Drive& drive, const ModeParameters& of) {
    std::string text = fmt::format("      modes:\n        lamps: {}\n", list(of.lamps));
    for (std::size_t i = 0; i < of.settings.size(); ++i) {
        const BeamModeSettings& mode = of.settings[i];
        std::string file;
        for (const LampSource& source : drive.lamp_sources)
            if (mode.file && source.file == mode.file)
                file = ", file: " + quoted(source.path.string());
        text += fmt::format("        {}: {{{}{}}}\n", mode_classes[i], flow_text(mode_fields(), &mode), file);
    }
    return text + block_text(threshold_fields(), &of, 4);
}

std::string glare_free_lines(const GlareFreeParameters& of) {
    std::string text = "      glare_free:\n        windows_deg:\n";
    for (const SegmentedLamp& lamp : of.lamps) {
        std::vector<std::string> windows;
        for (const auto& [from, to] : lamp.windows_deg)
            windows.push_back(fmt::format("[{}, {}]", from, to));
        text += fmt::format("          \"{}\": [{}]\n", lamp.name, fmt::join(windows, ", "));
    }
    return text + block_text(glare_free_fields(), &of, 4);
}

std::string plugin_lines(const std::vector<PluginParameters>& plugins) {
    std::string text = plugins.empty() ? "" : "      plugins:\n";
    for (const PluginParameters& of : plugins)
        text += fmt::format("        - {{{}}}\n", flow_text(plugin_fields(), &of));
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
    text += lines_of(law_fields(), "period_s", &control, 3);
    if (control.bend)
        text += fmt::format("      bend: {{{}}}\n", flow_text(bend_fields(), &*control.bend));
    if (control.levelling)
        text += fmt::format("      levelling: {{control: {}, {}}}\n",
                            control.levelling->control == LevellingControl::slow ? "static" : "dynamic",
                            flow_text(law_actuator_fields(), &control.levelling->actuator));
    if (control.cornering)
        text += fmt::format("      cornering: {{{}}}\n", flow_text(cornering_fields(), &*control.cornering));
    if (control.load != AxleLoad{})
        text += lines_of(law_fields(), "load", &control, 3);
    if (control.modes)
        text += mode_lines(drive, *control.modes);
    if (control.high_beam)
        text += fmt::format("      high_beam: {{{}}}\n", flow_text(high_beam_fields(), &*control.high_beam));
    if (control.glare_free)
        text += glare_free_lines(*control.glare_free);
    text += plugin_lines(control.plugins);
    text += lines_of(law_fields(), "safe_pitch", &control, 3);
    text += lines_of(law_fields(), "stuck_swivel", &control, 3);
    text += failure_lines(control.failures);
    text += input_lines(control.inputs);
    return text;
}

} // namespace fernlicht
