#include "runner/experiments/run/signals_json.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr const char* state_names[] = {"fresh", "stale", "missing", "out_of_range", "contradictory"};

/// Seven digits, as other columns have; times six places, as candump has.
nlohmann::ordered_json shortened(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(std::stod(fmt::format("{:.7g}", *value))) : nlohmann::ordered_json(nullptr);
}
nlohmann::ordered_json microseconds(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(std::stod(fmt::format("{:.6f}", *value))) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json counts_by_state(const std::array<std::uint64_t, 5>& counts) {
    nlohmann::ordered_json json;
    for (std::size_t state = 0; state < counts.size(); ++state)
        json[state_names[state]] = counts[state];
    return json;
}

nlohmann::ordered_json input_json(const BusSignalReport& signal) {
    nlohmann::ordered_json policies = nlohmann::ordered_json::object(), states = nlohmann::ordered_json::array(),
                           value = nlohmann::ordered_json::array(), received = nlohmann::ordered_json::array();
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
            {"also", signal.also.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(signal.also)},
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
    nlohmann::ordered_json inputs = nlohmann::ordered_json::array(), all = nlohmann::ordered_json::array();
    for (const BusSignalReport& signal : bus.signals)
        inputs.push_back(input_json(signal));
    for (const SignalStamp& signal : bus.all)
        all.push_back({{"name", signal.name},
                       {"unit", signal.unit},
                       {"last_change_s", microseconds(signal.changed_s)},
                       {"age_s", microseconds(signal.age_s)}});
    return {{"log", bus.log.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(bus.log)},
            {"start_s", microseconds(bus.start_s)},
            {"frames", bus.frames},
            {"frames_read", bus.read},
            {"frames_sent", bus.sent},
            {"frame", bus.frame},
            {"inputs", std::move(inputs)},
            {"all", std::move(all)}};
}

} // namespace fernlicht
