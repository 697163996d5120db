#include "runner/experiments/run/run_notes.h"

#include "runner/findings/lamp_aim.h"
#include "runner/findings/run_context.h"
#include "runner/play/capture.h"
#include "runner/play/display_pipeline.h"
#include "scenarios/drives/play/bus_report.h"
#include "scenarios/drives/play/motion.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace fernlicht {

std::vector<std::string> notes_for(const Stage& stage, const LampSet& lamp_set, const Renderer& renderer) {
    std::vector<std::string> notes = stage.drive.notes;
    if (lamp_set.motion)
        std::ranges::copy(lamp_set.motion->notes, std::back_inserter(notes));
    notes.insert(notes.end(), stage.network.warnings.begin(), stage.network.warnings.end());
    const Technique& technique = renderer.technique();
    if (stage.drive.beams && technique.kind != TechniqueKind::ours && technique.features.find("PROJECTED") == std::string_view::npos)
        notes.push_back(
            fmt::format("beams: technique {} has no beam textures, so that their size and depth change nothing", technique.name));
    if (!stage.drive.traffic.empty() && technique.name != "photometric" && technique.name != "photometric-unpruned")
        notes.push_back(
            fmt::format("traffic: technique {} does not render the light of other vehicles' lamps, and its pictures do not show "
                        "them as sources; it renders the road users' bodies. photometric renders all three",
                        technique.name));
    std::map<const LampFile*, std::optional<double>> beam_errors; // which take their time, and most lamps come in pairs
    for (const MountedLamp& lamp : lamp_set.lamps) {
        if (lamp.photometric_distance_m > 0.0)
            notes.push_back(fmt::format("{}: nearer than {:.3g} m it is in its near field, where a point source is an approximation",
                                        lamp.name, lamp.photometric_distance_m));
        for (const std::string& note : lamp.file->notes)
            notes.push_back(lamp.name + ": " + note);
        const auto [known, is_new] = beam_errors.try_emplace(lamp.file.get());
        if (is_new)
            known->second = renderer.beam_error(*lamp.file);
        if (const std::optional<double>& error = known->second)
            notes.push_back(fmt::format("{}: as rendered, the beam differs from the candela table by at most {:.2g} % of the peak",
                                        lamp.name, 100.0 * *error));
    }
    return notes;
}

std::vector<std::string> gaze_warnings(const std::vector<PlayedCell>& played) {
    constexpr double least_deg = 1.0, within_m = 120.0; // on a straight, lamps of the next lane stand 1.7 degrees aside at 120 m
    std::map<std::pair<std::string, std::string>, double> nearest;
    for (const PlayedCell& cell : played)
        for (const SeeingSeries& series : cell.seeing)
            for (const SeeingSeries::Column& column : series.columns)
                for (std::size_t i = 0; i < column.values.size(); ++i)
                    if (const auto theta = column.values[i].number(); theta && *theta < least_deg && column.name.starts_with("theta_") &&
                                                                      series.over.ends_with("to the observer") &&
                                                                      series.at_m[i] <= within_m) {
                        double& known = nearest.try_emplace({cell.drive, series.title}, *theta).first->second;
                        known = std::min(known, *theta);
                    }
    std::vector<std::string> warnings;
    for (const auto& [eye, theta] : nearest)
        warnings.push_back(fmt::format("{}: {}: the line of sight passes the lamps at {:.2f}°: veil and threshold increment are of one who "
                                       "looks into them",
                                       eye.first, eye.second, theta));
    return warnings;
}

void add_warnings(const std::deque<Stage>& stages, const std::vector<Drive>& drives, const TickRange& ticks, Report& report) {
    for (const Stage& stage : stages)
        if (const int asked = ticks_to_play(stage.drive, ticks), all = tick_count(stage.drive); asked < all) {
            bool stored = false;
            for (int tick = ticks.first; tick < ticks.first + asked; ++tick)
                stored = stored || is_captured(stage.drive.capture, tick, stage.drive.step_s);
            report.warnings.push_back(fmt::format("{}: {} of {} moments, as --frames asks; readings are of these alone{}", stage.drive.name,
                                                  asked, all, stored ? "" : ", and none is stored (--capture all stores every one)"));
        }
    for (const Stage& stage : stages)
        if (const auto& tolerances = stage.drive.seeing.tolerances;
            tolerances && !stage.drive.vehicle && tolerance_of(*tolerances, ToleranceKind::load).counts())
            report.warnings.push_back(stage.drive.name +
                                      ": tolerances: load_kg is left out: nobody knows the springs of a car without vehicle:");
    for (const Stage& stage : stages)
        std::ranges::copy(bus_warnings(stage.drive), std::back_inserter(report.warnings));
    for (const Drive& drive : drives) {
        const std::string instead = substitute_shadows(drive);
        if (!instead.empty() && drive.shadows.method != ShadowMethod::map) // which nobody needs to ask for
            report.warnings.push_back(fmt::format("{}: shadows by '{}' were asked for, and technique {} does not use it: {}", drive.name,
                                                  name(drive.shadows.method), drive.technique, instead));
    }
    for (const PlayedCell& played : report.played)
        for (const std::string& warning : aim_warnings(played.lamp_set, played.aims))
            report.warnings.push_back(fmt::format("{}: {}", played.drive, warning));
    std::ranges::copy(gaze_warnings(report.played), std::back_inserter(report.warnings));
    for (const Drive& drive : drives)
        if (drive.display.profile)
            for (const std::string& warning : display_warnings(*drive.display.profile))
                report.warnings.push_back(fmt::format("{}: {}", drive.name, warning));
}

void add_reruns(const std::vector<Drive>& drives, const RunOptions& options, Report& report) {
    for (PlayedCell& played : report.played) {
        std::vector<std::string> others;
        for (const Drive& drive : drives)
            if (drive.name != played.drive)
                others.push_back(drive.file.string());
        for (Verdict& verdict : played.verdicts)
            verdict.rerun = repeat_command(options.command, options.choice, others);
    }
    for (Verdict& verdict : report.listed)
        verdict.rerun = repeat_command(options.command, options.choice);
}

} // namespace fernlicht
