#include "metrics/readings/reading_labels.h"
#include "runner/experiments/study/change_text.h"
#include "runner/experiments/study/study_decision.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/findings/plots/dot_plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <tuple>

namespace fernlicht {
namespace {

constexpr double full_shade = 0.4; ///< the relative change that is shaded most

using Groups = std::vector<std::vector<std::size_t>>;

/// Three significant digits.
std::string short_figure(double value) {
    return figure(value, std::abs(value) < 1e-6 ? 0 : std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 6));
}

std::string value_words(const Value& value, const ReadingKey& key) {
    return value.measured() ? with_bound(value, short_figure(*value.figure())) + unit_suffix(unit_of(key)) : "not measured";
}

/// `backward`: of the lamp that it is compared against.
std::string signed_words(const Change& change, bool backward) {
    const Value told = backward ? difference(0.0, change.change(), unit_of(change.reading)) : change.change();
    const double found = told.figure().value_or(0.0);
    return with_bound(told, (found > 0.0 ? "+" : "") + short_figure(found)) + unit_suffix(change.unit());
}

/// Of a cell against the lamp that it is compared with first.
const Change* change_of(const StudyResult& result, std::size_t cell, const ReadingKey& key) {
    const auto found =
        std::ranges::find_if(result.changes, [&](const Change& change) { return change.tested == cell && change.reading == key; });
    return found == result.changes.end() ? nullptr : &*found;
}

Value read_by(const CellResult& cell, const ReadingKey& key) {
    const auto found = cell.readings.find(key);
    return found == cell.readings.end() ? Value() : found->second.value;
}

/// Above 0: better. Only of what is real.
double real_gain(const Change& change) {
    return change.kind == ChangeKind::real ? better_is(change.reading) * (change.change().low() > 0.0 ? 1.0 : -1.0) : 0.0;
}

std::string standing_of(const Change& change) {
    return change.kind != ChangeKind::real ? change_name(change.kind)
           : real_gain(change) > 0.0       ? "better"
           : real_gain(change) < 0.0       ? "worse"
                                           : "changed";
}

MatrixEntry entry_of(const StudyResult& result, std::size_t cell, const ReadingKey& key) {
    const Value value = read_by(result.cells[cell], key);
    MatrixEntry entry{cell_of(value, short_figure(value.figure().value_or(0.0)))};
    const Change* const change = change_of(result, cell, key);
    if (!change)
        return entry;
    const std::optional<double> share = change->relative();
    entry.change = change_cell(*change).text;
    entry.share = share ? signed_figure(100.0 * *share, 0) : "";
    entry.standing = standing_of(*change);
    entry.open = change->aim_effect ? short_figure(*change->aim_effect) : "";
    entry.shade = real_gain(*change) * std::min(1.0, std::abs(share.value_or(1.0)) / full_shade);
    entry.value = std::move(entry.value).linked("#" + change->id);
    if (change->uncertainty)
        entry.value = std::move(entry.value)
                          .hinted(fmt::format("against {}: {}{}", result.lamp_of(change->against),
                                              open_words(*change, change->total_uncertainty(), unit_suffix(change->unit())),
                                              change->aim_effect ? fmt::format(", ±{}{} by 0.1° of aim", short_figure(*change->aim_effect),
                                                                               unit_suffix(change->unit()))
                                                                 : ""));
    return entry;
}

PlaceMatrix matrix_of(const StudyResult& result, const Groups& groups, const ReadingKey& key) {
    PlaceMatrix matrix{.name = "matrix",
                       .caption = capitalised(reading_label(key)),
                       .corner = "route",
                       .unit = unit_label(unit_of(key)),
                       .open_by = "aim"};
    for (std::size_t i = 0; i < result.study.lamps.size(); ++i)
        matrix.columns.push_back(Cell::of_series(short_text(result.study.lamps[i].name, 24), i));
    for (const std::vector<std::size_t>& group : groups) {
        auto& [name, entries] = matrix.rows.emplace_back(Cell(clean_text(result.place_of(group.front()))), std::vector<MatrixEntry>());
        name = std::move(name).hinted(result.cells[group.front()].title + "; " + result.cells[group.front()].cell.condition);
        for (std::size_t lamp = 0; lamp < result.study.lamps.size(); ++lamp) {
            const auto cell = std::ranges::find_if(group, [&](std::size_t i) { return result.cells[i].cell.lamp == lamp; });
            entries.push_back(cell == group.end() ? MatrixEntry{Cell("not played")} : entry_of(result, *cell, key));
        }
    }
    return matrix;
}

struct Ranking {
    std::vector<std::pair<std::size_t, Value>> lamps; ///< each one's median, best first
    std::size_t places = 0;                           ///< of these: where all of them were played and measured
};

Ranking lamps_ranked(const StudyResult& result, const Groups& groups, const ReadingKey& key) {
    std::vector<CensoredSamples> samples(result.study.lamps.size());
    std::size_t whole = 0, places = 0;
    for (const std::vector<std::size_t>& group : groups)
        whole = std::max(whole, group.size());
    for (const std::vector<std::size_t>& group : groups)
        if (group.size() == whole && std::ranges::all_of(group, [&](std::size_t i) { return read_by(result.cells[i], key).measured(); })) {
            ++places;
            for (const std::size_t i : group)
                samples[result.cells[i].cell.lamp].add(read_by(result.cells[i], key));
        }
    std::vector<std::pair<std::size_t, Value>> lamps;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (const Value median = samples[i].quantile(0.5); median.measured())
            lamps.emplace_back(i, median);
    std::ranges::stable_sort(lamps, std::greater{}, [&](const auto& lamp) { return better_is(key) * lamp.second.figure().value_or(0.0); });
    return {std::move(lamps), places};
}

/// What a lamp changes against another, place by place; none where the study does not compare the two this way round.
std::vector<const Change*> changes_of_lamps(const StudyResult& result, std::size_t tested, std::size_t against, const ReadingKey& key) {
    std::vector<const Change*> changes;
    for (const Change& change : result.changes)
        if (change.reading == key && result.cells[change.tested].cell.lamp == tested && result.cells[change.against].cell.lamp == against)
            changes.push_back(&change);
    return changes;
}

/// On routes, at places.
const char* preposition(const std::string& places) { return places == "places" ? "at" : "on"; }

/// "better on 5 of 5 routes, most on village-1 (+12.1 m), least on straight-1 (+8.0 m)".
std::string where_words(const StudyResult& result, const std::vector<const Change*>& changes, bool best_is_tested,
                        const std::string& places) {
    const char* const at = preposition(places);
    std::vector<const Change*> real;
    for (const Change* const change : changes)
        if (change->kind == ChangeKind::real)
            real.push_back(change);
    const auto is_better = [&](const Change* change) { return (real_gain(*change) > 0.0) == best_is_tested; };
    const auto better = std::ranges::count_if(real, is_better), worse = std::ssize(real) - better;
    if (changes.size() == 1 && better == 1) // the place is named before it
        return fmt::format("better ({})", signed_words(*real.front(), !best_is_tested));
    std::string text = fmt::format("better {} {} of {} {}", at, better, changes.size(), places);
    if (worse > 0)
        text += fmt::format(", worse {} {}", at, worse);
    const auto unknown = std::ranges::count(changes, ChangeKind::unknown, &Change::kind);
    if (const auto open = std::ssize(changes) - std::ssize(real) - unknown; open > 0)
        text += fmt::format(", {} {} within what calculation, noise and 0.1° of aim leave open", at, open);
    if (unknown > 0)
        text += fmt::format(", {} {} not known", at, unknown);
    std::erase_if(real, [&](const Change* change) { return !is_better(change); });
    if (real.empty())
        return text;
    const auto [least, most] = std::ranges::minmax_element(real, {}, [](const Change* change) { return change->least(); });
    const auto told = [&](const Change& change) {
        return fmt::format("{} ({})", result.place_of(change.tested), signed_words(change, !best_is_tested));
    };
    if (const std::string words = signed_words(**most, !best_is_tested); real.size() > 1 && words == signed_words(**least, !best_is_tested))
        return text + fmt::format(", {} {} each", words, at);
    text += fmt::format(", most on {}", told(**most));
    return (*most)->least() > (*least)->least() ? text + fmt::format(", least on {}", told(**least)) : text;
}

/// The first deciding reading in a sentence: best and worst lamp, by how much, where.
struct Answer {
    std::string heading, where;
};

/// What the decision tells of the reading, of two lamps of which one is better wherever they were compared; nullptr where none is.
const DecidedReading* decided_alike(const StudyResult& result, const std::vector<Decision>& decisions, const ReadingKey& key) {
    if (decisions.size() != 1 || result.study.lamps.size() != 2)
        return nullptr;
    const auto found = std::ranges::find(decisions.front().readings, key, &DecidedReading::reading);
    return found != decisions.front().readings.end() &&
                   (found->outcome == DecisionOutcome::better || found->outcome == DecisionOutcome::worse) &&
                   found->decided_by.size() == found->changes.size()
               ? &*found
               : nullptr;
}

Answer answer_of(const StudyResult& result, const Groups& groups, const std::vector<Decision>& decisions, const ReadingKey& key) {
    auto [lamps, ranked_places] = lamps_ranked(result, groups, key);
    if (lamps.size() < 2 || better_is(key) == 0.0)
        return {};
    const DecidedReading* const decided = decided_alike(result, decisions, key);
    if (decided) { // the same figures as everywhere else on the page
        const Change& told = result.changes[decided->told];
        lamps = {{result.cells[told.tested].cell.lamp, told.new_value}, {result.cells[told.against].cell.lamp, told.old_value}};
        if (real_gain(told) < 0.0)
            std::swap(lamps.front(), lamps.back());
    }
    const auto& [best, best_value] = lamps.front();
    const auto& [worst, worst_value] = lamps.back();
    const std::string &best_name = result.study.lamps[best].name, &worst_name = result.study.lamps[worst].name;
    std::set<std::size_t> drives;
    for (const std::vector<std::size_t>& group : groups)
        drives.insert(result.cells[group.front()].cell.drive);
    const std::string places = drives.size() == groups.size() ? (groups.size() == 1 ? "route" : "routes") : "places";
    const char* const median_words = !decided || decided->decided_by.size() == 1 ? ""
                                     : decided->decided_by.size() % 2 == 1       ? " by change in per cent"
                                                                                 : " by change in per cent, the smaller of the middle two";
    const std::string over =
        groups.size() == 1 ? "On " + result.place_of(groups.front().front())
                           : fmt::format("Median over {}{} {}{}", ranked_places < groups.size() ? fmt::format("{} of ", ranked_places) : "",
                                         groups.size(), places, median_words);
    const std::string reading = capitalised(reading_label(key)) + ": ";
    bool forward = true;
    std::vector<const Change*> changes = changes_of_lamps(result, best, worst, key);
    if (changes.empty()) {
        forward = false;
        changes = changes_of_lamps(result, worst, best, key);
    }
    const Value gap = difference(best_value, worst_value, unit_of(key));
    const double base = std::abs(worst_value.figure().value_or(0.0));
    const std::string by =
        gap.measured() ? with_bound(gap, (*gap.figure() > 0.0 ? "+" : "") + short_figure(*gap.figure())) + unit_suffix(unit_of(key)) +
                             (base > 0.0 && !gap.censored() ? fmt::format(", {} %", signed_figure(100.0 * *gap.figure() / base, 0)) : "")
                       : "";
    const std::string figures =
        fmt::format("{} against {}{}", value_words(best_value, key), value_words(worst_value, key), by.empty() ? "" : " (" + by + ")");
    if (changes.empty())
        return {reading + fmt::format("{} is best, {} worst: {}", best_name, worst_name, figures),
                over + ". The study does not compare these two, so noise and aim are not told."};
    const auto better = std::ranges::count_if(
        changes, [&](const Change* change) { return real_gain(*change) != 0.0 && (real_gain(*change) > 0.0) == forward; });
    const auto worse = std::ranges::count(changes, ChangeKind::real, &Change::kind) - better;
    std::string heading;
    if (better == 0 && worse == 0)
        heading = fmt::format("{} and {} do not differ by more than aim and noise: {}", best_name, worst_name, figures);
    else if (better == 0)
        heading = fmt::format("{} is worse than {} {} {} of {} {}, better {} none: {}", best_name, worst_name, preposition(places), worse,
                              changes.size(), places, preposition(places), figures);
    else if (worse > 0)
        heading = fmt::format("{} is better than {} {} {} of {} {}, worse {} {}: {}", best_name, worst_name, preposition(places), better,
                              changes.size(), places, preposition(places), worse, figures);
    else if (lamps.size() > 2)
        heading = fmt::format("{} is best, {} worst: {}", best_name, worst_name, figures);
    else
        heading = fmt::format("{} is better than {}: {}", best_name, worst_name, figures);
    return {reading + heading, over + ": " + where_words(result, changes, forward, places) + "."};
}

/// What speaks against the headline: the other deciding readings, and what `decide:` asks for and no cell measured.
std::string against_words(const StudyResult& result, const std::vector<Decision>& decisions) {
    std::string text;
    for (const Decision& decision : decisions) {
        text += (text.empty() ? "" : " ") + decision_count(result, decision) + ".";
        for (const std::string& part : decision_parts(result, decision, DecisionParts::doubts))
            text += " " + part + ".";
        if (const std::size_t open = decision.count(DecisionOutcome::undecided)) {
            const auto first = std::ranges::find(decision.readings, DecisionOutcome::undecided, &DecidedReading::outcome);
            text += fmt::format(" Not known: {}{}.", reading_label(first->reading), open > 1 ? fmt::format(", and {} more", open - 1) : "");
        }
    }
    std::vector<std::string> kinds; // "reach", "glare": the first words of the names, in their order
    std::set<std::string> measured;
    for (const std::string& name : result.study.decide) {
        const std::string kind = name.substr(0, name.find('_'));
        if (std::ranges::find(kinds, kind) == kinds.end())
            kinds.push_back(kind);
        if (!measured.contains(kind) && std::ranges::any_of(result.cells, [&](const CellResult& cell) {
                return std::ranges::any_of(
                    cell.readings, [&](const auto& read) { return read.second.value.measured() && place_among(read.first, {name}); });
            }))
            measured.insert(kind);
    }
    std::erase_if(kinds, [&](const std::string& kind) { return measured.contains(kind); });
    std::ranges::replace(kinds, std::string("uniformity"), std::string("evenness")); // as its readings are called
    return kinds.empty() ? text : fmt::format("{} Not measured, though it would decide: {}.", text, fmt::join(kinds, ", "));
}

} // namespace

std::optional<ReadingKey> first_deciding(const StudyResult& result) {
    std::set<ReadingKey> seen; // names are matched with patterns, which takes its time
    std::optional<std::pair<std::size_t, ReadingKey>> first;
    for (const CellResult& cell : result.cells)
        for (const auto& [key, reading] : cell.readings)
            if (reading.value.measured() && seen.insert(key).second)
                if (const auto place = place_among(key, result.study.decide); place && (!first || std::pair(*place, key) < *first))
                    first = std::pair(*place, key);
    return first ? std::optional(first->second) : std::nullopt;
}

std::optional<double> gain_among(const StudyResult& result, const std::vector<std::size_t>& cells, const ReadingKey& key) {
    for (const std::size_t cell : cells)
        if (const Change* const change = change_of(result, cell, key))
            if (const auto share = change->relative())
                return real_gain(*change) * std::abs(*share);
    return std::nullopt;
}

std::optional<plots::DotPlot> ranking_of(const StudyResult& result, const Decision& decision) {
    const StudyComparison& pair = result.study.comparisons[decision.comparison];
    plots::DotPlot dots{.title =
                            fmt::format("What decides, ranked: {} against {}", short_text(pair.tested, 24), short_text(pair.against, 24)),
                        .subtitle = "dot: median route; ticks: others; line: ± calculation, noise, 0.1° of aim; hollow: not real",
                        .left = "worse",
                        .right = "better",
                        .unit = "%"};
    for (const DecidedReading& decided : decision.readings) {
        const Change& change = result.changes[decided.told];
        const double better = better_is(decided.reading);
        if (better == 0.0)
            continue;
        plots::DotRow row{.name = reading_label(decided.reading),
                          .figure = change.change().measured() ? change_cell(change).text + unit_suffix(change.unit()) : "not known"};
        if (const auto share = change.relative()) {
            const double percent = 100.0 / std::abs(*change.old_value.figure()),
                         open = percent * (change.total_uncertainty() + change.aim_effect.value_or(0.0));
            row.value = 100.0 * better * *share;
            row.low = *row.value - open;
            row.high = *row.value + open;
            row.sure = change.kind == ChangeKind::real;
            for (const std::size_t i : decided.changes)
                if (const auto other = result.changes[i].relative(); other && i != decided.told)
                    row.others.push_back(100.0 * better * *other);
        } else if (const Value by = change.change(); by.censored() && change.old_value.figure().value_or(0.0) != 0.0) {
            row.value = row.low = row.high =
                100.0 * better * *by.figure() / std::abs(*change.old_value.figure()); // at least; `figure` says so
            row.sure = change.kind == ChangeKind::real;
        }
        dots.rows.push_back(std::move(row));
    }
    std::ranges::stable_sort(dots.rows, std::greater{}, [](const plots::DotRow& row) {
        return std::tuple(row.value.has_value(), row.sure ? *row.value > 0.0 ? 2 : 0 : 1, row.value.value_or(0.0));
    });
    if (dots.rows.empty())
        return std::nullopt;
    return dots;
}

Section answer_section(const StudyResult& result, const std::vector<Decision>& decisions) {
    const std::optional<ReadingKey> key = first_deciding(result);
    if (!key)
        return {};
    const Groups groups = groups_of(result);
    const Answer answer = answer_of(result, groups, decisions, *key);
    Section section{answer.heading.empty() ? reading_label(*key) : answer.heading, {}};
    section.is_answer = true;
    if (const std::string mounted = decisions.size() == 1 ? mounted_words(decisions.front()) : "";
        !answer.heading.empty() && !mounted.empty())
        section.title += fmt::format("; the cut-off of {} lies {}", result.study.comparisons.front().tested, mounted);
    if (!answer.where.empty())
        section.blocks.emplace_back(answer.where);
    if (std::string against = against_words(result, decisions); !against.empty())
        section.blocks.emplace_back(std::move(against));
    section.blocks.emplace_back(matrix_of(result, groups, *key));
    for (const Decision& decision : decisions)
        if (const std::optional<plots::DotPlot> dots = ranking_of(result, decision)) {
            const StudyComparison& pair = result.study.comparisons[decision.comparison];
            section.blocks.emplace_back(Plot{.name = fmt::format("figures/ranking_{}-{}", pair.tested, pair.against),
                                             .figure = drawing_of(*dots),
                                             .scale = 2.0,
                                             .beside = true});
        }
    return section;
}

} // namespace fernlicht
