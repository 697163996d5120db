// Values in JSON: a number, {"at_least": 200}, {"at_most": 10}, or null.
#pragma once

#include "metrics/readings/value.h"
#include "runner/files/checked_json.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

inline nlohmann::ordered_json value_json(const Value& value) {
    if (value.censored())
        return {{bound_name(value), *value.figure()}};
    return value.measured() ? nlohmann::ordered_json(*value.figure()) : nlohmann::ordered_json(nullptr);
}

/// null: not measured, for `reason`. Refuses all else.
inline Value value_in(const CheckedJson& json, const std::string& reason = {}) {
    if (json.has("at_least"))
        return Value::at_least(json.at("at_least").number());
    if (json.has("at_most"))
        return Value::at_most(json.at("at_most").number());
    return Value::of(json.number_or_null(), reason);
}

} // namespace fernlicht
