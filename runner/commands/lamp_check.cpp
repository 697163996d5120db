#include "runner/commands/lamp_command.h"

#include "metrics/beam/intake.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/described_json.h"
#include "runner/files/json_text.h"
#include "runner/findings/lamp_checks.h"
#include "runner/findings/lamp_checks_json.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::optional<BeamFunction> function_asked(const std::string& word) {
    if (word.empty())
        return std::nullopt;
    for (const BeamFunction function : {BeamFunction::low, BeamFunction::high, BeamFunction::other})
        if (name_of(function) == word)
            return function;
    throw InputError({{}, 0, 0, "--function"}, "found '" + printable(word) + "'", "low, high or other");
}

void refuse_beside_check(const LampRequest& request) {
    for (const auto& [given, option] : {std::pair{!request.convert.empty(), "--convert"}, std::pair{!request.picture.empty(), "--picture"},
                                        std::pair{request.spots.has_value(), "--spots"}, std::pair{!request.against.empty(), "--against"},
                                        std::pair{!request.regulation.empty(), "--regulation"}, std::pair{request.cut_off, "--cut-off"}})
        if (given)
            throw InputError({{}, 0, 0, option}, "found together with --check", "one of them");
    if (request.voltage_v && !(*request.voltage_v >= 12.0 && *request.voltage_v <= 13.8))
        throw InputError({{}, 0, 0, "--voltage"}, fmt::format("found {}", *request.voltage_v), "12 to 13.8 V");
    if (!request.add.empty())
        throw InputError({{}, 0, 0, "--add"}, "found together with --check", "--other-side FILE, the lamp of the right side");
}

std::string facts_direction(double deg, const char* more, const char* less) {
    return fmt::format("{:.2f} {}", std::abs(deg), deg < 0.0 ? less : more);
}

std::string cut_off_fact(const Intake& intake) {
    if (!intake.cut_off_v_deg)
        return intake.function == BeamFunction::low ? "none found" : "";
    std::string text = facts_direction(*intake.cut_off_v_deg, "U", "D");
    constexpr double regular_deg = -0.573, notable_deg = 0.05; // 1 % down, as on the goniometer in regulation aim
    if (const double up_deg = *intake.cut_off_v_deg - regular_deg; intake.function == BeamFunction::low && std::abs(up_deg) > notable_deg)
        text +=
            fmt::format(", {:.2f} degrees {} 1 % down, which `aim: auto` takes away", std::abs(up_deg), up_deg > 0.0 ? "above" : "below");
    if (intake.rise_deg)
        text += std::abs(*intake.rise_deg) < 0.1 ? ", level"
                                                 : fmt::format(", {:.1f} degrees higher on the {}", std::abs(*intake.rise_deg),
                                                               *intake.rise_deg < 0.0 ? "left" : "right");
    return text;
}

Document document(const LampFile& lamp, const Intake& intake, const LampRequest& request) {
    Table facts{"facts", "", {{.head = "", .words = true}, {.head = "", .words = true}}, {}};
    const auto fact = [&](const char* what, const std::string& text) {
        if (!text.empty())
            facts.rows.push_back({what, text});
    };
    fact("lamp", printable(lamp.name, 90));
    fact("function", function_text(intake.function, intake.function_stated));
    fact("maximum", intake.peak.cd > 0.0 ? fmt::format("{:.5g} cd at {}, {}", intake.peak.cd, facts_direction(intake.peak.h_deg, "R", "L"),
                                                       facts_direction(intake.peak.v_deg, "U", "D"))
                                         : "no light in any direction");
    fact("flux", fmt::format("{:.0f} lm", intake.flux_lm));
    fact("cut-off", cut_off_fact(intake));
    fact("its steps", intake.step_deg ? fmt::format("{:.2g} degrees between samples in V", *intake.step_deg) : "");
    fact("measured at",
         voltage_text(true, request.voltage_v) + (request.voltage_v ? "" : "; without a filament the voltage changes nothing"));
    Section section{"", {std::move(facts)}};
    if (intake.findings.empty()) {
        section.blocks.emplace_back(intake.function == BeamFunction::other
                                        ? "Not checked: neither a low nor a high beam. `--function` says so if it is."
                                        : "No finding.");
        return {"Intake check", {std::move(section)}};
    }
    Table findings{.name = "findings", .caption = "", .columns = columns_of("finding<|meaning<|found<"), .rows = {}, .prose = true};
    for (const IntakeFinding& finding : intake.findings)
        findings.rows.push_back(
            {name_of(finding.fault), finding.meaningless ? "readings with it are meaningless" : "doubtful", finding.text});
    section.blocks.emplace_back(std::move(findings));
    return {"Intake check", {std::move(section)}};
}

std::string check_json(const LampFile& lamp, Intake intake, const LampRequest& request) {
    CheckedLampFile file{.file = lamp.name,
                         .used_as = {},
                         .function = intake.function,
                         .function_stated = intake.function_stated,
                         .filament = true,
                         .measured_at_v = request.voltage_v,
                         .findings = intake.findings};
    nlohmann::ordered_json json = as_json(file, lamp_file_members);
    json.erase("used_as");
    json.erase("filament");
    json["maximum"] = {{"cd", intake.peak.cd}, {"h_deg", intake.peak.h_deg}, {"v_deg", intake.peak.v_deg}};
    json["flux_lm"] = intake.flux_lm;
    for (const auto& [key, value] :
         {std::pair{"cut_off_v_deg", intake.cut_off_v_deg}, std::pair{"rise_deg", intake.rise_deg}, std::pair{"step_deg", intake.step_deg}})
        json[key] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
    return json_text(json);
}

} // namespace

int lamp_check(const LampRequest& request) {
    refuse_beside_check(request);
    const LampFile lamp = lamp_of(request);
    Intake intake = check_intake(lamp, {function_asked(request.function), request.left_hand_traffic});
    if (!request.other_side.empty())
        if (const auto swapped = swapped_sides(lamp, read_lamp(request.other_side, request.reading), !request.mirror))
            intake.findings.push_back(*swapped);
    fmt::print("{}", request.json ? check_json(lamp, intake, request) : document_text(document(lamp, intake, request)));
    std::fflush(stdout); // the table before the error
    if (request.strict)
        refuse_meaningless(request.file, intake.findings, "the check");
    return 0;
}

void refuse_check_options(const LampRequest& request) {
    const char* option = request.strict ? "--strict" : !request.function.empty() ? "--function" : request.voltage_v ? "--voltage" : nullptr;
    if (option)
        throw InputError({{}, 0, 0, option}, "found without --check", "both");
}

void add_check_options(CLI::App& command, LampRequest& request) {
    const char* group = "Intake check";
    command
        .add_flag(
            "--check", request.check,
            "look for what exports do to a lamp: units, axes, sides, aim, coverage, steps; with --other-side, of the left lamp beside "
            "the right one")
        ->group(group);
    command.add_option("--function", request.function, "with --check: what the beam is for")
        ->option_text("low|high|other")
        ->default_str("as recognised")
        ->group(group);
    command.add_option("--voltage", request.voltage_v, "with --check: volts at which the lamp was measured")
        ->option_text("V")
        ->group(group);
    add_shared(command, "--strict", request.strict)->group(group);
}

} // namespace fernlicht
