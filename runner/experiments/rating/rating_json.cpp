#include "runner/experiments/rating/rating_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/context_json.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace fernlicht {
namespace {

auto verdict_words() {
    return [] { return std::vector<std::string>(std::begin(rating_verdict_words), std::end(rating_verdict_words)); };
}
auto all_known_words() {
    return [] { return std::vector<std::string>(std::begin(known_words), std::end(known_words)); };
}

JsonMembers worst_members(LightSample& sample) {
    return {{"tick", sample.tick},
            {"time_s", sample.time_s},
            {"distance_m", sample.distance_m},
            {"lx", sample.lx},
            {"pitch_deg", sample.pitch_deg}};
}

JsonMembers range_members(RangeJudgement& judged) {
    const bool limited = judged.limit_lx.has_value();
    return {{"from_m", judged.range.from_m},
            {"to_m", judged.range.to_m},
            {"at_most_lx", judged.range.at_most_lx},
            {"at_most_lx_far", judged.range.at_most_lx_far},
            {"verdict", one_of(judged.verdict, verdict_words())},
            {"why_not_measured", or_null(judged.why)},
            {"lx", judged.lx},
            {"limit_lx", judged.limit_lx},
            {"margin", limited ? std::optional(judged.margin()) : std::nullopt},
            {"worst", judged.worst, worst_members},
            {"samples", judged.samples},
            {"left_out", judged.left_out},
            {"excused", judged.excused}};
}

JsonMembers photometer_members(PhotometerFound& found) {
    return {{"photometer", found.photometer.name},
            {"place_is", one_of(found.photometer.is, all_known_words())},
            {"verdict", one_of(found.verdict, verdict_words())},
            {"mean_pitch_deg", found.pitch_deg},
            {"ranges", found.ranges, range_members},
            {"lx_aimed_higher", found.higher_lx}};
}

JsonMembers rating_note_members(RatingNote& note) { return {{"note", note.note}, {"drives", note.drives}}; }

JsonMembers rated_row_members(RowFound& found) {
    return {{"row", found.row.name},
            {"title", found.row.title},
            {"drive", found.drive},
            {"lamp_set", or_null(found.row.lamp_set)},
            {"row_is", one_of(found.row.is, all_known_words())},
            {"verdict", one_of(found.verdict, verdict_words())},
            {"why_not_measured", or_null(found.why)},
            {"counts", found.counts},
            {"reading", or_null(found.row.reading)},
            {"unit", or_null(found.unit)},
            {"value", found.value},
            {"value_aimed_higher", found.higher},
            {"at_least", found.row.at_least},
            {"at_most", found.row.at_most},
            {"points", found.points},
            {"photometers", found.photometers, photometer_members}};
}

} // namespace

JsonMembers rating_members(RatingFound& found) {
    return {{"schema", json_constant("fernlicht rating")},
            {"schema_version", json_constant(1)},
            {"context", context_members(found.context)},
            {"rating", found.rating.name},
            {"title", found.rating.title},
            {"modelled_on", or_null(found.rating.modelled_on)},
            {"edition", found.rating.edition},
            {"source", found.rating.source},
            {"unsettled", found.rating.unsettled},
            {"momentary_excess_allowed", found.rating.rules.excess.allowed},
            {"lamps", found.lamps},
            {"lamp_set", found.lamp_set},
            {"verdict", std::string(rating_verdict_words[static_cast<std::size_t>(found.verdict())])},
            {"rows", found.rows, rated_row_members},
            {"points", found.score.points},
            {"most_points", found.score.most},
            {"capped_by", or_null(found.score.capped_by)},
            {"grade", or_null(found.score.grade)},
            {"notes", found.notes, rating_note_members}};
}

std::string rating_csv(const RatingFound& found) {
    std::string out = csv_line(std::string("row"), std::string("drive"), std::string("lamp_set"), std::string("judged"), std::string("is"),
                               std::string("from_m"), std::string("to_m"), std::string("value"), std::string("unit"), std::string("limit"),
                               std::string("margin"), std::string("time_s"), std::string("distance_m"), std::string("verdict"),
                               std::string("why_not_measured"));
    using Optional = std::optional<double>;
    for (const RowFound& row : found.rows) {
        const std::string lamp_set = row.row.lamp_set.empty() ? found.lamp_set : row.row.lamp_set;
        if (row.photometers.empty())
            out += csv_line(csv_text(row.row.name), csv_text(row.drive), csv_text(lamp_set),
                            csv_text(row.row.of_reading() ? row.row.reading : row.row.limits),
                            std::string(known_words[static_cast<std::size_t>(row.row.is)]), std::string(), std::string(),
                            csv_number(row.value.figure()), row.unit.empty() ? std::string("lx") : csv_text(row.unit),
                            csv_number(row.row.at_least ? row.row.at_least : row.row.at_most), std::string(), std::string(), std::string(),
                            std::string(rating_verdict_words[static_cast<std::size_t>(row.verdict)]), csv_text(row.why));
        for (const PhotometerFound& photometer : row.photometers)
            for (const RangeJudgement& range : photometer.ranges) {
                const bool limited = range.limit_lx.has_value();
                out += csv_line(csv_text(row.row.name), csv_text(row.drive), csv_text(lamp_set), csv_text(photometer.photometer.name),
                                std::string(known_words[static_cast<std::size_t>(photometer.photometer.is)]),
                                csv_number(range.range.from_m), csv_number(range.range.to_m), csv_number(range.lx), std::string("lx"),
                                csv_number(range.limit_lx), csv_number(limited ? Optional(range.margin()) : std::nullopt),
                                csv_number(range.worst ? Optional(range.worst->time_s) : std::nullopt),
                                csv_number(range.worst ? Optional(range.worst->distance_m) : std::nullopt),
                                std::string(rating_verdict_words[static_cast<std::size_t>(range.verdict)]), csv_text(range.why));
            }
    }
    return out;
}

std::string light_csv(const RatingFound& found) {
    std::string out = csv_line(std::string("row"), std::string("photometer"), std::string("tick"), std::string("time_s"),
                               std::string("distance_m"), std::string("lx"), std::string("pitch_deg"), std::string("left_out"));
    for (const RowFound& row : found.rows)
        for (const PhotometerFound& photometer : row.photometers)
            for (const LightSample& sample : photometer.approach)
                out += csv_line(csv_text(row.row.name), csv_text(photometer.photometer.name), fmt::format("{}", sample.tick),
                                csv_number(sample.time_s), csv_number(sample.distance_m), csv_number(sample.lx),
                                csv_number(sample.pitch_deg), std::string(sample.left_out ? "1" : "0"));
    return out;
}

} // namespace fernlicht
