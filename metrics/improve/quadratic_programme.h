// A quadratic programme as plain values, and what solves one. The solver is a library that only few starts need (runner/modules).
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A sum over variables, each of them once: which, and times what.
using LinearForm = std::vector<std::pair<std::size_t, double>>;

struct LinearRow {
    LinearForm form;
    double low = -unbounded, high = unbounded;
};

/// Minimise x H x / 2 + linear x, where every variable and every row keeps between its bounds. H is positive semidefinite.
struct QuadraticProgramme {
    struct Term {
        std::size_t row = 0, column = 0; ///< row >= column: the other half is the same
        double value = 0.0;
    };
    std::vector<Term> hessian; ///< each place once
    std::vector<double> linear, low, high;
    std::vector<LinearRow> rows;
};

struct QuadraticSolution {
    bool solved = false;
    std::string by; ///< the solver, with its version
    std::vector<double> x;
    std::vector<double> prices; ///< by row, >= 0: how much the minimum falls for each unit by which the bound that holds it is loosened
};

using SolveQuadratic = std::function<QuadraticSolution(const QuadraticProgramme&)>;

} // namespace fernlicht
