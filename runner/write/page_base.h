// What every page has: figures for people, colours, and what its results were made with.
#pragma once

#include "runner/findings/report.h"

#include <kainjow/mustache.hpp>

namespace fernlicht {

/// Colours of the variants in every table and plot (after Okabe and Ito: told apart by colour-blind readers too); starts again after six.
const char* variant_colour(std::size_t index);

/// Numbers for people: fixed decimals with U+2212 as minus sign; a difference always carries its sign.
std::string figure(double value, int decimals);
std::string signed_figure(double value, int decimals);

/// Commands, versions, machine, input files.
kainjow::mustache::data context_part(const RunContext& context);

} // namespace fernlicht
