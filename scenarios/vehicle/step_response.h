// The closed form that solvers of second-order systems are held against.
#pragma once

namespace fernlicht {

/// x(t) of x'' = w^2 (1 - x) - 2 z w x' from rest at 0, w in rad/s, z >= 0; 0 before t = 0. From the roots of s^2 + 2 z w s + w^2, in any
/// textbook of control; to some roundings of 1 except within 1e-4 of z = 1, where the roots cancel (z = 1 itself has its own form).
double step_response(double w, double z, double t_s);

} // namespace fernlicht
