// What a regulation check and the measurement of a cut-off found, and how it is reported.
#pragma once

#include "metrics/beam/cut_off.h"
#include "metrics/beam/cut_off_elbow.h"
#include "metrics/regulation/regulation_check.h"
#include "runner/findings/document.h"
#include "scenarios/lamps/lamp_file.h"

namespace fernlicht {

/// A lamp, or those of both sides, held against a table.
struct RegulationFound {
    Regulation regulation;
    std::vector<std::string> lamps; ///< names of the files
    RegulationCheck check;
};

/// A lamp's cut-off. Under left-hand traffic it is that of the mirrored table, and is mirrored back in what is told.
struct CutOffFound {
    LampFile lamp;
    CutOffOptions options;
    bool left_hand_traffic = false;
    CutOffFigures cut_off;
    CutOffElbow elbow;
};

Document document(const RegulationFound& found);
Document document(const CutOffFound& found);
/// What the list has: all tables, and fmvss108-adb without its rows.
std::vector<Regulation> listed_regulations();
/// All ids with edition, source and what is in them.
Document regulation_list();
/// The same, shorter: docs/reference/regulations.md.
Document regulation_reference();

std::string regulation_json(const RegulationFound& found);
std::string cut_off_json(const CutOffFound& found);
std::string regulation_list_json();

/// The scans, what they found, and the elbow's fit over the isocandela diagram.
plots::Figure cut_off_figure(const CutOffFound& found);

const char* name_of(RowVerdict verdict);     ///< "pass", "fail", "not_measured"
const char* name_of(AimRule rule);           ///< "auto", "cut-off-line"
std::string limits_of(const RowResult& row); ///< ">= 850", "0.13 to 0.4"
/// The regulation's notes. That on its aim says so where the lamp was aimed in another way.
std::vector<std::string> notes_of(const RegulationFound& found);
/// At most `count` of the rows that were measured, the smallest margin first.
std::vector<const RowResult*> narrowest(const RegulationCheck& check, std::size_t count);

} // namespace fernlicht
