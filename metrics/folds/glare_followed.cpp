#include "metrics/folds/glare_followed.h"

#include "metrics/folds/adaptation.h"
#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace fernlicht {
namespace {

constexpr double everywhere_m = std::numeric_limits<double>::infinity();
const char* const no_moment = "no moment of the drive was measured";

/// The figure over the drive, or why some moment lacks it: an extreme over the rest could be another.
Value over_drive(const std::optional<double>& extreme, const std::string& missing, const std::string& why_none) {
    if (!missing.empty())
        return Value::not_measured("in some moment: " + missing);
    return Value::of(extreme, why_none);
}

/// Type 7, of the moments that have the figure.
std::optional<double> quantile_over(const Approach& moments, double share) {
    std::vector<double> numbers;
    for (const ApproachSample& sample : moments)
        if (sample.value)
            numbers.push_back(*sample.value);
    std::ranges::sort(numbers);
    return numbers.empty() ? std::nullopt : std::optional(quantile_of(numbers, share));
}

/// What is told of a figure over a range or a drive. `share`: of a quantile; nullopt: the extreme.
struct Told {
    Statistic statistic;
    const char* word;
    std::optional<double> share;
};
constexpr Told of_more_is_worse[] = {{Statistic::median, "median", 0.5},
                                     {Statistic::p95, "95th percentile", 0.95},
                                     {Statistic::maximum, "largest", {}}},
               of_less_is_worse[] = {
                   {Statistic::median, "median", 0.5}, {Statistic::p05, "5th percentile", 0.05}, {Statistic::minimum, "smallest", {}}};

/// Reading::between_moments of what is told over `figure`'s moments from `near_m` to `far_m`: the larger of what every second moment alone
/// would move it by and, of a quantile, what one moment more or less on either side would. Where neither half tells it, or the
/// approach ends at its extreme, which may grow on until the next moment: all that those moments and the ones beside them differ by.
std::optional<double> between_moments(const FollowedFigure& figure, const std::optional<double>& share,
                                      const std::function<Value(const FollowedFigure&)>& told, double near_m = -everywhere_m,
                                      double far_m = everywhere_m) {
    const std::optional<double> all = told(figure).number();
    if (!all)
        return std::nullopt;
    const Approach around = figure.around(near_m, far_m);
    const std::optional<double> even = told(figure.every_second(0)).number(), odd = told(figure.every_second(1)).number();
    const bool ends_there = !share && far_m == everywhere_m && around.back().value == all;
    if ((!even && !odd) || ends_there) {
        const std::optional<double> most = largest(around), least = smallest(around);
        return most && least ? std::optional(*most - *least) : std::nullopt;
    }
    double moved = std::max(std::abs(even.value_or(*all) - *all), std::abs(odd.value_or(*all) - *all));
    moved *= even && odd ? 1.0 : 2.0; // one half alone tells less
    if (share) {
        Approach moments = far_m == everywhere_m ? figure.approach : figure.within(near_m, far_m);
        const double one = 1.0 / static_cast<double>(moments.size());
        if (far_m != everywhere_m) // the one more may lie at either end
            for (const double end_m : {far_m, near_m})
                moments.push_back({0.0, end_m, value_at(figure.approach, end_m).number()});
        for (const double beside : {*share - one, *share + one})
            moved = std::max(moved, std::abs(quantile_over(moments, std::clamp(beside, 0.0, 1.0)).value_or(*all) - *all));
    }
    return moved;
}

std::vector<double> numbers_in(const std::vector<Value>& values) {
    std::vector<double> numbers;
    for (const Value& value : values)
        if (const auto number = value.number())
            numbers.push_back(*number);
    return numbers;
}

} // namespace

GlareFigures glare_figures(const std::vector<GlareSource>& sources, double facing, const Value& adaptation_cdm2,
                           const GlareParameters& parameters) {
    double eye_lx = 0.0;
    for (const GlareSource& source : sources)
        eye_lx += source.eye_lx;
    GlareFigures figures;
    figures.facing_lx = facing;
    figures.eye_lx = eye_lx;
    figures.veiling_cdm2 = veiling_luminance_cdm2(parameters.equation, sources, {parameters.age_years, parameters.pigmentation});
    figures.adaptation_cdm2 = adaptation_cdm2;
    const std::optional<double> adapted = adaptation_cdm2.number();
    figures.increment_percent = !figures.veiling_cdm2.measured() ? figures.veiling_cdm2
                                : !adapted                       ? adaptation_cdm2
                                                                 : threshold_increment_percent(*figures.veiling_cdm2.number(), *adapted);
    figures.de_boer = adapted ? de_boer_rating(sources, *adapted) : adaptation_cdm2;
    return figures;
}

GlareFigures no_figures(const std::string& why, const Value& adaptation_cdm2) {
    const Value none = Value::not_measured(why);
    return {none, none, none, none, none, adaptation_cdm2};
}

void FollowedFigure::add(const Moment& moment, double to_go_m, const Value& value, bool counts) {
    approach.push_back({moment.time_s, to_go_m, value.number()});
    why_not.push_back(counts ? value.reason() : "");
}

std::string FollowedFigure::missing() const {
    const auto first = std::ranges::find_if(why_not, [](const std::string& reason) { return !reason.empty(); });
    return first == why_not.end() ? "" : *first;
}

std::string FollowedFigure::unknown_between(double near_m, double far_m, const std::string& why_none) const {
    if (approach.empty())
        return why_none;
    const double from_m = std::min(approach.front().distance_m, far_m), to_m = std::max(approach.back().distance_m, near_m);
    if (from_m < to_m)
        return fmt::format("the drive comes from {:.1f} m away to {:.1f} m, and {:g} to {:g} m are asked for", approach.front().distance_m,
                           approach.back().distance_m, near_m, far_m);
    if (from_m < far_m || to_m > near_m)
        return fmt::format("the drive covers only {:.1f} to {:.1f} m of {:g} to {:g} m", to_m, from_m, near_m, far_m);
    for (std::size_t i = 0; i < approach.size(); ++i) {
        const double here_m = approach[i].distance_m;
        const bool touches = here_m > far_m    ? i + 1 < approach.size() && approach[i + 1].distance_m < far_m
                             : here_m < near_m ? i > 0 && approach[i - 1].distance_m > near_m
                                               : true;
        if (touches && !why_not[i].empty())
            return "in some moment: " + why_not[i];
    }
    return "";
}

Approach FollowedFigure::within(double near_m, double far_m) const {
    Approach moments;
    std::ranges::copy_if(approach, std::back_inserter(moments),
                         [&](const ApproachSample& sample) { return sample.distance_m >= near_m && sample.distance_m <= far_m; });
    return moments;
}

Approach FollowedFigure::around(double near_m, double far_m) const {
    Approach moments;
    for (std::size_t i = 0; i < approach.size(); ++i) { // which comes nearer
        const bool is_before = i + 1 < approach.size() && approach[i + 1].distance_m <= far_m,
                   is_behind = i > 0 && approach[i - 1].distance_m >= near_m;
        if ((approach[i].distance_m <= far_m || is_before) && (approach[i].distance_m >= near_m || is_behind))
            moments.push_back(approach[i]);
    }
    return moments;
}

FollowedFigure FollowedFigure::every_second(std::size_t first) const {
    FollowedFigure half;
    for (std::size_t i = first; i < approach.size(); i += 2) {
        half.approach.push_back(approach[i]);
        half.why_not.push_back(why_not[i]);
    }
    return half;
}

Value FollowedFigure::extreme_between(double near_m, double far_m, bool of_largest, const std::string& why_none) const {
    if (std::string unknown = unknown_between(near_m, far_m, why_none); !unknown.empty())
        return Value::not_measured(std::move(unknown));
    Approach looked_at = within(near_m, far_m);
    for (const double end_m : {far_m, near_m})
        looked_at.push_back({0.0, end_m, value_at(approach, end_m).number()});
    return Value::of(of_largest ? largest(looked_at) : smallest(looked_at), why_none);
}

Value FollowedFigure::quantile_between(double near_m, double far_m, double share, const std::string& why_none) const {
    if (std::string unknown = unknown_between(near_m, far_m, why_none); !unknown.empty())
        return Value::not_measured(std::move(unknown));
    const Approach moments = within(near_m, far_m);
    return Value::of(quantile_over(moments, share), moments.empty() ? "no moment lies within that range" : why_none);
}

void GlareFollowed::add(const Moment& moment, double to_go_m, const std::vector<GlareSource>& sources, std::size_t lamps,
                        const GlareFigures& figures) {
    ticks.push_back(moment.tick);
    adaptation.push_back(figures.adaptation_cdm2);
    const bool adapted = figures.adaptation_cdm2.measured();
    facing.add(moment, to_go_m, figures.facing_lx);
    eye_lx.add(moment, to_go_m, figures.eye_lx);
    veiling.add(moment, to_go_m, figures.veiling_cdm2);
    increment.add(moment, to_go_m, figures.increment_percent, adapted || !figures.veiling_cdm2.measured());
    de_boer.add(moment, to_go_m, figures.de_boer,
                adapted && figures.eye_lx.number() != 0.0); // in the dark nothing is rated, and nothing glares
    theta_deg.resize(lamps);
    for (std::size_t i = 0; i < lamps; ++i)
        theta_deg[i].push_back(sources[i].theta_deg);
}

std::string GlareFollowed::no_adaptation() const {
    return adaptation.empty() || std::ranges::any_of(adaptation, &Value::measured) ? "" : adaptation.front().reason();
}

std::string GlareFollowed::adapted() const {
    const std::vector<double> numbers = numbers_in(adaptation);
    if (numbers.empty())
        return "";
    const auto [least, most] = std::ranges::minmax(numbers);
    const std::string from = fmt::format("{:.3g}", least), to = fmt::format("{:.3g}", most);
    std::string text = fmt::format(", adapted to {}{} cd/m2", from, from == to ? "" : " to " + to);
    if (const std::size_t out = adaptation.size() - numbers.size(); out > 0)
        text += fmt::format(" ({} moment{} left out: {})", out, out == 1 ? "" : "s",
                            std::ranges::find_if(adaptation, [](const Value& value) { return !value.measured(); })->reason());
    return text;
}

void GlareFollowed::say(Readings& readings, const ReadingKey& eye, const std::string& where, const std::string& why_none,
                        const GlareParameters& parameters, std::span<const double> ranges_m) const {
    const auto add = [&](Quantity quantity, Statistic statistic, const Threshold& threshold, const std::string& what, const Value& found) {
        ReadingKey key = eye;
        key.quantity = quantity;
        key.threshold = threshold;
        key.statistic = statistic;
        readings.push_back({key, found, fmt::format("{}, {}", where, what)});
    };
    const std::string none = why_none.empty() ? no_moment : why_none, unadapted = no_adaptation(), adapted_to = adapted();
    const std::string& no_increment = unadapted.empty() ? none : unadapted;
    const bool dark = !facing.approach.empty() && largest(eye_lx.approach).value_or(0.0) == 0.0;
    struct Followed {
        Quantity quantity;
        const FollowedFigure& figure;
        std::string before, behind, why_none; ///< of the word for the statistic
        std::span<const Told> told = of_more_is_worse;
    };
    const Followed all[] = {{Quantity::glare_facing, facing, "facing the lamps, ", "", none},
                            {Quantity::glare_eye, eye_lx, "across the line of sight, ", "", none},
                            {Quantity::glare_veiling, veiling, fmt::format("veiling luminance, {}, ", name(parameters.equation)), "", none},
                            {Quantity::glare_increment, increment, "", adapted_to, no_increment},
                            {Quantity::glare_de_boer, de_boer, "", adapted_to + "; 9 unnoticeable, 5 just acceptable, 1 unbearable",
                             dark ? "no light reaches the eye" : no_increment, of_less_is_worse}};
    for (std::size_t i = 1; i < ranges_m.size(); ++i)
        for (const Followed& followed : all)
            for (const Told& told : followed.told) {
                const double near_m = ranges_m[i - 1], far_m = ranges_m[i];
                const bool of_largest = followed.quantity != Quantity::glare_de_boer;
                const std::string lightless =
                    of_largest || !unadapted.empty() || facing.approach.empty() ? followed.why_none : "no light reaches the eye";
                const std::string& why = why_none.empty() ? lightless : why_none;
                const auto over = [&](const FollowedFigure& figure) {
                    return told.share ? figure.quantile_between(near_m, far_m, *told.share, why)
                                      : figure.extreme_between(near_m, far_m, of_largest, why);
                };
                add(followed.quantity, told.statistic, {},
                    fmt::format("the bumper {} to {} m before it, {}{}{}", near_m, far_m, followed.before, told.word, followed.behind),
                    over(followed.figure));
                readings.back().between_moments = between_moments(followed.figure, told.share, over, near_m, far_m);
                readings.back().key.distance_m = near_m;
                readings.back().key.to_m = far_m;
            }
    const bool approaches = !eye.subject.empty(); // a distribution over it would mix distances
    for (const Followed& followed : all)
        for (const Told& told : followed.told) {
            if (told.share && approaches)
                continue;
            const auto over = [&](const FollowedFigure& figure) {
                const Approach& moments = figure.approach;
                return over_drive(told.share                             ? quantile_over(moments, *told.share)
                                  : told.statistic == Statistic::minimum ? smallest(moments)
                                                                         : largest(moments),
                                  figure.missing(), followed.why_none);
            };
            add(followed.quantity, told.statistic, {}, followed.before + told.word + followed.behind, over(followed.figure));
            readings.back().between_moments = between_moments(followed.figure, told.share, over);
        }
    add(Quantity::glare_adaptation, Statistic::median, {},
        parameters.adaptation_cdm2
            ? "what the eye is adapted to, as the drive says"
            : fmt::format("what the eye is adapted to: its own lane {} to {} m ahead, median", adaptation_from_m, adaptation_to_m),
        median_value(numbers_in(adaptation), no_increment));
    const auto limits = [&](const std::vector<double>& values, const FollowedFigure& figure, const std::string& why, ThresholdUnit unit,
                            const std::string& what) {
        const std::string missing = figure.missing();
        for (const double limit : values) {
            const Stretch stretch = unit == ThresholdUnit::de_boer ? below(figure.approach, limit) : at_or_above(figure.approach, limit);
            const bool measured = missing.empty() && !figure.approach.empty() && (unit == ThresholdUnit::lx || unadapted.empty());
            const auto figure_of = [&](double found) { return over_drive(measured ? std::optional(found) : std::nullopt, missing, why); };
            add(Quantity::glare_time, Statistic::none, {limit, unit}, what, figure_of(stretch.time_s));
            add(Quantity::glare_length, Statistic::none, {limit, unit}, what, figure_of(stretch.length_m));
        }
    };
    limits(parameters.thresholds_lx, facing, none, ThresholdUnit::lx, "facing the lamps");
    limits(parameters.thresholds_percent, increment, no_increment, ThresholdUnit::percent, "threshold increment" + adapted_to);
    limits(parameters.thresholds_de_boer, de_boer, no_increment, ThresholdUnit::de_boer, "de Boer's rating" + adapted_to);
}

SeeingSeries GlareFollowed::series(const ReadingKey& eye, const std::string& title, const std::string& over,
                                   const std::vector<std::string>& lamps) const {
    SeeingSeries series{eye_name(eye), title, over, ticks};
    for (const ApproachSample& sample : facing.approach)
        series.at_m.push_back(sample.distance_m);
    const auto column = [&](const char* name, const char* label, const char* unit, bool logarithmic, const FollowedFigure& figure) {
        series.add({name, label, unit, logarithmic}, figure.approach,
                   [](const ApproachSample& sample) { return Value::of(sample.value, "not measured at this place"); });
    };
    column("facing_lx", "facing illuminance", "lx", true, facing);
    column("eye_lx", "illuminance across the line of sight", "lx", true, eye_lx);
    series.columns.back().drawn = false;
    column("veiling_cdm2", "veiling luminance", "cd/m2", true, veiling);
    column("threshold_increment_percent", "threshold increment", "%", true, increment);
    column("de_boer", "de Boer's rating", "", false, de_boer);
    series.add({"adaptation_cdm2", "adaptation luminance", "cd/m2", true, false}, adaptation, std::identity());
    for (std::size_t i = 0; i < theta_deg.size(); ++i)
        series.add({"theta_" + lamps.at(i) + "_deg", "angle of " + lamps.at(i), "deg", false, false}, theta_deg[i], std::identity());
    return series;
}

} // namespace fernlicht
