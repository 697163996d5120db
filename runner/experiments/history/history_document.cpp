#include "runner/experiments/history/history_document.h"

#include "metrics/readings/reading_labels.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

/// Of the readings of one event; CSV has all.
constexpr std::size_t most_rows = 8, most_since = 24;

std::string told_percent(double share) { return fmt::format("{:.{}g} %", 100.0 * share, share < 1e-5 ? 2 : 3); }

const NightCell& night_cell(const Night& night, const std::string& name) {
    static const NightCell none;
    const NightCell* const cell = night.cell(name);
    return cell ? *cell : none;
}

/// As it was in that night: "xenon on straight, night, aim -1 %, 13.2 V".
std::string place_of(const Night& night, const std::string& cell) {
    const NightCell& one = night_cell(night, cell);
    return one.name.empty() ? cell : fmt::format("{} on {}{}{}", one.lamp, one.drive, one.condition.empty() ? "" : ", ", one.condition);
}

std::size_t count_cells(const std::vector<MovedReading>& moved) {
    std::set<std::string> cells;
    for (const MovedReading& one : moved)
        cells.insert(one.cell);
    return cells.size();
}

/// "24 readings of 6 cells, above all reach at 5 lx ..., xenon on straight: 40.2 m → 41.1 m (+2.31 %)".
std::string told_moved(const HistoryFindings& findings, const Night& night, const std::vector<MovedReading>& moved) {
    const MovedReading& largest = moved.front();
    const std::string share = told_share(largest.share());
    std::string aim;
    const auto effect = findings.aim_effects.find({largest.cell, largest.reading});
    if (effect != findings.aim_effects.end() && largest.before.figure() && largest.now.figure())
        aim = fmt::format(", {} what 0.1° of aim would do ({})",
                          std::abs(*largest.now.figure() - *largest.before.figure()) > effect->second ? "beyond" : "within",
                          told_value(largest.reading, effect->second));
    const std::optional<ReadingKey> key = key_of(largest.reading); // what decides stands first
    const bool decides = night.decide.empty() || (key && place_among(*key, night.decide));
    return fmt::format("{} of {}, {} {}, {}: {}{}{}", counted(moved.size(), "reading"), counted(count_cells(moved), "cell"),
                       decides ? "above all" : "none that decides; the largest is", label_of_reading(largest.reading),
                       place_of(night, largest.cell), told_step(largest.reading, largest.before, largest.now),
                       share.empty() ? "" : " (" + share + ")", aim);
}

std::string told_split(const HistoryFindings& findings, const HistoryEvent& event) {
    const ToldApart& told = *event.told_apart;
    const std::string others = has_cause(event.causes, Cause::program) && has_cause(event.causes, Cause::machine) ? "program and machine"
                               : has_cause(event.causes, Cause::program)                                          ? "program"
                                                                                                                  : "machine";
    if (told.parts.empty())
        return fmt::format("; what the {} did and what the inputs did cannot be told apart: {}", others, told.why_not);
    const auto step = [](const ToldApart::Part& part, const Value& from, const Value& to) {
        const std::string share = told_share(MovedReading{part.reading, "", from, to}.share());
        return share.empty() ? told_step(part.reading, from, to) : share;
    };
    const auto by_program = [](const ToldApart::Part& part) { return MovedReading{"", "", part.before, part.with_earlier_inputs}.size(); };
    const auto by_inputs = [](const ToldApart::Part& part) { return MovedReading{"", "", part.with_earlier_inputs, part.now}.size(); };
    std::vector<const ToldApart::Part*> shown{&told.parts.front()};
    if (told.program_moved && told.inputs_moved) {
        shown = {&*std::ranges::max_element(told.parts, {}, by_inputs)};
        if (const auto other = std::ranges::max_element(told.parts, {}, by_program); &*other != shown.front())
            shown.push_back(&*other);
    }
    std::string parts;
    for (const ToldApart::Part* part : shown)
        parts += fmt::format("{}{}: {} {}, inputs {}", parts.empty() ? "" : "; ", label_of_reading(part->reading), others,
                             step(*part, part->before, part->with_earlier_inputs), step(*part, part->with_earlier_inputs, part->now));
    const std::string verdict = told.program_moved && told.inputs_moved ? "both moved readings"
                                : told.inputs_moved                     ? "the inputs alone moved them"
                                                                        : "the " + others + " alone moved them";
    return fmt::format("; told apart by {}, played with that night's {} and the inputs before: {} ({}); the other order cannot be played: "
                       "the earlier program is gone",
                       place_of(findings.nights[event.night], told.cell), others, verdict, parts);
}

std::string told_causes(const HistoryFindings& findings, const HistoryEvent& event) {
    if (!night_cell(findings.nights[event.night], *event.cells.begin()).inputs->empty())
        return phrase_of(event.causes);
    return event.causes.empty() ? "cause not known: program and machine are as they were, what went in was not kept"
                                : phrase_of(event.causes) + " (what went in was not kept)";
}

std::string told_event(const HistoryFindings& findings, const HistoryEvent& event) {
    std::string text = findings.when(event.night) + ": " + told_causes(findings, event) + "; ";
    if (!event.moved.empty())
        text += told_moved(findings, findings.nights[event.night], event.moved);
    if (event.within_rounding > 0)
        text += fmt::format("{}{} within rounding{}", event.moved.empty() ? "" : "; ",
                            event.moved.empty()
                                ? fmt::format("{} of {}", counted(event.within_rounding, "reading"), counted(event.cells.size(), "cell"))
                                : fmt::format("{} more", event.within_rounding),
                            event.most_within > 0.0 ? ", at most " + told_percent(event.most_within) : "");
    if (event.told_apart && !event.moved.empty())
        text += told_split(findings, event);
    return text;
}

std::string told_drift(const HistoryFindings& findings, const HistoryDrift& drift) {
    const std::string beyond = drift.exceeded
                                   ? fmt::format("beyond {} since {}", told_percent(findings.drift_bound), findings.when(*drift.exceeded))
                                   : fmt::format("not beyond {} so far", told_percent(findings.drift_bound));
    return fmt::format("{} to {}: drift in {} nights; {}, {}; {}", findings.when(drift.nights.front()), findings.when(drift.nights.back()),
                       drift.nights.size(), told_moved(findings, findings.nights[drift.nights.back()], drift.moved), beyond,
                       phrase_of(drift.causes));
}

/// All of one night with the same causes in one sentence.
std::vector<std::string> told_times(const HistoryFindings& findings) {
    std::map<std::pair<std::size_t, InputChanges>, std::vector<HistoryTimes::Change>> together;
    for (const HistoryTimes::Change& change : findings.times.changes)
        together[{change.night, change.causes}].push_back(change);
    std::vector<std::string> told;
    for (const auto& [key, changes] : together) {
        const auto [least, most] = std::ranges::minmax_element(changes, {}, &HistoryTimes::Change::ratio);
        const double p = std::ranges::max_element(changes, {}, &HistoryTimes::Change::p)->p;
        std::string by = told_share(least->ratio - 1.0);
        if (changes.size() > 1)
            by += " to " + told_share(most->ratio - 1.0);
        told.push_back(
            fmt::format("{}: time a frame of {} {} (p at most {:.2g}); {}", findings.when(key.first),
                        changes.size() == 1 ? place_of(findings.nights[key.first], changes.front().cell) : counted(changes.size(), "cell"),
                        by, p, phrase_of(key.second)));
    }
    return told;
}

std::string base_words(const HistoryFindings& findings) {
    return findings.is_accepted() ? "the accepted night of " + findings.when(findings.base)
                                  : fmt::format("the first night, {} (none {}is accepted)", findings.when(findings.base),
                                                findings.tonight().accepted ? "before this one " : "");
}

std::string headline(const HistoryFindings& findings) {
    const char* const accepted = findings.tonight().accepted ? " This night is accepted itself: later ones are compared with it." : "";
    if (findings.is_first())
        return fmt::format("This is the first night in {}.{}", findings.nights.size() == 1 ? "the history" : "which anything was read",
                           accepted);
    const std::size_t nights = findings.nights.size() - 1 - findings.base;
    const std::string note = findings.before().note.empty() ? "" : fmt::format(" (\"{}\")", short_text(findings.before().note, 120));
    const std::string since = fmt::format("since {}{}, in {}", base_words(findings), note, counted(nights, "night"));
    const std::string absent =
        findings.absent.empty() ? "" : fmt::format(" {} cannot be compared.", counted(findings.absent.size(), "cell"));
    if (findings.nothing_changed() && findings.cells_compared == 0)
        return fmt::format("Nothing can be compared with {}{}: no cell was played in both nights.{}{}", base_words(findings), note, absent,
                           accepted);
    if (findings.nothing_changed())
        return fmt::format("Nothing changed {}: {} of {} are the same to the last bit.{}{}", since,
                           counted(findings.readings_compared, "reading"), counted(findings.cells_compared, "cell"), absent, accepted);
    std::vector<std::string> parts;
    const auto add = [&](std::size_t count, const std::string& what) {
        if (count > 0)
            parts.push_back(counted(count, what));
    };
    add(findings.events.size(), "change");
    add(findings.drifts.size(), "drift");
    add(told_times(findings).size(), "change");
    if (!findings.times.changes.empty())
        parts.back() += " of times";
    std::string all = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i)
        all += (i + 1 < parts.size() ? ", " : " and ") + parts[i];
    if (findings.came_back())
        return fmt::format("{} {}, and back: {} of {} are as then, to the last bit.{}{}", all, since,
                           counted(findings.readings_compared, "reading"), counted(findings.cells_compared, "cell"), absent, accepted);
    return fmt::format("{} {}.{}{}", all, since, absent, accepted);
}

Table moved_table(const std::string& name, const std::string& caption) {
    return {name, caption, columns_of("night<|cause<|lamp<|route<|reading<|before|now|unit<|change [%]"), {}};
}

std::string with_digits(double value, int digits) { return digits == 4 ? four_digits(value) : fmt::format("{:.{}g}", value, digits); }

/// As many as tell the two apart, four at least.
int digits_apart(const Value& before, const Value& now) {
    int digits = 4;
    if (before.measured() && now.measured() && before != now)
        while (digits < 17 &&
               with_bound(before, with_digits(*before.figure(), digits)) == with_bound(now, with_digits(*now.figure(), digits)))
            ++digits;
    return digits;
}

void add_moved_row(Table& table, const Night& in, const std::string& night, const std::string& cause, const MovedReading& moved) {
    const NightCell& cell = night_cell(in, moved.cell);
    const int digits = digits_apart(moved.before, moved.now);
    const auto value = [&](const Value& one) {
        return one.measured() ? Cell(with_bound(one, with_digits(*one.figure(), digits)), *one.figure()) : Cell("not measured");
    };
    const std::optional<ReadingKey> key = key_of(moved.reading);
    const std::optional<double> share = moved.share();
    table.rows.push_back(
        {night, cause, cell.lamp, cell.drive + (cell.condition.empty() ? "" : ", " + cell.condition),
         Cell(label_of_reading(moved.reading)).hinted(moved.reading), value(moved.before), value(moved.now),
         key ? unit_label(unit_of(*key)) : "",
         share ? Cell(fmt::format("{}{}", *share < 0 ? "−" : "+", four_digits(100.0 * std::abs(*share))), 100.0 * *share) : Cell("")});
}

void add_moved_rows(Table& table, const Night& in, const std::string& night, const std::string& cause,
                    const std::vector<MovedReading>& moved) {
    for (std::size_t i = 0; i < std::min(most_rows, moved.size()); ++i)
        add_moved_row(table, in, night, cause, moved[i]);
}

Section readings_section(const HistoryFindings& findings) {
    Section section{"The readings that moved", {}};
    Table table = moved_table(
        "moved", fmt::format("Of each change {} readings, what decides first, then the largest; `fernlicht history trend` shows the others",
                             most_rows));
    for (const HistoryEvent& event : findings.events)
        add_moved_rows(table, findings.nights[event.night], findings.when(event.night), causes_of(event.causes), event.moved);
    for (const HistoryDrift& drift : findings.drifts)
        add_moved_rows(table, findings.nights[drift.nights.back()], "from " + findings.when(drift.nights.front()),
                       "drift: " + causes_of(drift.causes), drift.moved);
    if (!table.rows.empty())
        section.blocks.emplace_back(std::move(table));
    Table since = moved_table("since", fmt::format("In sum: tonight off {}", base_words(findings)));
    since.columns.erase(since.columns.begin(), since.columns.begin() + 2);
    for (std::size_t i = 0; i < std::min(most_since, findings.since.size()); ++i) {
        add_moved_row(since, findings.tonight(), "", "", findings.since[i]);
        since.rows.back().erase(since.rows.back().begin(), since.rows.back().begin() + 2);
    }
    since.off_terminal = since.folded = true;
    if (!since.rows.empty())
        section.blocks.emplace_back(std::move(since));
    return section;
}

Section apart_section(const HistoryFindings& findings) {
    Section section{"Told apart", {}};
    for (const HistoryEvent& event : findings.events) {
        if (!event.told_apart || event.told_apart->parts.empty())
            continue;
        Table table{fmt::format("apart-{}", section.blocks.size() + 1),
                    fmt::format("{}, {}: {}", findings.when(event.night), place_of(findings.nights[event.night], event.told_apart->cell),
                                phrase_of(event.causes)),
                    columns_of("reading<|before|new program, inputs before|now|unit<"),
                    {}};
        const std::vector<ToldApart::Part>& parts = event.told_apart->parts;
        for (std::size_t i = 0; i < std::min(most_rows, parts.size()); ++i) {
            const auto value = [](const Value& one) {
                return one.measured() ? Cell(with_bound(one, four_digits(*one.figure())), *one.figure()) : Cell("not measured");
            };
            const std::optional<ReadingKey> key = key_of(parts[i].reading);
            table.rows.push_back({Cell(label_of_reading(parts[i].reading)).hinted(parts[i].reading), value(parts[i].before),
                                  value(parts[i].with_earlier_inputs), value(parts[i].now), key ? unit_label(unit_of(*key)) : ""});
        }
        section.blocks.emplace_back(std::move(table));
    }
    return section;
}

Section times_section(const HistoryFindings& findings) {
    Section section{"Times", {}};
    const HistoryTimes& times = findings.times;
    if (times.cells == 0) {
        section.blocks.emplace_back(
            fmt::format("No cell was timed by itself in {} nights or more: no change of times can be told.", fewest_samples_of_change));
        return section;
    }
    section.blocks.emplace_back(fmt::format(
        "Frames of {}, timed in up to {}. Readings are exact, times are not: p is the share of {} random orders of the nights or more in "
        "which two "
        "levels lie as far apart (permutation test of the largest step of the logarithms). A change is claimed where p passes the "
        "procedure "
        "of Benjamini and Hochberg over all cells, at a false discovery rate of {} %.",
        counted(times.cells, "cell"), counted(times.nights, "night"), orders_of_change + 1, 100.0 * times.rate));
    Table table{"times", "", columns_of("night<|lamp<|route<|time a frame [%]|p|cause<"), {}};
    for (const HistoryTimes::Change& change : times.changes) {
        const NightCell& cell = night_cell(findings.nights[change.night], change.cell);
        table.rows.push_back({findings.when(change.night), cell.lamp, cell.drive + (cell.condition.empty() ? "" : ", " + cell.condition),
                              Cell(signed_figure(100.0 * (change.ratio - 1.0), 1), 100.0 * (change.ratio - 1.0)),
                              Cell(fmt::format("{:.2g}", change.p), change.p), phrase_of(change.causes)});
    }
    if (!table.rows.empty())
        section.blocks.emplace_back(std::move(table));
    return section;
}

Section frames_section(const HistoryFindings& findings) {
    Section section{"Before and after", {}};
    for (const NightFrames& pair : findings.frames)
        section.blocks.emplace_back(PictureStrip{
            pair.title, {{pair.before, findings.when(findings.base)}, {pair.after, findings.when(findings.nights.size() - 1)}}});
    if (!findings.no_frames.empty())
        section.blocks.emplace_back(findings.no_frames);
    return section;
}

} // namespace

std::string when_of(const std::vector<Night>& nights, std::size_t night) {
    std::string when;
    for (const std::size_t digits : {10U, 16U, 19U}) { // date, minutes, seconds
        when = nights[night].played_utc.substr(0, digits);
        if (std::ranges::count_if(nights, [&](const Night& one) { return one.played_utc.starts_with(when); }) == 1)
            break;
    }
    std::ranges::replace(when, 'T', ' ');
    return when;
}

std::string HistoryFindings::when(std::size_t night) const { return when_of(nights, night); }

std::string label_of_reading(const std::string& name) {
    if (name == timed_frame)
        return "time a frame";
    const std::optional<ReadingKey> key = key_of(name);
    return key ? reading_label(*key) : short_text(name, 80);
}

std::string told_value(const std::string& reading, const Value& value, int digits) {
    if (!value.measured())
        return "not measured";
    const std::optional<ReadingKey> key = key_of(reading);
    return with_bound(value, with_digits(*value.figure(), digits)) + (reading == timed_frame ? " s"
                                                                      : key                  ? unit_suffix(unit_of(*key))
                                                                                             : "");
}

std::string told_step(const std::string& reading, const Value& before, const Value& now) {
    const int digits = digits_apart(before, now);
    return told_value(reading, before, digits) + " → " + told_value(reading, now, digits);
}

std::string told_share(const std::optional<double>& share) {
    return !share ? "" : (*share < 0.0 ? "−" : *share > 0.0 ? "+" : "") + told_percent(std::abs(*share));
}

std::string clock_warning(const HistoryFindings& findings) {
    if (findings.ahead.empty())
        return "";
    const std::size_t last = findings.ahead.back(), others = findings.ahead.size() - 1;
    return fmt::format(
        "The night of {}{} is dated after this one of {}, though it was added before: this machine's clock or that night's was wrong. "
        "Nights are compared in the order in which they were added. Set this clock if it is wrong; if that night's was, accept a night "
        "that is dated rightly: `fernlicht history accept last`.",
        findings.when(last), others > 0 ? fmt::format(", as {} before it,", counted(others, "other")) : "",
        findings.when(findings.nights.size() - 1));
}

Section changes_section(const HistoryFindings& findings) {
    Section section{findings.is_first() ? "The first night" : "What changed since " + findings.when(findings.base), {headline(findings)}};
    if (!findings.ahead.empty())
        section.blocks.emplace_back(clock_warning(findings));
    std::vector<std::pair<std::size_t, std::string>> claims;
    for (const HistoryEvent& event : findings.events)
        claims.emplace_back(event.night, told_event(findings, event));
    for (const HistoryDrift& drift : findings.drifts)
        claims.emplace_back(drift.nights.front(), told_drift(findings, drift));
    std::ranges::stable_sort(claims, {}, &std::pair<std::size_t, std::string>::first);
    Listing listing;
    for (auto& [night, claim] : claims)
        listing.items.emplace_back(std::move(claim));
    for (std::string& claim : told_times(findings))
        listing.items.emplace_back(std::move(claim));
    if (!listing.items.empty())
        section.blocks.emplace_back(std::move(listing));
    const auto list = [&](const std::vector<std::string>& sentences, const std::string& caption) {
        if (sentences.empty())
            return;
        Listing told(std::vector<std::string>(sentences.begin(),
                                              sentences.begin() + static_cast<std::ptrdiff_t>(std::min(most_rows, sentences.size()))));
        told.caption = caption;
        if (sentences.size() > most_rows)
            told.items.emplace_back(fmt::format("and {} more", sentences.size() - most_rows));
        section.blocks.emplace_back(std::move(told));
    };
    list(findings.absent, "Cells that cannot be compared");
    list(findings.quiet, "Changed, and moved no reading");
    return section;
}

std::vector<Section> history_sections(const HistoryFindings& findings) {
    std::vector<Section> sections{changes_section(findings)};
    if (findings.is_first())
        return sections;
    Section lines{"Lamp by lamp and route by route", {}, 2, true};
    for (Plot& plot : sparklines(findings))
        lines.blocks.emplace_back(std::move(plot));
    for (Section& section : std::vector<Section>{readings_section(findings), apart_section(findings), times_section(findings),
                                                 std::move(lines), frames_section(findings)})
        if (!section.blocks.empty())
            sections.push_back(std::move(section));
    return sections;
}

Document document(const HistoryFindings& findings) {
    return {fmt::format("{}, night of {}", short_text(findings.study, 120), findings.when(findings.nights.size() - 1)),
            history_sections(findings)};
}

} // namespace fernlicht
