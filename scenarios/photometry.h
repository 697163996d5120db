// The light equations of photometry.glsl as C++ in double precision: the twin of everything that the GPU computes.
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace fernlicht::photometry {

using real = double;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
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
#undef FN
#undef OUT
#undef PRECISE
#undef SELECT

} // namespace fernlicht::photometry
