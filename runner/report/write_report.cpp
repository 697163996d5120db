#include "runner/report/report.h"
#include "runner/report/report_writers.h"

#include <algorithm>

namespace fernlicht {

VerdictKind overall(const Report& report) {
    const auto any = [&](VerdictKind kind) {
        return std::any_of(report.played.begin(), report.played.end(), [&](const PlayedVariant& played) {
            return std::any_of(played.verdicts.begin(), played.verdicts.end(),
                               [&](const Verdict& verdict) { return verdict.kind == kind; });
        });
    };
    if (any(VerdictKind::fail))
        return VerdictKind::fail;
    return any(VerdictKind::not_measured) || !report.complete ? VerdictKind::not_measured : VerdictKind::pass;
}

void write_report(const Report& report, const std::filesystem::path& folder) {
    // The figures first, the large page last: a disk that fills up takes the page before it takes the numbers.
    write_file(folder / "readings.csv", report_csv(report));
    write_file(folder / "times.csv", times_csv(report));
    write_file(folder / "junit.xml", report_junit(report));
    write_file(folder / "report.json", report_json(report));
    write_file(folder / "report.html", report_html(report, folder));
}

} // namespace fernlicht
