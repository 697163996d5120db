// The smallest change of a lamp's candela table that improves readings as far as asked and keeps what must be kept.
//
// Readings are linear in small changes of the table alone, so this goes in steps (Fletcher's S l1 QP: R. Fletcher, Practical Methods of
// Optimization, 2nd ed. 1987, 14.4): linearise where the beam stands, solve a quadratic programme for the whole change with each
// variable at most so far from where it stands, read the drives again, and take the step where that is better: by the size of the change
// and what is missed of readings and regulation. Else the next step is half as long.
#pragma once

#include "metrics/importance/reading_of_light.h"
#include "metrics/improve/beam_limits.h"

#include <memory>
#include <string>
#include <vector>

namespace fernlicht {

/// One that must be at least, or at most, a bound.
struct SoughtReading {
    std::string name; ///< in what binds
    const ReadingOfLight* reading = nullptr;
    std::size_t drive = 0; ///< into ImproveProblem::drives
    bool at_least = true;
    double bound = 0.0;
    double scale = 1.0; ///< of what it misses, > 0: of a gain the gain; of what is kept a hundredth of it
    bool is_gain = false;
};

struct ImproveProblem {
    CandelaTable table;
    std::vector<std::vector<Moment>> drives; ///< moments; lamps with exactly this table are those that change
    std::vector<SoughtReading> readings;
    TableLimits limits;
    RegulationRows* regulation = nullptr; ///< nullptr: none
    double floor_cd = 100.0;
    double narrowest_deg = 1.0; ///< bends of the change over less than this in H, and half of it in V, count as its size does
    int max_steps = 60;
};

struct ImproveStep {
    double longest = 0.0;               ///< any variable may change so much in it
    std::vector<Value> foretold, found; ///< by reading
    std::string regulation_row;         ///< the one that is most worse than it may be; "" for none
    double size = 0.0;                  ///< of the whole change, root of the integral of x^2 and its bends over square degrees, degrees
    bool taken = false;
};

/// What holds the change where it is.
struct BindingLimit {
    std::string of;
    /// What 1 % less of it is worth: of the size of the change, as a share of its square; where a gain is missed, of that gain.
    double worth = 0.0;
};

struct ImprovedBeam {
    std::vector<Value> before, foretold, found; ///< by reading; foretold by the last step taken
    std::vector<bool> met;
    bool regulation_met = true; ///< no row of it is worse than it may be
    CandelaTable table;
    std::vector<ImproveStep> steps;
    std::vector<BindingLimit> binding; ///< the one worth most first
    bool gain_missed = false;
    bool settled = false; ///< no step would do better; else they became too short or too many
    std::size_t variables = 0;
};

/// Throws InputError for readings that no light decides.
ImprovedBeam improve_beam(const ImproveProblem& problem, const SolveQuadratic& solve);

} // namespace fernlicht
