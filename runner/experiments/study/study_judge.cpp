#include "runner/experiments/study/study_result.h"

#include "metrics/folds/reading_names.h"
#include "metrics/readings/reading_labels.h"
#include "runner/findings/run_context.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace fernlicht {
namespace {

Verdict verdict_on(const std::string& name, const Value& value, const std::string& unit, const std::optional<double>& least,
                   const std::optional<double>& most, const std::string& rerun) {
    if (!value.measured())
        return {VerdictKind::not_measured, name, value.reason(), rerun};
    std::string limits = least ? fmt::format("at least {:g}{}", *least, unit_suffix(unit)) : "";
    if (most)
        limits += fmt::format("{}at most {:g}{}", limits.empty() ? "" : ", ", *most, unit_suffix(unit));
    const std::optional<bool> kept = holds(value, least, most);
    return {!kept   ? VerdictKind::not_measured
            : *kept ? VerdictKind::pass
                    : VerdictKind::fail,
            name, fmt::format("{}{}, limit {}", with_bound(value, fmt::format("{:.4g}", *value.figure())), unit_suffix(unit), limits),
            rerun};
}

std::string no_such_reading(const std::string& name, const std::set<ReadingKey>& keys) {
    std::vector<std::string> names;
    for (const ReadingKey& key : keys)
        names.push_back(name_of(key));
    std::ranges::sort(names);
    const std::string nearest = nearest_name(name, names);
    return "there is no reading of this name" + (nearest.empty() ? "" : "; the nearest name is " + nearest);
}

/// Where no cell has any reading that its beginning asks for: "; ask for `glare` in `measure:`".
std::string how_to_ask(const std::string& name, const std::set<ReadingKey>& keys) {
    const std::string measure = asked_for_by(name);
    const auto is_asked = [&](const ReadingKey& key) { return asked_for_by(name_of(key)) == measure; };
    return measure.empty() || std::ranges::any_of(keys, is_asked)
               ? ""
               : fmt::format(", as no drive measures {0}: ask for `{0}` in `measure:`", measure);
}

bool is_in(const std::set<ReadingKey>& keys, const std::optional<ReadingKey>& key) { return key && keys.contains(*key); }

/// The first cell's reason where no cell has a value of what fits; "" where one has.
template <class Fits> std::string why_unmeasured(const StudyResult& result, Fits fits) {
    std::string why;
    for (const CellResult& cell : result.cells)
        for (const auto& [key, reading] : cell.readings)
            if (fits(key)) {
                if (reading.value.measured())
                    return "";
                if (why.empty())
                    why = reading.value.reason();
            }
    return why;
}

/// A reading that the study names and that nothing has decides nothing, and must not look as if it had not changed. Of the usual ones a
/// drive need not have all.
void judge_deciding(StudyResult& result) {
    const std::set<ReadingKey>& keys = result.keys;
    if (result.study.decide == decides_by_default() || keys.empty()) // cells that were not played say so themselves
        return;
    for (const std::string& name : result.study.decide) {
        const auto missing = [&](const std::string& why) {
            result.verdicts.push_back({VerdictKind::not_measured, "deciding reading " + name, why, repeat_command(result.call)});
        };
        const auto fits = [&](const ReadingKey& key) { return place_among(key, {name}).has_value(); };
        if (std::ranges::none_of(keys, fits))
            missing((name.find_first_of("*?") == std::string::npos ? no_such_reading(name, keys) : "no reading's name fits") +
                    how_to_ask(name, keys));
        else if (const std::string why = why_unmeasured(result, fits); !why.empty())
            missing("no cell measured it: " + why);
        else if (result.changes.size() + result.changes_elsewhere > 0 &&
                 std::ranges::none_of(result.changes, fits, &ReadingChange::reading))
            missing("no two cells were compared by it: it is a time, says how exact another is, or one lamp alone has it");
    }
}

void judge_values(StudyResult& result, const StudyLimit& limit) {
    const auto key = key_of(limit.reading);
    for (const CellResult& cell : result.cells) {
        if (!limit.lamp.empty() && result.study.lamps[cell.cell.lamp].name != limit.lamp)
            continue;
        const auto found = key ? cell.readings.find(*key) : cell.readings.end();
        const bool known = found != cell.readings.end();
        const Value value = known ? found->second.value
                                  : Value::not_measured(cell.failed.empty() ? no_such_reading(limit.reading, result.keys)
                                                                            : "the cell was not played: " + cell.failed);
        result.verdicts.push_back(verdict_on(cell.cell.name + ": " + limit.reading, value, known ? unit_of(*key) : "", limit.at_least,
                                             limit.at_most, repeat_command(result.call, {"--only", cell.cell.name})));
    }
}

void judge_changes(StudyResult& result, const StudyLimit& limit) {
    const auto key = key_of(limit.reading);
    bool found = false;
    for (const Change& change : result.changes) {
        if (change.reading != key)
            continue;
        found = true;
        const CellResult& cell = result.cells[change.tested];
        result.verdicts.push_back(verdict_on(
            cell.cell.name + ": change of " + limit.reading, change.change(), change.unit(), limit.change_at_least, limit.change_at_most,
            repeat_command(result.call, {"--only", cell.cell.name + "," + result.cells[change.against].cell.name})));
    }
    const std::set<ReadingKey>& keys = result.keys;
    if (!found && !result.only.empty() && is_in(keys, key) && result.changes.size() + result.changes_elsewhere == 0)
        return; // of the cells that were asked for no two are compared
    if (!found)
        result.verdicts.push_back(
            {VerdictKind::not_measured, "change of " + limit.reading,
             keys.empty() || is_in(keys, key) ? "no comparison has this reading" : no_such_reading(limit.reading, keys),
             repeat_command(result.call)});
}

} // namespace

void judge(StudyResult& result) {
    judge_deciding(result);
    for (const StudyLimit& limit : result.study.limits) {
        const auto others = static_cast<std::ptrdiff_t>(result.verdicts.size());
        limit.change_at_least || limit.change_at_most ? judge_changes(result, limit) : judge_values(result, limit);
        std::for_each(result.verdicts.begin() + others, result.verdicts.end(), [&](Verdict& verdict) { verdict.line = limit.line; });
    }
}

} // namespace fernlicht
