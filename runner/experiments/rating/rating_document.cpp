#include "runner/experiments/rating/rating_result.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr plots::Colour limit_colour{190, 30, 30};
constexpr double drawn_from_lx = 1e-3;

const char* word(RatingVerdict verdict) {
    return verdict == RatingVerdict::not_measured ? "not measured" : rating_verdict_words[static_cast<std::size_t>(verdict)];
}
const char* word(Known known) { return known_words[static_cast<std::size_t>(known)]; }

std::string section_verdict(RatingVerdict verdict) {
    switch (verdict) {
    case RatingVerdict::within:
        return "pass";
    case RatingVerdict::exceeded:
        return "fail";
    case RatingVerdict::not_measured:
        return "not_measured";
    case RatingVerdict::told:
        break;
    }
    return "none";
}

/// Rounded as the rating rounds, else three digits.
Cell lux_cell(double lx, const JudgingRules& rules) {
    const int decimals = rules.round_lx ? std::max(0, static_cast<int>(std::ceil(-std::log10(*rules.round_lx) - 1e-9))) : lx < 1.0 ? 3 : 2;
    return {figure(lx, decimals), lx};
}

Cell margin_cell(double margin) { return {signed_figure(100.0 * margin, 0), 100.0 * margin}; }

std::string range_text(const LimitRange& range) { return fmt::format("{:g}–{:g}", range.from_m, range.to_m); }

std::string lamp_set_of(const RowFound& row, const RatingFound& found) {
    return row.row.lamp_set.empty() ? found.lamp_set : row.row.lamp_set;
}

/// The range that decides: what is not measured, else the smallest margin, without limits the brightest.
const RangeJudgement* narrowest_range(const PhotometerFound& photometer) {
    const RangeJudgement* narrowest = nullptr;
    for (const RangeJudgement& range : photometer.ranges) {
        const auto is_narrower = [&] {
            if (narrowest->verdict != range.verdict)
                return worst_of(narrowest->verdict, range.verdict) == range.verdict;
            if (!range.worst || !narrowest->worst)
                return false;
            return range.verdict == RatingVerdict::told ? range.lx > narrowest->lx : range.margin() < narrowest->margin();
        };
        if (!narrowest || is_narrower())
            narrowest = &range;
    }
    return narrowest;
}

/// Light, limit, margin, moment; then the light with the lamps aimed higher.
void add_worst(std::vector<Cell>& cells, const PhotometerFound& photometer, const RangeJudgement* range, const JudgingRules& rules) {
    if (!range || !range->worst) {
        cells.insert(cells.end(), 6, "");
        return;
    }
    const bool limited = range->range.at_most_lx.has_value();
    cells.push_back(lux_cell(*range->lx, rules));
    cells.push_back(limited ? lux_cell(*range->limit_lx, rules) : Cell("none"));
    cells.push_back(limited ? margin_cell(range->margin()) : Cell(""));
    cells.push_back({figure(range->worst->time_s, 2), range->worst->time_s});
    cells.push_back({figure(range->worst->distance_m, 1), range->worst->distance_m});
    const std::optional<double>& higher = photometer.higher_lx[static_cast<std::size_t>(range - photometer.ranges.data())];
    cells.push_back(higher ? lux_cell(*higher, rules) : Cell(""));
}

constexpr const char* worst_columns = "range [m]|light [lx]|limit [lx]|margin [%]|time [s]|distance [m]|aimed 0.1° higher [lx]";

Table light_table(const RatingFound& found) {
    const bool several =
        std::ranges::any_of(found.rows, [](const RowFound& row) { return !row.of_reading() && !row.row.lamp_set.empty(); });
    Table table{"verdicts",
                "Each row and photometer where it is nearest to its limit or farthest above, without a limit where it is brightest, and "
                "the moment of it. Place: whether a source states where the photometer is",
                columns_of(std::string("row<|") + (several ? "lamp set<|" : "") + "photometer<|place<|verdict<|" + worst_columns),
                {}};
    for (const RowFound& row : found.rows) {
        if (row.of_reading())
            continue;
        std::vector<Cell> first{row.row.title};
        if (several)
            first.emplace_back(lamp_set_of(row, found));
        if (row.photometers.empty()) {
            std::vector<Cell>& cells = table.rows.emplace_back(first);
            cells.insert(cells.end(), 2, "");
            cells.emplace_back(word(row.verdict));
        }
        for (const PhotometerFound& photometer : row.photometers) {
            const RangeJudgement* const range = narrowest_range(photometer);
            std::vector<Cell>& cells = table.rows.emplace_back(first);
            cells.emplace_back(photometer.photometer.name);
            cells.emplace_back(word(photometer.photometer.is));
            cells.emplace_back(word(photometer.verdict));
            cells.emplace_back(range ? range_text(range->range) : "");
            add_worst(cells, photometer, range, found.rating.rules);
        }
    }
    return table;
}

std::string threshold_text(const RatingRow& row) {
    std::vector<std::string> parts;
    if (row.at_least)
        parts.push_back(fmt::format("at least {:g}", *row.at_least));
    if (row.at_most)
        parts.push_back(fmt::format("at most {:g}", *row.at_most));
    return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

Table reading_table(const RatingFound& found) {
    const bool with_points = found.score.most > 0.0;
    Table table{"readings",
                "Readings of the drives. Row: whether a source states it",
                columns_of(std::string("row<|drive<|lamp set<|row is<|reading`|value|in<|aimed 0.1° higher|limit<|verdict<") +
                           (with_points ? "|points" : "")),
                {}};
    for (const RowFound& row : found.rows) {
        if (!row.of_reading())
            continue;
        const auto told = [](const Value& value) {
            return value.figure() ? Cell(with_bound(value, four_digits(*value.figure())), *value.figure()) : Cell("");
        };
        table.rows.push_back({row.row.title, row.drive, lamp_set_of(row, found), word(row.row.is), row.row.reading, told(row.value),
                              row.unit, told(row.higher), threshold_text(row.row), word(row.verdict)});
        if (with_points)
            table.rows.back().push_back(row.points.number() ? Cell(four_digits(*row.points.number()), *row.points.number()) : Cell(""));
    }
    return table;
}

Table range_table(const RowFound& row, const RatingFound& found) {
    const JudgingRules& rules = found.rating.rules;
    const bool pitching = rules.pitch_off_mean_deg.has_value(), excusing = rules.excess.allowed;
    Table table{"light-" + row.row.name,
                "By distance; light and limit at the worst moment of each range",
                columns_of(std::string("photometer<|verdict<|") + worst_columns + "|moments" + (pitching ? "|left out by pitch" : "") +
                           (excusing ? "|excused moments" : "")),
                {}};
    const auto count = [](std::size_t number) { return Cell(fmt::format("{}", number), static_cast<double>(number)); };
    for (const PhotometerFound& photometer : row.photometers)
        for (const RangeJudgement& range : photometer.ranges) {
            std::vector<Cell>& cells = table.rows.emplace_back();
            cells = {photometer.photometer.name, word(range.verdict), range_text(range.range)};
            add_worst(cells, photometer, &range, rules);
            cells.push_back(count(range.samples));
            if (pitching)
                cells.push_back(count(range.left_out));
            if (excusing)
                cells.push_back(count(range.excused));
        }
    return table;
}

void add_limits(plots::Figure& figure, const std::vector<RangeJudgement>& ranges, std::vector<double>& values) {
    plots::Series steps{.name = "limit", .colour = limit_colour, .width_px = 2.2};
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    for (const RangeJudgement& judged : ranges) {
        const LimitRange& range = judged.range;
        if (!range.at_most_lx) {
            steps.points.push_back({gap, gap});
            continue;
        }
        for (const double at_m : {range.from_m, range.to_m}) {
            steps.points.push_back({at_m, range.limit_lx(at_m)});
            values.push_back(range.limit_lx(at_m));
        }
    }
    if (std::ranges::any_of(steps.points, [](const plots::Point& point) { return std::isfinite(point.y); }))
        figure.series.push_back(std::move(steps));
}

plots::Figure light_figure(const RowFound& row, const RatingFound& found) {
    plots::Figure figure;
    figure.title = row.row.title;
    figure.height_px = 400.0;
    std::vector<double> values;
    double farthest_m = 0.0;
    for (const PhotometerFound& photometer : row.photometers)
        for (const RangeJudgement& range : photometer.ranges)
            farthest_m = std::max(farthest_m, range.range.to_m);
    add_limits(figure, row.photometers.front().ranges, values);
    std::size_t number = 0;
    bool any_out = false;
    for (const PhotometerFound& photometer : row.photometers) {
        plots::Series light{.name = fmt::format("{} ({} place)", photometer.photometer.name, word(photometer.photometer.is)),
                            .colour = plots::series_colour(number++)};
        plots::Series out{.name = any_out ? "" : "left out by pitch", .colour = {150, 150, 150}, .dash = "2 3"};
        for (const LightSample& sample : photometer.approach) {
            if (sample.distance_m > farthest_m)
                continue;
            constexpr double none = std::numeric_limits<double>::quiet_NaN();
            light.points.push_back({sample.distance_m, sample.left_out ? none : sample.lx});
            out.points.push_back({sample.distance_m, sample.left_out ? sample.lx : none});
            values.push_back(std::max(sample.lx, drawn_from_lx));
        }
        figure.series.push_back(std::move(light));
        if (std::ranges::any_of(photometer.approach, &LightSample::left_out)) {
            figure.series.push_back(std::move(out));
            any_out = true;
        }
        for (const RangeJudgement& range : photometer.ranges)
            if (range.worst && range.verdict == RatingVerdict::exceeded)
                figure.notes.push_back({range.worst->distance_m, range.worst->lx,
                                        fmt::format("{} lx", lux_cell(*range.lx, found.rating.rules).text), limit_colour, true});
    }
    figure.x = {"distance", "m", 0.0, farthest_m};
    figure.y = plots::axis_around("illuminance on the photometer", "lx", values, plots::Scale::logarithmic);
    return figure;
}

std::string excess_text(const MomentaryExcess& excess) {
    return fmt::format("Momentary excess ({:g} % above a limit for at most {:g} s or {:g} m) is {}; {}{}", excess.percent, excess.for_s,
                       excess.for_m, excess.allowed ? "let pass" : "not let pass", word(excess.is),
                       excess.why.empty() ? "" : ": " + excess.why);
}

std::string distance_text(const JudgingRules& rules) {
    return fmt::format("Distance runs horizontally from the {} to {}; {}",
                       rules.from == DistanceFrom::lamps ? "middle of the lamps" : "front bumper's middle",
                       rules.to == DistanceTo::photometer ? "the photometer" : "the nearer end of the road user that carries it",
                       word(rules.distance_is));
}

Table photometer_table(const Rating& rating) {
    static const char* const across[] = {"own lane's centre", "oncoming lane's centre", "right edge of the lanes",
                                         "left edge of the lanes"};
    static const char* const faces[] = {"each lamp", "forward", "backward"};
    Table table{"photometers",
                "Places of judgement. On a road user ahead counts from its rear axle, else along the route",
                columns_of("photometer<|on<|ahead [m]|left [m]|above the road [m]|faces<|place<|why<"),
                {}};
    const auto metres = [](double m) { return Cell(figure(m, 2), m); };
    for (const Photometer& one : rating.photometers) {
        const bool ridden = !one.on.empty();
        table.rows.push_back({one.name, ridden ? one.on : across[static_cast<std::size_t>(one.across)],
                              metres(ridden ? one.position_m.x : *one.at_m), ridden ? metres(one.position_m.y) : Cell(""),
                              metres(ridden ? one.position_m.z : one.above_m), faces[static_cast<std::size_t>(one.faces)], word(one.is),
                              one.why});
    }
    return table;
}

std::vector<std::string> basis_of(const RatingFound& found) {
    const Rating& rating = found.rating;
    std::vector<std::string> sentences{fmt::format("Rating {}, edition {}; source: {}", rating.name, rating.edition, rating.source)};
    for (const std::string& open : rating.unsettled)
        sentences.push_back("Not settled: " + open);
    const auto is_limited = [](const LimitCurve& limits) {
        return std::ranges::any_of(limits.ranges, [](const LimitRange& range) { return range.at_most_lx.has_value(); });
    };
    if (!rating.photometers.empty())
        sentences.push_back(distance_text(rating.rules));
    if (std::ranges::any_of(rating.limits, is_limited))
        sentences.push_back(excess_text(rating.rules.excess));
    for (const LimitCurve& limits : rating.limits)
        sentences.push_back(fmt::format("Limits {}: {}{}", limits.name, word(limits.is), limits.why.empty() ? "" : ", " + limits.why));
    sentences.emplace_back("By the twin: no shadows, nothing hides a lamp, no light but that of the own car's lamps, no filter on it");
    for (const auto& [note, drives] : found.notes)
        sentences.push_back(fmt::format("{}: {}", fmt::join(drives, ", "), note));
    return sentences;
}

std::vector<std::string> reasons_of(const RatingFound& found) {
    std::vector<std::string> reasons;
    for (const RowFound& row : found.rows) {
        if (!row.why.empty() && row.photometers.empty())
            reasons.push_back(fmt::format("{}: {}", row.row.title, row.why));
        for (const PhotometerFound& photometer : row.photometers)
            for (const RangeJudgement& range : photometer.ranges) {
                std::string reason = fmt::format("{}, {}{}: {}", row.row.title, photometer.photometer.name,
                                                 photometer.why.empty() ? fmt::format(", {} m", range_text(range.range)) : "", range.why);
                if (!range.why.empty() && std::ranges::find(reasons, reason) == reasons.end())
                    reasons.push_back(std::move(reason));
            }
    }
    return reasons;
}

std::string counted_verdicts(const RatingFound& found) {
    std::vector<std::string> counts;
    for (const RatingVerdict verdict : {RatingVerdict::exceeded, RatingVerdict::not_measured, RatingVerdict::within, RatingVerdict::told})
        if (const auto count = std::ranges::count(found.rows, verdict, &RowFound::verdict); count > 0)
            counts.push_back(fmt::format("{} {}", count, word(verdict)));
    return fmt::format("{}: {}.", counted(found.rows.size(), "row"), fmt::join(counts, ", "));
}

std::string score_text(const RatingFound& found) {
    const Score& score = found.score;
    if (score.most == 0.0)
        return "The rating gives no points.";
    if (!score.points.number())
        return fmt::format("Points: not measured, {}.", score.points.reason());
    return fmt::format("Points: {} of {}{}{}.", four_digits(*score.points.number()), four_digits(score.most),
                       score.capped_by.empty() ? "" : fmt::format(", capped by row {}", score.capped_by),
                       score.grade.empty() ? "" : ": " + score.grade);
}

} // namespace

std::string modelled_text(const Rating& rating) {
    return rating.modelled_on.empty() ? "" : fmt::format("modelled on {}, {}", rating.modelled_on, rating.edition);
}

Document document(const RatingFound& found) {
    const Rating& rating = found.rating;
    Document document{rating.title, {}};
    Section& top = document.sections.emplace_back(Section{fmt::format("{}, {}", found.lamps, found.lamp_set), {}});
    top.verdict = section_verdict(found.verdict());
    if (!rating.modelled_on.empty())
        top.blocks.emplace_back(fmt::format(
            "This judgement is {}. It is not that test, and says nothing of whether lamps or a car meet it.", modelled_text(rating)));
    top.blocks.emplace_back(counted_verdicts(found));
    if (found.score.most > 0.0 || !rating.grades.empty())
        top.blocks.emplace_back(score_text(found));
    if (std::ranges::any_of(found.rows, [](const RowFound& row) { return !row.of_reading(); }))
        top.blocks.emplace_back(light_table(found));
    if (std::ranges::any_of(found.rows, &RowFound::of_reading))
        top.blocks.emplace_back(reading_table(found));
    if (const std::vector<std::string> reasons = reasons_of(found); !reasons.empty()) {
        Listing listing(reasons);
        listing.caption = "Why it is not measured";
        top.blocks.emplace_back(std::move(listing));
    }
    Section& basis = document.sections.emplace_back(Section{"What it rests on", {Listing(basis_of(found))}});
    if (!rating.photometers.empty())
        basis.blocks.emplace_back(photometer_table(rating));
    for (const RowFound& row : found.rows) {
        if (row.photometers.empty())
            continue;
        Section& section = document.sections.emplace_back(Section{row.row.title, {}});
        section.verdict = section_verdict(row.verdict);
        section.on_page_alone = true;
        std::string sentence = fmt::format("Drive `{}`, lamp set {}. The row is {}{}.", row.drive, lamp_set_of(row, found),
                                           word(row.row.is), row.row.why.empty() ? "" : ": " + row.row.why);
        if (const std::optional<double>& pitch = row.photometers.front().pitch_deg)
            sentence += fmt::format(" Mean pitch {}°.", figure(*pitch, 2));
        section.blocks.emplace_back(std::move(sentence));
        section.blocks.emplace_back(Plot{"light-" + row.row.name, light_figure(row, found)});
        section.blocks.emplace_back(range_table(row, found));
    }
    return document;
}

} // namespace fernlicht
