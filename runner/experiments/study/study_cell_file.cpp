#include "runner/experiments/study/study_result.h"
#include "runner/files/checked_json.h"

namespace fernlicht {

void read_cell_report(const std::filesystem::path& study_folder, CellResult& cell) {
    const std::string folder = "cells/" + cell.cell.name;
    const CheckedJson report = CheckedJson::read(study_folder / folder / "report.json");
    report.expect_schema("fernlicht report", 1);
    if (const CheckedJson complete = report.at("complete"); !complete.truth())
        complete.refuse("a complete run");
    const std::vector<CheckedJson> drives = report.at("drives").items();
    if (drives.size() != 1)
        report.at("drives").refuse("one drive with one lamp set");
    PlayedResult played = read_played(report, drives.front(), folder);
    static_cast<Steps&>(played) = cell; // the drive's, not the report's
    static_cast<PlayedResult&>(cell) = std::move(played);
}

} // namespace fernlicht
