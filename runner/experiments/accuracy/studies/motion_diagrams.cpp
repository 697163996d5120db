
#include "runner/experiments/accuracy/studies/studies.h"
#include "scenarios/control/control_stability.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

WorkPrecisionRow row_of(const SolverRow& found) {
    WorkPrecisionRow row;
    const bool fixed = found.step_s > 0.0;
    const std::string setting = fixed ? fmt::format("steps of {:g} ms", 1.0e3 * found.step_s) : fmt::format("{:g}", found.tolerance);
    row.label = fmt::format("{}, {}", name(found.solver), setting);
    row.parameters = {{"solver", std::string(name(found.solver))}, {fixed ? "step" : "tolerance", setting}};
    row.why_not = found.not_measured;
    if (!found.not_measured.empty())
        return row;
    row.error = exactly(found.error);
    row.seconds = Interval{found.seconds, found.min_seconds, found.max_seconds, found.repetitions};
    row.floor = found.floor;
    for (const auto& [what, number] : {std::pair("steps", found.steps), std::pair("rejected", found.rejected),
                                       std::pair("evaluations", found.derivatives), std::pair("Jacobians", found.jacobians)})
        row.parameters.emplace_back(what, std::to_string(number));
    return row;
}

/// "car to rest" in letters that a file name may have.
std::string slug(std::string problem) {
    std::ranges::replace(problem, ' ', '-');
    return "solvers-" + problem;
}

} // namespace

WorkPrecision control_study(const StudyGoesOn& go_on) {
    WorkPrecision diagram{"control-period",
                          "Control period: bend light on a road that weaves",
                          "largest error of the swivel over 4 s",
                          "rad",
                          "time of the run",
                          "what the finest run is itself off",
                          {"against a period of 0.25 ms; that run's own error is taken as what a period of 0.5 ms differs from it: the "
                           "error grows with the period. "
                           "Two lamps, actuators of 3 Hz"},
                          {}};
    for (const auto& [law, name] :
         {std::pair(BendLaw::steering, "steering"), std::pair(BendLaw::yaw_rate, "yaw-rate"), std::pair(BendLaw::route, "route")}) {
        const double floor = control_period_error_rad(law, 5.0e-4);
        for (const double period_s : {0.1, 0.05, 0.02, 0.01, 0.005, 0.001}) {
            if (!go_on())
                return diagram;
            WorkPrecisionRow row;
            row.label = fmt::format("{}, every {:g} ms", name, 1.0e3 * period_s);
            row.note = period_s == ControlParameters{}.period_s ? "the default" : "";
            row.parameters = {{"law", name}, {"period_s", fmt::format("{}", period_s)}};
            row.error = exactly(control_period_error_rad(law, period_s));
            row.floor = floor;
            row.seconds = timed([&, law = law] { weave(law, period_s, 4.0); });
            diagram.rows.push_back(std::move(row));
        }
    }
    return diagram;
}

std::vector<WorkPrecision> solver_diagrams(const std::vector<SolverRow>& rows) {
    std::vector<WorkPrecision> diagrams;
    for (const SolverRow& row : rows) {
        auto diagram = std::ranges::find(diagrams, slug(row.problem), &WorkPrecision::name);
        if (diagram == diagrams.end()) {
            WorkPrecision made;
            made.name = slug(row.problem);
            made.title = "Solvers: " + row.problem;
            made.error_name = row.unit == "rad" ? "largest error of pitch, between steps too" : "largest error, between steps too";
            made.error_unit = row.unit;
            made.time_name = "time of the run";
            made.floor_name = row.floor > 0.0 ? "what two tight runs differ by" : "";
            made.notes.push_back(
                fmt::format("against {}; a number beside the solver is its tolerance; bars: min and max of the times", row.against));
            diagram = diagrams.insert(diagrams.end(), std::move(made));
        }
        diagram->rows.push_back(row_of(row));
    }
    return diagrams;
}

} // namespace fernlicht
