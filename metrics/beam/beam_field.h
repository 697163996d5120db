// A lamp's table as a field of log intensity that can be looked up between its samples, with the error of doing so.
// Where a low beam ends upwards: the steepest fall of each column of its table.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <optional>

namespace fernlicht {

/// Natural logarithm of the intensity at a direction, of floor_cd where there is less.
struct FieldValue {
    double log_cd = 0.0;      ///< cubic through four samples a side
    double uncertainty = 0.0; ///< how far linear in log cd and linear in cd lie from that: what interpolation leaves open; 0 on the samples
};

/// How a whole beam was turned: as its table's angles shift, or as a lamp turns on its mount. They differ far from the axis alone.
enum class BeamTurn { angles_shifted, lamp_rotated };

struct BeamShift {
    double right_deg = 0.0, up_deg = 0.0;
    BeamTurn turn = BeamTurn::angles_shifted;
};

class BeamField {
  public:
    /// `floor_cd` above 0 keeps the logarithm finite where there is no light. The table must hold its invariants. With `system` its axes
    /// are that system's angles, and directions are brought onto them. Both must outlive this.
    BeamField(const CandelaTable& table, double floor_cd, const AngleSystem* system = nullptr);

    const CandelaTable& table() const { return *table_; }
    /// At the samples exactly what the table has. Directions outside the axes take the edge's value: ask `has` first.
    FieldValue at(double h_deg, double v_deg) const;
    /// By the table's own rule between its samples.
    double cd(double h_deg, double v_deg) const;
    bool has(double h_deg, double v_deg) const;
    std::size_t nearest(double h_deg, double v_deg) const; ///< sample, on either axis
    /// By how much each sample of the table counts in `at`; those without weight are left out.
    std::vector<std::pair<std::size_t, double>> weights(double h_deg, double v_deg) const;
    double node(std::size_t v, std::size_t h) const { return log_cd_[v * table_->h_deg.size() + h]; }
    /// d log / d h and d log / d v at a sample, by central differences between its neighbours.
    std::pair<double, double> gradient(std::size_t v, std::size_t h) const;

  private:
    TwoAngles on_axes(double h_deg, double v_deg) const;
    const CandelaTable* table_;
    const AngleSystem* system_;
    double floor_cd_;
    std::vector<double> log_cd_;
};

/// Where the light that a shifted beam sends to (h, v) lies in the beam as it was.
std::pair<double, double> before_shift(double h_deg, double v_deg, const BeamShift& shift);

/// The step to which the table's intensities are rounded, a power of ten in cd; 0 when they are not.
double rounding_of(const CandelaTable& table);

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
