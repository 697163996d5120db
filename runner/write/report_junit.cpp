#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/write/report_texts.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

struct Counts {
    std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
};

/// What was asked for and could not be measured is an error, not skipped: a build that reads this file must not stay green on it.
/// Skipped are known failures alone.
const char* element_of(const Verdict& verdict) {
    if (!is_red(verdict))
        return verdict.kind == VerdictKind::pass ? "" : "skipped";
    return verdict.kind == VerdictKind::not_measured ? "error" : "failure";
}

const char* type_of(const Verdict& verdict) {
    switch (verdict.kind) {
    case VerdictKind::pass:
        return "unexpected pass";
    case VerdictKind::flaky:
        return "flaky";
    case VerdictKind::fail:
        return "limit exceeded";
    case VerdictKind::not_measured:
        break;
    }
    return "not measured";
}

Counts count(const std::vector<Verdict>& verdicts) {
    const auto of = [&](std::string_view element) {
        return static_cast<std::size_t>(
            std::ranges::count_if(verdicts, [&](const Verdict& verdict) { return element_of(verdict) == element; }));
    };
    return {verdicts.size(), of("failure"), of("error"), of("skipped")};
}

std::string open_suite(const std::string& name, const Counts& counts) {
    return fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n", xml_text(name),
                       counts.tests, counts.failures, counts.errors, counts.skipped);
}

std::string test_case(const std::string& suite, const Verdict& verdict) {
    const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_text(suite), xml_text(verdict.name));
    const std::string text = xml_text(verdict.known.empty() ? verdict.text : verdict.text + "; " + verdict.known);
    const std::string_view element = element_of(verdict);
    if (element.empty())
        return head + fmt::format(">\n      <system-out>{}</system-out>\n    </testcase>\n", text);
    if (element == "skipped")
        return head + fmt::format(">\n      <skipped message=\"{}\"/>\n    </testcase>\n", text);
    std::string detail = text;
    if (!verdict.rerun.empty())
        detail += "\nrepeat with: " + xml_text(verdict.rerun);
    return head +
           fmt::format(">\n      <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n    </testcase>\n", element, text, type_of(verdict), detail);
}

} // namespace

std::string report_junit(const Report& report) {
    Counts all;
    std::string suites;
    const auto add = [&](const std::string& name, const std::vector<Verdict>& verdicts) {
        const Counts counts = count(verdicts);
        all = {all.tests + counts.tests, all.failures + counts.failures, all.errors + counts.errors, 0};
        suites += open_suite(name, counts);
        for (const Verdict& verdict : verdicts)
            suites += test_case(name, verdict);
        suites += "  </testsuite>\n";
    };
    for (const PlayedVariant& played : report.played)
        add(played.drive + ", " + played.variant + (played.technique == "photometric" ? "" : ", technique " + played.technique),
            played.verdicts);
    if (!report.listed.empty())
        add("known failures", report.listed);
    if (!report.complete)
        add("run", {{VerdictKind::not_measured, "complete", "interrupted: " + report.interrupted, report.context.command}});
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
           fmt::format("<testsuites name=\"fernlicht\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n", all.tests, all.failures,
                       all.errors) +
           suites + "</testsuites>\n";
}

} // namespace fernlicht
