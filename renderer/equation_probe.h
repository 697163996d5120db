// The light equations as the GPU computes them, by themselves: arguments in, values out. For measuring what its floats, and its own atan,
// exp and pow, cost.
#pragma once

#include "renderer/device.h"

#include <array>
#include <vector>

namespace fernlicht {

using EquationArguments = std::array<float, 16>; ///< as equation_calls.glsl takes them
using EquationValue = std::array<float, 4>;

/// Compiles one equation, by its number in equation_calls.glsl, and calls it at points. The device must outlive it.
class EquationProbe {
  public:
    /// Throws DeviceError.
    EquationProbe(Device& device, int equation);
    ~EquationProbe();
    EquationProbe(const EquationProbe&) = delete;
    EquationProbe& operator=(const EquationProbe&) = delete;

    /// As many values as points. Throws DeviceError.
    std::vector<EquationValue> at(const std::vector<EquationArguments>& points);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace fernlicht
