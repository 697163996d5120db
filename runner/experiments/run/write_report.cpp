#include "runner/experiments/run/report_writers.h"
#include "runner/findings/report.h"

namespace fernlicht {

namespace {

template <class Take> void each_verdict(const Report& report, const Take& take) {
    for (const PlayedVariant& played : report.played)
        for (const Verdict& verdict : played.verdicts)
            take(verdict);
    for (const Verdict& verdict : report.listed)
        take(verdict);
}

} // namespace

VerdictCounts count_verdicts(const Report& report) {
    VerdictCounts counts;
    each_verdict(report, [&](const Verdict& verdict) {
        if (verdict.expectation == Expectation::unexpected_pass)
            ++counts.unexpected_pass;
        else if (verdict.expectation == Expectation::known)
            ++counts.known;
        else
            ++(verdict.kind == VerdictKind::pass    ? counts.pass
               : verdict.kind == VerdictKind::fail  ? counts.fail
               : verdict.kind == VerdictKind::flaky ? counts.flaky
                                                    : counts.not_measured);
    });
    return counts;
}

VerdictKind overall(const Report& report) {
    const VerdictCounts counts = count_verdicts(report);
    if (counts.fail > 0 || counts.unexpected_pass > 0)
        return VerdictKind::fail;
    if (counts.flaky > 0)
        return VerdictKind::flaky;
    return counts.not_measured > 0 || !report.complete ? VerdictKind::not_measured : VerdictKind::pass;
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
