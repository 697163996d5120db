#include "runner/flight/lamp_names.h"

#include <cctype>
#include <tuple>
#include <utility>

namespace fernlicht {
namespace {

std::string lower(std::string text) {
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Whether the word stands in the text with no letters beside it.
bool has_word(const std::string& text, const std::string& word) {
    const auto letter = [&](std::size_t at) { return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0; };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if ((at == 0 || !letter(at - 1)) && !letter(at + word.size()))
            return true;
    return false;
}

} // namespace

std::optional<NamedLamp> lamp_named(const std::string& given) {
    const std::string name = lower(given);
    const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
    NamedLamp lamp;
    const bool front = has("front") || has_word(name, "f"), light = has("lamp") || has("light") || has("lite");
    if (has("high") && (has("beam") || light))
        lamp.function = "high";
    else if (has("headl") || has("head_l") || has("low_beam") || has("lowbeam") || (has("low") && light))
        lamp.function = "low";
    else if (has("fog") && light)
        std::tie(lamp.function, lamp.rear) = std::pair("fog", has("rear"));
    else if (has("brake") || (has("stop") && light))
        std::tie(lamp.function, lamp.rear) = std::pair("brake", true);
    else if (has("taill") || has("tail_l") || (has("rear") && light))
        std::tie(lamp.function, lamp.rear) = std::pair("tail", true);
    else if (has("indicator") || has("blinker") || (has("turn") && (light || has("sig"))))
        std::tie(lamp.function, lamp.rear) = front ? std::pair("indicator-front", false) : std::pair("indicator-rear", true);
    else if (has("reverse") && light)
        std::tie(lamp.function, lamp.rear) = std::pair("reverse", true);
    else if ((has("parking") || has("position")) && light)
        lamp.function = "position";
    else
        return std::nullopt;
    for (const char* word : {"l", "lh", "lt"})
        if (has("left") || has_word(name, word))
            lamp.left = true;
    for (const char* word : {"r", "rh", "rt"})
        if (has("right") || has_word(name, word))
            lamp.left = false;
    return lamp;
}

} // namespace fernlicht
