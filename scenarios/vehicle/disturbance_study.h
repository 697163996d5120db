// Stiff and extreme cars, roads and loads: how far the usual solver ends up from a reference. Takes seconds in all.
#pragma once

#include "scenarios/vehicle/solver_study.h"

namespace fernlicht {

/// Each: automatic choice at the default tolerance of 1e-6 against Rosenbrock at 1e-10, and that against Dormand-Prince at 1e-10, two
/// methods that share nothing but the equations. Error: of pitch or roll, the larger, at 997 moments, rad.
///
/// A slalom at 20 m/s: bars of 1e8 Nm/rad on tyres of 1e9 N/m; a body that its weight all but tips over.
std::vector<ExtremeTrial> roll_of_extreme_cars();
/// Class B with dampers of 1e6 Ns/m at 30 m/s: 1e4/s against waves of 85 Hz; class H at 60 m/s, where wheels fly more than they roll.
/// Stiffer tyres make a car that bounces undamped, whose landings no two methods find alike.
std::vector<ExtremeTrial> extreme_rough_roads();
/// 2 t over the rear axle at once, on springs of 1e8 N/m with dampers of 1e6 Ns/m; 100 loads of 500 kg that come and go every 5 ms.
std::vector<ExtremeTrial> extreme_loads();

} // namespace fernlicht
