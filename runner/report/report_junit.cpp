#include "runner/report/clean_text.h"
#include "runner/report/extent_summary.h"
#include "runner/report/report_writers.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

struct Counts {
    std::size_t tests = 0, failures = 0, errors = 0;
};

Counts count(const std::vector<Verdict>& verdicts) {
    const auto of = [&](VerdictKind kind) {
        return static_cast<std::size_t>(
            std::count_if(verdicts.begin(), verdicts.end(), [&](const Verdict& verdict) { return verdict.kind == kind; }));
    };
    return {verdicts.size(), of(VerdictKind::fail), of(VerdictKind::not_measured)};
}

std::string open_suite(const std::string& name, const Counts& counts) {
    return fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\">\n", xml_text(name), counts.tests,
                       counts.failures, counts.errors);
}

/// What was asked for and could not be measured is an error, not skipped: a build that reads this file must not stay green on it.
std::string test_case(const std::string& suite, const Verdict& verdict) {
    const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_text(suite), xml_text(verdict.name));
    if (verdict.kind == VerdictKind::pass)
        return head + fmt::format(">\n      <system-out>{}</system-out>\n    </testcase>\n", xml_text(verdict.text));
    const char* const element = verdict.kind == VerdictKind::fail ? "failure" : "error";
    const char* const type = verdict.kind == VerdictKind::fail ? "limit exceeded" : "not measured";
    std::string detail = xml_text(verdict.text);
    if (!verdict.rerun.empty())
        detail += "\nrepeat with: " + xml_text(verdict.rerun);
    return head + fmt::format(">\n      <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n    </testcase>\n", element, xml_text(verdict.text),
                              type, detail);
}

} // namespace

std::string report_junit(const Report& report) {
    Counts all;
    std::string suites;
    const auto add = [&](const std::string& name, const std::vector<Verdict>& verdicts) {
        const Counts counts = count(verdicts);
        all = {all.tests + counts.tests, all.failures + counts.failures, all.errors + counts.errors};
        suites += open_suite(name, counts);
        for (const Verdict& verdict : verdicts)
            suites += test_case(name, verdict);
        suites += "  </testsuite>\n";
    };
    for (const PlayedVariant& played : report.played)
        add(played.drive + ", " + played.variant + (played.technique == "photometric" ? "" : ", technique " + played.technique),
            played.verdicts);
    if (!report.complete)
        add("run", {{VerdictKind::not_measured, "complete", "interrupted: " + report.interrupted, report.context.command}});
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
           fmt::format("<testsuites name=\"fernlicht\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n", all.tests, all.failures,
                       all.errors) +
           suites + "</testsuites>\n";
}

} // namespace fernlicht
