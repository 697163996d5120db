// Rows of regulation tables that our own lamps are held to, right-hand traffic, candela. H right positive, V up positive, degrees.
// UN R112 class B and UN R98 (R149 00 series, class D) as collected from published transcriptions; not the primary text.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht::regulation {

/// A point (from == to), a segment or a rectangular zone; every direction in it keeps to the limits.
struct Row {
    std::string name;
    double h_from, h_to, v_from, v_to;
    double min_cd = 0.0, max_cd = std::numeric_limits<double>::infinity();
};

inline constexpr double none = std::numeric_limits<double>::infinity();

inline Row point(std::string name, double h, double v, double min_cd, double max_cd = none) {
    return {std::move(name), h, h, v, v, min_cd, max_cd};
}

/// Zone III, both regulations: at most 625 cd inside.
inline const std::vector<std::pair<double, double>> zone_3{{-8, 1}, {-8, 4}, {8, 4}, {8, 2}, {6, 1.5}, {1.5, 1.5}, {0, 0}, {-4, 0}};
inline constexpr double zone_3_max_cd = 625.0;

/// Light for overhead signs: sums over three points, and two points of their own (both regulations).
struct Sum {
    std::string name;
    std::vector<std::pair<double, double>> points;
    double min_cd;
};
inline const std::vector<Sum> overhead{
    {"S50", {{-8, 4}, {0, 4}, {8, 4}}, 190}, {"S100", {{-4, 2}, {0, 2}, {4, 2}}, 375}, {"B7", {{-8, 0}}, 65}, {"B8", {{-4, 0}}, 125}};

/// R112 class B, passing. Zone I is at most twice the intensity at 50R and is checked apart.
inline const std::vector<Row> r112_b{
    point("B50L", -3.43, 0.57, 0, 350),   point("BR", 2.5, 1.0, 0, 1750),
    point("75R", 1.15, -0.57, 10100),     point("75L", -3.43, -0.57, 0, 10600),
    point("50L", -3.43, -0.86, 0, 13200), point("50R", 1.72, -0.86, 10100),
    point("50V", 0, -0.86, 5100),         point("25L", -9, -1.72, 1700),
    point("25R", 9, -1.72, 1700),         {"zone IV", -5.15, 5.15, -1.72, -0.86, 2500},
};

/// R98 class D, passing. Imax right and left of V-V: above 1.72 D.
inline const std::vector<Row> r98_d{
    point("B50L", -3.43, 0.57, 0, 350),
    point("BR", 2.5, 1.0, 0, 1750),
    point("75R", 1.15, -0.57, 12500),
    point("50L", -3.43, -0.86, 0, 18480),
    point("50R", 1.72, -0.86, 12500),
    point("50V", 0, -0.86, 7500),
    point("25L1", -3.43, -1.72, 0, 18800),
    point("25L2", -9, -1.72, 2500),
    point("25R1", 9, -1.72, 2500),
    point("25L3", -15, -1.72, 1250),
    point("25R2", 15, -1.72, 1250),
    point("15L", -20, -2.86, 625),
    point("15R", 20, -2.86, 625),
    {"segment I A-B", -5.15, 5.15, -0.86, -0.86, 3750},
    {"segment III and under", -9.37, 8.5, -21, -4.29, 0, 12500},
    {"Imax right", 0, 52, -1.72, 16, 0, 43800},
    {"Imax left", -52, 0, -1.72, 16, 0, 31300},
};

/// Driving beams, both sides. HV is at least 0.8 of Imax and Imax at most 215 000, checked apart.
struct Driving {
    double imax_min, at_5, at_2_5;
};
inline constexpr Driving driving_b{40500, 5100, 20300}, driving_d{43800, 6250, 25000};
inline constexpr double driving_imax_max = 215000;

} // namespace fernlicht::regulation
