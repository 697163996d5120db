// Each light equation by itself, in float against double: on the CPU and on the device.
#include "runner/experiments/stability/equations.h"
#include "runner/experiments/stability/stability_case.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

std::string text_of(const Equation& equation, const EquationArguments& x) {
    std::string text;
    for (const EquationInput& input : equation.inputs)
        for (std::size_t slot = input.slot; slot < input.slot + (input.kind == EquationInput::Kind::direction ? 3 : 1); ++slot)
            text += fmt::format("{}{:.9g}", text.empty() ? "" : " ", x[slot]);
    return text;
}

Found examined(const Equation& equation, StabilityBench& bench) {
    const EquationBound& bound = bound_of(equation.function);
    const Examination found = examine(equation, bench.device(), bench.thorough ? 10.0 : 1.0, StabilityBench::seed);
    const bool gpu_worse = !(found.on_gpu.error <= found.in_float.error);
    const EquationError& worse = gpu_worse ? found.on_gpu : found.in_float;
    const std::string condition = found.condition > 1e4 ? "unbounded" : fmt::format("{:.2g}", found.condition);
    Found result;
    result.add(std::max(found.in_float.error, worse.error),
               fmt::format("C++ {:.2g}, device {:.2g}, condition {}{}", found.in_float.error, found.on_gpu.error, condition,
                           worse.error > 0.0 ? "; worst at " + text_of(equation, worse.at) : std::string()));
    if (bound.condition > 0.0 && found.condition > 1.01 * bound.condition)
        result.add(std::numeric_limits<double>::infinity(), fmt::format("condition {:.3g} at {}, stated is {:g}", found.condition,
                                                                        text_of(equation, found.condition_at), bound.condition));
    return result;
}

} // namespace

std::vector<StabilityCase> equation_cases() {
    std::vector<StabilityCase> cases;
    for (const Equation& equation : equations()) {
        const EquationBound& bound = bound_of(equation.function);
        cases.push_back({"equation", equation.lamp_set.empty() ? equation.function : equation.function + "-" + equation.lamp_set,
                         "float against double over " + equation.domain, bound.error, bound.of, bound.reason,
                         [&equation](StabilityBench& bench) { return examined(equation, bench); }});
    }
    return cases;
}

} // namespace fernlicht
