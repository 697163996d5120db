// photometry.glsl and the calls of it, compiled as C++ in double.
#include "runner/experiments/stability/equations.h"
#include "scenarios/photometry.h"

namespace fernlicht {
namespace photometry {

#define FN inline
#include "renderer/shaders/equation_calls.glsl"
#undef FN

} // namespace photometry

std::array<double, 4> equation_in_double(int equation, const EquationDoubles& x) {
    const auto four = [&](std::size_t i) { return glm::dvec4(x[i], x[i + 1], x[i + 2], x[i + 3]); };
    const glm::dvec4 value = photometry::equation_value(equation, four(0), four(4), four(8), four(12));
    return {value.x, value.y, value.z, value.w};
}

} // namespace fernlicht
