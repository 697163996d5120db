// Systems of angles other than the UN goniometer's, and a table as its file lists it.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <functional>
#include <string>

namespace fernlicht {

struct TwoAngles {
    double h_deg = 0.0, v_deg = 0.0;
};

/// Another system's two angles, its polar axis elsewhere. Each function is the inverse of the other where both are defined.
struct AngleSystem {
    std::string name;                                   ///< for notes: "type B"
    std::function<TwoAngles(double, double)> to_native; ///< from UN H, V to the system's own two angles
    std::function<TwoAngles(double, double)> to_un;
    bool turns_about_beam = false; ///< the first angle does: its steps say nothing of how far directions lie apart
};

/// What was measured, before it was brought onto H and V.
struct MeasuredTable {
    CandelaTable table; ///< over the system's two angles
    AngleSystem system;
};

MeasuredTable scaled(MeasuredTable measured, double factor); ///< factor >= 0
MeasuredTable mirrored(MeasuredTable measured);              ///< H and -H exchanged

} // namespace fernlicht
