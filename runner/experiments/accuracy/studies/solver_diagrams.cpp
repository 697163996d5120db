#include "runner/experiments/accuracy/studies/solver_diagrams.h"

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
    row.error = Interval{found.error, found.error, found.error};
    row.seconds = Interval{found.seconds, found.least_seconds, found.most_seconds, found.repetitions};
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
                fmt::format("against {}; a number beside the solver is its tolerance; bars: least and most time", row.against));
            diagram = diagrams.insert(diagrams.end(), std::move(made));
        }
        diagram->rows.push_back(row_of(row));
    }
    return diagrams;
}

} // namespace fernlicht
