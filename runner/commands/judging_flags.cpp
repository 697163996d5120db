#include "runner/commands/judging_flags.h"

#include "runner/commands/flag_values.h"
#include "runner/findings/run_context.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>

namespace fernlicht {
namespace {

std::string today_of(const JudgingFlags& flags) {
    if (flags.today.empty())
        return utc_now().substr(0, 10);
    if (!is_date(flags.today))
        refuse_flag("--today", flags.today, "a date, e.g. 2026-12-31");
    if (flags.known.empty())
        refuse_flag("--today", flags.today, "--known beside it: nothing else asks for the day");
    return flags.today;
}

} // namespace

TickRange tick_range(const std::string& frames) {
    TickRange range;
    if (frames.empty())
        return range;
    constexpr const char* expected = "FIRST:LAST with FIRST 0 or more and FIRST <= LAST, e.g. 0:59";
    const auto [first, last] = two_numbers("--frames", frames, ':', true, expected);
    range.first = first < 0 ? 0 : first;
    range.last = last < 0 ? range.last : last;
    if (range.first > range.last)
        refuse_flag("--frames", frames, expected);
    return range;
}

void add_judging_flags(CLI::App& command, JudgingFlags& flags) {
    command.add_option("--references", flags.references, "folder of accepted results to judge against");
    command.add_flag("--across-devices", flags.across_devices,
                     "where nothing is accepted for this device class, judge by results of other classes");
    command.add_option("--repeat", flags.repeats, "times to play each lamp set; results that differ in a byte are flaky, which is red")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command.add_option("--known", flags.known, "YAML list of known failures and flakes, each with reason and expiry");
    command.add_option("--today", flags.today, "YYYY-MM-DD, the day used to expire known failures (default: today, UTC)");
}

std::optional<KnownFailures> take(const JudgingFlags& flags, RunOptions& options) {
    if (flags.across_devices && flags.references.empty())
        throw InputError({{}, 0, 0, "--across-devices"}, "found no --references", "the folder of accepted results");
    options.references = flags.references;
    options.across_devices = flags.across_devices;
    options.repeats = flags.repeats;
    options.today = today_of(flags);
    return flags.known.empty() ? std::nullopt : std::optional(read_known_failures(flags.known));
}

} // namespace fernlicht
