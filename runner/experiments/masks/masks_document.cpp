#include "runner/experiments/masks/masks_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double drawn_from = 1e-3; ///< lx; less is no light in a plot of decades

/// Those as they are, one for each lamp set.
std::vector<const MaskedDrive*> as_they_are(const MasksFound& found) {
    std::vector<const MaskedDrive*> own;
    for (const MaskedDrive& one : found.drives)
        if (one.as_it_is)
            own.push_back(&one);
    return own;
}

const MaskedDrive& full_light(const MasksFound& found) {
    const auto own = as_they_are(found);
    return **std::ranges::find(own, found.against, &MaskedDrive::lamp_set);
}

/// Margins that come from radians: to a thousandth.
std::string margin_text(double deg) { return fmt::format("{:g}", std::round(1000.0 * deg) / 1000.0); }
std::string degrees_text(double deg) { return margin_text(deg) + "°"; }

std::string name_in_plots(const MaskedDrive& one) { return short_text(one.lamp_set, 24); }

/// By margin, which plots draw as a curve.
std::vector<const MaskedDrive*> curve_of(const MasksFound& found, const std::string& lamp_set) {
    std::vector<const MaskedDrive*> all;
    for (const MaskedDrive& one : found.drives)
        if (one.lamp_set == lamp_set)
            all.push_back(&one);
    return all;
}

/// A word at a point of the cost plots.
struct CostLabel {
    double x, y;
    std::string text;
    plots::Colour colour;
};

/// A label at a place that another takes joins that one where both are of one curve or at the very same point, else moves up or down to the
/// next free place; with none within three lines it is left out. The first come first.
void add_labels(plots::Figure& figure, const std::vector<CostLabel>& labels) {
    constexpr double letter = 0.013, high = 0.035; // of the plot's width and height: what a letter and a line take
    constexpr std::size_t longest = 32;
    struct Placed {
        CostLabel label;
        double from, to, at; // shares of the plot
    };
    std::vector<Placed> placed;
    for (const CostLabel& label : labels) {
        const double from = plots::position(figure.x, label.x), to = from + letter * (static_cast<double>(label.text.size()) + 1.0);
        const double at = plots::position(figure.y, label.y);
        const auto on = [&](double y) {
            return std::ranges::find_if(
                placed, [&](const Placed& other) { return from < other.to && other.from < to && std::abs(y - other.at) < high; });
        };
        const auto met = on(at);
        if (met != placed.end()) {
            const bool one_point = std::abs(met->from - from) < 1e-3 && std::abs(met->at - at) < 1e-3;
            if ((one_point || met->label.colour == label.colour) && met->label.text.size() + label.text.size() < longest) {
                met->label.text += ", " + label.text;
                met->to += letter * (static_cast<double>(label.text.size()) + 2.0);
                continue;
            }
        }
        for (const double lines : {0.0, -1.0, 1.0, -2.0, 2.0, -3.0, 3.0})
            if (const double y = at + lines * high; y > 0.0 && y < 1.0 && on(y) == placed.end()) {
                placed.push_back({label, from, to, y});
                break;
            }
    }
    for (const Placed& one : placed)
        figure.notes.push_back({one.label.x, figure.y.from + one.at * (figure.y.to - figure.y.from), one.label.text, one.label.colour});
}

/// `close`: of lamp sets that mask alone, which on the whole plot may lie on one another.
plots::Figure cost_figure(const MasksFound& found, bool close) {
    plots::Figure figure;
    figure.title = close ? "The same, masks alone" : "Light lost to masks against light that others get";
    figure.subtitle = "Lower left is better for both. Figures at the dots are margins in degrees; a large dot is the lamp set as it is.";
    figure.height_px = close ? 440.0 : 520.0;
    std::vector<double> x, y;
    std::vector<CostLabel> names, margins;
    const auto own = as_they_are(found);
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (close && !own[i]->margin_deg)
            continue;
        const plots::Colour colour = plots::lamp_colour(i);
        const std::string name = name_in_plots(*own[i]);
        plots::Series line{.name = own[i]->margin_deg ? name : "", .colour = colour, .markers = true};
        for (const MaskedDrive* const one : curve_of(found, own[i]->lamp_set)) {
            x.push_back(one->others_lxs);
            y.push_back(one->lost_lxs);
            line.points.push_back({x.back(), y.back()});
            if (one->margin_deg && !one->as_it_is)
                margins.push_back({x.back(), y.back(), margin_text(*one->margin_deg), colour});
        }
        names.push_back(
            {own[i]->others_lxs, own[i]->lost_lxs, own[i]->margin_deg ? name + " " + margin_text(*own[i]->margin_deg) : name, colour});
        figure.series.push_back(std::move(line));
        figure.series.push_back({.points = {{names.back().x, names.back().y}}, .colour = colour, .width_px = 3.6, .markers = true});
    }
    const bool linear = close || std::ranges::any_of(x, [](double lxs) { return !(lxs > 0.0); });
    figure.x = plots::axis_around("light in eyes and mirrors of others, over the drive", "lx s", x,
                                  linear ? plots::Scale::linear : plots::Scale::logarithmic, linear && !close);
    figure.y = plots::axis_around(fmt::format("lost on own lane and verge, against {}", short_text(found.against, 24)), "lx s", y,
                                  plots::Scale::linear, !close);
    names.insert(names.end(), margins.begin(), margins.end());
    add_labels(figure, names);
    return figure;
}

/// nullopt: no pedestrian is detected anywhere.
std::optional<plots::Figure> walker_figure(const MasksFound& found) {
    plots::Figure figure;
    figure.title = "Pedestrian beside an oncoming car";
    figure.subtitle =
        fmt::format("{}, visibility level {:g}: from how far away detected, median over oncoming cars. Full: left edge of the "
                    "road; broken: right edge. Level lines: lamp sets without masks. "
                    "What is detected nowhere is left out.",
                    found.walker, found.walker_level);
    std::vector<double> x, y;
    for (const MaskedDrive& one : found.drives)
        if (one.margin_deg)
            x.push_back(*one.margin_deg);
    figure.x = plots::axis_around("margin of the masks", "deg", x, plots::Scale::linear, true);
    const auto own = as_they_are(found);
    for (std::size_t i = 0; i < own.size(); ++i)
        for (const bool left : {true, false}) {
            plots::Series line{
                .name = name_in_plots(*own[i]) + (left ? ", left" : ", right"), .colour = plots::lamp_colour(i), .dash = left ? "" : "6 4"};
            for (const MaskedDrive* const one : curve_of(found, own[i]->lamp_set))
                if (const std::optional<double> m = (left ? one->left_m : one->right_m).figure()) {
                    y.push_back(*m);
                    line.points.push_back({one->margin_deg.value_or(figure.x.from), *m});
                    line.markers = one->margin_deg.has_value();
                }
            if (line.points.size() == 1 && !own[i]->margin_deg)
                line.points.push_back({figure.x.to, line.points.front().y});
            if (std::ranges::any_of(line.points, [](const plots::Point& point) { return point.y > 0.0; }))
                figure.series.push_back(std::move(line));
        }
    if (figure.series.empty())
        return std::nullopt;
    figure.y = plots::axis_around("detected from", "m", y, plots::Scale::linear, true);
    return figure;
}

plots::Figure figure_over_time(const MasksFound& found, const char* title, const char* label, double MaskedDrive::Moment::*lx,
                               bool decades) {
    plots::Figure figure;
    figure.title = title;
    figure.width_px = 640.0;
    figure.height_px = 300.0;
    std::vector<double> y;
    const auto own = as_they_are(found);
    for (std::size_t i = 0; i < own.size(); ++i) {
        plots::Series line{.name = name_in_plots(*own[i]), .colour = plots::lamp_colour(i)};
        for (const MaskedDrive::Moment& moment : own[i]->moments) {
            const bool shown = !decades || moment.*lx >= drawn_from;
            line.points.push_back({moment.time_s, shown ? moment.*lx : std::numeric_limits<double>::quiet_NaN()});
            if (shown)
                y.push_back(moment.*lx);
        }
        figure.series.push_back(std::move(line));
    }
    figure.x = {"time", "s", 0.0, found.moments * found.step_s};
    figure.y = plots::axis_around(label, "lx", y, decades ? plots::Scale::logarithmic : plots::Scale::linear, !decades);
    return figure;
}

Cell lux_seconds(double lxs) { return {four_digits(lxs), lxs}; }

Cell metres_cell(const Value& value) {
    if (value.figure() == 0.0)
        return {"nowhere", 0.0};
    return value.measured() ? Cell(with_bound(value, figure(*value.figure(), 1)), *value.figure()) : Cell("–").hinted(value.reason());
}

std::string no_light(const MasksFound& found) {
    return fmt::format("{} gives no light on own lane and verge", short_text(found.against, 40));
}

Table masks_table(const MasksFound& found) {
    Table table{"masks",
                "",
                columns_of("lamps<|margin [°]|own lane [lx s]|verge [lx s]|both, lost [lx s]|both, lost [%]|others [lx s]|above limits [lx "
                           "s]|brightest [lx]|most of a limit [%]|worst for<|at [s]|from [m]|on foot, left edge [m]|right edge [m]"),
                {}};
    const auto own = as_they_are(found);
    for (const MaskedDrive& one : found.drives) {
        const auto place = std::ranges::find(own, one.lamp_set, &MaskedDrive::lamp_set) - own.begin();
        std::vector<Cell>& row = table.rows.emplace_back();
        row.push_back(Cell::of_series(short_text(one.lamp_set, 40), static_cast<std::size_t>(place)));
        row.push_back(one.margin_deg ? Cell(margin_text(*one.margin_deg) + (one.as_it_is ? ", as it is" : ""), *one.margin_deg)
                                     : Cell("–"));
        row.insert(row.end(), {lux_seconds(one.lane_lxs), lux_seconds(one.verge_lxs), lux_seconds(one.lost_lxs),
                               one.lost_percent ? Cell(figure(*one.lost_percent, 1), *one.lost_percent) : Cell("–").hinted(no_light(found)),
                               lux_seconds(one.others_lxs), lux_seconds(one.above_lxs), lux_seconds(one.most_lx)});
        row.push_back(one.most_of_limit ? Cell(figure(100.0 * *one.most_of_limit, 0), 100.0 * *one.most_of_limit) : Cell("–"));
        if (one.worst_user.empty())
            row.insert(row.end(), 3, "–");
        else
            row.insert(row.end(), {Cell(short_text(one.worst_user, 24)), Cell(figure(one.worst_s, 1), one.worst_s),
                                   Cell(figure(one.worst_m, 0), one.worst_m)});
        row.insert(row.end(), {metres_cell(one.left_m), metres_cell(one.right_m)});
    }
    return table;
}

/// Of the lamp sets that mask nobody the one that others get least of, the low beam mostly; nullptr: there is none but the full light.
const MaskedDrive* least_without_masks(const MasksFound& found) {
    const MaskedDrive* least = nullptr;
    for (const MaskedDrive& one : found.drives)
        if (!one.margin_deg && one.lamp_set != found.against && (!least || one.others_lxs < least->others_lxs))
            least = &one;
    return least;
}

/// Of a lamp set's margins the least that keeps all others below their limits.
std::optional<std::string> least_margin_words(const MasksFound& found, const std::string& lamp_set) {
    const MaskedDrive* least = nullptr;
    bool judged = false;
    for (const MaskedDrive& one : found.drives)
        if (one.lamp_set == lamp_set && one.margin_deg) {
            judged = judged || one.most_of_limit;
            if (one.most_of_limit && one.above_lxs == 0.0 && (!least || *one.margin_deg < *least->margin_deg))
                least = &one;
        }
    if (!judged)
        return std::nullopt;
    if (least)
        return fmt::format("Of the margins tried, {} is the least with nothing above limits", degrees_text(*least->margin_deg));
    std::string none = "None of the margins tried keeps all light below limits";
    if (const MaskedDrive* const low = least_without_masks(found); low && low->above_lxs > 0.0)
        none +=
            fmt::format(": {} by itself gives {} lx s above them, up to {} % of a limit, which no mask takes away",
                        short_text(low->lamp_set, 40), four_digits(low->above_lxs), figure(100.0 * low->most_of_limit.value_or(0.0), 0));
    return none;
}

std::vector<std::string> told(const MasksFound& found) {
    const MaskedDrive& full = full_light(found);
    std::vector<std::string> sentences;
    if (std::ranges::all_of(found.drives, [](const MaskedDrive& one) { return one.others_lxs == 0.0; }))
        sentences.push_back("No eye or mirror of others gets any light in this drive: there is nobody to spare, and margins say nothing");
    for (const MaskedDrive* const one : as_they_are(found))
        if (const std::string least = least_margin_words(found, one->lamp_set).value_or(""); one != &full)
            sentences.push_back(fmt::format(
                "{}{}: {}. Others get {} lx s, of which {} lx s above limits; with {} {} and {}{}", short_text(one->lamp_set, 40),
                one->margin_deg ? ", margin " + degrees_text(*one->margin_deg) : "",
                one->lost_percent ? fmt::format("{} % of {}’s light on own lane and verge is lost, {} lx s", figure(*one->lost_percent, 1),
                                                short_text(full.lamp_set, 40), four_digits(one->lost_lxs))
                                  : no_light(found),
                four_digits(one->others_lxs), four_digits(one->above_lxs), short_text(full.lamp_set, 40), four_digits(full.others_lxs),
                four_digits(full.above_lxs), least.empty() ? "" : ". " + least));
    return sentences;
}

std::vector<std::string> basis(const MasksFound& found) {
    const MaskPlaces& places = found.places;
    return {
        fmt::format(
            "Own lane and verge: targets that face the lamps, {:g} m above the road, {:g} to {:g} m before the bumper, in the middle "
            "of cells of at most {:g} by {:g} m; the verge is {:g} m wide, beside the driving lanes on the {}. Their mean, each with its "
            "cell's area, times the time over {} moments of {:g} s. The choice of places is ours",
            places.above_m, places.from_m, places.to_m, places.row_m, places.across_m, places.verge_m, places.left_hand ? "left" : "right",
            found.moments, found.step_s),
        fmt::format(
            "Others: photometers and limits of rating `{}`: eyes of oncoming, mirrors of preceding road users, from 15 m before "
            "the lamps on; of each road user but pedestrians the brightest, as if each sat in a car. Limits hold where the rating has "
            "some",
            short_text(found.limits, 40)),
        fmt::format("On foot: `{}` at the edges of the road as the driver sees them, level with the front of an oncoming road user; "
                    "detected with visibility level {:g} (Adrian). The driver looks at him; other lamps veil him (CIE general equation)",
                    short_text(found.walker, 40), found.walker_level),
        "By the twin, in double precision. Crests of the road hide lamps; bodies of others hide them from targets and eyes, since what "
        "lies in somebody’s shadow is no loss. Nothing else hides any"};
}

} // namespace

Document document(const MasksFound& found) {
    Document document{"What masks cost: " + short_text(found.title.empty() ? found.drive : found.title, 90), {}};
    Section& top = document.sections.emplace_back(
        Section{"", {Listing(told(found)), Plot{"cost", cost_figure(found, false)}, Plot{"cost-masks", cost_figure(found, true)}}});
    if (std::optional<plots::Figure> figure = walker_figure(found))
        top.blocks.emplace_back(Plot{"on-foot", std::move(*figure)});
    document.sections.push_back({"By margin", {masks_table(found)}});
    Section& course = document.sections.emplace_back(Section{"Over the drive, as they are", {}});
    course.blocks.emplace_back(
        Plot{.name = "lane-over-time",
             .figure = figure_over_time(found, "Own lane and verge", "mean illuminance", &MaskedDrive::Moment::both_lx, false),
             .beside = true});
    course.blocks.emplace_back(Plot{
        .name = "others-over-time",
        .figure = figure_over_time(found, "Eyes and mirrors of others, added up", "illuminance", &MaskedDrive::Moment::others_lx, true),
        .beside = true});
    document.sections.push_back({"What is measured", {Listing(basis(found))}});
    if (!found.notes.empty())
        document.sections.push_back({"Notes", {Listing(found.notes)}});
    return document;
}

} // namespace fernlicht
