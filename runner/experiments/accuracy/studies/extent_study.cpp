#include "metrics/road/extent.h"
#include "metrics/road/lux_near_thresholds.h"
#include "metrics/statistics/statistics.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "runner/experiments/bench/bench_run.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

constexpr Surface surfaces[] = {Surface::road, Surface::target};

/// Reach on the own lane's centre by plane and limit; without those that are cut off.
using Reaches = std::map<std::pair<Surface, double>, double>;

Reaches reaches_of(const Stage& stage, const Moment& moment, const ExtentParameters& parameters) {
    const ExtentGrid grid = make_extent_grid(stage.route, moment, stage.drive.bumper_m, parameters);
    Reaches reaches;
    for (const Surface surface : surfaces)
        for (const LaneExtent& extent : measure_extent(grid, twin_lux_near_thresholds(grid, moment, surface, parameters.thresholds_lx),
                                                       surface, parameters.thresholds_lx, parameters.width_at_m))
            if (extent.lane == "own" && !extent.reach_is_cut_off)
                reaches[{surface, extent.threshold_lx}] = extent.reach_centre_m;
    return reaches;
}

ExtentParameters parameters_of(const Drive& drive, double cell_m) {
    ExtentParameters parameters = drive.extent.value_or(ExtentParameters{});
    parameters.cell_m = cell_m;
    return parameters;
}

std::vector<double> differences(const Reaches& tested, const Reaches& truth) {
    std::vector<double> all;
    for (const auto& [key, reach_m] : truth)
        if (const auto found = tested.find(key); found != tested.end())
            all.push_back(std::abs(found->second - reach_m));
    return all;
}

/// 5 %, 50 % and 95 % of each reach over the drive at this step.
std::map<std::pair<std::pair<Surface, double>, int>, double> statistics_of(const Stage& stage, const LampSet& lamp_set, double step_s) {
    Drive drive = stage.drive;
    drive.step_s = step_s;
    std::map<std::pair<Surface, double>, std::vector<double>> over_drive;
    const ExtentParameters parameters = parameters_of(drive, 1.0);
    State state = start(drive);
    for (int tick = 0; tick < tick_count(drive); ++tick, state = advance(state, drive))
        for (const auto& [key, reach_m] : reaches_of(stage, moment_at(state, drive, stage.route, lamp_set), parameters))
            over_drive[key].push_back(reach_m);
    std::map<std::pair<std::pair<Surface, double>, int>, double> statistics;
    for (const auto& [key, samples] : over_drive)
        if (const auto spread = spread_of(samples))
            for (const auto& [share, value] : {std::pair(5, spread->p05), std::pair(50, spread->median), std::pair(95, spread->p95)})
                statistics[{key, share}] = value;
    return statistics;
}

/// Reports store reach to a tenth of a millimetre.
constexpr double stored_m = 1e-4;
constexpr const char* stored = "what reports store";

void set_error(WorkPrecisionRow& row, const std::vector<double>& errors) {
    row.floor = stored_m;
    if (const auto spread = spread_of(errors))
        row.error = {spread->p95, spread->median, spread->maximum};
    else
        row.why_not = "no reach ends on the road";
}

} // namespace

WorkPrecision extent_study(const Stage& stage, const LampSet& lamp_set, const StudyGoesOn& go_on) {
    constexpr double finest_m = 0.0625, beside_m = 4.0;
    WorkPrecision diagram{"extent",
                          "Extent grid",
                          "error of reach, 95 % of the reaches",
                          "m",
                          "time a moment",
                          stored,
                          {"reach on the own lane's centre at the drive's limits, on the road and on targets, by the twin in three "
                           "moments, against cells of 1/16 m; bars from the median to the largest; on a grid as wide as the drive's"},
                          {}};
    const int ticks = tick_count(stage.drive);
    const std::vector<Moment> moments = moments_at(ticks_over(ticks, std::min(3, ticks)), stage, lamp_set);
    std::vector<Reaches> truth;
    for (const Moment& moment : moments) {
        ExtentParameters fine = parameters_of(stage.drive, finest_m);
        fine.beside_m = std::min(fine.beside_m, beside_m);
        truth.push_back(reaches_of(stage, moment, fine));
    }
    for (const double cell_m : {4.0, 2.0, 1.0, 0.5, 0.25}) {
        if (!go_on())
            break;
        const ExtentParameters parameters = parameters_of(stage.drive, cell_m);
        std::vector<double> errors;
        for (std::size_t m = 0; m < moments.size(); ++m)
            std::ranges::copy(differences(reaches_of(stage, moments[m], parameters), truth[m]), std::back_inserter(errors));
        WorkPrecisionRow row;
        row.label = fmt::format("cells of {} m", cell_m);
        row.note = cell_m == parameters_of(stage.drive, stage.drive.extent.value_or(ExtentParameters{}).cell_m).cell_m ? "the drive's" : "";
        row.parameters = {{"cell_m", fmt::format("{}", cell_m)}};
        set_error(row, errors);
        row.seconds = timed([&] { reaches_of(stage, moments.front(), parameters); });
        diagram.rows.push_back(std::move(row));
    }
    return diagram;
}

WorkPrecision step_study(const Stage& stage, const LampSet& lamp_set, const StudyGoesOn& go_on) {
    constexpr int finest = 256;
    WorkPrecision diagram{
        "step",
        "Time step",
        "error of reach over the drive, 95 % of its figures",
        "m",
        "time for the drive",
        stored,
        {fmt::format("5 %, median and 95 % over the drive of each reach that the drive asks for, by the twin on cells of 1 m, against "
                     "{} moments; the drive itself has {}",
                     finest, tick_count(stage.drive))},
        {}};
    const auto truth = statistics_of(stage, lamp_set, stage.drive.duration_s / finest);
    for (const int moments : {4, 8, 16, 32, 64, 128}) {
        if (!go_on())
            break;
        WorkPrecisionRow row;
        const double step_s = stage.drive.duration_s / moments;
        row.label = fmt::format("{} moments, every {:.3f} s", moments, step_s);
        row.parameters = {{"step_s", fmt::format("{}", step_s)}};
        std::vector<double> errors;
        const auto tested = statistics_of(stage, lamp_set, step_s);
        for (const auto& [key, value] : truth)
            if (const auto found = tested.find(key); found != tested.end())
                errors.push_back(std::abs(found->second - value));
        set_error(row, errors);
        row.seconds = timed([&] { statistics_of(stage, lamp_set, step_s); });
        diagram.rows.push_back(std::move(row));
    }
    return diagram;
}

} // namespace fernlicht
