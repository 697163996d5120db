#include "runner/experiments/rating/rating_run.h"

#include "metrics/folds/place_fold.h"
#include "metrics/folds/seeing_fold.h"
#include "metrics/importance/reading_of_light.h"
#include "metrics/rating/path_circle.h"
#include "runner/experiments/rating/rating_play.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/moment.h"
#include "scenarios/drives/play/nudge.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/light/light_gradient.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <numbers>

namespace fernlicht {
namespace {

/// Of a path that counts as one of a radius: FMVSS 108 S14.9.3.12. The arc from which on its own radius counts: as that laboratory fits it.
constexpr double most_off_circle_m = 0.5, least_arc_deg = 10.0;

/// Why the drive is not what the row asks for where it measures; "": it is.
std::string not_as_asked(const RatingRow& row, const LightApproach& approach, const std::vector<Approaches::Place>& all) {
    std::vector<glm::dvec2> places_m;
    double slowest = 1.0e9, fastest = 0.0;
    for (const LightSample& sample : approach) {
        if (sample.distance_m < row.from_m || sample.distance_m > row.to_m)
            continue;
        const Approaches::Place& place = all[static_cast<std::size_t>(sample.tick)];
        places_m.push_back(place.ego_m);
        slowest = std::min(slowest, 3.6 * place.speed_mps);
        fastest = std::max(fastest, 3.6 * place.speed_mps);
    }
    if (places_m.empty())
        return "no moment of the drive lies at the distances that are measured";
    if (!row.speed_kmh.empty() && (slowest < row.speed_kmh[0] - 1e-6 || fastest > row.speed_kmh[1] + 1e-6))
        return fmt::format("the car drives {:.1f} to {:.1f} km/h, asked for are {:g} to {:g}", slowest, fastest, row.speed_kmh[0],
                           row.speed_kmh[1]);
    if (row.radius_m.empty())
        return "";
    const std::optional<PathCircle> circle = path_circle(places_m);
    if (!circle)
        return "too few moments to know the path's radius";
    // A short arc does not tell its radius: any of the range will do that it follows.
    const double radius_m = std::clamp(circle->radius_m, row.radius_m[0], row.radius_m[1]);
    const bool told = circle->arc_rad >= least_arc_deg * std::numbers::pi / 180.0;
    if (off_circle_m(places_m, radius_m) > most_off_circle_m || (told && radius_m != circle->radius_m))
        return fmt::format("the path {} and is {:.2f} m off the nearest circle of {:g} to {:g} m",
                           std::isinf(circle->radius_m) ? std::string("is straight")
                                                        : fmt::format("has a radius of {:.1f} m (left positive)", circle->radius_m),
                           off_circle_m(places_m, radius_m), row.radius_m[0], row.radius_m[1]);
    return "";
}

/// The same with all lamps aimed a little higher.
void add_higher(PhotometerFound& found, LightApproach higher, const Rating& rating, const RatingRow& row, const LimitCurve& limits) {
    if (rating.rules.pitch_off_mean_deg)
        leave_out_pitching(higher, row.from_m, row.to_m, *rating.rules.pitch_off_mean_deg);
    for (const RangeJudgement& range : judge_light(higher, limits, row.from_m, row.to_m, rating.rules))
        found.higher_lx.push_back(found.why.empty() ? range.lx : std::nullopt);
}

void judge_light_row(RowFound& found, const Rating& rating, const PlayedRating& played) {
    const RatingRow& row = found.row;
    const LimitCurve& limits = *limits_named(rating, row.limits);
    std::vector<Photometer> photometers;
    for (const std::string& name : row.photometers)
        photometers.push_back(*photometer_named(rating, name));
    Approaches approaches = approaches_of(rating, row, photometers, played);
    for (std::size_t i = 0; i < photometers.size(); ++i) {
        PhotometerFound& photometer = found.photometers.emplace_back();
        photometer.photometer = photometers[i];
        photometer.approach = std::move(approaches.as_aimed[i]);
        if (rating.rules.pitch_off_mean_deg)
            photometer.pitch_deg = leave_out_pitching(photometer.approach, row.from_m, row.to_m, *rating.rules.pitch_off_mean_deg);
        photometer.ranges = judge_light(photometer.approach, limits, row.from_m, row.to_m, rating.rules);
        photometer.why = not_as_asked(row, photometer.approach, approaches.places);
        if (!photometer.why.empty())
            for (RangeJudgement& range : photometer.ranges) {
                const LimitRange of = range.range;
                range = {};
                range.range = of;
                range.why = photometer.why;
            }
        add_higher(photometer, std::move(approaches.higher[i]), rating, row, limits);
        for (const RangeJudgement& range : photometer.ranges)
            photometer.verdict = worst_of(photometer.verdict, range.verdict);
        found.verdict = worst_of(found.verdict, photometer.verdict);
        if (found.why.empty() && photometer.verdict == RatingVerdict::not_measured)
            found.why = std::ranges::find(photometer.ranges, RatingVerdict::not_measured, &RangeJudgement::verdict)->why;
    }
}

/// Each light of an approach that counts in a judged range, with its limit there.
void add_limited(std::vector<LimitedLight>& lights, const std::vector<RangeJudgement>& ranges, const LightApproach& approach,
                 const std::vector<LightPlace>& places) {
    for (std::size_t k = 0; k < approach.size(); ++k) {
        const double distance_m = approach[k].distance_m;
        std::optional<double> limit_lx; // where two ranges meet, that of the farther one
        for (const RangeJudgement& range : ranges)
            if (range.range.at_most_lx && distance_m >= range.range.from_m && distance_m <= range.range.to_m)
                limit_lx = range.range.limit_lx(distance_m);
        if (limit_lx && !approach[k].left_out)
            lights.push_back({static_cast<std::size_t>(approach[k].tick), places[k], *limit_lx});
    }
}

bool needs_extent(const RowFound& row) { return row.key && (row.key->quantity == Quantity::reach || row.key->quantity == Quantity::width); }

Value reading_value(const RowFound& found, const Rating& rating, PlayedRating& played, const Nudge& nudge) {
    if (needs_extent(found)) {
        std::vector<Moment> moments;
        for (const State& state : played.states)
            moments.push_back(nudged(played.at(state), nudge));
        try {
            return ReadingOfLight(*found.key, played.stage.drive, played.stage.route, moments).value(moments);
        } catch (const InputError&) {
            refuse_row(rating, found.row, "reading", fmt::format("'{}' of drive {}", found.row.reading, played.stage.drive.name),
                       "a reach or a width of one lane, over the drive, of a threshold and surface that the drive measures");
        }
    }
    Readings& readings = played.readings[nudge.pitch_rad];
    if (readings.empty()) {
        SeeingFold fold(played.stage.drive, played.stage.route, nudge);
        for (const State& state : played.states)
            fold.add(played.at(state), played.lamp_set);
        readings = fold.readings();
    }
    const auto reading = std::ranges::find(readings, *found.key, &Reading::key);
    if (reading == readings.end() && found.row.reading.starts_with("control_"))
        return Value::not_measured("the lamp set has no such law");
    if (reading == readings.end())
        refuse_row(rating, found.row, "reading",
                   fmt::format("'{}', which drive {} does not measure", found.row.reading, played.stage.drive.name),
                   "a reading of what it measures, and that needs no picture");
    return reading->value;
}

void judge_reading_row(RowFound& found, const Rating& rating, PlayedRating& played) {
    const RatingRow& row = found.row;
    found.value = reading_value(found, rating, played, {});
    found.higher = reading_value(found, rating, played, aimed_higher());
    if (!found.value.measured()) {
        found.verdict = RatingVerdict::not_measured;
        found.why = found.value.reason();
        return;
    }
    if (!row.at_least && !row.at_most)
        return;
    const std::optional<bool> held = holds(found.value, row.at_least, row.at_most);
    found.verdict = !held ? RatingVerdict::not_measured : *held ? RatingVerdict::within : RatingVerdict::exceeded;
    if (!held)
        found.why = "what is known of it leaves the limit open";
}

void give_points(RowFound& found) {
    const RatingRow& row = found.row;
    if (!row.points_by.empty())
        found.points = found.verdict == RatingVerdict::not_measured && !found.value.measured() ? Value::not_measured(found.why)
                                                                                               : points_at(row.points_by, found.value);
    else if (row.points > 0.0)
        found.points = found.verdict == RatingVerdict::not_measured ? Value::not_measured(found.why)
                       : found.verdict == RatingVerdict::exceeded   ? Value(0.0)
                                                                    : Value(row.points);
}

/// The names of the lamp sets under test: read once with the first row's drive.
std::vector<std::string> lamp_set_names(const Drive& drive) {
    std::vector<std::string> names;
    for (const LampSet& lamp_set : drive.lamp_sets)
        names.push_back(lamp_set.name);
    return names;
}

/// What is missing is missing in the lamps under test, whatever drive they were read with.
std::string rated_lamp_set(const RatingRequest& request, const std::vector<std::string>& names) {
    if (!request.lamp_set.empty() && std::ranges::find(names, request.lamp_set) == names.end())
        throw InputError({request.lamps, 0, 0, "--lamp-set"}, "found '" + printable(request.lamp_set) + "'",
                         fmt::format("one of {}", fmt::join(names, ", ")));
    return request.lamp_set.empty() ? names.front() : request.lamp_set;
}

bool has_limit(const RatingRow& row, const Rating& rating) {
    return row.of_reading() ? row.at_least || row.at_most || row.points > 0.0
                            : std::ranges::any_of(limits_named(rating, row.limits)->ranges,
                                                  [](const LimitRange& range) { return range.at_most_lx.has_value(); });
}

void add_notes(std::vector<RatingNote>& notes, const Drive& drive) {
    for (const std::string& note : drive.notes) {
        auto known = std::ranges::find(notes, note, &RatingNote::note);
        if (known == notes.end())
            known = notes.insert(notes.end(), {note, {}});
        if (std::ranges::find(known->drives, drive.name) == known->drives.end())
            known->drives.push_back(drive.name);
    }
}

/// Plays a drive with one of the lamp sets and judges the rows that ask for that.
void judge_rows(RatingFound& found, std::vector<RowFound*> rows, const Drive& read, const std::string& lamp_set) {
    Drive drive = read;
    std::erase_if(drive.lamp_sets, [&](const LampSet& one) { return one.name != lamp_set; });
    if (std::ranges::none_of(rows, [](const RowFound* row) { return needs_extent(*row); }))
        drive.extent.reset();
    PlayedRating played(std::move(drive));
    for (const FilesRead* files : {&played.stage.drive.opened, &played.stage.network.opened})
        add_inputs(found.context.inputs, *files);
    add_notes(found.notes, played.stage.drive);
    for (RowFound* row : rows) {
        row->drive = played.stage.drive.name;
        if (row->row.of_reading())
            judge_reading_row(*row, found.rating, played);
        else
            judge_light_row(*row, found.rating, played);
    }
}

} // namespace

RatingVerdict RatingFound::verdict() const {
    RatingVerdict all = RatingVerdict::told;
    for (const RowFound& row : rows)
        if (row.counts)
            all = worst_of(all, row.verdict);
    return all;
}

bool all_within(const RatingFound& found) { return found.verdict() == RatingVerdict::within || found.verdict() == RatingVerdict::told; }

RatingFound run_rating(const RatingRequest& request) {
    RatingFound found;
    found.rating = request.rating;
    found.lamps = request.lamps.filename().string();
    found.context = make_context({}, request.command, 1);
    add_inputs(found.context.inputs, request.rating.opened);
    for (const RatingRow& row : request.rating.rows) {
        RowFound& one = found.rows.emplace_back();
        one.row = row;
        if (!row.of_reading())
            continue;
        one.key = key_of(row.reading);
        if (!one.key)
            refuse_row(request.rating, row, "reading", "'" + printable(row.reading) + "'",
                       "a reading's name; `fernlicht readings` lists them");
        one.unit = unit_of(*one.key);
    }
    // Each drive is read once, and played once with each lamp set that its rows ask for.
    std::vector<const RowFound*> done;
    DriveEdits edits;
    edits.lamp_sets = request.lamps;
    for (RowFound& first : found.rows) {
        if (std::ranges::find(done, &first) != done.end())
            continue;
        const Drive drive = read_drive(first.row.drive, edits);
        const std::vector<std::string> names = lamp_set_names(drive);
        if (found.lamp_set.empty())
            found.lamp_set = rated_lamp_set(request, names);
        std::vector<std::pair<std::string, std::vector<RowFound*>>> by_lamp_set;
        for (RowFound& row : found.rows) {
            if (row.row.drive != first.row.drive)
                continue;
            done.push_back(&row);
            const std::string& lamp_set = row.row.lamp_set.empty() ? found.lamp_set : row.row.lamp_set;
            row.drive = drive.name;
            if (std::ranges::find(names, lamp_set) == names.end()) {
                row.counts = has_limit(row.row, request.rating);
                row.verdict = RatingVerdict::not_measured;
                row.why = fmt::format("{} has no lamp set '{}'", found.lamps, lamp_set);
                continue;
            }
            auto same = std::ranges::find(by_lamp_set, lamp_set, &std::pair<std::string, std::vector<RowFound*>>::first);
            if (same == by_lamp_set.end())
                same = by_lamp_set.insert(by_lamp_set.end(), {lamp_set, {}});
            same->second.push_back(&row);
        }
        for (const auto& [lamp_set, rows] : by_lamp_set)
            judge_rows(found, rows, drive, lamp_set);
    }
    std::vector<ScoredRow> scored;
    for (RowFound& row : found.rows) {
        give_points(row);
        scored.push_back({row.row.name, row.verdict, row.points, row.row.points, row.row.weight, row.row.cap});
    }
    found.score = score(scored, request.rating.grades);
    OutputFolder folder(request.folder);
    request.write(found);
    folder.finish();
    return found;
}

RatedRow rated_row(const Rating& rating, const std::string& name, const std::string& photometer, const std::filesystem::path& lamps,
                   const std::string& lamp_set) {
    const auto refuse = [](const char* flag, const std::string& found, const std::string& expected) {
        throw InputError({{}, 0, 0, flag}, "found " + found, expected);
    };
    std::vector<std::string> names;
    for (const RatingRow& one : rating.rows)
        names.push_back(one.name);
    const auto row = std::ranges::find(rating.rows, name, &RatingRow::name);
    if (row == rating.rows.end())
        refuse("--row", "'" + printable(name) + "'", fmt::format("a row of the rating: {}", fmt::join(names, ", ")));
    if (!photometer.empty() && std::ranges::find(row->photometers, photometer) == row->photometers.end())
        refuse("--photometer", "'" + printable(photometer) + "'",
               row->of_reading() ? "a row of light" : fmt::format("one of the row's: {}", fmt::join(row->photometers, ", ")));
    DriveEdits edits;
    edits.lamp_sets = lamps;
    Drive drive = read_drive(row->drive, edits);
    RatedRow rated;
    rated.lamp_set = lamp_set_of(drive, lamp_set.empty() ? row->lamp_set : lamp_set).name;
    std::erase_if(drive.lamp_sets, [&](const LampSet& one) { return one.name != rated.lamp_set; });
    auto played = std::make_unique<PlayedRating>(std::move(drive));
    for (const State& state : played->states)
        rated.moments.push_back(played->at(state));
    if (row->of_reading()) {
        rated.key = key_of(row->reading);
        if (!rated.key)
            refuse("--row", "'" + printable(row->reading) + "'", "a reading's name; `fernlicht readings` lists them");
    } else {
        if (rating.rules.excess.allowed)
            refuse("--rating", "one that lets light above a limit pass for a moment", "one where each moment's light counts");
        std::vector<Photometer> photometers;
        for (const std::string& one : row->photometers)
            if (photometer.empty() || one == photometer)
                photometers.push_back(*photometer_named(rating, one));
        Approaches approaches = approaches_of(rating, *row, photometers, *played);
        for (std::size_t i = 0; i < photometers.size(); ++i) {
            LightApproach& approach = approaches.as_aimed[i];
            if (rating.rules.pitch_off_mean_deg)
                leave_out_pitching(approach, row->from_m, row->to_m, *rating.rules.pitch_off_mean_deg);
            const std::vector<RangeJudgement> ranges =
                judge_light(approach, *limits_named(rating, row->limits), row->from_m, row->to_m, rating.rules);
            std::string why = not_as_asked(*row, approach, approaches.places);
            for (const RangeJudgement& range : ranges)
                why = why.empty() ? range.why : why;
            if (!why.empty())
                refuse("--row", fmt::format("'{}', not measured: {}", name, why), "a row that the drive measures");
            add_limited(rated.lights, ranges, approach, approaches.lit[i]);
        }
        if (rated.lights.empty())
            refuse("--row", fmt::format("'{}', whose light is told alone", name), "a row with limits");
    }
    rated.stage = std::move(played->owned);
    return rated;
}

} // namespace fernlicht
