#include "runner/commands/lamp_command.h"

#include "runner/commands/words/shared_flags.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

void refuse_other_work(const LampRequest& request, const char* option) {
    const auto refuse = [&](bool given, const char* other) {
        if (given)
            throw InputError({{}, 0, 0, other}, fmt::format("found {} together with {}", other, option), "one of them");
    };
    refuse(!request.convert.empty(), "--convert");
    refuse(request.spots.has_value(), "--spots");
    refuse(!request.against.empty(), "--against");
}

/// The lamp, and the other side where --other-side names it, which sits across the car's middle.
std::vector<LampFile> requested_lamps(const LampRequest& request, const Regulation& r, std::vector<std::string>& notes) {
    const auto spared = [&](LampFile lamp, double side) {
        if (request.adaptive.other_m.empty())
            return lamp;
        AdaptiveRequest asked = request.adaptive;
        asked.lamp_at_m[0] *= side;
        spare_other(lamp, asked, notes.emplace_back());
        return lamp;
    };
    if (!r.pairs && !request.other_side.empty())
        throw InputError({{}, 0, 0, "--other-side"}, "found with --regulation " + r.id + ", which judges the lamp by itself",
                         "none; --add adds another lamp's light");
    if (request.other_side.empty())
        return {spared(lamp_of(request), 1.0)};
    LampRequest other = request;
    other.file = request.other_side;
    other.model.clear();
    other.levels.clear();
    other.levels_s.reset();
    return {spared(lamp_of(request), 1.0), spared(lamp_of(other), -1.0)};
}

} // namespace

std::optional<AimRule> requested_aim(const LampRequest& request) {
    if (request.aim.empty())
        return std::nullopt;
    using enum AimRule;
    for (const AimRule rule : {automatic, as_is, cut_off, cut_off_by_line, elbow, vol, vor, maximum})
        if (name_of(rule) == request.aim)
            return rule;
    throw InputError({{}, 0, 0, "--aim-rule"}, "found '" + printable(request.aim) + "'",
                     "auto, as-is, cut-off, cut-off-line, elbow, vol, vor or maximum");
}

int tell_regulation(const RegulationFound& found, const LampRequest& request) {
    fmt::print("{}", request.json ? regulation_json(found) : document_text(document(found)));
    return found.check.verdict == RowVerdict::pass ? 0 : 1;
}

int lamp_regulation(const LampRequest& request) {
    if (request.regulation == "list") {
        fmt::print("{}", request.json ? regulation_list_json() : document_text(regulation_list()));
        return 0;
    }
    refuse_other_work(request, "--regulation");
    if (!request.picture.empty())
        throw InputError({{}, 0, 0, "--picture"}, "found together with --regulation", "--cut-off, which draws what the aim goes by");
    if (request.cut_off)
        throw InputError({{}, 0, 0, "--cut-off"}, "found together with --regulation", "one of them");
    if (request.regulation == adaptive_table)
        return lamp_adaptive(request);
    Regulation r = regulation(request.regulation);
    request.adaptive.check();
    const bool adaptive = r.id.find("-adb-") != std::string::npos; // one state of an adaptive beam
    if (!request.adaptive.dimmed_deg.empty() || (!adaptive && request.adaptive.asked()))
        throw InputError({{}, 0, 0, request.adaptive.dimmed_deg.empty() ? "--other" : "--dimmed"},
                         "found with --regulation " + printable(request.regulation),
                         adaptive ? "--other AHEAD LEFT: this table has places of its own"
                                  : fmt::format("--regulation {}", adaptive_table));
    if (!request.adaptive.other_m.empty() &&
        (request.scale != 1.0 || request.mirror || !request.subtract.empty() || request.left_hand_traffic))
        throw InputError({{}, 0, 0, "--other"}, "found with a lamp that is changed, or with --left-hand-traffic", "the lamp as it is");
    const std::vector<LampFile> lamps = requested_lamps(request, r, r.notes);
    std::vector<CandelaTable> tables;
    std::vector<std::string> names;
    for (const LampFile& lamp : lamps) {
        tables.push_back(lamp.table);
        names.push_back(lamp.name);
    }
    CheckOptions options;
    options.aim = requested_aim(request);
    options.left_hand_traffic = request.left_hand_traffic;
    options.re_aim = !request.no_re_aim;
    std::optional<LampFile> aim_by;
    if (!request.aim_by.empty()) {
        aim_by = read_lamp(request.aim_by, request.reading);
        options.aim_by = &aim_by->table;
    }
    return tell_regulation({r, names, check_regulation(r, tables, options)}, request);
}

int lamp_cut_off(const LampRequest& request) {
    refuse_other_work(request, "--cut-off");
    if (!(request.detector_mm >= 0.0 && request.detector_mm <= 200.0))
        throw InputError({{}, 0, 0, "--detector"}, fmt::format("found {}", request.detector_mm), "0 to 200 mm at 25 m");
    const LampFile lamp = lamp_of(request);
    const CutOffOptions options{request.sharpness, degrees(std::atan(request.detector_mm / 25000.0))};
    const CandelaTable table = request.left_hand_traffic ? mirrored(lamp.table) : lamp.table;
    const CutOffFound found{lamp, options, request.left_hand_traffic, measure_cut_off({&table, {}}, options), fit_elbow({&table, {}})};
    if (!request.picture.empty())
        write_lamp_picture(cut_off_figure(found), request);
    if (request.picture != "-")
        fmt::print("{}", request.json ? cut_off_json(found) : document_text(document(found)));
    return 0;
}

void refuse_regulation_options(const LampRequest& request) {
    request.adaptive.check();
    const char* option = !request.aim.empty()          ? "--aim-rule"
                         : !request.aim_by.empty()     ? "--aim-by"
                         : request.no_re_aim           ? "--no-re-aim"
                         : request.left_hand_traffic   ? "--left-hand-traffic"
                         : !request.other_side.empty() ? "--other-side"
                         : request.adaptive.asked()    ? (request.adaptive.other_m.empty() ? "--dimmed" : "--other")
                                                       : nullptr;
    if (option)
        throw InputError({{}, 0, 0, option}, "found without --regulation, --cut-off or --check", "one of them");
}

void add_regulation_options(CLI::App& command, LampRequest& request) {
    const char* group = "Regulations (our copies of their tables; not an approval)";
    add_shared(command, "--regulation", request.regulation)->group(group);
    command.add_flag("--cut-off", request.cut_off, "measure the cut-off: position, sharpness, linearity, kink")->group(group);
    add_shared(command, "--left-hand-traffic", request.left_hand_traffic)->group(group);
    command
        .add_option("--aim-rule", request.aim, "how to aim for the table: auto, as-is, cut-off, cut-off-line, elbow, vol, vor or maximum")
        ->option_text("RULE")
        ->default_str("the regulation's way")
        ->group(group);
    command.add_option("--aim-by", request.aim_by, "low-beam file whose aim this beam takes over")->option_text("FILE")->group(group);
    command.add_flag("--no-re-aim", request.no_re_aim, "do not re-aim a failing lamp within the edition's allowance")->group(group);
    add_adaptive_options(command, request.adaptive);
    command.add_option("--detector", request.detector_mm, "with --cut-off: detector diameter in mm at 25 m; 0: a point")
        ->option_text("MM")
        ->capture_default_str()
        ->group(group);
    command
        .add_option_function<std::string>(
            "--sharpness",
            [&request](const std::string& word) {
                if (word != "maximum" && word != "at-inflection")
                    throw InputError({{}, 0, 0, "--sharpness"}, "found '" + printable(word) + "'", "maximum or at-inflection");
                request.sharpness = word == "maximum" ? SharpnessRule::maximum : SharpnessRule::at_inflection;
            },
            "with --cut-off: which G represents a scan")
        ->option_text("maximum|at-inflection")
        ->default_str("maximum")
        ->group(group);
}

} // namespace fernlicht
