// Figures and tables for papers.
#pragma once

#include "runner/findings/paper_figure.h"

#include <filesystem>

namespace fernlicht {

/// Of each figure NAME.svg and NAME.pdf at its width, letters embedded, and NAME.csv with its data; figures.tex with all captions;
/// tables.tex with the tables, for booktabs. `folder` is made.
void write_paper(const std::vector<PaperFigure>& figures, const Document& tables, const std::filesystem::path& folder);

} // namespace fernlicht
