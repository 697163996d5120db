#include "runner/judge/verdict_line.h"

#include "runner/files/log.h"
#include "runner/judge/baselines.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

const char* word_for(const Verdict& verdict) {
    if (verdict.expectation == Expectation::unexpected_pass)
        return "UNEXPECTED PASS";
    if (verdict.expectation == Expectation::known)
        return "known";
    switch (verdict.kind) {
    case VerdictKind::fail:
        return "FAIL";
    case VerdictKind::flaky:
        return "FLAKY";
    case VerdictKind::not_measured:
        return "NOT MEASURED";
    case VerdictKind::pass:
        break;
    }
    return verdict.name == other_device_class ? "note:" : "";
}

} // namespace

std::string verdict_line(const Verdict& verdict, const std::string& subject) {
    const std::string word = word_for(verdict);
    return word.empty() ? ""
                        : fmt::format("{} {}{}: {}{}{}\n", word, subject, verdict.name, verdict.text, verdict.known.empty() ? "" : "; ",
                                      verdict.known);
}

void annotate_red(const Verdict& verdict, const std::string& subject, const InputError::Where& where) {
    if (is_red(verdict))
        annotate(where, fmt::format("{} {}{}", word_for(verdict), subject, verdict.name),
                 verdict.text + (verdict.known.empty() ? "" : "; " + verdict.known) +
                     (verdict.rerun.empty() ? "" : "\nrepeat with: " + verdict.rerun));
}

} // namespace fernlicht
