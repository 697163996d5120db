#include "scenarios/can/bus_units.h"

#include <array>
#include <fmt/format.h>
#include <string>

namespace fernlicht {
namespace {

constexpr double rad_per_deg = 0.017453292519943295;

struct KnownUnit {
    std::string_view table, text; ///< as it is after `plain_unit`
    UnitConversion conversion;
};

// Miles are those of 1609.344 m, g is 9.80665 m/s2.
constexpr std::array known{
    KnownUnit{"s", "s", {}},
    KnownUnit{"s", "sec", {}},
    KnownUnit{"s", "ms", {1.0, 0.0, 1000.0}},
    KnownUnit{"s", "us", {1.0, 0.0, 1.0e6}},
    KnownUnit{"s", "min", {60.0}},
    KnownUnit{"m", "m", {}},
    KnownUnit{"m", "km", {1000.0}},
    KnownUnit{"m", "cm", {1.0, 0.0, 100.0}},
    KnownUnit{"m", "mm", {1.0, 0.0, 1000.0}},
    KnownUnit{"m/s", "m/s", {}},
    KnownUnit{"m/s", "mps", {}},
    KnownUnit{"m/s", "km/h", {1.0, 0.0, 3.6}},
    KnownUnit{"m/s", "kmh", {1.0, 0.0, 3.6}},
    KnownUnit{"m/s", "kph", {1.0, 0.0, 3.6}},
    KnownUnit{"m/s", "mph", {0.44704}},
    KnownUnit{"m/s2", "m/s2", {}},
    KnownUnit{"m/s2", "m/s/s", {}},
    KnownUnit{"m/s2", "g", {9.80665}},
    KnownUnit{"rad/s", "rad/s", {}},
    KnownUnit{"rad/s", "deg/s", {rad_per_deg}},
    KnownUnit{"rad", "rad", {}},
    KnownUnit{"rad", "mrad", {1.0, 0.0, 1000.0}},
    KnownUnit{"rad", "deg", {rad_per_deg}},
    KnownUnit{"1/m", "1/m", {}},
    KnownUnit{"1/m", "m-1", {}},
    KnownUnit{"1/m", "1/km", {1.0, 0.0, 1000.0}},
    KnownUnit{"lx", "lx", {}},
    KnownUnit{"lx", "lux", {}},
    KnownUnit{"lx", "klx", {1000.0}},
    KnownUnit{"1", "", {}},
    KnownUnit{"1", "1", {}},
    KnownUnit{"1", "-", {}},
    KnownUnit{"1", "%", {1.0, 0.0, 100.0}},
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Lower case, without blanks and "^"; degrees as "deg", squares as "2", seconds below a stroke as "s".
std::string plain_unit(std::string_view written) {
    std::string text;
    for (const char c : written)
        if (c != ' ' && c != '^' && c != '\t')
            text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    replace_all(text, "\xc2\xb0", "deg");
    replace_all(text, "\xc2\xb2", "2");
    replace_all(text, "degrees", "deg");
    replace_all(text, "degree", "deg");
    replace_all(text, "/sec", "/s");
    replace_all(text, "km/hr", "km/h");
    return text;
}

} // namespace

std::optional<UnitConversion> conversion_between(std::string_view written, std::string_view table_unit) {
    const std::string text = plain_unit(written);
    for (const KnownUnit& unit : known)
        if (unit.table == table_unit && unit.text == text)
            return unit.conversion;
    return std::nullopt;
}

std::string known_units(std::string_view table_unit) {
    std::string names;
    for (const KnownUnit& unit : known)
        if (unit.table == table_unit)
            names += fmt::format("{}{}", names.empty() ? "" : ", ", unit.text.empty() ? "none" : unit.text);
    return names;
}

} // namespace fernlicht
