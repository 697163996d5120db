#include "scenarios/can/bus_sources.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>

namespace fernlicht {
namespace {

template <class Items> std::string nearest_text(const std::string& wanted, const Items& items) {
    std::vector<std::string> names;
    for (const auto& item : items)
        names.push_back(item.name);
    const std::string near = nearest_name(wanted, names);
    return near.empty() ? "" : fmt::format(" (nearest: '{}')", printable(near));
}

std::string database_names(const std::vector<CanDatabase>& databases) {
    std::string names;
    for (const CanDatabase& database : databases)
        names += (names.empty() ? "" : ", ") + database.file.filename().string();
    return names;
}

} // namespace

FoundSource find_source(const std::vector<CanDatabase>& databases, const BusSource& source, const InputError::Where& where) {
    const CanMessage* found = nullptr;
    std::vector<CanMessage> all;
    for (const CanDatabase& database : databases)
        if (const CanMessage* const message = database.message(source.message)) {
            if (found)
                throw InputError(where, fmt::format("message '{}' in more than one database", printable(source.message)),
                                 "a name that one of them has");
            found = message;
        }
    if (!found) {
        for (const CanDatabase& database : databases)
            all.insert(all.end(), database.messages.begin(), database.messages.end());
        throw InputError(where, fmt::format("no message '{}' in {}", printable(source.message), database_names(databases)),
                         fmt::format("one of its {} messages{}", all.size(), nearest_text(source.message, all)));
    }
    const CanSignal* const signal = found->signal(source.signal);
    if (!signal)
        throw InputError(where, fmt::format("no signal '{}' in message '{}'", printable(source.signal), printable(source.message)),
                         fmt::format("one of its {} signals{}", found->signals.size(), nearest_text(source.signal, found->signals)));
    return {found, signal};
}

std::vector<std::pair<double, double>> resolve_values(const std::vector<std::pair<std::string, double>>& values, const CanSignal& signal,
                                                      const InputError::Where& where) {
    std::vector<std::pair<double, double>> resolved;
    for (const auto& [text, value] : values) {
        const auto label = std::ranges::find_if(signal.labels, [&, &wanted = text](const auto& known) { return known.second == wanted; });
        double physical = 0.0;
        if (label != signal.labels.end()) {
            physical = static_cast<double>(label->first) * signal.factor + signal.offset;
        } else {
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), physical);
            if (error != std::errc() || end != text.data() + text.size())
                throw InputError(where, fmt::format("'{}', which signal '{}' has no label for", printable(text), printable(signal.name)),
                                 "a label of its value table, or a number");
        }
        resolved.emplace_back(physical, value);
    }
    return resolved;
}

UnitConversion resolve_units(const std::optional<double>& factor, const std::optional<double>& offset, const CanSignal& signal,
                             std::string_view table_unit, const InputError::Where& where) {
    if (factor || offset)
        return {factor.value_or(1.0), offset.value_or(0.0), 1.0};
    if (const auto known = conversion_between(signal.unit, table_unit))
        return *known;
    throw InputError(where, fmt::format("unit '{}' of signal '{}'", printable(signal.unit), printable(signal.name)),
                     fmt::format("one that fits '{}' ({}), or factor, offset or values", table_unit, known_units(table_unit)));
}

std::pair<double, double> physical_range(const CanSignal& signal) {
    double least = -std::numeric_limits<double>::max(), greatest = std::numeric_limits<double>::max();
    if (signal.kind == CanValueKind::float32) {
        least = -double{std::numeric_limits<float>::max()};
        greatest = -least;
    } else if (signal.kind == CanValueKind::whole) {
        const double below = std::ldexp(1.0, signal.is_signed ? signal.length - 1 : signal.length);
        greatest = signal.length > 53 ? std::nextafter(below, 0.0) : below - 1.0;
        least = signal.is_signed ? -below : 0.0;
    }
    least = least * signal.factor + signal.offset;
    greatest = greatest * signal.factor + signal.offset;
    if (least > greatest)
        std::swap(least, greatest);
    if (signal.has_limits() && signal.minimum <= signal.maximum) {
        least = std::max(least, signal.minimum);
        greatest = std::min(greatest, signal.maximum);
    }
    return {least, greatest};
}

namespace {

constexpr double rad_per_deg = 0.017453292519943295;

struct KnownUnit {
    std::string_view table, text; ///< as it is after `plain_unit`
    UnitConversion conversion;
};

// Miles are those of 1609.344 m, g is 9.80665 m/s2.
constexpr KnownUnit known[] = {{"s", "s", {}},
                               {"s", "sec", {}},
                               {"s", "ms", {1.0, 0.0, 1000.0}},
                               {"s", "us", {1.0, 0.0, 1.0e6}},
                               {"s", "min", {60.0}},
                               {"m", "m", {}},
                               {"m", "km", {1000.0}},
                               {"m", "cm", {1.0, 0.0, 100.0}},
                               {"m", "mm", {1.0, 0.0, 1000.0}},
                               {"m/s", "m/s", {}},
                               {"m/s", "mps", {}},
                               {"m/s", "km/h", {1.0, 0.0, 3.6}},
                               {"m/s", "kmh", {1.0, 0.0, 3.6}},
                               {"m/s", "kph", {1.0, 0.0, 3.6}},
                               {"m/s", "mph", {0.44704}},
                               {"m/s2", "m/s2", {}},
                               {"m/s2", "m/s/s", {}},
                               {"m/s2", "g", {9.80665}},
                               {"rad/s", "rad/s", {}},
                               {"rad/s", "deg/s", {rad_per_deg}},
                               {"rad", "rad", {}},
                               {"rad", "mrad", {1.0, 0.0, 1000.0}},
                               {"rad", "deg", {rad_per_deg}},
                               {"1/m", "1/m", {}},
                               {"1/m", "m-1", {}},
                               {"1/m", "1/km", {1.0, 0.0, 1000.0}},
                               {"lx", "lx", {}},
                               {"lx", "lux", {}},
                               {"lx", "klx", {1000.0}},
                               {"1", "", {}},
                               {"1", "1", {}},
                               {"1", "-", {}},
                               {"1", "%", {1.0, 0.0, 100.0}}};

/// Lower case, without blanks and "^"; degrees as "deg", squares as "2", seconds below a stroke as "s".
std::string plain_unit(std::string_view written) {
    std::string text;
    for (const char c : written)
        if (c != ' ' && c != '^' && c != '\t')
            text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    static constexpr std::pair<std::string_view, std::string_view> spellings[] = {
        {"\xc2\xb0", "deg"}, {"\xc2\xb2", "2"}, {"degrees", "deg"}, {"degree", "deg"}, {"/sec", "/s"}, {"km/hr", "km/h"}};
    for (const auto& [from, to] : spellings)
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
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
