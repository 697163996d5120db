// A figure as a paper prints it: at column width, its caption with what each number comes from, its data beside it.
#pragma once

#include "runner/findings/document.h"

namespace fernlicht {

inline constexpr double one_column_mm = 84.0, two_columns_mm = 174.0;

struct PaperFigure {
    std::string name; ///< of its files, without extension
    std::variant<plots::Figure, plots::Drawing> figure;
    std::string caption; ///< sentences
    double width_mm = one_column_mm;
    Table data;
};

} // namespace fernlicht
