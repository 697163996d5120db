#include "runner/experiments/study/study_document.h"

#include <algorithm>

namespace fernlicht {

void add_lamp_files(const StudyResult& result, Document& document) {
    if (result.lamp_files.empty())
        return;
    Section section{"Lamp files", {}};
    const std::vector<std::string> warnings = lamp_warnings(result.lamp_files);
    if (!warnings.empty())
        section.blocks.emplace_back(Listing(warnings));
    Table table = lamp_files_table(result.lamp_files);
    table.caption = "What the check found";
    section.blocks.emplace_back(std::move(table));
    const auto place = warnings.empty() ? document.sections.end() - (document.sections.size() > 1 ? 1 : 0) : document.sections.begin();
    document.sections.insert(place, std::move(section));
}

} // namespace fernlicht
