#include "runner/findings/report.h"

#include "runner/findings/run_page.h"

#include <algorithm>

namespace fernlicht {
namespace {

template <class Take> void each_verdict(const Report& report, const Take& take) {
    for (const PlayedCell& played : report.played)
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

std::vector<ComparedDrive> compared_drives(const Report& report) {
    std::vector<ComparedDrive> drives;
    for (const PlayedCell& played : report.played) {
        auto found = std::ranges::find(drives, played.drive, &ComparedDrive::name);
        if (found == drives.end())
            found = drives.insert(drives.end(), ComparedDrive{played.drive, {}});
        found->lamp_sets.push_back(&played);
    }
    return drives;
}

std::vector<std::size_t> spread_over(std::size_t count, std::size_t most) {
    std::vector<std::size_t> out;
    if (count <= most)
        for (std::size_t i = 0; i < count; ++i)
            out.push_back(i);
    else if (most == 1)
        out.push_back((count - 1) / 2);
    else
        for (std::size_t i = 0; i < most; ++i)
            out.push_back((i * (count - 1) + (most - 1) / 2) / (most - 1));
    return out;
}

} // namespace fernlicht
