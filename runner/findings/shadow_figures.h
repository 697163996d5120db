// Figures of shadows as people read them: two significant digits, never an exponent, and 0 for what is below what can be measured. JSON
// and CSV have them in full.
#pragma once

#include <string>

namespace fernlicht {

/// Below these a figure is rounding: of single-precision light (%), of a pixel of the ground (0.02 m2), and a hundredth of the pixels in
/// which edges are measured (edge_pixel_m).
inline constexpr double min_shadow_percent = 1e-4, min_shadow_m2 = 5e-4, min_shadow_cm = 0.01;

/// "0.053", "12", "260", without the unit; "0" below `least`, which is 1e-4 or more.
std::string shadow_figure(double value, double least);
/// Of a share, in percent.
std::string shadow_percent(double share);
std::string shadow_m2(double m2);
std::string shadow_cm(double cm);

} // namespace fernlicht
