// What a change of a beam is made of: tents over knots a few tenths of a degree apart, each a certain share of the light that is there.
// A change that is relative keeps the beam's fine structure, its cut-off first of all; a floor lets light come to where there is little.
#pragma once

#include "metrics/beam/received_beam.h"
#include "metrics/improve/quadratic_programme.h"
#include "scenarios/lamps/candela_table.h"

namespace fernlicht {

/// Directions within which a beam changes.
struct BeamBox {
    double left_deg = 0.0, right_deg = 0.0, bottom_deg = 0.0, top_deg = 0.0;
    void add(double h_deg, double v_deg);
};

/// The change of a sample of I cd is (I + floor) times a surface over H and V that is bilinear between knots: x at those within the box, 0
/// on its border and beyond. A change of size x is thus one of 100 x per cent where there is much light.
class BeamBasis {
  public:
    /// Knots are samples of the table, at least `h_step_deg` and `v_step_deg` apart where it has them so fine. The box is widened to
    /// samples of the table. floor_cd > 0. The table must outlive it.
    BeamBasis(const CandelaTable& table, const BeamBox& box, double h_step_deg, double v_step_deg, double floor_cd);

    std::size_t size() const { return columns() * rows(); }
    Direction knot(std::size_t variable) const;
    /// Whether what is received over so much about a direction may change.
    bool reaches(Direction place, double over_deg) const {
        return place.h_deg + over_deg > h_.knots_deg.front() && place.h_deg - over_deg < h_.knots_deg.back() &&
               place.v_deg + over_deg > v_.knots_deg.front() && place.v_deg - over_deg < v_.knots_deg.back();
    }
    /// (I + floor) of a sample.
    double weight_cd(std::size_t sample) const { return table_.cd[sample] + floor_cd_; }
    /// The surface at a sample of the table; empty where the change is 0.
    LinearForm at_sample(std::size_t sample) const;
    /// Of a figure whose derivative by each sample is this.
    LinearForm form(const std::vector<double>& per_cd) const;
    LinearForm form(const std::vector<SampleWeight>& per_cd) const;
    CandelaTable changed(const std::vector<double>& x) const; ///< no sample below 0
    /// Size and bends of a change: the integral of x^2 + (length_h^2 d2x/dH2)^2 + (length_v^2 d2x/dV2)^2 over square degrees, as the sum
    /// over knots. Twice it is x H x.
    std::vector<QuadraticProgramme::Term> size_and_bends(double length_h_deg, double length_v_deg) const;
    const CandelaTable& table() const { return table_; }

  private:
    /// Between which knots a sample lies; `share` of the way to the next.
    struct Between {
        std::size_t knot = 0;
        double share = 0.0;
        bool inside = false;
    };
    struct Axis {
        std::vector<double> knots_deg; ///< with both ends, which do not change
        std::vector<Between> samples;
    };
    static Axis axis_of(const std::vector<double>& samples_deg, double from_deg, double to_deg, double step_deg);
    std::size_t columns() const { return h_.knots_deg.size() - 2; }
    std::size_t rows() const { return v_.knots_deg.size() - 2; }

    const CandelaTable& table_;
    Axis h_, v_;
    double floor_cd_;
};

/// What of a dense sum is not 0.
LinearForm sparse(const std::vector<double>& sums);
double value_of(const LinearForm& form, const std::vector<double>& x);

} // namespace fernlicht
