// The light equations one by one: what they are defined for, and how exact they are in float, on the CPU, over packs and on the GPU.
#pragma once

#include "renderer/equation_probe.h"
#include "scenarios/packs/level.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace fernlicht {

using EquationDoubles = std::array<double, 16>;

/// The same text in double, as the twin computes it, and in float, rounded after each operation, with libm's functions.
std::array<double, 4> equation_in_double(int equation, const EquationDoubles& arguments);
EquationValue equation_in_float(int equation, const EquationArguments& arguments);
/// And over packs of floats, with functions of their own; as many values as points.
std::vector<EquationValue> equation_in_packs(packs::Level level, int equation, const std::vector<EquationArguments>& points);

/// One argument, or three that are a unit vector.
struct EquationInput {
    enum class Kind { linear, logarithmic, signed_logarithmic, direction } kind = Kind::linear;
    std::size_t slot = 0; ///< first of its arguments
    double low = 0.0, high = 1.0;
};

struct Equation {
    int number = 0; ///< in renderer/shaders/equation_calls.glsl
    std::string function, lamp_set;
    std::string domain; ///< in words
    std::vector<EquationInput> inputs;
    std::size_t outputs = 1;
    /// What an output's error is measured by.
    std::function<double(const EquationDoubles& arguments, double value)> scale;
    /// Which arguments within the inputs' ranges belong to the domain.
    std::function<bool(const EquationDoubles& arguments, const std::array<double, 4>& value)> holds = [](const auto&, const auto&) {
        return true;
    };
};

std::span<const Equation> equations();

/// What is stated beside an equation in photometry.glsl, and held by the cases.
struct EquationBound {
    const char* function;
    double error;
    const char* of;   ///< what the error is measured by: "relative", "rad" ...
    double condition; ///< greatest change of the value, by the same measure, per relative change of one argument; 0: unbounded
    const char* reason;

    /// "Float: 4.8e-07 relative, condition 2."
    std::string comment() const;
};
std::span<const EquationBound> equation_bounds();
const EquationBound& bound_of(const std::string& function);

/// The worst that a search found.
struct EquationError {
    double error = 0.0;
    EquationArguments at{};
};
struct Examination {
    EquationError in_float, in_packs, on_gpu;
    double condition = 0.0;
    EquationArguments condition_at{};
    std::size_t points = 0;
};
/// Random points over the domain, special ones at its ends, then from the worst of them uphill, argument by argument and by single units in
/// the last place. `effort` 1: some 200 000 points on either side. The same seed finds the same.
Examination examine(const Equation& equation, Device& device, double effort, std::uint64_t seed);

} // namespace fernlicht
