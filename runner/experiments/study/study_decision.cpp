#include "runner/experiments/study/study_decision.h"

#include "metrics/readings/reading_labels.h"
#include "runner/experiments/study/change_text.h"
#include "runner/findings/figures.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace fernlicht {
namespace {

/// Whether two figures are one, within what is not known of them.
bool is_same(const Value& a, const Value& b, double uncertainty) {
    return a.kind() == b.kind() && (!a.measured() || std::abs(*a.figure() - *b.figure()) <= uncertainty);
}

/// What is not known repeats nothing.
bool is_same_result(const Change& a, const Change& b) {
    const double unsure = std::max(a.uncertainty.value_or(0.0), b.uncertainty.value_or(0.0));
    return a.kind == b.kind && a.kind != ChangeKind::unknown && is_same(a.old_value, b.old_value, unsure) &&
           is_same(a.new_value, b.new_value, unsure);
}

/// By one change that is real.
DecisionOutcome outcome_of(const Change& change) {
    const Value found = change.change();
    const double gain = better_is(change.reading) * (found.low() > 0.0 ? 1.0 : -1.0);
    return gain > 0.0 ? DecisionOutcome::better : gain < 0.0 ? DecisionOutcome::worse : DecisionOutcome::changed;
}

void conclude(const StudyResult& result, DecidedReading& decided) {
    const auto of_kind = [&](ChangeKind kind) {
        std::vector<std::size_t> found;
        std::ranges::copy_if(decided.changes, std::back_inserter(found), [&](std::size_t i) { return result.changes[i].kind == kind; });
        return found;
    };
    std::vector<std::pair<ChangeKind, DecisionOutcome>> kinds{{ChangeKind::real, DecisionOutcome::changed},
                                                              {ChangeKind::within_aim, DecisionOutcome::within_aim},
                                                              {ChangeKind::none, DecisionOutcome::same},
                                                              {ChangeKind::unknown, DecisionOutcome::undecided}};
    if (2 * of_kind(ChangeKind::unknown).size() > decided.changes.size()) // a few that are known to be small say nothing of these
        std::swap(kinds[1], kinds[3]);
    for (const auto& [kind, outcome] : kinds)
        if (decided.decided_by = of_kind(kind); !decided.decided_by.empty()) {
            decided.outcome = outcome;
            break;
        }
    if (decided.outcome == DecisionOutcome::changed) {
        decided.outcome = outcome_of(result.changes[decided.decided_by.front()]);
        if (std::ranges::any_of(decided.decided_by, [&](std::size_t i) { return outcome_of(result.changes[i]) != decided.outcome; }))
            decided.outcome = better_is(decided.reading) == 0.0 ? DecisionOutcome::changed : DecisionOutcome::mixed;
    }
    std::vector<std::size_t> by_size = decided.decided_by;
    std::ranges::stable_sort(by_size, {}, [&](std::size_t i) { return result.changes[i].size(); });
    decided.told = by_size[(by_size.size() - 1) / 2]; // of two in the middle the smaller, which claims less
}

/// Of the first place that both lamps were played in.
std::optional<AimsApart> mounted_apart(const StudyResult& result, const StudyComparison& comparison) {
    for (const auto& [tested, against] : result.pairs_of(comparison))
        if (const auto apart = low_beams_apart(result.cells[tested].aims, result.cells[against].aims))
            return apart;
    return std::nullopt;
}

constexpr double alike_deg = 0.02; ///< nearer, two marks are one: what they are found to in beams with noise

/// Files that are one beam, perhaps turned, on lamps that are not aimed alike.
bool differ_by_aim_alone(const StudyResult& result, const StudyComparison& comparison) {
    const auto mounted = mounted_apart(result, comparison);
    bool turned = false, compared = false;
    for (const LampComparison& lamps : result.lamps)
        if (lamps.tested == comparison.tested && lamps.against == comparison.against) {
            const LampDifference& d = lamps.difference;
            if (d.cut_off_up_deg || d.level || !d.zones.empty())
                return false;
            compared = true;
            turned = turned || (d.aim_up_deg && !lamps.is_turned_later);
        }
    return compared && (mounted ? mounted->most_deg > alike_deg : turned);
}

const StudyComparison& comparison_of(const StudyResult& result, const Decision& decision) {
    return result.study.comparisons[decision.comparison];
}

/// Whether cells differ by the axis: else it says nothing of one that is not true of all.
bool is_told(const StudyResult& result, std::size_t axis) {
    const auto value_in = [&](const CellResult& cell) { return axis < cell.cell.axes.size() ? cell.cell.axes[axis].value : ""; };
    return std::ranges::any_of(result.cells, [&](const CellResult& cell) { return value_in(cell) != value_in(result.cells.front()); });
}

/// "reach at 5 lx on a target, own lane +14.2 m (+21 %) in 3 of 4 results, at most +18.0 m (+25 %) on country-1"
std::string told(const StudyResult& result, const DecidedReading& decided) {
    const std::size_t of = decided.changes.size(), by = decided.decided_by.size();
    const std::size_t largest = *std::ranges::max_element(decided.decided_by, {}, [&](std::size_t i) { return result.changes[i].least(); });
    const CellResult& cell = result.cells[result.changes[largest].tested];
    std::string place = cell.drive;
    for (std::size_t i = 0; i < cell.cell.axes.size(); ++i)
        if (const AxisValue& at = cell.cell.axes[i]; !at.value.empty() && is_told(result, i))
            place += fmt::format(", {} {}", at.axis, at.value);
    const std::string told = change_words(result.changes[decided.told]), most = change_words(result.changes[largest]);
    return fmt::format("{} {}{}{}", reading_label(decided.reading), told, by < of ? fmt::format(" in {} of {} results", by, of) : "",
                       of == 1   ? ""
                       : by == 1 ? ", on " + place
                                 : fmt::format(", {} on {}", most == told ? "most" : "at most " + most, place));
}

std::string listed(const StudyResult& result, const Decision& decision, DecisionOutcome outcome, const char* words) {
    constexpr std::size_t most = 4;
    std::vector<const DecidedReading*> shown;
    for (const DecidedReading& decided : decision.readings)
        if (decided.outcome == outcome)
            shown.push_back(&decided);
    const std::size_t more = shown.size() > most ? shown.size() - most : 0;
    for (std::size_t i = 0; i < more; ++i) // the smallest go, the others keep the study's order
        shown.erase(std::ranges::min_element(shown, {}, [&](const DecidedReading* d) { return result.changes[d->told].size(); }));
    std::vector<std::string> items;
    items.reserve(shown.size());
    for (const DecidedReading* decided : shown)
        items.push_back(told(result, *decided));
    return items.empty() ? "" : fmt::format("{} {}{}", words, fmt::join(items, "; "), more > 0 ? fmt::format("; and {} more", more) : "");
}

/// By name, without figures: they say nothing.
std::string within_aim(const Decision& decision) {
    constexpr std::size_t most = 3;
    std::vector<std::string> names;
    for (const DecidedReading& decided : decision.readings)
        if (decided.outcome == DecisionOutcome::within_aim)
            names.push_back(reading_label(decided.reading));
    const std::size_t more = names.size() > most ? names.size() - most : 0;
    names.resize(names.size() - more);
    return fmt::format("{}{}", fmt::join(names, "; "), more > 0 ? fmt::format("; and {} more", more) : "");
}

std::string undecided(const StudyResult& result, const Decision& decision) {
    std::map<std::string, std::vector<std::string>> by_reason;
    for (const DecidedReading& decided : decision.readings)
        if (decided.outcome == DecisionOutcome::undecided)
            by_reason[result.changes[decided.told].reason_unknown].push_back(reading_label(decided.reading));
    std::string text;
    for (const auto& [reason, readings] : by_reason)
        text += fmt::format("{}{} because {}", text.empty() ? "Undecided: " : "; ",
                            readings.size() > 2 ? fmt::format("{} readings, {} among them,", readings.size(), readings.front())
                                                : fmt::format("{}", fmt::join(readings, " and ")),
                            reason);
    return text;
}

} // namespace

double better_is(const ReadingKey& reading) {
    const Better better = row_of(reading.quantity).better;
    return better == Better::higher ? 1.0 : better == Better::lower ? -1.0 : 0.0;
}

const char* outcome_name(DecisionOutcome outcome) {
    static constexpr const char* names[] = {"better", "worse", "better and worse", "changed", "within aim", "undecided", "no difference"};
    return names[static_cast<std::size_t>(outcome)];
}

std::size_t Decision::count(DecisionOutcome outcome) const {
    return static_cast<std::size_t>(std::ranges::count(readings, outcome, &DecidedReading::outcome));
}

std::vector<Decision> decide(const StudyResult& result) {
    std::vector<Decision> decisions;
    for (std::size_t comparison = 0; comparison < result.study.comparisons.size(); ++comparison) {
        const StudyComparison& pair = result.study.comparisons[comparison];
        std::map<std::pair<std::size_t, ReadingKey>, DecidedReading> by_place;
        for (std::size_t i = 0; i < result.changes.size(); ++i) {
            const Change& change = result.changes[i];
            if (result.lamp_of(change.tested) != pair.tested || result.lamp_of(change.against) != pair.against)
                continue;
            const auto place = place_among(change.reading, result.study.decide);
            if (!place)
                continue;
            DecidedReading& decided = by_place[{*place, change.reading}];
            decided.reading = change.reading;
            decided.changes.push_back(i);
        }
        Decision decision{.comparison = comparison, .readings = {}, .aim_alone = differ_by_aim_alone(result, pair)};
        if (const auto mounted = mounted_apart(result, pair))
            decision.aimed_up_deg = mounted->up_deg;
        for (auto& [place, decided] : by_place) {
            conclude(result, decided);
            decision.readings.push_back(std::move(decided));
        }
        if (!decision.readings.empty())
            decisions.push_back(std::move(decision));
    }
    return decisions;
}

std::vector<std::string> decision_parts(const StudyResult& result, const Decision& decision, DecisionParts which) {
    const bool all = which == DecisionParts::all;
    std::vector<std::string> parts;
    for (const auto& [outcome, words] : {std::pair(DecisionOutcome::better, "Better by"),
                                         {DecisionOutcome::worse, "Worse by"},
                                         {DecisionOutcome::mixed, "Better in some places and worse in others by"},
                                         {DecisionOutcome::changed, "Changed, neither for better nor for worse:"}})
        if (all || outcome == DecisionOutcome::worse || outcome == DecisionOutcome::mixed)
            parts.push_back(listed(result, decision, outcome, words));
    if (all)
        parts.push_back(undecided(result, decision));
    if (all && decision.count(DecisionOutcome::within_aim) > 0)
        parts.push_back(fmt::format("Within 0.1° of aim: {}", within_aim(decision)));
    if (const std::size_t same = all ? decision.count(DecisionOutcome::same) : 0)
        parts.push_back(fmt::format("{} without a difference", counted(same, "reading")));
    if (decision.aim_alone)
        parts.emplace_back("Both beams differ by their aim alone: it is the aim, not the lamp");
    else if (!mounted_words(decision).empty())
        parts.push_back(fmt::format("As mounted its cut-off lies {}: some or all of this is aim, which `aim: auto` takes away",
                                    mounted_words(decision)));
    std::erase(parts, "");
    return parts;
}

std::string mounted_words(const Decision& decision) { return higher_words(decision.aimed_up_deg.value_or(0.0)); }

std::string decision_sentence(const StudyResult& result, const Decision& decision) {
    const StudyComparison& pair = comparison_of(result, decision);
    std::string text = fmt::format("{}.", fmt::join(decision_parts(result, decision), ". "));
    if (text.front() >= 'A' && text.front() <= 'Z')
        text.front() = static_cast<char>(text.front() - 'A' + 'a');
    return fmt::format("{} against {}: {}", pair.tested, pair.against, text);
}

std::string decision_count(const StudyResult& result, const Decision& decision) {
    const StudyComparison& pair = comparison_of(result, decision);
    std::vector<std::string> parts;
    for (const auto& [outcome, words] :
         {std::pair(DecisionOutcome::better, "better in"), {DecisionOutcome::worse, "worse in"}, {DecisionOutcome::mixed, "both in"}})
        if (const std::size_t count = decision.count(outcome))
            parts.push_back(fmt::format("{} {}", words, count));
    if (!parts.empty())
        return fmt::format("{} against {}: {} of {}", pair.tested, pair.against, fmt::join(parts, ", "),
                           counted(decision.readings.size(), "deciding reading"));
    return decision.count(DecisionOutcome::within_aim) > 0 ? fmt::format("{} is within 0.1° of aim of {}", pair.tested, pair.against)
           : decision.count(DecisionOutcome::undecided) > 0
               ? fmt::format("{} and {}: undecided", pair.tested, pair.against)
               : fmt::format("{} and {} differ in no deciding reading", pair.tested, pair.against);
}

std::string decision_heading(const StudyResult& result, const std::vector<Decision>& decisions) {
    return decisions.empty()       ? "Nothing was compared"
           : decisions.size() == 1 ? decision_count(result, decisions.front())
                                   : fmt::format("What {} decide", counted(decisions.size(), "comparison"));
}

std::vector<std::string> same_results(const StudyResult& result, const std::vector<Decision>& decisions) {
    std::map<std::pair<std::string, std::string>, std::size_t> alike;
    const auto cell_of = [&](std::size_t change) -> const CellResult& { return result.cells[result.changes[change].tested]; };
    for (const Decision& decision : decisions)
        for (const DecidedReading& decided : decision.readings) {
            std::map<std::array<std::size_t, 6>, std::vector<std::size_t>> known; // under one condition: one for each drive
            for (const std::size_t i : decided.changes) {
                const StudyCell& at = cell_of(i).cell;
                std::vector<std::size_t>& earlier = known[{at.technique, at.time_of_day, at.aim, at.voltage, at.mirror, at.point}];
                const auto same =
                    std::ranges::find_if(earlier, [&](std::size_t k) { return is_same_result(result.changes[k], result.changes[i]); });
                if (same != earlier.end())
                    ++alike[{cell_of(*same).drive, cell_of(i).drive}];
                earlier.push_back(i);
            }
        }
    std::vector<std::string> sentences;
    for (const auto& [drives, results] : alike)
        sentences.push_back(fmt::format("{} of {} repeat{} what {} has: no further evidence", counted(results, "result"), drives.second,
                                        results == 1 ? "s" : "", drives.first));
    return sentences;
}

Table decision_table(const StudyResult& result, const std::vector<Decision>& decisions) {
    const bool several = decisions.size() > 1;
    Table table{.name = "decision",
                .caption = "Old, new and change are those of the middle one of a reading's results, ranked by change in per cent: of the "
                           "real ones where there are any. Of two in the middle it is the one that changes less",
                .columns = columns_of(std::string(several ? "new / old<|" : "") +
                                      "reading<|is<|old|new|change|%|± 0.1° of aim|unit<|results|where<"),
                .rows = {},
                .off_terminal = true};
    for (const Decision& decision : decisions)
        for (const DecidedReading& decided : decision.readings) {
            const Change& change = result.changes[decided.told];
            const int decimals = decimals_of(change);
            const std::optional<double> share = change.relative();
            std::vector<Cell>& cells = table.rows.emplace_back();
            if (several)
                cells.emplace_back(comparison_of(result, decision).tested + " / " + comparison_of(result, decision).against);
            cells.insert(cells.end(),
                         {Cell(reading_label(decided.reading)).hinted(name_of(decided.reading)), outcome_name(decided.outcome),
                          value_cell(change.old_value, decimals), value_cell(change.new_value, decimals), change_cell(change),
                          share ? Cell(signed_figure(100.0 * *share, 1), 100.0 * *share) : Cell(""),
                          change.aim_effect ? Cell(figure(*change.aim_effect, decimals), *change.aim_effect) : Cell(""),
                          unit_label(change.unit()), fmt::format("{} of {}", decided.decided_by.size(), decided.changes.size()),
                          Cell(result.cells[change.tested].drive).linked("#" + change.id)});
            if (decided.outcome > DecisionOutcome::changed)
                table.quiet.push_back(table.rows.size() - 1);
        }
    return table;
}

} // namespace fernlicht
