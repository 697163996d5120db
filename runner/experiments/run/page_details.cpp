#include "runner/experiments/run/page_parts.h"
#include "runner/files/clean_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

/// What tells one reading of a drive from another; the lamp set does not.
bool same_reading(const Reading& a, const Reading& b) { return a.key == b.key && a.where == b.where && a.tick == b.tick; }

const Reading* find_reading(const PlayedVariant& played, const Reading& wanted) {
    const auto found =
        std::find_if(played.readings.begin(), played.readings.end(), [&](const Reading& reading) { return same_reading(reading, wanted); });
    return found == played.readings.end() ? nullptr : &*found;
}

std::string unit_text(const std::string& unit) {
    return unit == "m2" ? "m\u00b2" : unit == "cd/m2" ? "cd/m\u00b2" : unit == "1" ? "" : clean_text(unit);
}

data reading_row(const ComparedDrive& drive, const Reading& reading) {
    data row, cells{List::list};
    for (const PlayedVariant* const played : drive.variants) {
        const Reading* const own = find_reading(*played, reading);
        data cell;
        cell.set("measured", own && own->value.measured());
        cell.set("value", own && own->value.measured() ? with_bound(own->value, fmt::format("{:.5g}", *own->value.figure())) : "");
        cell.set("why_not", !own ? "not asked for" : own->value.measured() ? "" : "not measured: " + clean_text(own->value.reason()));
        cells.push_back(cell);
    }
    row.set("name", clean_text(reading.name()));
    row.set("cells", cells);
    row.set("unit", unit_text(reading.unit()));
    row.set("where", clean_text(reading.where));
    row.set("frame", reading.tick < 0 ? "whole drive" : fmt::format("{}", reading.tick));
    return row;
}

/// Each sentence once; those that do not hold for every lamp set name theirs.
std::vector<std::string> merged(const ComparedDrive& drive, std::vector<std::string> PlayedVariant::*sentences) {
    std::vector<std::string> distinct, out;
    for (const PlayedVariant* const played : drive.variants)
        for (const std::string& sentence : played->*sentences)
            if (std::find(distinct.begin(), distinct.end(), sentence) == distinct.end())
                distinct.push_back(sentence);
    for (const std::string& sentence : distinct) {
        std::string names;
        std::size_t count = 0;
        for (const PlayedVariant* const played : drive.variants)
            if (const auto& own = played->*sentences; std::find(own.begin(), own.end(), sentence) != own.end()) {
                names += (names.empty() ? "" : ", ") + short_text(played->variant, 40);
                ++count;
            }
        out.push_back((count == drive.variants.size() ? "" : names + ": ") + clean_text(sentence));
    }
    return out;
}

void set_list(data& part, const std::string& name, const std::vector<std::string>& texts) {
    data list{List::list};
    for (const std::string& text : texts)
        list.push_back(text);
    part.set("has_" + name, !texts.empty());
    part.set(name, list);
}

/// "shadow maps: nothing stands in a beam" in two.
data what_and_why(const std::string& sentence) {
    const std::size_t colon = sentence.rfind(": ");
    data row;
    row.set("what", sentence.substr(0, colon));
    row.set("why", colon == std::string::npos ? "" : sentence.substr(colon + 2));
    return row;
}

data lamp_set(const PlayedVariant& played, std::size_t index) {
    data row, files{List::list};
    for (const auto& [place, file] : played.lamps) {
        data lamp;
        lamp.set("place", clean_text(place));
        lamp.set("file", clean_text(file));
        files.push_back(lamp);
    }
    row.set("lamp", short_text(played.variant, 40));
    row.set("colour", variant_colour(index));
    row.set("files", files);
    row.set("done", fmt::format("{}", played.ticks_done));
    row.set("planned", fmt::format("{}", played.ticks_planned));
    return row;
}

} // namespace

data details_part(const ComparedDrive& drive) {
    data part, heads{List::list}, readings{List::list}, sets{List::list};
    Readings distinct;
    for (std::size_t i = 0; i < drive.variants.size(); ++i) {
        data head;
        head.set("lamp", short_text(drive.variants[i]->variant, 30));
        head.set("colour", variant_colour(i));
        heads.push_back(head);
        sets.push_back(lamp_set(*drive.variants[i], i));
        for (const Reading& reading : drive.variants[i]->readings)
            if (std::none_of(distinct.begin(), distinct.end(), [&](const Reading& other) { return same_reading(other, reading); }))
                distinct.push_back(reading);
    }
    for (const Reading& reading : distinct)
        readings.push_back(reading_row(drive, reading));
    part.set("heads", heads);
    part.set("sets", sets);
    part.set("has_readings", !distinct.empty());
    part.set("readings", readings);
    data left_out{List::list};
    for (const std::string& sentence : merged(drive, &PlayedVariant::left_out))
        left_out.push_back(what_and_why(sentence));
    part.set("has_left_out", left_out.is_non_empty_list());
    part.set("left_out", left_out);
    part.set("savings", savings_part(drive));
    part.set("shadows", shadows_part(drive));
    part.set("display", display_part(drive));
    set_list(part, "notes", merged(drive, &PlayedVariant::notes));
    return part;
}

} // namespace fernlicht
