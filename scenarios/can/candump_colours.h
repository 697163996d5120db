// Colours of candump -c: what switches them on, in its order, and off.
#pragma once

#include <array>
#include <string_view>

namespace fernlicht {

inline constexpr std::array<std::string_view, 6> candump_colours = {"\33[1m\33[34m", "\33[1m\33[31m", "\33[1m\33[32m",
                                                                    "\33[1m",        "\33[1m\33[35m", "\33[1m\33[36m"};
inline constexpr std::string_view candump_colour_off = "\33[0m";

} // namespace fernlicht
