#include "runner/experiments/run/run_document.h"

namespace fernlicht {

void add_aims(const ComparedDrive& drive, Sections& sections) {
    Table table{drive.name + "-aim", "", aim_columns("lamp set<"), {}};
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i)
        add_aim_rows(table, {lamp_cell(drive, i)}, drive.lamp_sets[i]->aims);
    if (!table.rows.empty())
        sections.push_back({"Aim of the lamps", {aim_legend(), std::move(table)}, 3});
}

} // namespace fernlicht
