#include "metrics/readings/reading_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <regex>
#include <utility>

namespace fernlicht {
namespace {

std::string extent_in_words(const std::string& name) {
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

/// What is read in an eye, after the eye's name.
std::string of_eye(const std::string& quantity) {
    static const std::pair<std::regex, const char*> forms[] = {
        {std::regex("facing_max_lx"), "largest illuminance"},
        {std::regex("eye_max_lx"), "largest illuminance across the line of sight"},
        {std::regex("veiling_max_cdm2"), "largest veiling luminance"},
        {std::regex("threshold_increment_max_percent"), "largest threshold increment"},
        {std::regex("de_boer_min"), "smallest de Boer rating"},
        {std::regex("at_([0-9.]+)m_lx"), "illuminance $1 m before it"},
        {std::regex("time_above_([0-9.]+)lx_s"), "time above $1 lx"},
        {std::regex("length_above_([0-9.]+)lx_m"), "metres above $1 lx"},
        {std::regex("time_above_([0-9.]+)percent_s"), "time above $1 % of threshold increment"},
        {std::regex("length_above_([0-9.]+)percent_m"), "metres above $1 % of threshold increment"},
        {std::regex("time_below_([0-9.]+)_de_boer_s"), "time below de Boer's $1"},
        {std::regex("length_below_([0-9.]+)_de_boer_m"), "metres below de Boer's $1"}};
    for (const auto& [form, words] : forms)
        if (std::regex_match(quantity, form))
            return std::regex_replace(quantity, form, words);
    return {};
}

/// "pedestrian-dark, right edge of the lanes, least" of "pedestrian-dark_right_min".
std::string target_in_words(const std::string& name) {
    static const std::regex form("(.+)_(own|oncoming|right|left)(_min|_p05)?");
    std::smatch parts;
    if (!std::regex_match(name, parts, form))
        return name;
    const std::string place = parts[2], which = parts[3];
    return parts[1].str() +
           (place == "own"        ? ", own lane"
            : place == "oncoming" ? ", oncoming lane"
                                  : ", " + place + " edge of the lanes") +
           (which == "_min"   ? ", least"
            : which == "_p05" ? ", 5th percentile"
                              : "");
}

std::string seeing_in_words(const std::string& name) {
    static const std::regex detection("detection_(.+)_m"), level("visibility_level_(.+)_at_([0-9.]+)m");
    if (std::smatch parts; std::regex_match(name, parts, detection))
        return "detection distance of " + target_in_words(parts[1]);
    else if (std::regex_match(name, parts, level))
        return "visibility level of " + target_in_words(parts[1]) + ", " + parts[2].str() + " m ahead";
    if (name.starts_with("glare_"))
        for (std::size_t at = name.find('_', 7); at != std::string::npos; at = name.find('_', at + 1))
            if (const std::string quantity = of_eye(name.substr(at + 1)); !quantity.empty())
                return quantity + ", " + eyes_in_words(name.substr(0, at));
    static const std::pair<std::regex, const char*> forms[] = {
        {std::regex("foreground_ratio_own"), "light from 5 to 15 m over light from 40 to 60 m, own lane"},
        {std::regex("kerb_at_([0-9.]+)m_lx"), "illuminance at the right edge of the lanes, $1 m ahead"},
        {std::regex("board_(left|right|overhead)_at_([0-9.]+)m_lx"), "illuminance on a board, $1, $2 m ahead"},
        {std::regex("board_(left|right|overhead)_at_([0-9.]+)m_cdm2"), "luminance of a board, $1, $2 m ahead"},
        {std::regex("marking_(left|right)_at_([0-9.]+)m_cdm2"), "luminance of the $1 marking, $2 m ahead"}};
    for (const auto& [form, words] : forms)
        if (std::regex_match(name, form))
            return std::regex_replace(name, form, words);
    return name;
}

} // namespace

std::string eyes_in_words(const std::string& subject) {
    static const std::regex mirrors("glare_mirrors_at_([0-9.]+)m"), oncoming("glare_(.+)");
    if (std::regex_match(subject, mirrors))
        return std::regex_replace(subject, mirrors, "mirrors of a car $1 m ahead");
    if (subject == "glare_oncoming")
        return "eyes of an oncoming driver";
    return std::regex_replace(subject, oncoming, "eyes of oncoming driver $1");
}

std::string reading_in_words(const std::string& name) {
    const std::string words = extent_in_words(name);
    return words == name ? seeing_in_words(name) : words;
}

std::string with_bound(const Value& value, const std::string& figure) {
    return value.censored() ? fmt::format("{} {}", bound_sign(value), figure) : figure;
}

} // namespace fernlicht
