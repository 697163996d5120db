// Low beams whose cut-off is known: level, a straight rise, a level shoulder; noise and steps as files have them.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace fernlicht::planted {

struct CutOff {
    double elbow_h_deg = 0.0, level_v_deg = -0.57, angle_deg = 15.0;
    double rise_deg = 3.0;     ///< along the edge
    double softness_deg = 0.1; ///< of the logistic in which log I falls by two decades: G = 2 tanh(0.1 / (4 s))
    double noise = 0.0;
    double step_deg = 0.1;
    unsigned seed = 1;

    double slope() const { return std::tan(angle_deg * 3.14159265358979 / 180.0); }
    double rise_h_deg() const { return rise_deg * std::cos(angle_deg * 3.14159265358979 / 180.0); }
    double edge(double h_deg) const { return level_v_deg + slope() * std::clamp(h_deg - elbow_h_deg, 0.0, rise_h_deg()); }
};

/// 40 000 cd below the edge, less towards the sides and downwards; right-hand traffic.
inline CandelaTable beam(const CutOff& c) {
    CandelaTable t;
    const auto axis = [&](double to) {
        std::vector<double> a;
        const auto n = static_cast<int>(std::lround(to / c.step_deg));
        for (int i = -n; i <= n; ++i)
            a.push_back(i * c.step_deg);
        return a;
    };
    t.h_deg = axis(9.0);
    t.v_deg = axis(6.0);
    std::mt19937 random(c.seed);
    std::normal_distribution<double> normal;
    for (const double v : t.v_deg)
        for (const double h : t.h_deg) {
            const double above = v - c.edge(h);
            const double log10 = 2.6 + 2.0 / (1.0 + std::exp(above / c.softness_deg)) - h * h / 200.0 - 0.03 * std::abs(v + 1.0);
            t.cd.push_back(std::pow(10.0, log10) * std::max(0.0, 1.0 + c.noise * normal(random)));
        }
    return t;
}

} // namespace fernlicht::planted
