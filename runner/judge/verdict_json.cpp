#include "runner/judge/verdict_json.h"

#include "runner/findings/extent_keys.h"

namespace fernlicht {

JsonPart verdict_kind_part(VerdictKind& kind) { return one_of(kind, names_of<VerdictKind>(verdict_name, 4)); }

JsonMembers verdict_members(Verdict& verdict) {
    const auto expectations = [] { return std::vector<std::string>{"", "known", "expired", "unexpected_pass"}; };
    return joined({{"name", verdict.name}, {"verdict", verdict.kind, verdict_kind_part}, {"text", verdict.text}, {"rerun", verdict.rerun}},
                  when(verdict.expectation != Expectation::none || !verdict.known.empty(),
                       {{"listed", {{"as", one_of(verdict.expectation, expectations)}, {"text", verdict.known}}}}));
}

JsonMembers count_members(VerdictCounts& counts) {
    return {{"pass", counts.pass},   {"fail", counts.fail},   {"not_measured", counts.not_measured},
            {"flaky", counts.flaky}, {"known", counts.known}, {"unexpected_pass", counts.unexpected_pass}};
}

JsonMembers repeats_members(Repeats& repeats) {
    const auto spread_members = [](ReadingSpread& reading) -> JsonMembers {
        return {{"name", reading.key},
                {"frame", or_null(reading.tick, -1)},
                {"count", reading.count},
                {"mean", reading.mean},
                {"variance", reading.variance}};
    };
    return {{"count", repeats.count}, {"differ", repeats.differ}, {"spread", repeats.spread, spread_members}};
}

} // namespace fernlicht
