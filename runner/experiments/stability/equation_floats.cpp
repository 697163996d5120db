// The same text as C++ in float. Its literals have no suffix: the build compiles this file with -fsingle-precision-constant, so that they
// are floats as they are in GLSL.
#include "runner/experiments/stability/equations.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace fernlicht {
namespace {

using real = float;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using glm::abs;
using glm::atan;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::inversesqrt;
using glm::length;
using glm::log;
using glm::max;
using glm::min;
using glm::pow;
using glm::sqrt;

#define FN inline
#define OUT(type) type&
#define PRECISE
#define SELECT(condition, a, b) ((condition) ? (a) : (b))
#include "scenarios/photometry.glsl"

#include "renderer/shaders/equation_calls.glsl"
#undef FN
#undef OUT
#undef PRECISE
#undef SELECT

static_assert(sizeof(0.1) == sizeof(float), "compile this file with -fsingle-precision-constant");

} // namespace

EquationValue equation_in_float(int equation, const EquationArguments& x) {
    const auto four = [&](std::size_t i) { return glm::vec4(x[i], x[i + 1], x[i + 2], x[i + 3]); };
    const glm::vec4 value = equation_value(equation, four(0), four(4), four(8), four(12));
    return {value.x, value.y, value.z, value.w};
}

} // namespace fernlicht
