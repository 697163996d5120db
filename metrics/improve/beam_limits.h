// What a changed beam must keep to beside readings, as rows of a quadratic programme: its table's own limits, and the rows of a regulation.
#pragma once

#include "metrics/improve/beam_basis.h"
#include "metrics/regulation/regulation_check.h"

#include <optional>
#include <string>

namespace fernlicht {

/// Of the candela table, each as far as it is asked for. Intensity stays at least 0 in any case.
struct TableLimits {
    std::optional<double> change_share; ///< of a sample's intensity, up or down
    std::optional<double> change_cd;    ///< of a sample, up or down
    std::optional<double> flux_share;   ///< of all the beam's flux more, at most; may be below 0
    std::optional<double> steepness;    ///< the steepest place, cd/deg along H or V between samples, at most so many times as steep
};

/// A row, and what it is of.
struct LimitRow {
    std::string of;
    LinearRow row;
    double hundredth = 1.0;     ///< of the limit, in the row's unit
    bool may_be_missed = false; ///< where it must, and by as little as can be; it has one bound, and a hundredth of 1
};

/// Where a change stands from which a step is taken: x, and each variable at most `step` from it.
struct StepFrom {
    const std::vector<double>& x;
    double step = 0.0;
    /// Whether a form may leave these bounds in that step.
    bool may_leave(const LinearForm& form, double low, double high) const;
};

/// What of the limits a step could break, by x as the whole change.
std::vector<LimitRow> table_rows(const BeamBasis& basis, const TableLimits& limits, const StepFrom& from);

/// A regulation's rows by the places where they are held: points and sums where they are, zones and segments on a lattice and wherever a
/// check found them worst, minima of a zone's brightest place where that is. Limits that the beam broke from the first it may not break
/// more. Aim, and limits that are another row's share, are as the last check found them.
class RegulationRows {
  public:
    /// `kept`: rows by their ids that may get no worse, but for half a per cent of the limit. Throws std::invalid_argument for one that the
    /// check of this lamp does not have.
    RegulationRows(const Regulation& regulation, bool left_hand_traffic, const CandelaTable& first, std::vector<std::string> kept = {});
    /// Keeps in mind where the check found rows worst. A lamp that was not re-aimed at first is not re-aimed.
    RegulationCheck check(const CandelaTable& table);
    /// What a step from here, checked just before, could break.
    std::vector<LimitRow> rows(const BeamBasis& basis, const CandelaTable& table, const RegulationCheck& check, const StepFrom& from) const;
    struct Missed {
        double by = 0.0; ///< as a share of the limit
        std::string row = {};
    };
    /// The row that is most worse than it may be; `by` 0 where none is.
    Missed missed_by(const RegulationCheck& check) const;
    const RegulationCheck& before() const { return before_; }
    const Regulation& regulation() const { return regulation_; }

  private:
    bool is_kept(const std::string& id) const;
    const RowResult& result_of(const RegulationCheck& check, std::size_t row) const;

    const Regulation& regulation_;
    bool left_hand_traffic_;
    std::vector<const RegulationRow*> asked_;    ///< of one lamp
    std::vector<std::vector<Direction>> places_; ///< of asked_, for right-hand traffic, aimed
    std::vector<std::string> kept_;
    RegulationCheck before_;
};

} // namespace fernlicht
