// A lamp as a photometer on a goniometer sees it: aimed, averaged over the receiver's opening, one lamp or half the sum of two.
// What a photometer on a goniometer looks at: a direction, and the opening that it averages over.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <optional>
#include <vector>

namespace fernlicht {

/// Of the goniometer: H right positive, V up positive.
struct Direction {
    double h_deg = 0.0, v_deg = 0.0;
    bool operator==(const Direction&) const = default;
};

/// What a photometer averages over. Its size is an angle: 65 mm at 25 m are 0.149 degrees.
struct Receiver {
    enum class Shape { square, disc } shape = Shape::square;
    double size_deg = 0.0; ///< side or diameter; 0: a point
};

/// Mean intensity in cd over the receiver turned to a direction; nullopt where the table has no data there. Parts of the opening without
/// data are left out of the mean. The square stands level, the size is an angle seen from the lamp: in H it grows by 1 / cos V (at most
/// tenfold, towards the poles).
/// Exact but for rounding for linear_cd and a square: over a piece of one cell the mean of a bilinear function is its value in the middle.
/// Under a disc the pieces of each chord are exact, and chords are summed by 8-point Gauss-Legendre between the table's rows (relative
/// error below 1e-6). log_cd takes 2 x 2 Gauss points a piece: relative error (change of ln I over the piece)^4 / 4320.
std::optional<double> received_cd(const CandelaTable& table, const Receiver& receiver, Direction to);

/// How received_cd() answers to the samples of the table: some may come more than once. Empty where the table has no data.
std::vector<SampleWeight> received_weights(const CandelaTable& table, const Receiver& receiver, Direction to);

/// `turned` is how far the aim turned the beam to the right and up, as offsets of the goniometer's two angles.
struct AimedLamp {
    const CandelaTable* table = nullptr;
    Direction turned;
};

/// The lamps under test. Directions are those of the goniometer after aiming; the tables stay as they are.
class ReceivedBeam {
  public:
    /// One or two lamps; with two, `at` is half their sum. The tables must outlive this.
    ReceivedBeam(std::vector<AimedLamp> lamps, Receiver receiver);

    /// nullopt unless each lamp has data there.
    std::optional<double> at(Direction to) const;
    /// At least and at most what `at` gives for directions in a rectangle (of any order of corners), by the samples around it.
    struct Bounds {
        double low_cd = 0.0, high_cd = 0.0;
    };
    Bounds bounds(Direction from, Direction to) const;
    /// The rectangle of directions outside which no lamp has data.
    struct Window {
        double left_deg = 0.0, right_deg = 0.0, bottom_deg = 0.0, top_deg = 0.0;
    };
    Window window() const;
    /// How close samples of this beam may stand, degrees: a third of the receiver, or half the finest step of a table for a point.
    double step_deg() const { return step_deg_; }

  private:
    std::vector<AimedLamp> lamps_;
    Receiver receiver_;
    double step_deg_;
};

} // namespace fernlicht
