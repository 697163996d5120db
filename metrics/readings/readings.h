// What a measurement says: rows that reports write and limits judge.
#pragma once

#include "metrics/readings/reading_key.h"
#include "metrics/readings/sensitivity.h"
#include "metrics/readings/value.h"

namespace fernlicht {

struct Reading {
    ReadingKey key;
    Value value;
    std::string where = {}; ///< "own lane, centre" - free text for people
    int tick = -1;          ///< -1: of the whole drive
    Sensitivity sensitivity = {};
    /// Of extremes and percentiles of eyes and mirrors: what lies between the moments may move it so far, in its unit; nullopt of all else.
    std::optional<double> between_moments = {};

    std::string name() const { return name_of(key); }
    const char* unit() const { return unit_of(key); }
};
using Readings = std::vector<Reading>;

} // namespace fernlicht
