// Figures of seeing and glare over the moments of a drive, as moments-*.csv stores and the page draws them.
#pragma once

#include "metrics/readings/value.h"

#include <string>
#include <vector>

namespace fernlicht {

struct SeeingSeries {
    std::string subject; ///< "glare_oncoming": the stem of its readings
    std::string title;   ///< "Oncoming driver \"opposite\""
    std::string over;    ///< what `at_m` is: "distance to the observer"
    std::vector<int> ticks = {};
    std::vector<double> at_m = {};
    struct Column {
        std::string name;  ///< with its unit at the end, as of readings: "facing_lx"
        std::string label; ///< for people: "facing illuminance"
        std::string unit;
        bool logarithmic = false; ///< as drawn
        bool drawn = true;
        std::vector<Value> values = {}; ///< one per tick
    };
    std::vector<Column> columns = {};

    /// A column with `of(row)` for each row.
    void add(Column column, const auto& rows, const auto& of) {
        for (const auto& row : rows)
            column.values.push_back(of(row));
        columns.push_back(std::move(column));
    }
};

} // namespace fernlicht
