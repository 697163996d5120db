#include "runner/findings/lamp_checks.h"

#include "scenarios/traffic/road_user.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>

namespace fernlicht {
namespace {

const LampSource* source_of(const Drive& drive, const LampFile* file) {
    const auto found = std::ranges::find_if(drive.lamp_sources, [&](const LampSource& source) { return source.file.get() == file; });
    return found == drive.lamp_sources.end() ? nullptr : &*found;
}

std::filesystem::path path_of(const Drive& drive, const LampFile& file) {
    const LampSource* const source = source_of(drive, &file);
    return source ? source->path : std::filesystem::path(file.name);
}

/// By whose place on the car it has, as its name says; nullopt for any other name.
std::optional<BeamFunction> mount_of(const MountedLamp& lamp, const std::vector<LampChange>& changes) {
    if (std::ranges::any_of(changes, [&](const LampChange& change) { return change.lamp == lamp.name && change.file; }))
        return std::nullopt; // a lamp for several beams
    if (function_of(lamp.name) == LampFunction::high)
        return BeamFunction::high;
    const bool low = lamp.name == "left" || lamp.name == "right" || lamp.name.find("low") != std::string::npos;
    return low ? std::optional(BeamFunction::low) : std::nullopt;
}

bool is_of_aim(const IntakeFinding& finding) { return finding.fault == IntakeFault::cut_off_high || finding.fault == IntakeFault::aim; }

/// What a user may do about it.
std::string instead_of_strict(bool any_aim, const char* without) {
    return fmt::format("a file without such findings, {}or {} without --strict", any_aim ? "`aim: auto`, " : "", without);
}

const char* meaning_of(const IntakeFinding& finding) { return finding.meaningless ? "readings are meaningless" : "doubtful"; }

} // namespace

/// A file on a mount.
struct LampFileChecks::Use {
    const Drive& drive;
    const LampFile& file;
    const MountedLamp& lamp;
    std::string as;
    IntakeContext context;
};

CheckedLampFile& LampFileChecks::checked(const Use& use) {
    const LampSource* const source = source_of(use.drive, &use.file);
    const LampReadOptions options = source ? source->options : LampReadOptions{};
    const std::filesystem::path path = path_of(use.drive, use.file);
    const auto name_if = [](const std::optional<BeamFunction>& function) { return function ? name_of(*function) : ""; };
    const std::string key =
        fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", path.string(), static_cast<int>(options.type_c_axis),
                    static_cast<int>(options.rule), options.mirrored, name_if(use.context.function), name_if(use.context.mount),
                    use.context.left_hand_traffic, use.context.turned_up_deg.value_or(0.0), use.context.turned_right_deg,
                    static_cast<int>(use.lamp.source), use.lamp.reference_voltage_v.value_or(0.0));
    const auto [place, is_new] = places_.emplace(key, files_.size());
    if (is_new) {
        Intake intake = check_intake(use.file, use.context);
        files_.push_back({.file = path.filename().string(),
                          .used_as = {},
                          .function = intake.function,
                          .function_stated = intake.function_stated,
                          .filament = use.lamp.source == SourceKind::filament,
                          .measured_at_v = use.lamp.reference_voltage_v,
                          .findings = std::move(intake.findings)});
        paths_.push_back(path);
    }
    CheckedLampFile& file = files_[place->second];
    if (std::ranges::find(file.used_as, use.as) == file.used_as.end())
        file.used_as.push_back(use.as);
    return file;
}

void LampFileChecks::check_pair(const Drive& drive, const LampSet& lamp_set, const std::string& left, const std::string& right) {
    const auto of_left = std::ranges::find(lamp_set.lamps, left, &MountedLamp::name),
               of_right = std::ranges::find(lamp_set.lamps, right, &MountedLamp::name);
    if (of_left == lamp_set.lamps.end() || of_right == lamp_set.lamps.end() || of_left->file == of_right->file)
        return;
    const LampSource* const source = source_of(drive, of_left->file.get());
    const auto swapped = swapped_sides(*of_left->file, *of_right->file, !source || !source->options.mirrored);
    if (!swapped)
        return;
    const std::string as = lamp_set.name + ": " + left;
    for (CheckedLampFile& file : files_)
        if (std::ranges::find(file.used_as, as) != file.used_as.end() &&
            std::ranges::find(file.findings, IntakeFault::sides, &IntakeFinding::fault) == file.findings.end())
            file.findings.push_back(*swapped);
}

void LampFileChecks::add(const Drive& drive, bool left_hand_traffic, std::optional<double> turned_up_deg) {
    const auto look = [&](const std::string& set, const MountedLamp& lamp, const std::shared_ptr<const LampFile>& file, double pitch_rad,
                          std::optional<BeamFunction> function, std::optional<BeamFunction> mount) {
        std::optional<double> turned_deg; // an automatic aim finds the cut-off wherever the file has it
        if (lamp.aim_rule != BeamAim::automatic)
            turned_deg = turned_up_deg.value_or(std::min(0.0, degrees(lamp.mount.pitch_rad + pitch_rad)));
        const double turned_right_deg = 0.0 - degrees(lamp.mount.yaw_rad + lamp.yaw_rad);
        checked({drive, *file, lamp, set + ": " + lamp.name, {function, left_hand_traffic, turned_deg, turned_right_deg, mount}});
    };
    const auto look_at = [&](const std::string& set, const std::vector<MountedLamp>& lamps, const std::vector<LampChange>& changes,
                             bool own_car) {
        for (const MountedLamp& lamp : lamps) {
            look(set, lamp, lamp.file, lamp.pitch_rad, lamp.function, own_car ? mount_of(lamp, changes) : std::nullopt);
            for (const LampChange& change : changes)
                if (change.lamp == lamp.name && change.file)
                    look(set, lamp, change.file, change.pitch_rad.value_or(lamp.pitch_rad), std::nullopt, std::nullopt);
        }
    };
    for (const LampSet& lamp_set : drive.lamp_sets) {
        look_at(lamp_set.name, lamp_set.lamps, lamp_set.changes, true);
        check_pair(drive, lamp_set, "left", "right");
        check_pair(drive, lamp_set, "high-left", "high-right");
    }
    for (const TrafficRow& row : drive.traffic_rows) {
        std::vector<MountedLamp> headlamps;
        std::ranges::copy_if(row.lamps, std::back_inserter(headlamps), [](const MountedLamp& lamp) {
            return function_of(lamp.name) == LampFunction::low || function_of(lamp.name) == LampFunction::high;
        });
        look_at("traffic " + row.name, headlamps, row.changes, false); // others may drive with high beams
    }
}

void LampFileChecks::refuse_meaningless() const {
    std::vector<std::string> told;
    std::filesystem::path first;
    bool any_aim = false;
    for (std::size_t i = 0; i < files_.size(); ++i)
        for (const IntakeFinding& finding : files_[i].findings)
            if (finding.meaningless) {
                if (told.empty())
                    first = paths_[i];
                any_aim = any_aim || is_of_aim(finding);
                told.push_back(fmt::format("{} ({}), {}: {}", printable(paths_[i].filename().string()),
                                           printable(fmt::format("{}", fmt::join(files_[i].used_as, "; ")), 80), name_of(finding.fault),
                                           finding.text));
            }
    if (!told.empty())
        throw InputError({first, 0, 0, "--strict"},
                         told.size() == 1
                             ? told.front()
                             : fmt::format("{} findings that make readings meaningless:\n  {}\n", told.size(), fmt::join(told, "\n  ")),
                         instead_of_strict(any_aim, "the run"));
}

void refuse_meaningless(const std::filesystem::path& file, const std::vector<IntakeFinding>& findings, const char* without) {
    std::vector<std::string> told;
    bool any_aim = false;
    for (const IntakeFinding& finding : findings)
        if (finding.meaningless) {
            any_aim = any_aim || is_of_aim(finding);
            told.push_back(finding.text);
        }
    if (!told.empty())
        throw InputError({file, 0, 0, "--strict"}, fmt::format("{}", fmt::join(told, "; and ")), instead_of_strict(any_aim, without));
}

std::vector<std::string> lamp_warnings(const std::vector<CheckedLampFile>& files) {
    std::vector<std::string> warnings;
    for (const CheckedLampFile& file : files)
        for (const IntakeFinding& finding : file.findings)
            if (finding.meaningless || finding.fault == IntakeFault::function)
                warnings.push_back(fmt::format("lamp file {} ({}), {}: {}{}", printable(file.file),
                                               printable(fmt::format("{}", fmt::join(file.used_as, "; ")), 80), name_of(finding.fault),
                                               finding.text, finding.meaningless ? "; readings with it are meaningless" : ""));
    return warnings;
}

std::vector<std::string> lamp_warnings(const Drive& drive, const LampSet& lamp_set, bool left_hand_traffic) {
    Drive alone;
    alone.lamp_sources = drive.lamp_sources;
    alone.lamp_sets = {lamp_set};
    LampFileChecks checks;
    checks.add(alone, left_hand_traffic);
    return lamp_warnings(checks.files());
}

Table lamp_files_table(const std::vector<CheckedLampFile>& files) {
    Table table{.name = "lamp-files",
                .caption = "Lamp files",
                .columns = columns_of("file<|used as<|function<|measured at<|finding<|found<|meaning<"),
                .rows = {},
                .folded = std::ranges::all_of(files, [](const CheckedLampFile& file) { return file.findings.empty(); })};
    for (const CheckedLampFile& file : files) {
        std::vector<Cell> row{file.file, fmt::format("{}", fmt::join(file.used_as, "; ")),
                              function_text(file.function, file.function_stated), voltage_text(file.filament, file.measured_at_v)};
        if (file.findings.empty()) {
            row.insert(row.end(), {"none", "", ""});
            table.rows.push_back(row);
        }
        for (const IntakeFinding& finding : file.findings) {
            table.rows.push_back(row);
            table.rows.back().insert(table.rows.back().end(), {name_of(finding.fault), finding.text, meaning_of(finding)});
            row = {"", "", "", ""};
        }
    }
    return table;
}

std::string voltage_text(bool filament, const std::optional<double>& measured_at_v) {
    if (!filament)
        return measured_at_v ? fmt::format("{:g} V; its light does not go with it", *measured_at_v) : "any voltage";
    if (measured_at_v)
        return fmt::format("{:g} V", *measured_at_v);
    return fmt::format("not stated: taken as {:g} V (UN); a lamp measured at {:g} V (FMVSS 108) has ×{:.2f} of the light it has there",
                       un_voltage_v, fmvss_voltage_v, filament_flux_factor(fmvss_voltage_v, un_voltage_v));
}

std::string function_text(BeamFunction function, bool stated) {
    return fmt::format("{} ({})", name_of(function), stated ? "stated" : "recognised");
}

} // namespace fernlicht
