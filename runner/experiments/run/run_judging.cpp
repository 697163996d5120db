#include "runner/experiments/run/run_judging.h"

#include "renderer/technique.h"
#include "runner/findings/summary.h"
#include "runner/judge/baselines.h"
#include "runner/judge/limits.h"
#include "runner/play/stage.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {

std::vector<Verdict> limit_verdicts(const Drive& drive, const PlayedCell& played) {
    Readings judged = played.readings;
    std::ranges::copy(times(played), std::back_inserter(judged)); // a limit may be set on them; rows of the report they are not
    std::vector<Verdict> verdicts = judge_limits(drive, judged);
    if (technique_named(drive.technique, drive.file).kind != TechniqueKind::ours)
        for (Verdict& verdict : verdicts)
            verdict.text += fmt::format(" (as technique {} lights it)", drive.technique);
    return verdicts;
}

std::string lit_title(const std::string& title, const std::string& technique) {
    return technique_named(technique, {}).kind == TechniqueKind::ours ? title : title + fmt::format(", lit by technique {}", technique);
}

void judge_whole(Report& report, const RunOptions& options) {
    const TraceSpan span("judge", "run");
    if (!options.baselines.empty())
        for (PlayedCell& played : report.played)
            std::ranges::copy(judge_against_baselines(played, report.context, options.folder, options.baselines, played.technique,
                                                      options.across_devices),
                              std::back_inserter(played.verdicts));
    if (options.known) {
        add_inputs(report.context.inputs, options.known->opened);
        apply_known_failures(report, *options.known, options.today);
    }
}

} // namespace fernlicht
