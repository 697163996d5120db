// Where a low beam ends upwards: the steepest fall of each column of its table.
#pragma once

#include "metrics/beam/beam_field.h"

#include <optional>

namespace fernlicht {

/// V of the cut-off by column of a table's H axis; nullopt where a column has none: outside |H| <= 20 degrees, or where within |V| <= 4
/// degrees no fall is as steep as 1.5 natural logs a degree with at least 2 % of the peak below it.
class CutOffLine {
  public:
    CutOffLine(const BeamField& beam, double peak_cd);

    bool exists() const { return columns_ >= 10; }
    /// At the nearest column.
    std::optional<double> at(double h_deg) const;
    /// V below which a tenth of the columns have their cut-off: its level part, whatever single columns do. NaN when none has one.
    double lowest_deg() const;

  private:
    std::vector<double> h_deg_;
    std::vector<std::optional<double>> v_deg_;
    std::size_t columns_ = 0;
};

} // namespace fernlicht
