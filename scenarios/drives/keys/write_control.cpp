#include "scenarios/drives/keys/control_fields.h"
#include "scenarios/drives/keys/control_keys.h"
#include "scenarios/fields/field_bits.h"
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

std::string file_text(const Drive& drive, const BeamModeSettings& mode) {
    for (const LampSource& source : drive.lamp_sources)
        if (mode.file && source.file == mode.file)
            return ", file: " + quoted(source.path.string());
    return "";
}

std::string mode_lines(const Drive& drive, const ModeParameters& of) {
    std::string text = fmt::format("      modes:\n        lamps: {}\n", list(of.lamps));
    for (std::size_t i = 0; i < of.settings.size(); ++i)
        text += fmt::format("        {}: {{{}{}}}\n", mode_classes[i], flow_text(mode_fields(), &of.settings[i]),
                            file_text(drive, of.settings[i]));
    return text + block_text(threshold_fields(), &of, 4);
}

std::string mode_bits(const Drive& drive, const ModeParameters& of) {
    std::string bits = fmt::format("modes {}\n{}", list(of.lamps), field_bits(threshold_fields(), &of));
    for (const BeamModeSettings& mode : of.settings)
        bits += fmt::format("mode{}\n{}", file_text(drive, mode), field_bits(mode_fields(), &mode));
    return bits;
}

} // namespace

std::string write_control(const Drive& drive, const Variant& variant) {
    if (!variant.control)
        return {};
    const ControlParameters& control = *variant.control;
    std::string text = "    control:\n";
    for (const Field& law : law_fields().fields) {
        text += lines_of(law_fields(), law.key, &control, 3);
        if (law.key == "load" && control.modes)
            text += mode_lines(drive, *control.modes);
    }
    return text;
}

std::string control_bits(const Drive& drive, const Variant& variant) {
    if (!variant.control)
        return {};
    return "control\n" + field_bits(law_fields(), variant.control.get()) +
           (variant.control->modes ? mode_bits(drive, *variant.control->modes) : "");
}

} // namespace fernlicht
