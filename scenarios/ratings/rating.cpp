#include "scenarios/ratings/rating.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>

namespace fernlicht {
namespace {

constexpr int rating_version = 1;
constexpr std::size_t most_rows = 200, most_ranges = 100;
constexpr double farthest_judged_m = 2000.0, most_points = 1.0e6, most_lux = 1.0e6;

FieldRule known() { return words({known_words[0], known_words[1]}); }

const Fields<Photometer>& photometer_fields() {
    static const Fields<Photometer> fields =
        Fields<Photometer>{
            field("on", 1, &Photometer::on, a_name(), "road user of the drive that carries it, by name"),
            field("position_m", 2, &Photometer::position_m, range(-100.0, 100.0),
                  "on it: x forward from its rear axle, y left, z up from the road"),
            field("at_m", 3, &Photometer::at_m, range(0.0, 1.0e6), "instead: beside the road, so far along the route from its start"),
            field("across", 4, &Photometer::across, words(across_words), "where across the road: centres of lanes, edges of driving lanes"),
            field("above_m", 5, &Photometer::above_m, range(0.0, 50.0), "above the road"),
            field("faces", 6, &Photometer::faces, words({"lamps", "forward", "backward"}),
                  "lamps: each lamp, without a cosine; else as the road user does, beside the road as the own car"),
            field("is", 7, &Photometer::is, known(), "whether a source states the place").required(),
            field("why", 8, &Photometer::why, any(), "the source, or the reason"),
        }
            .checked([](const YamlMap& keys, const Photometer& photometer) {
                if (photometer.on.empty() && !photometer.at_m)
                    keys.refuse_missing("on", "on: a road user, with position_m; or at_m: a place along the route");
                for (const char* const key : {"at_m", "across", "above_m"})
                    if (const auto given = keys.find(key); given && !photometer.on.empty())
                        given->refuse(fmt::format("{} beside on", key), "one of them");
                if (const auto place = keys.find("position_m"); place && photometer.on.empty())
                    place->refuse("position_m without on", "on: the road user whose frame it is in");
            });
    return fields;
}

const Fields<LimitRange>& range_fields() {
    using Range = LimitRange;
    static const Fields<Range> fields =
        Fields<Range>{
            field("from_m", 1, &Range::from_m, range(0.0, farthest_judged_m), "the nearer end").required(),
            field("to_m", 2, &Range::to_m, range(0.0, farthest_judged_m), "the farther one").required(),
            field("at_most_lx", 3, &Range::at_most_lx, above(0.0, most_lux), "the limit; without one light is told alone"),
            field("at_most_lx_far", 4, &Range::at_most_lx_far, above(0.0, most_lux),
                  "what it runs to at to_m, linearly; the same by default"),
        }
            .checked([](const YamlMap& keys, const Range& one) {
                if (!(one.from_m < one.to_m))
                    keys.require("to_m").refuse("a range that ends before it begins", fmt::format("more than from_m, {:g} m", one.from_m));
                if (const auto far = keys.find("at_most_lx_far"); far && !one.at_most_lx)
                    far->refuse("at_most_lx_far without at_most_lx", "both");
            });
    return fields;
}

const Fields<LimitCurve>& curve_fields() {
    static const Fields<LimitCurve> fields =
        Fields<LimitCurve>{
            field("is", 1, &LimitCurve::is, known(), "whether a source states the limits").required(),
            field("why", 2, &LimitCurve::why, any(), "the source, or the reason"),
            list("ranges", 3, &LimitCurve::ranges, 1, most_ranges, range_fields(), "of distance, the nearest first").required(),
        }
            .checked([](const YamlMap& keys, const LimitCurve& curve) {
                for (std::size_t i = 1; i < curve.ranges.size(); ++i)
                    if (curve.ranges[i].from_m < curve.ranges[i - 1].to_m)
                        keys.require("ranges").list(0, most_ranges)[i].refuse(
                            fmt::format("a range from {:g} m", curve.ranges[i].from_m),
                            fmt::format("at least {:g} m, where the one before ends", curve.ranges[i - 1].to_m));
            });
    return fields;
}

void read_existing_drive(const YamlEntry& entry, RatingRow& row) {
    row.drive = entry.path();
    check_file(row.drive, entry);
}

void read_points_by(const YamlEntry& entry, RatingRow& row) {
    row.points_by.clear();
    for (const YamlEntry& pair : entry.list(2, 100)) {
        const std::vector<double> two = pair.numbers(2, 2, -1.0e9, 1.0e9);
        if (!row.points_by.empty() && two[0] <= row.points_by.back().first)
            pair.refuse("a reading that is not above the one before", "pairs [reading, points] with readings that rise");
        row.points_by.emplace_back(two[0], two[1]);
        row.points = std::max(row.points_by.size() > 1 ? row.points : two[1], two[1]);
    }
}

std::string points_by_text(const RatingRow& row) {
    std::vector<std::string> pairs;
    for (const auto& [value, points] : row.points_by)
        pairs.push_back(fmt::format("[{}, {}]", value, points));
    return pairs.empty() ? "" : fmt::format("[{}]", fmt::join(pairs, ", "));
}

void check_row(const YamlMap& keys, const RatingRow& row) {
    const auto only_of = [&](bool of_reading, std::initializer_list<const char*> others) {
        for (const char* const key : others)
            if (const auto given = keys.find(key); given && row.of_reading() == of_reading)
                given->refuse(fmt::format("{} of a row of {}", key, of_reading ? "a reading" : "light on photometers"), "none");
    };
    if (row.of_reading() == !row.photometers.empty())
        keys.refuse_missing("reading", "reading, or photometers and limits; one of them");
    only_of(true, {"limits", "from_m", "to_m", "speed_kmh", "radius_m"});
    only_of(false, {"at_least", "at_most", "points_by"});
    if (!row.of_reading())
        keys.require("limits");
    if (row.at_least && row.at_most && *row.at_least > *row.at_most)
        keys.require("at_most").refuse("a limit that no reading keeps", fmt::format("at least at_least, {:g}", *row.at_least));
    if (!(row.from_m < row.to_m))
        keys.require("to_m").refuse("a distance that ends before it begins", fmt::format("more than from_m, {:g} m", row.from_m));
    for (const char* const key : {"speed_kmh", "radius_m"})
        if (const auto given = keys.find(key); given && given->numbers(2, 2, -1.0e5, 1.0e5)[0] > given->numbers(2, 2, -1.0e5, 1.0e5)[1])
            given->refuse("a greatest value below the least", "[least, greatest]");
    if (keys.find("points") && keys.find("points_by"))
        keys.require("points").refuse("points beside points_by", "one of them");
}

const Fields<RatingRow>& row_fields() {
    using Row = RatingRow;
    static const Fields<Row> fields =
        Fields<Row>{
            field("title", 1, &Row::title, any(), "for people; the row's name by default"),
            field("drive", 2, &Row::drive, any(), "what is driven; relative to the rating's file").read_by(read_existing_drive).required(),
            field("lamp_set", 3, &Row::lamp_set, a_name(), "of the lamps under test; the one that is rated by default"),
            field("reading", 4, &Row::reading, any(), "of the drive, as `fernlicht readings` lists them; or photometers"),
            field("at_least", 5, &Row::at_least, range(-1.0e12, 1.0e12), "in the reading's unit; without a limit it is told alone"),
            field("at_most", 6, &Row::at_most, range(-1.0e12, 1.0e12), "in the reading's unit"),
            field("photometers", 7, &Row::photometers, names(1, 32), "on which light is judged while the car comes nearer"),
            field("limits", 8, &Row::limits, a_name(), "by which; of the rating's limits"),
            field("from_m", 9, &Row::from_m, range(0.0, farthest_judged_m), "the nearest distance that is measured"),
            field("to_m", 10, &Row::to_m, range(0.0, farthest_judged_m), "the farthest"),
            field("speed_kmh", 11, &Row::speed_kmh, numbers(2, 2, 0.0, 540.0), "least and greatest speed of the drive there"),
            field("radius_m", 12, &Row::radius_m, numbers(2, 2, -1.0e5, 1.0e5),
                  "least and greatest radius of its path there, left positive"),
            field("is", 13, &Row::is, known(), "whether a source states the row").required(),
            field("why", 14, &Row::why, any(), "the source, or the reason"),
            field("points", 15, &Row::points, range(0.0, most_points), "if it is within its limits").written_off_default(),
            own<Row>("points_by", 16, read_points_by, points_by_text,
                     R"({"type": "array", "minItems": 2, "maxItems": 100, "items": {"type": "array", "minItems": 2, "maxItems": 2,
                         "items": {"type": "number"}}})",
                     "instead: pairs of reading and points, linear between"),
            field("weight", 17, &Row::weight, range(0.0, most_points), "on its points"),
            field("cap", 18, &Row::cap, range(0.0, most_points), "the most that the whole gets if the row exceeds a limit"),
        }
            .block()
            .checked(check_row);
    return fields;
}

const Fields<MomentaryExcess>& excess_fields() {
    using Excess = MomentaryExcess;
    static const Fields<Excess> fields{
        field("allowed", 1, &Excess::allowed, any(), "true: such light does not count").required(),
        field("percent", 2, &Excess::percent, range(0.0, 1000.0), "above the limit"),
        field("for_s", 3, &Excess::for_s, range(0.0, 100.0), "at a time"),
        field("for_m", 4, &Excess::for_m, range(0.0, 1000.0), "or so far"),
        field("is", 5, &Excess::is, known(), "whether a source states it"),
        field("why", 6, &Excess::why, any(), "the source, or the reason"),
    };
    return fields;
}

const Fields<JudgingRules>& distance_fields() {
    using Rules = JudgingRules;
    static const Fields<Rules> fields{
        field("from", 1, &Rules::from, words({"lamps", "bumper"}), "the middle of the lamps, or of the front bumper"),
        field("to", 2, &Rules::to, words({"photometer", "road-user"}),
              "the photometer, or the nearer end of the road user that carries it"),
        field("is", 3, &Rules::distance_is, known(), "whether a source states it").required(),
    };
    return fields;
}

const Fields<JudgingRules>& rules_fields() {
    using Rules = JudgingRules;
    static const Fields<Rules> fields{
        section("distance", 1, distance_fields(), "from where to where it runs, horizontally"),
        field("pitch_off_mean_deg", 2, &Rules::pitch_off_mean_deg, range(0.0, 90.0),
              "moments whose pitch is farther off the mean over the distance measured are left out; none by default"),
        field("round_lx", 3, &Rules::round_lx, above(0.0, 1000.0),
              "light and limits are rounded to multiples, as ASTM E29 rounds; not by default"),
        field("momentary_excess", 4, &Rules::excess, excess_fields(), "light above a limit for a moment"),
    };
    return fields;
}

void check_grades(const YamlMap& keys, const Rating& rating) {
    for (std::size_t i = 1; i < rating.grades.size(); ++i)
        if (rating.grades[i].from_points <= rating.grades[i - 1].from_points)
            keys.require("grades").refuse("grades that do not rise", "the lowest grade first");
}

/// That what rows name is there. Those keys were read before.
void check_names(const YamlMap& keys, Rating& rating) {
    const auto refuse_unknown = [&](const YamlEntry& entry, const std::string& name, const char* what, const auto& known) {
        std::vector<std::string> known_names;
        for (const auto& one : known)
            known_names.push_back(one.name);
        if (std::ranges::find(known_names, name) == known_names.end())
            entry.refuse(fmt::format("no {} '{}' in this rating", what, printable(name)), one_of_names(name, known_names));
    };
    const auto rows = keys.require("rows").named(most_rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        RatingRow& row = rating.rows[i];
        row.line = rows[i].second.value().line;
        if (row.title.empty())
            row.title = row.name;
        if (row.of_reading())
            continue;
        const YamlMap given = rows[i].second.map(keys_of(row_fields()));
        refuse_unknown(given.require("limits"), row.limits, "limits", rating.limits);
        for (const YamlEntry& entry : given.require("photometers").list(1, 32))
            refuse_unknown(entry, entry.name(), "photometer", rating.photometers);
        const LimitCurve& curve = *limits_named(rating, row.limits);
        if (std::ranges::none_of(curve.ranges, [&](const LimitRange& one) { return one.from_m < row.to_m && one.to_m > row.from_m; }))
            given.require("limits").refuse("limits that have no range where the row measures", "some between from_m and to_m");
        if (row.points > 0.0 && std::ranges::none_of(curve.ranges, [](const LimitRange& one) { return one.at_most_lx.has_value(); }))
            given.require("points").refuse("points of a row that no limit judges", "at_most_lx in its limits, or no points");
    }
}

template <class Named> const Named* named_one(const std::vector<Named>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &Named::name);
    return found == all.end() ? nullptr : &*found;
}

} // namespace

const Fields<Rating>& rating_fields() {
    static const Fields<Rating> fields =
        Fields<Rating>{
            form<Rating>("fernlicht_rating", FieldKind::own, {}, "version of this schema").schema_by(R"({"const": 1})").required(),
            field("title", 1, &Rating::title, any(), "for people; the file's name by default"),
            field("modelled_on", 2, &Rating::modelled_on, any(), "regulation or test that it follows; none by default"),
            field("edition", 3, &Rating::edition, any(), "of that, or the version of the rating").required(),
            field("source", 4, &Rating::source, any(), "where its figures come from").required(),
            field("unsettled", 5, &Rating::unsettled, texts(0, 50),
                  "what the sources do not settle, a sentence each; told in every result"),
            inlined(6, &Rating::rules, rules_fields()),
            named("photometers", 7, &Rating::photometers, 100, photometer_fields(), "places of judgement"),
            named("limits", 8, &Rating::limits, 100, curve_fields(), "of light on photometers, over distance"),
            named("rows", 9, &Rating::rows, most_rows, row_fields(), "what is judged").required(),
            named("grades", 10, &Rating::grades, 20,
                  Fields<Grade>{field("from_points", 1, &Grade::from_points, range(-1.0e9, 1.0e9), "of the whole")}.bare(),
                  "names for so many points and more, the lowest first"),
        }
            .block()
            .checked(check_grades);
    return fields;
}

Rating read_rating(const std::filesystem::path& file) {
    Rating rating;
    rating.file = file;
    const YamlValue document = parse_yaml(to_utf8(read_file(file, rating.opened, std::size_t{1} << 20)), file);
    const YamlMap keys(YamlEntry(document, file, ""), keys_of(rating_fields()));
    if (keys.require("fernlicht_rating").whole(0, 1'000'000) != rating_version)
        keys.require("fernlicht_rating").refuse(fmt::format("{}, the version of the rating file's schema", rating_version));
    rating.name = name_from(file);
    rating.title = rating.name;
    read_group(rating_fields(), keys, &rating);
    check_names(keys, rating);
    return rating;
}

const Photometer* photometer_named(const Rating& rating, const std::string& name) { return named_one(rating.photometers, name); }

const LimitCurve* limits_named(const Rating& rating, const std::string& name) { return named_one(rating.limits, name); }

} // namespace fernlicht
