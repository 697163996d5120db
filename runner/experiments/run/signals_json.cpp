#include "runner/experiments/run/run_json.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* state_names[] = {"fresh", "stale", "missing", "out_of_range", "contradictory"};

/// Seven digits, as other columns have; times six places, as candump has.
Json shortened(const std::optional<double>& value) { return value ? Json(seven_digits(*value)) : Json(nullptr); }
Json microseconds(const std::optional<double>& value) { return value ? Json(std::stod(fmt::format("{:.6f}", *value))) : Json(nullptr); }

Json counts_by_state(const std::array<std::uint64_t, 5>& counts) {
    Json json;
    for (std::size_t state = 0; state < counts.size(); ++state)
        json[state_names[state]] = counts[state];
    return json;
}

Json input_json(const BusSignalReport& signal) {
    Json policies = Json::object(), states = Json::array(), value = Json::array(), received = Json::array();
    for (std::size_t state = 0; state < signal.policies.size(); ++state)
        if (!signal.policies[state].empty())
            policies[state_names[state]] = signal.policies[state];
    for (const auto& [from_s, state] : signal.states)
        states.push_back({{"from_s", microseconds(from_s)}, {"state", state_names[state]}});
    for (const std::optional<double>& one : signal.value)
        value.push_back(shortened(one));
    for (const std::optional<double>& one : signal.received)
        received.push_back(shortened(one));
    return {{"name", signal.name},
            {"source", signal.source},
            {"also", signal.also.empty() ? Json(nullptr) : Json(signal.also)},
            {"tolerance", shortened(signal.tolerance)},
            {"unit", signal.unit},
            {"frames", signal.frames},
            {"changes", signal.changes},
            {"age_max_s", microseconds(signal.frames > 0 ? std::optional(signal.oldest_s) : std::nullopt)},
            {"stale_after_s", microseconds(signal.stale_after_s)},
            {"last_change_s", microseconds(signal.changed_s)},
            {"ticks", counts_by_state(signal.ticks)},
            {"policy_acted", counts_by_state(signal.acted)},
            {"unchecked", signal.unchecked},
            {"policies", std::move(policies)},
            {"states", std::move(states)},
            {"value", std::move(value)},
            {"received", std::move(received)}};
}

} // namespace

nlohmann::ordered_json signals_json(const BusReport& bus) {
    Json inputs = Json::array(), all = Json::array();
    for (const BusSignalReport& signal : bus.signals)
        inputs.push_back(input_json(signal));
    for (const SignalStamp& signal : bus.all)
        all.push_back({{"name", signal.name},
                       {"unit", signal.unit},
                       {"last_change_s", microseconds(signal.changed_s)},
                       {"age_s", microseconds(signal.age_s)}});
    return {{"log", bus.log.empty() ? Json(nullptr) : Json(bus.log)},
            {"start_s", microseconds(bus.start_s)},
            {"frames", bus.frames},
            {"frames_read", bus.read},
            {"frames_sent", bus.sent},
            {"frame", bus.frame},
            {"inputs", std::move(inputs)},
            {"all", std::move(all)}};
}

} // namespace fernlicht
