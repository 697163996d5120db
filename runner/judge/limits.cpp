#include "runner/judge/limits.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// How far a value surely lies beyond a limit; 0 or less: within.
double excess(const Limit& limit, const Value& value) {
    return std::max(limit.at_least ? *limit.at_least - value.high() : -HUGE_VAL, limit.at_most ? value.low() - *limit.at_most : -HUGE_VAL);
}

std::string limit_text(const Limit& limit, const std::string& unit) {
    std::string text = "limit";
    if (limit.at_least)
        text += fmt::format(" at least {} {}", *limit.at_least, unit);
    if (limit.at_most)
        text += fmt::format("{} at most {} {}", limit.at_least ? " and" : "", *limit.at_most, unit);
    return text;
}

/// Four digits; all of them where four would show the value on the wrong side of its limit.
std::string deciding_digits(const Limit& limit, double value) {
    const std::string text = fmt::format("{:.4g}", value);
    double shown = value;
    std::from_chars(text.data(), text.data() + text.size(), shown);
    const bool honest = (excess(limit, shown) > 0.0) == (excess(limit, value) > 0.0);
    return honest ? text : fmt::format("{}", value);
}

/// The readings that a limit means: the whole drive's, else those of moments.
std::vector<const Reading*> meant(const Limit& limit, const Readings& readings) {
    const auto key = key_of(limit.reading);
    std::vector<const Reading*> named;
    for (const Reading& reading : readings)
        if (reading.key == key)
            named.push_back(&reading);
    if (std::ranges::any_of(named, [](const Reading* reading) { return reading->tick < 0; }))
        std::erase_if(named, [](const Reading* reading) { return reading->tick >= 0; });
    return named;
}

Verdict unknown(const Limit& limit, const Readings& readings) {
    std::vector<std::string> names;
    for (const Reading& reading : readings)
        names.push_back(reading.name());
    const std::string nearest = nearest_name(limit.reading, names);
    const std::string hint = nearest.empty() ? "" : fmt::format("; the nearest name is {}", nearest);
    return {VerdictKind::not_measured, limit.reading, fmt::format("there is no reading of this name{}", hint), ""};
}

std::string moment_text(const Reading& reading) { return reading.tick < 0 ? "" : fmt::format(" at frame {}", reading.tick); }

Verdict judge(const Limit& limit, const Readings& readings) {
    if (!limit.at_least && !limit.at_most)
        return {VerdictKind::not_measured, limit.reading, "the limit names neither a least nor a greatest value", ""};
    const std::vector<const Reading*> named = meant(limit, readings);
    if (named.empty())
        return unknown(limit, readings);
    const Reading *missing = nullptr, *worst = nullptr; // what leaves the limit open, and what is farthest beyond or nearest to it
    for (const Reading* reading : named) {
        if (!holds(reading->value, limit.at_least, limit.at_most) && !missing)
            missing = reading;
        if (reading->value.measured() && (!worst || excess(limit, reading->value) > excess(limit, worst->value)))
            worst = reading;
    }
    const bool fails = worst && holds(worst->value, limit.at_least, limit.at_most) == false;
    const Reading& told = missing && !fails ? *missing : *worst;
    const std::string found = told.value.measured()
                                  ? with_bound(told.value, deciding_digits(limit, *told.value.figure())) + " " + told.unit()
                                  : "not measured: " + told.value.reason();
    return {fails     ? VerdictKind::fail
            : missing ? VerdictKind::not_measured
                      : VerdictKind::pass,
            limit.reading, fmt::format("{}{}, {}", found, moment_text(told), limit_text(limit, told.unit())), ""};
}

} // namespace

std::vector<Verdict> judge_limits(const Drive& drive, const Readings& readings) {
    std::vector<Verdict> verdicts;
    for (const Limit& limit : drive.limits) {
        verdicts.push_back(judge(limit, readings));
        verdicts.back().line = limit.line;
    }
    return verdicts;
}

} // namespace fernlicht
