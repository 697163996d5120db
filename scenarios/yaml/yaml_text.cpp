#include "scenarios/yaml/yaml_text.h"

#include "scenarios/values/pose.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            out += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
        else
            out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    return out + '"';
}

std::string angle_entry(std::string_view key, double angle_rad) {
    const double middle = degrees(angle_rad);
    for (const double candidate : {middle, std::nextafter(middle, -HUGE_VAL), std::nextafter(middle, HUGE_VAL)})
        if (radians(candidate) == angle_rad)
            return fmt::format("{}_deg: {}", key, candidate);
    return fmt::format("{}_rad: {}", key, angle_rad);
}

} // namespace fernlicht
