#include "runner/experiments/study/study_document.h"

#include "runner/findings/run_context.h"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <system_error>

namespace fernlicht {

Report as_report(const StudyResult& result) {
    Report report;
    report.context = result.context;
    report.complete = result.complete();
    for (const CellResult& cell : result.cells) {
        PlayedCell played;
        played.drive = cell.drive;
        played.lamp_set = cell.lamp_set;
        played.technique = result.study.techniques[cell.cell.technique];
        played.verdicts = cell.verdicts;
        report.played.push_back(std::move(played));
    }
    PlayedCell own;
    own.drive = result.study.name;
    own.verdicts = result.verdicts;
    report.played.push_back(std::move(own));
    return report;
}

VerdictKind overall(const StudyResult& result) { return overall(as_report(result)); }

bool met_full_disk(const StudyResult& result) {
    const std::string full = std::generic_category().message(ENOSPC);
    return std::ranges::any_of(result.cells, [&](const CellResult& cell) { return cell.failed.find(full) != std::string::npos; });
}

void apply_known_failures(StudyResult& result, const KnownFailures& known, const std::string& today) {
    Report report = as_report(result);
    apply_known_failures(report, known, today);
    for (std::size_t i = 0; i < result.cells.size(); ++i)
        result.cells[i].verdicts = std::move(report.played[i].verdicts);
    result.verdicts = std::move(report.played.back().verdicts);
    for (Verdict& listed : report.listed) {
        listed.name = "known failure " + listed.name;
        listed.rerun = repeat_command(result.call);
        result.verdicts.push_back(std::move(listed));
    }
    result.warnings = std::move(report.warnings);
}

Report suites_of(const StudyResult& result) {
    Report report = as_report(result);
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        const CellResult& cell = result.cells[i];
        const std::string moments = cell.moments < cell.moments_of_drive
                                        ? fmt::format("{} of {} moments (--frames {})", cell.moments, cell.moments_of_drive, result.frames)
                                        : "all moments";
        PlayedCell& suite = report.played[i];
        suite.drive = cell.cell.name;
        suite.lamp_set = cell.cell.condition;
        suite.verdicts.insert(suite.verdicts.begin(), cell.failed.empty()
                                                          ? Verdict{VerdictKind::pass, "played", moments, cell.command}
                                                          : Verdict{VerdictKind::not_measured, "played", cell.failed, cell.command});
    }
    if (std::vector<Verdict>& own = report.played.back().verdicts; !result.played_in_part.empty())
        own.insert(own.begin(), {VerdictKind::pass, "played in part", result.played_in_part, repeat_command(result.call)});
    report.played.back().lamp_set = "limits of the study";
    report.played.back().technique = "photometric";
    report.complete = result.interrupted.empty();
    report.interrupted = result.interrupted;
    return report;
}

} // namespace fernlicht
