// Numbers as YAML writes them on one line, each with as many digits as bring it back.
#pragma once

#include <fmt/format.h>
#include <glm/vec3.hpp>
#include <vector>

namespace fernlicht {

inline std::string flow_list(const std::vector<double>& numbers) { return fmt::format("[{}]", fmt::join(numbers, ", ")); }
inline std::string flow_list(const glm::dvec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

} // namespace fernlicht
