#include "runner/reading_words.h"

#include <algorithm>
#include <utility>

namespace fernlicht {

std::string reading_in_words(const std::string& name) {
    std::string words = name;
    for (const auto& [from, to] : {std::pair("reach_", "reach at "), std::pair("width_", "width at "), std::pair("area_", "area at "),
                                   std::pair("unlit_before_reach_", "unlit before reach at ")})
        if (words.starts_with(from)) {
            words = to + words.substr(std::string(from).size());
            break;
        }
    if (words == name)
        return name;
    for (const auto& [from, to] :
         {std::pair("lx_road_", " lx on the road, "), std::pair("lx_target_", " lx on a target, "), std::pair("own", "own lane"),
          std::pair("all", "whole width"), std::pair("_at_", ", "), std::pair("_p05", ", 5th percentile"), std::pair("_min", ", least"),
          std::pair("_left_edge", ", left edge"), std::pair("_right_edge", ", right edge")})
        if (const std::size_t at = words.find(from); at != std::string::npos)
            words.replace(at, std::string(from).size(), to);
    for (const char* unit : {"m_m", "_m2", "_m"}) // "20m_m" is at 20 m, in metres
        if (words.ends_with(unit)) {
            words.resize(words.size() - std::string(unit).size());
            words += unit == std::string("m_m") ? " m ahead" : "";
            break;
        }
    std::ranges::replace(words, '_', ' ');
    return words;
}

} // namespace fernlicht
