// A plot's SVG. No scripts, no outside resources, all text escaped; the same figure gives the same bytes. Several may be put into one HTML
// page: there are no ids to clash.
#pragma once

#include "runner/findings/plots/figure.h"

namespace fernlicht::plots {

/// The figure as a complete SVG document of its size. Throws std::invalid_argument when an axis is empty (from == to, not finite,
/// or not above 0 on a logarithmic scale).
std::string svg_of(const Figure& figure);

} // namespace fernlicht::plots
