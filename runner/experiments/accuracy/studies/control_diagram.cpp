#include "runner/experiments/accuracy/studies/studies.h"
#include "scenarios/control/control_stability.h"

#include <fmt/format.h>

namespace fernlicht {

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
            const double error = control_period_error_rad(law, period_s);
            row.error = Interval{error, error, error};
            row.floor = floor;
            row.seconds = timed([&, law = law] { weave(law, period_s, 4.0); });
            diagram.rows.push_back(std::move(row));
        }
    }
    return diagram;
}

} // namespace fernlicht
