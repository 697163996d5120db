// Values in JSON: a number, {"at_least": 200}, {"at_most": 10}, or null; and names of readings.
#pragma once

#include "metrics/readings/readings.h"
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

/// Refuses what is no reading's name.
inline ReadingKey key_in(const CheckedJson& name) {
    const auto key = key_of(name.text());
    if (!key)
        name.refuse("the name of a reading");
    return *key;
}

/// Of an object with a reading's name and unit.
inline ReadingKey key_with_unit(const CheckedJson& row) {
    ReadingKey key = key_in(row.at("name"));
    if (const CheckedJson unit = row.at("unit"); unit.text() != unit_of(key))
        unit.refuse(std::string("the unit ") + unit_of(key));
    return key;
}

} // namespace fernlicht
