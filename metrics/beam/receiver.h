// What a photometer on a goniometer looks at: a direction, and the opening that it averages over.
#pragma once

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

} // namespace fernlicht
