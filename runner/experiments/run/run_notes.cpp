#include "runner/experiments/run/run_notes.h"

#include "runner/findings/gazes.h"
#include "runner/findings/lamp_aim.h"
#include "runner/findings/run_context.h"
#include "runner/play/capture.h"
#include "runner/play/display_pipeline.h"
#include "scenarios/drives/play/bus_report.h"
#include "scenarios/drives/play/motion.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
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
    Gazes gazes;
    for (const PlayedCell& cell : played)
        for (const SeeingSeries& series : cell.seeing)
            for (const SeeingSeries::Column& column : series.columns)
                if (column.name.starts_with("theta_")) {
                    std::vector<double> theta_deg;
                    for (const Value& value : column.values)
                        theta_deg.push_back(value.number().value_or(std::numeric_limits<double>::quiet_NaN()));
                    add_gaze(gazes, cell.drive, series, series.at_m, theta_deg);
                }
    return gaze_warnings(gazes);
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
