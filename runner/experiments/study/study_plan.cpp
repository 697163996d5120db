#include "runner/experiments/study/study_plan.h"

#include "metrics/readings/reading_key.h"
#include "metrics/regulation/installed_aim.h"
#include "renderer/device.h"
#include "runner/experiments/study/study_run.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/aim_lamps.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/stage.h"
#include "runner/store/cell_key.h"
#include "scenarios/can/bus_mapping.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"
#include "scenarios/values/pose.h"
#include "scenarios/values/refusals.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

/// Where the study's file has the lamp.
[[noreturn]] void refuse_aim(const Study& study, const StudyLamp& lamp, const std::string& found, const char* expected) {
    throw InputError({study.file, lamp.line, lamp.column, "lamps." + lamp.name + ".aim"}, found, expected);
}

/// Lamps that the aim of a drive finds nothing in; those of other road users are the drive's own affair.
void refuse_unaimable_by(const Study& study, const StudyLamp& lamp, const Drive& drive) {
    Drive traffic = drive, own = drive;
    traffic.lamp_sets.clear();
    aim_lamps(traffic);
    own.traffic_rows.clear();
    try {
        aim_lamps(own);
    } catch (const InputError& error) {
        refuse_aim(study, lamp, fmt::format("a drive's aim: auto cannot aim it ({})", error.what()),
                   "aim: as-is, or the file of a beam with a cut-off");
    }
}

/// Of a road with what stands and drives on it, the lamps apart: what a stage told when one was made.
struct KnownStage {
    std::string of; ///< what it was made from
    bool left_hand_traffic = false;
    std::shared_ptr<const FilesRead> road, others;
};

bool is_opened_for_lamps(const Drive& drive, const FileRead& file) {
    return std::ranges::any_of(drive.lamp_sources, [&](const LampSource& source) {
        return std::ranges::find(source.file->opened, file.path, &FileRead::path) != source.file->opened.end();
    });
}

FilesRead opened_beside_lamps(const Drive& drive, const FilesRead& road) {
    FilesRead others;
    for (const FileRead& file : drive.opened)
        if (file.path != drive.file && !is_opened_for_lamps(drive, file) &&
            std::ranges::find(road, file.path, &FileRead::path) == road.end())
            add_inputs(others, {file});
    return others;
}

/// Axes may put a drive on another road, or elsewhere on it.
std::string stage_text(const StudyCell& cell, const Drive& drive) {
    std::string text = fmt::format("{} {} {} {} {} {} {} {} {}\n", cell.drive, cell.technique, cell.mirror, drive.road_file.string(),
                                   drive.mirrored_road, drive.start.road, drive.start.lane, drive.start.s_m, fmt::join(drive.via, ","));
    for (const FileRead& file : opened_beside_lamps(drive, {}))
        text += file.path.string() + "\n";
    for (const TrafficRow& row : drive.traffic_rows) // read with the scene
        text += row.model.string() + "\n";
    if (drive.can) {
        text += drive.can->log.value_or("").string() + "\n";
        for (const fs::path& database : drive.can->databases)
            text += database.string() + "\n";
    }
    return text;
}

KnownStage stage_told(const StudyCell& cell, const Drive& drive) {
    const Stage stage(drive);
    KnownStage known{stage_text(cell, drive), left_hand_traffic(stage), std::make_shared<FilesRead>(stage.network.opened), nullptr};
    known.others = std::make_shared<FilesRead>(opened_beside_lamps(stage.drive, *known.road));
    return known;
}

/// As the study has them at its usual aim, which is 1 % down: other aims are asked for. Lamps that stay as they are where the condition
/// mirrors were made for the other side.
void check_lamps(const Study& study, const StudyCell& cell, const Drive& drive, bool left_hand_traffic, LampFileChecks& checks) {
    const StudyLamp& lamp = study.lamps[cell.lamp];
    const bool stays = study.conditions.mirror[cell.mirror] && !lamp.mirrors;
    checks.add(drive, left_hand_traffic != stays, degrees(std::atan(-0.01) - std::atan(lamp.file_aim_percent / 100.0)));
}

bool limits_times(const std::string& reading) {
    const std::optional<ReadingKey> key = key_of(reading);
    return key && is_time(*key);
}

void refuse_limits_on_times(const Study& study, const std::vector<PlannedCell>& cells) {
    const auto refuse = [&](const std::string& where) {
        throw InputError(
            {study.file, 0, 0, "--jobs"},
            fmt::format("found a limit on times in {}, and no times are taken of cells that may have others beside them", where),
            "--timed, which plays cells by themselves");
    };
    for (const PlannedCell& one : cells)
        if (one.limits_times)
            refuse("the drive of cell " + one.cell.name);
    if (std::ranges::any_of(study.limits, limits_times, &StudyLimit::reading))
        refuse("limits");
}

/// A range that lies beyond some drives leaves their cells out; one that lies beyond all is a mistake.
void refuse_no_moments(const Study& study, const std::vector<PlannedCell>& cells, const TickRange& ticks) {
    int most = 0;
    for (const PlannedCell& one : cells) {
        if (one.moments > 0)
            return;
        most = std::max(most, one.moments_of_drive);
    }
    throw InputError({study.file, 0, 0, "--frames"}, fmt::format("found a range from {} on", ticks.first),
                     fmt::format("moments of a drive, the longest of which has 0 to {}", most - 1));
}

} // namespace

/// As `--frames` takes it; "" for all moments.
std::string frames_text(const TickRange& ticks) {
    if (ticks.last == TickRange{}.last)
        return ticks.first > 0 ? fmt::format("{}:", ticks.first) : "";
    return fmt::format("{}:{}", ticks.first, ticks.last);
}

std::vector<std::size_t> lacking_cells(const CellStore& store, const StudyPlan& plan, bool damaged_too) {
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; i < plan.cells.size(); ++i)
        if (const PlannedCell& one = plan.cells[i];
            one.moments > 0 && (!store.find(one.key) || (damaged_too && !store.damage(one.key).empty())))
            cells.push_back(i);
    return cells;
}

std::vector<std::vector<std::string>> reasons_to_play(const Study& study, const StudyPlan& plan, const std::vector<std::size_t>& cells,
                                                      const CellStore& store) {
    std::map<std::string, StoredCell> latest; // by cell
    if (cells.empty())
        return {};
    const std::vector<StoredCell> all = store.list();
    for (const bool own : {false, true}) // those of other studies where this one played none of that name
        for (const StoredCell& stored : all)
            if ((stored.study == study.name) == own)
                latest.insert_or_assign(stored.cell, stored);
    std::vector<std::vector<std::string>> reasons;
    for (const std::size_t i : cells) {
        const PlannedCell& one = plan.cells[i];
        const auto before = latest.find(one.cell.name);
        std::string known = store.failure(one.key);
        if (known.empty())
            known = store.damage(one.key);
        if (known.empty() && before == latest.end())
            known = "new";
        reasons.push_back(known.empty() ? input_changes(before->second.inputs, plan.inputs(one)) : std::vector{known});
    }
    return reasons;
}

CellInputs StudyPlan::inputs(const PlannedCell& cell) const {
    CellInputs all = cell.own_inputs;
    all.insert(all.end(), of_machine.begin(), of_machine.end());
    return all;
}

void refuse_unknown_readings(const Study& study) {
    const auto refuse = [&](const std::string& name, std::size_t line, const char* key) {
        if (name.find_first_of("*?") != std::string::npos || key_of(name))
            return;
        const std::string nearest = nearest_name(name, decides_by_default());
        refuse_and_go_on(InputError({study.file, line, 0, key}, fmt::format("found '{}', which is no reading's name", printable(name)),
                                    nearest.empty() ? "one that `fernlicht readings` lists"
                                                    : "one that `fernlicht readings` lists, such as " + nearest));
    };
    for (const std::string& name : study.decide)
        refuse(name, 0, "decide");
    for (const StudyLimit& limit : study.limits)
        refuse(limit.reading, limit.line, "limits");
}

StudyPlan plan_study(const Study& study, const StudyOptions& options) {
    refuse_unknown_readings(study);
    const TraceSpan span("plan", "study");
    StudyPlan plan;
    KnownStage stage;
    LampFileChecks checks;
    std::set<std::pair<std::size_t, std::size_t>> aimed;
    const TickRange& ticks = options.run.ticks;
    for (const StudyCell& cell : chosen_cells(study, options.only)) {
        const Drive drive = cell_drive(study, cell);
        refuse_auto_shadows(drive); // each cell would choose for itself
        if (aimed.emplace(cell.lamp, cell.drive).second)
            refuse_unaimable_by(study, study.lamps[cell.lamp], drive);
        if (stage.of != stage_text(cell, drive)) // roads and techniques too, once each
            stage = stage_told(cell, drive);
        check_lamps(study, cell, drive, stage.left_hand_traffic, checks);
        PlannedCell& one = plan.cells.emplace_back();
        one = {cell,
               drive.name,
               drive.title,
               file_name_of(drive.name) + ".yaml",
               stage.left_hand_traffic,
               std::ranges::any_of(drive.limits, limits_times, &Limit::reading),
               ticks_to_play(drive, ticks),
               tick_count(drive),
               {},
               {},
               {},
               stage.road,
               stage.others};
        one.settings = {std::max(0, ticks.first), std::min(ticks.last, one.moments_of_drive - 1), options.run.accuracy,
                        options.run.repeats};
        one.own_inputs = cell_inputs(drive, *stage.road, *stage.others, one.settings);
    }
    if (!options.timed)
        refuse_limits_on_times(study, plan.cells);
    if (options.strict)
        checks.refuse_meaningless();
    plan.lamp_files = checks.files();
    refuse_no_moments(study, plan.cells, ticks);
    plan.context =
        make_context(open_device(options.run.backend).info(), options.run.command, cell_drive(study, plan.cells.front().cell).seed);
    plan.of_machine = machine_inputs(plan.context, options.run.accuracy);
    for (PlannedCell& one : plan.cells)
        one.key = cell_key(plan.inputs(one));
    return plan;
}

std::vector<StudyCell> chosen_cells(const Study& study, const std::vector<std::string>& only) {
    std::vector<StudyCell> cells = cells_of(study), chosen;
    for (const std::string& pattern : only)
        if (std::ranges::none_of(cells, [&](const StudyCell& cell) { return matches(pattern, cell.name); }))
            throw InputError({study.file, 0, 0, "--only"}, fmt::format("found '{}', which fits no cell", printable(pattern)),
                             "a pattern like '*xenon*'; --list names the cells");
    std::ranges::copy_if(cells, std::back_inserter(chosen), [&](const StudyCell& cell) {
        return only.empty() || std::ranges::any_of(only, [&](const std::string& pattern) { return matches(pattern, cell.name); });
    });
    return chosen;
}

void refuse_unaimable(const Study& study) {
    for (const StudyLamp& lamp : study.lamps) {
        if (lamp.aim != BeamAim::automatic)
            continue;
        std::vector<fs::path> seen{fs::path()}; // where the study names none
        for (const auto& [file, is_high] : {std::pair(lamp.left, false), {lamp.right, false}, {lamp.high, true}}) {
            if (std::ranges::find(seen, file) != seen.end())
                continue;
            seen.push_back(file);
            if (const AimMark mark = aim_mark(read_lamp(file, {.recipe = lamp.recipe}).table, is_high); !mark.v_deg)
                refuse_aim(study, lamp,
                           fmt::format("found auto, and nothing to aim by in {}: {}", printable(file.string(), 400), mark.why_not),
                           "as-is, or the file of a beam with a cut-off");
        }
    }
}

} // namespace fernlicht
