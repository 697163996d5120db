#include "runner/experiments/history/history_findings.h"

#include "metrics/readings/reading_key.h"
#include "scenarios/values/glob.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <stdexcept>
#include <tuple>

namespace fernlicht {
namespace {

constexpr std::size_t fewest_nights_of_drift = 3;
constexpr double size_without_share = 2.0;

/// A reading from one night to the next in which its cell was played.
struct HistoryStep {
    std::size_t night = 0;
    const InputChanges* causes = nullptr;
    MovedReading moved;
    bool beyond = false, drifts = false;
};
/// Of one reading of one cell, in order.
using StepsByReading = std::map<std::pair<std::string, std::string>, std::vector<HistoryStep>>;

const Value& value_named(const NightReadings& readings, const std::string& name) {
    static const Value none = Value::not_measured("not among that night's readings");
    const auto found = readings.find(name);
    return found == readings.end() ? none : found->second;
}

/// The figure that an uncertainty is of; 0 for what stands for itself.
double other_of(const NightReadings& readings, const std::string& name) {
    std::optional<ReadingKey> key = key_of(name);
    if (!key || !is_uncertainty(*key))
        return 0.0;
    key->aspect = Aspect::value;
    try {
        return value_named(readings, name_of(*key)).figure().value_or(0.0);
    } catch (const std::logic_error&) { // of several readings together, as the error of both edges
        return 0.0;
    }
}

bool is_same(const Value& before, const Value& now) {
    return before.measured() || now.measured() ? before == now : true; // reasons may be worded anew
}

std::set<std::string> names_in(const NightReadings& before, const NightReadings& now) {
    std::set<std::string> names;
    for (const NightReadings* readings : {&before, &now})
        for (const auto& [name, value] : *readings)
            names.insert(name);
    return names;
}

/// Readings of one cell that differ at all, and whether it is beyond rounding.
std::vector<std::pair<MovedReading, bool>> moved_between(const NightCell& before, const NightCell& now, const InputChanges& causes) {
    std::vector<std::pair<MovedReading, bool>> moved;
    if (before.readings == now.readings)
        return moved;
    for (const std::string& name : names_in(*before.readings, *now.readings)) {
        const Value &was = value_named(*before.readings, name), &is = value_named(*now.readings, name);
        if (!is_same(was, is))
            moved.emplace_back(MovedReading{now.name, name, was, is}, is_beyond(was, is, other_of(*before.readings, name), causes));
    }
    return moved;
}

/// What decides first, the largest of it, then all else; how exact others are comes last.
void sort_for_people(std::vector<MovedReading>& moved, const std::vector<std::string>& decide) {
    std::map<std::string, int> ranks;
    for (const MovedReading& one : moved)
        if (const auto [rank, is_new] = ranks.emplace(one.reading, 1); is_new) {
            const std::optional<ReadingKey> key = key_of(one.reading);
            if (key && is_uncertainty(*key))
                rank->second = 2;
            else if (std::ranges::any_of(decide, [&](const std::string& pattern) { return matches(pattern, one.reading); }))
                rank->second = 0;
        }
    std::ranges::sort(moved, [&](const MovedReading& a, const MovedReading& b) {
        const int rank_a = ranks.at(a.reading), rank_b = ranks.at(b.reading);
        const double of_a = a.size(), of_b = b.size();
        return std::tie(rank_a, of_b, a.cell, a.reading) < std::tie(rank_b, of_a, b.cell, b.reading);
    });
}

/// What crept by steps that each are within rounding moved in every one of them.
void raise_creeping(std::vector<HistoryStep>& steps) {
    const std::optional<ReadingKey> key = key_of(steps.front().moved.reading);
    if (std::ranges::any_of(steps, &HistoryStep::beyond) || (key && is_uncertainty(*key)))
        return;
    const MovedReading all{"", "", steps.front().moved.before, steps.back().moved.now};
    const bool one_machine = std::ranges::none_of(steps, [](const HistoryStep& step) { return has_cause(*step.causes, Cause::machine); });
    static const InputChanges of_program{{InputKind::program, "", "", ""}};
    if (one_machine && steps.size() >= fewest_nights_of_drift && is_beyond(all.before, all.now, 0.0, of_program))
        for (HistoryStep& step : steps)
            step.beyond = true;
}

/// Runs of small steps in one direction, with none beyond rounding between them that is not.
void mark_drifts(std::vector<HistoryStep>& steps, double bound) {
    std::vector<HistoryStep*> run;
    const auto end_run = [&run] {
        if (run.size() >= fewest_nights_of_drift)
            for (HistoryStep* step : run)
                step->drifts = true;
        run.clear();
    };
    for (HistoryStep& step : steps) {
        if (!step.beyond)
            continue;
        const std::optional<double> share = step.moved.share();
        const bool is_small = share && std::abs(*share) <= bound;
        if (!is_small || (!run.empty() && (*run.back()->moved.share() > 0.0) != (*share > 0.0)))
            end_run();
        if (is_small)
            run.push_back(&step);
    }
    end_run();
}

/// From the first value to the last of each input.
void add_causes(InputChanges& all, const InputChanges& more) {
    for (const InputChange& change : more) {
        const auto known =
            std::ranges::find_if(all, [&](const InputChange& one) { return one.kind == change.kind && one.name == change.name; });
        if (known == all.end())
            all.push_back(change);
        else
            known->now = change.now;
    }
}

std::vector<HistoryDrift> drifts_of(const StepsByReading& steps, double bound, const std::vector<std::string>& decide) {
    std::map<std::vector<std::size_t>, HistoryDrift> by_nights;
    std::map<std::vector<std::size_t>, std::map<std::size_t, const InputChanges*>> causes;
    for (const auto& [reading, all] : steps) {
        std::vector<const HistoryStep*> run;
        const auto end_run = [&, &of = reading] {
            if (run.empty())
                return;
            std::vector<std::size_t> nights;
            for (const HistoryStep* step : run)
                nights.push_back(step->night);
            HistoryDrift& drift = by_nights[nights];
            drift.nights = nights;
            const Value& from = run.front()->moved.before;
            drift.moved.push_back({of.first, of.second, from, run.back()->moved.now});
            for (const HistoryStep* step : run) {
                causes[nights][step->night] = step->causes;
                const MovedReading sum{"", "", from, step->moved.now};
                if (sum.size() > bound && (!drift.exceeded || step->night < *drift.exceeded))
                    drift.exceeded = step->night;
            }
            run.clear();
        };
        for (const HistoryStep& step : all) {
            if (!step.drifts && step.beyond)
                end_run();
            if (!step.drifts)
                continue;
            if (!run.empty() && (*run.back()->moved.share() > 0.0) != (*step.moved.share() > 0.0))
                end_run();
            run.push_back(&step);
        }
        end_run();
    }
    std::vector<HistoryDrift> drifts;
    for (auto& [nights, drift] : by_nights) {
        for (const auto& [night, of_night] : causes[nights])
            add_causes(drift.causes, *of_night);
        sort_for_people(drift.moved, decide);
        drifts.push_back(std::move(drift));
    }
    return drifts;
}

std::vector<HistoryEvent> events_of(const StepsByReading& steps, const std::vector<std::string>& decide) {
    std::map<std::pair<std::size_t, InputChanges>, HistoryEvent> by_cause;
    std::set<std::pair<std::size_t, InputChanges>> of_drifts;
    for (const auto& [reading, all] : steps)
        for (const HistoryStep& step : all) {
            const std::pair key(step.night, *step.causes);
            if (step.drifts) {
                of_drifts.insert(key);
                continue;
            }
            HistoryEvent& event = by_cause[key];
            event.night = step.night;
            event.causes = *step.causes;
            event.cells.insert(step.moved.cell);
            if (step.beyond) {
                event.moved.push_back(step.moved);
            } else {
                ++event.within_rounding;
                const std::optional<ReadingKey> of = key_of(step.moved.reading);
                const bool tells_exactness = of && is_uncertainty(*of); // its own share says nothing: 1e-5 m may be 1e-4 m
                event.most_within = std::max(event.most_within, step.moved.share() && !tells_exactness ? step.moved.size() : 0.0);
            }
        }
    std::vector<HistoryEvent> events;
    for (auto& [key, event] : by_cause)
        if (!event.moved.empty() || !of_drifts.contains(key)) { // rounding that goes with a drift says nothing of its own
            sort_for_people(event.moved, decide);
            events.push_back(std::move(event));
        }
    return events;
}

/// Cells that are not in both nights.
void add_absent(HistoryFindings& findings) {
    const Night &before = findings.before(), &tonight = findings.tonight();
    for (const NightCell& cell : tonight.cells)
        if (!cell.failed.empty())
            findings.absent.push_back(fmt::format("{} was not played: {}", cell.name, cell.failed));
        else if (const NightCell* earlier = before.cell(cell.name); !earlier || !earlier->failed.empty())
            findings.absent.push_back(cell.name + " was not played in the night that this is compared with");
    for (const NightCell& cell : before.cells)
        if (!tonight.cell(cell.name))
            findings.absent.push_back(cell.name + " was not played tonight");
}

} // namespace

std::optional<double> MovedReading::share() const {
    const std::optional<double> was = before.figure(), is = now.figure();
    return was && is && *was != 0.0 ? std::optional((*is - *was) / std::abs(*was)) : std::nullopt;
}

double MovedReading::size() const {
    const std::optional<double> relative = share();
    return relative ? std::abs(*relative) : size_without_share;
}

bool is_beyond(const Value& before, const Value& now, double other, const InputChanges& causes) {
    if (is_same(before, now))
        return false;
    if (causes.empty() || before.measured() != now.measured())
        return true;
    const HistoryRounding& rounding = has_cause(causes, Cause::machine) ? rounding_of_machines : rounding_of_class;
    const double was = *before.figure(), is = *now.figure();
    return std::abs(is - was) >
           std::max(rounding.absolute, rounding.relative * std::max(std::abs(was), std::abs(is))) + rounding.of_other * std::abs(other);
}

std::vector<std::size_t> chain_of(const std::vector<Night>& nights, const std::string& cell, std::size_t first) {
    const auto likely =
        static_cast<std::size_t>(std::ranges::find(nights.back().cells, cell, &NightCell::name) - nights.back().cells.begin());
    std::vector<std::size_t> played;
    std::vector<std::string> classes;
    const CellInputs* same = nullptr; // most nights share one object
    for (std::size_t i = first; i < nights.size(); ++i)
        if (const NightCell* one = nights[i].cell(cell, likely); one && one->failed.empty()) {
            played.push_back(i);
            const bool as_before = !one->inputs->empty() && one->inputs.get() == same;
            classes.push_back(as_before ? classes.back() : device_class_of(deciding_inputs(nights[i], *one)));
            same = one->inputs.get();
        }
    if (played.empty() || played.back() + 1 != nights.size())
        return {};
    std::vector<std::size_t> chain{played.back()};
    for (std::size_t at = played.size() - 1; at > 0;) {
        std::size_t earlier = at;
        for (std::size_t i = at; i > 0 && earlier == at; --i)
            if (classes[i - 1] == classes[at])
                earlier = i - 1;
        at = earlier == at ? at - 1 : earlier;
        chain.insert(chain.begin(), played[at]);
    }
    return chain;
}

HistoryFindings explain_nights(std::vector<Night> nights, const HistoryOptions& options) {
    HistoryFindings findings;
    findings.nights = std::move(nights);
    findings.study = findings.tonight().study;
    findings.drift_bound = options.drift_bound;
    const auto accepted = std::find_if(findings.nights.rbegin() + 1, findings.nights.rend(),
                                       [](const Night& night) { return night.accepted && night.has_readings(); });
    findings.base = static_cast<std::size_t>(
        accepted != findings.nights.rend()
            ? findings.nights.rend() - accepted - 1
            : std::ranges::find_if(findings.nights.begin(), findings.nights.end() - 1, &Night::has_readings) - findings.nights.begin());
    for (std::size_t i = findings.base; i + 1 < findings.nights.size(); ++i)
        if (findings.nights[i].played_utc > findings.tonight().played_utc)
            findings.ahead.push_back(i);
    std::map<std::pair<std::size_t, InputChanges>, std::size_t> changed; // cells, and
    std::set<std::pair<std::size_t, InputChanges>> moving;               // those whose readings moved
    StepsByReading steps;
    for (std::size_t place = 0; place < findings.tonight().cells.size(); ++place) {
        const NightCell& cell = findings.tonight().cells[place];
        const std::vector<std::size_t> chain = chain_of(findings.nights, cell.name, findings.base);
        for (std::size_t i = 1; i < chain.size(); ++i) {
            const Night &earlier = findings.nights[chain[i - 1]], &later = findings.nights[chain[i]];
            const NightCell &before = *earlier.cell(cell.name, place), &now = *later.cell(cell.name, place);
            InputChanges causes = changes_between(earlier, before, later, now);
            const auto& [key, count] = *changed.emplace(std::pair(chain[i], std::move(causes)), 0).first;
            for (auto& [moved, beyond] : moved_between(before, now, key.second)) {
                steps[{moved.cell, moved.reading}].push_back({chain[i], &key.second, moved, beyond});
                moving.insert(key);
            }
        }
        if (chain.size() > 1 && chain.front() == findings.base) {
            ++findings.cells_compared;
            findings.readings_compared += cell.readings->size();
            const Night& before = findings.before();
            const NightCell& earlier = *before.cell(cell.name);
            const InputChanges causes = changes_between(before, earlier, findings.tonight(), cell);
            for (auto& [moved, beyond] : moved_between(earlier, cell, causes)) {
                ++findings.bits_moved;
                if (beyond)
                    findings.since.push_back(std::move(moved));
            }
        }
    }
    for (auto& [reading, all] : steps) {
        raise_creeping(all);
        mark_drifts(all, options.drift_bound);
    }
    findings.drifts = drifts_of(steps, options.drift_bound, findings.tonight().decide);
    findings.events = events_of(steps, findings.tonight().decide);
    for (HistoryEvent& event : findings.events)
        if (has_cause(event.causes, Cause::inputs) && (has_cause(event.causes, Cause::program) || has_cause(event.causes, Cause::machine)))
            event.told_apart = tell_apart(findings, event, options.tell_apart, findings.replays);
    for (const auto& [key, count] : changed)
        if (!key.second.empty() && !moving.contains(key))
            findings.quiet.push_back(findings.when(key.first) + ": " + phrase_of(key.second));
    std::ranges::reverse(findings.quiet); // the newest matter most
    sort_for_people(findings.since, findings.tonight().decide);
    findings.times = changes_of_times(findings.nights, findings.base, options.rate);
    add_absent(findings);
    return findings;
}

} // namespace fernlicht
