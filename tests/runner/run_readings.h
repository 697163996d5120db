// What a run's folder says in CSV, as tests ask for it.
#pragma once

#include "runner/files/csv_file.h"

#include <optional>
#include <stdexcept>

namespace fernlicht::tests {

/// A field of the row of this name, of the whole drive where there is one; of one lamp set where it is named.
inline std::string field_of(const std::filesystem::path& run, const std::string& name, const char* column,
                            const std::string& lamp_set = {}) {
    const CsvFile csv = read_csv(run / "readings.csv");
    std::optional<std::string> found;
    for (const std::vector<std::string>& row : csv.rows)
        if (row[csv.column("name")] == name && (lamp_set.empty() || row[csv.column("lamp_set")] == lamp_set)) {
            if (row[csv.column("frame")].empty())
                return row[csv.column(column)];
            found = found.value_or(row[csv.column(column)]);
        }
    if (!found)
        throw std::runtime_error("no reading " + name);
    return *found;
}

inline double reading_of(const std::filesystem::path& run, const std::string& name, const std::string& lamp_set = {}) {
    return std::stod(field_of(run, name, "value", lamp_set));
}

/// The cells of one figure over the moments.
inline std::vector<std::string> moments_of(const std::filesystem::path& csv_file, const std::string& column) {
    const CsvFile csv = read_csv(csv_file);
    std::vector<std::string> cells;
    for (const std::vector<std::string>& row : csv.rows)
        cells.push_back(row[csv.column(column)]);
    return cells;
}

} // namespace fernlicht::tests
