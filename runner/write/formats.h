// The table of all forms in which documents are written. Flags, their help and their refusals list what stands in it.
#pragma once

#include "runner/findings/document.h"

#include <span>

namespace fernlicht {

struct OutputFormat {
    const char *name, *extension;                ///< as typed in flags; with its point
    const char* meaning;                         ///< for people who choose
    std::string (*of_table)(const Table&);       ///< nullptr: it has no tables that stand alone
    std::string (*of_document)(const Document&); ///< nullptr: it has tables alone
    bool for_papers = false;                     ///< a study leaves its paper in it
};

std::span<const OutputFormat> output_formats();

} // namespace fernlicht
