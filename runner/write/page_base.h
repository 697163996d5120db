// What every page has: colours, and what its results were made with.
#pragma once

#include "runner/findings/figures.h"
#include "runner/findings/report.h"

#include <kainjow/mustache.hpp>

namespace fernlicht {

/// Colours of the variants in every table and plot (after Okabe and Ito: told apart by colour-blind readers too); starts again after six.
const char* variant_colour(std::size_t index);

/// Commands, versions, machine, input files.
kainjow::mustache::data context_part(const RunContext& context);

} // namespace fernlicht
