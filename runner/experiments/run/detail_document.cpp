#include "runner/experiments/run/run_document.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

bool same_name(const Reading& a, const Reading& b) { return a.key == b.key && a.tick == b.tick; }

/// What tells one reading of a drive from another; the lamp set does not, and where it was found only if one lamp set has several.
bool same_reading(const ComparedDrive& drive, const Reading& a, const Reading& b) {
    return same_name(a, b) && (a.where == b.where || std::ranges::none_of(drive.lamp_sets, [&](const PlayedCell* played) {
                                   return std::ranges::count_if(played->readings, [&](const Reading& r) { return same_name(r, a); }) > 1;
                               }));
}

std::string unit_text(const std::string& unit) {
    return unit == "m2" ? "m\u00b2" : unit == "cd/m2" ? "cd/m\u00b2" : unit == "1" ? "" : unit;
}

const Reading* own_reading(const ComparedDrive& drive, const PlayedCell& played, const Reading& wanted) {
    const auto own = std::ranges::find_if(played.readings, [&](const Reading& reading) { return same_reading(drive, reading, wanted); });
    return own == played.readings.end() ? nullptr : &*own;
}

/// Of each lamp set where they differ: the eye is adapted to each one's light.
std::string where_text(const ComparedDrive& drive, const Reading& wanted) {
    std::string text;
    bool differ = false;
    for (const PlayedCell* const played : drive.lamp_sets)
        if (const Reading* own = own_reading(drive, *played, wanted)) {
            differ = differ || own->where != wanted.where;
            text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", short_text(played->lamp_set, 30), own->where);
        }
    return differ ? text : wanted.where;
}

Cell reading_cell(const Reading* own) {
    if (!own)
        return "not asked for";
    if (!own->value.measured())
        return "not measured: " + own->value.reason();
    return {with_bound(own->value, fmt::format("{:.5g}", *own->value.figure())), *own->value.figure()};
}

void add_readings(const ComparedDrive& drive, Sections& sections) {
    Table table{drive.name + "-readings", "", columns_of("reading`"), {}};
    Readings distinct;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        table.columns.push_back({.head = short_text(drive.lamp_sets[i]->lamp_set, 30), .series = i});
        for (const Reading& reading : drive.lamp_sets[i]->readings)
            if (std::ranges::none_of(distinct, [&](const Reading& other) { return same_reading(drive, other, reading); }))
                distinct.push_back(reading);
    }
    for (const char* const head : {"unit", "where", "frame"})
        table.columns.push_back({.head = head, .words = true});
    for (const Reading& reading : distinct) {
        std::vector<Cell>& row = table.rows.emplace_back(std::vector<Cell>{reading.name()});
        for (const PlayedCell* const played : drive.lamp_sets)
            row.push_back(reading_cell(own_reading(drive, *played, reading)));
        row.insert(row.end(), {unit_text(reading.unit()), where_text(drive, reading),
                               reading.tick < 0 ? "whole drive" : fmt::format("{}", reading.tick)});
    }
    if (!distinct.empty())
        sections.push_back({"Readings", {std::move(table)}, 3});
}

/// Each sentence once; those that do not hold for every lamp set name theirs.
std::vector<std::string> merged(const ComparedDrive& drive, std::vector<std::string> PlayedCell::*sentences) {
    std::vector<std::string> distinct, out;
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const std::string& sentence : played->*sentences)
            if (std::ranges::find(distinct, sentence) == distinct.end())
                distinct.push_back(sentence);
    for (const std::string& sentence : distinct) {
        std::string names;
        std::size_t count = 0;
        for (const PlayedCell* const played : drive.lamp_sets)
            if (std::ranges::find(played->*sentences, sentence) != (played->*sentences).end()) {
                names += (names.empty() ? "" : ", ") + short_text(played->lamp_set, 40);
                ++count;
            }
        out.push_back((count == drive.lamp_sets.size() ? "" : names + ": ") + sentence);
    }
    return out;
}

Table lamps_table(const ComparedDrive& drive) {
    Table table{drive.name + "-lamps", "", columns_of("lamp set<|lamps<|moments played|of"), {}};
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const PlayedCell& played = *drive.lamp_sets[i];
        std::string files;
        for (const auto& [place, file] : played.lamps)
            files += (files.empty() ? "" : "; ") + place + ": " + file;
        table.rows.push_back({lamp_cell(drive, i), files, fmt::format("{}", played.ticks_done), fmt::format("{}", played.ticks_planned)});
    }
    return table;
}

/// "shadow maps: nothing stands in a beam" in two.
Table left_out_table(const ComparedDrive& drive) {
    Table table{drive.name + "-left-out", "", columns_of("what<|why<"), {}};
    for (const std::string& sentence : merged(drive, &PlayedCell::left_out)) {
        const std::size_t colon = sentence.rfind(": ");
        table.rows.push_back({sentence.substr(0, colon), colon == std::string::npos ? "" : sentence.substr(colon + 2)});
    }
    return table;
}

Cell median_ms(const std::vector<double>& seconds) {
    const double ms = 1e3 * spread_of(seconds).value().median;
    return {figure(ms, 2), ms};
}

std::string savings_words(const PruningSavings& savings) {
    const std::optional<PairedRatio> ratio = savings.ratio();
    if (!ratio)
        return "not measured: " + savings.not_measured;
    const std::string pruned = median_ms(savings.pruned_s).text + " ms", unpruned = median_ms(savings.unpruned_s).text + " ms";
    const std::string spread = fmt::format("(ratio {}, {} … {} over {} rounds)", figure(ratio->median, 2), figure(ratio->p05, 2),
                                           figure(ratio->p95, 2), ratio->rounds);
    if (ratio->difference == Difference::not_distinguishable)
        return fmt::format("nothing that can be told from chance: {} a frame against {} {}", pruned, unpruned, spread);
    return fmt::format("{} instead of {} a frame {}{}", pruned, unpruned, spread,
                       ratio->difference == Difference::slower ? ": pruning made it slower" : "");
}

void add_savings_of(const ComparedDrive& drive, Sections& sections) {
    Listing sentences;
    Table table{
        drive.name + "-savings",
        "",
        columns_of("lamp<|rendered<|median [ms]|passes|pieces|textures read [at most]|features compiled in|triangles|fragments shaded"),
        {}};
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const PruningSavings& savings = drive.lamp_sets[i]->savings;
        if (savings.not_measured.empty() && !savings.ratio())
            continue; // the run ended before
        const Cell lamp = lamp_cell(drive, i);
        sentences.items.push_back(lamp.text + ": " + savings_words(savings));
        if (savings.ratio())
            for (const auto& [what, seconds, work] : {std::tuple("as in this run", &savings.pruned_s, &savings.pruned),
                                                      std::tuple("unpruned", &savings.unpruned_s, &savings.unpruned)}) {
                table.rows.push_back({lamp, what, median_ms(*seconds), fmt::format("{}", work->passes), fmt::format("{}", work->draws),
                                      fmt::format("{}", work->samplers), fmt::format("{}", work->features),
                                      fmt::format("{}", work->triangles), fmt::format("{}", work->fragments)});
            }
    }
    if (sentences.items.empty())
        return;
    Section& section = sections.emplace_back(Section{
        "What pruning saves", {"The driver’s view, rendered in turns as in this run and unpruned, to the same bytes.", sentences}, 4});
    if (!table.rows.empty())
        section.blocks.emplace_back(std::move(table));
}

} // namespace

void add_details(const ComparedDrive& drive, Sections& sections) {
    add_readings(drive, sections);
    sections.push_back({"Lamps, notes, what was pruned or left out", {lamps_table(drive)}, 3});
    if (std::vector<std::string> notes = merged(drive, &PlayedCell::notes); !notes.empty())
        sections.push_back({"Notes", {Listing(notes)}, 4});
    if (Table left_out = left_out_table(drive); !left_out.rows.empty())
        sections.push_back({"Pruned or left out", {std::move(left_out)}, 4});
    add_savings_of(drive, sections);
}

} // namespace fernlicht
