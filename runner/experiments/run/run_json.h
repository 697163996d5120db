// Parts of report.json.
#pragma once

#include "runner/findings/report.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

/// What `of` makes of each.
template <class Range, class Of> nlohmann::ordered_json list_of(const Range& range, const Of& of) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const auto& one : range)
        out.push_back(of(one));
    return out;
}

/// Far below what any of the lamp tables knows.
double seven_digits(double value);

/// Extents of all moments together, then moment by moment: columns with one entry per moment.
nlohmann::ordered_json summary_json(const PlayedVariant& played);
nlohmann::ordered_json extents_json(const PlayedVariant& played);
/// Columns with one entry per moment; null where it was not measured, with the reasons that there are.
nlohmann::ordered_json seeing_json(const std::vector<SeeingSeries>& all);
/// What a bus said and what became of it.
nlohmann::ordered_json signals_json(const BusReport& bus);

} // namespace fernlicht
