// Lamps made from formulae.
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <memory>
#include <utility>
#include <vector>

namespace fernlicht::tests {

/// from, from + by, ... to.
inline std::vector<double> steps(double from, double to, double by) {
    std::vector<double> all;
    for (int i = 0; from + i * by <= to + 1e-9; ++i)
        all.push_back(from + i * by);
    return all;
}

/// cd(h, v) over these angles.
template <class Intensity>
CandelaTable table_of(std::vector<double> h_deg, std::vector<double> v_deg, Intensity cd, BetweenSamples rule = BetweenSamples::linear_cd) {
    CandelaTable table{std::move(h_deg), std::move(v_deg), {}, {}, rule};
    for (const double v : table.v_deg)
        for (const double h : table.h_deg)
            table.cd.push_back(cd(h, v));
    check_invariants(table);
    return table;
}

/// The same in every direction within these angles.
inline CandelaTable even_table(double cd, double h_deg = 180.0, double v_deg = 90.0) {
    return {{-h_deg, h_deg}, {-v_deg, v_deg}, {cd, cd, cd, cd}, {}, BetweenSamples::linear_cd};
}

inline std::shared_ptr<const LampFile> file_of(CandelaTable table) {
    auto file = std::make_shared<LampFile>();
    file->table = std::move(table);
    return file;
}

} // namespace fernlicht::tests
