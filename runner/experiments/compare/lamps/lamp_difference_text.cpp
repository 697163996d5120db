#include "runner/experiments/compare/lamps/lamp_difference_text.h"

#include "metrics/beam/intake.h"
#include "metrics/regulation/named_places.h"
#include "runner/findings/figures.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr std::size_t max_framed = 4; ///< zones; more would hide the picture

JsonMembers fitted_figure_members(FittedFigure& fitted) { return {{"value", fitted.value}, {"standard_error", fitted.uncertainty}}; }

std::vector<std::string> extent_names() { return {"part", "wide", "all", "below_cut_off", "above_cut_off"}; }

JsonMembers beam_zone_members(BeamZone& zone) {
    return {{"share", zone.share},
            {"standard_error", zone.uncertainty},
            {"share_low", zone.share_low},
            {"share_high", zone.share_high},
            {"h_from_deg", zone.h_from_deg},
            {"h_to_deg", zone.h_to_deg},
            {"v_from_deg", zone.v_from_deg},
            {"v_to_deg", zone.v_to_deg},
            {"z", zone.z},
            {"directions", zone.samples},
            {"extent", one_of(zone.extent, extent_names)},
            {"places", zone.holds},
            {"part_of", or_null(zone.part_of)}};
}

JsonMembers corner_members(Direction& corner) { return {{"h_deg", corner.h_deg}, {"v_deg", corner.v_deg}}; }

JsonMembers place_change_members(PlaceChange& change) {
    return {{"name", change.place.name},
            {"what", change.place.what},
            {"corners", change.place.corners, corner_members},
            {"source", change.place.source},
            {"old_cd", change.old_cd},
            {"new_cd", change.new_cd},
            {"change_share", change.change()},
            {"standard_error", change.uncertainty},
            {"beyond_noise", change.is_beyond_noise},
            {"not_measured", or_null(change.not_measured)}};
}

JsonPart traffic_side_part(TrafficSide& side) { return one_of(side, names_of<TrafficSide>(traffic_side_name, 3)); }

JsonPart beam_function_part(BeamFunction& function) {
    return one_of(function, fernlicht::names_of<BeamFunction>([](BeamFunction one) { return name_of(one); }, 3));
}

void refuse_darkness(const LampFile& lamp) {
    if (!(peak_of(lamp.table).cd > 0.0))
        throw InputError({lamp.opened.empty() ? std::filesystem::path() : lamp.opened.front().path, 0, 0, {}}, "found no light in it",
                         "a lamp that shines");
}

/// The directions with at least 1 % of the peak, and a little round them.
void show_beam(plots::Figure& figure, const CandelaTable& table) {
    const double min_cd = 0.01 * peak_of(table).cd;
    double left = table.h_deg.back(), right = table.h_deg.front(), bottom = table.v_deg.back(), top = table.v_deg.front();
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            if (table.at(v, h) >= min_cd) {
                left = std::min(left, table.h_deg[h]);
                right = std::max(right, table.h_deg[h]);
                bottom = std::min(bottom, table.v_deg[v]);
                top = std::max(top, table.v_deg[v]);
            }
    figure.x = {"H, to the right", "deg", std::floor(left) - 1.0, std::ceil(right) + 1.0};
    figure.y = {"V, up", "deg", std::floor(bottom) - 1.0, std::ceil(top) + 1.0};
}

/// Tested over against; NaN where either has less than `floor_cd` or no data.
Image<float> ratio(const plots::Figure& figure, const CandelaTable& tested, const CandelaTable& against, double floor_cd) {
    constexpr int columns = 480, rows = 240;
    Image<float> image(columns, rows);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const double h = figure.x.from + (figure.x.to - figure.x.from) * (x + 0.5) / columns;
            const double v = figure.y.to - (figure.y.to - figure.y.from) * (y + 0.5) / rows;
            const double a = intensity_cd(tested, h, v), b = intensity_cd(against, h, v);
            const bool is_compared = has_data(tested, h, v) && has_data(against, h, v) && std::max(a, b) >= floor_cd && b > 0.0;
            image.at(x, y) = is_compared ? static_cast<float>(a / b) : std::numeric_limits<float>::quiet_NaN();
        }
    return image;
}

} // namespace

std::string distinct_label(const LampFile& lamp, const LampFile& other) {
    if (lamp.opened.empty())
        return lamp.name;
    const std::filesystem::path file = lamp.opened.front().path;
    const bool is_alike = !other.opened.empty() && other.opened.front().path.filename() == file.filename();
    const std::string name = is_alike ? file.string() : file.filename().string();
    const bool says_more = !lamp.name.empty() && lamp.name != file.filename().string() && lamp.name != file.stem().string();
    return says_more ? name + " (" + lamp.name + ")" : name;
}

plots::Axis ratio_axis(const Image<float>& values) {
    std::vector<double> sizes;
    for (const float value : values.pixels())
        if (std::isfinite(value) && value > 0.0F)
            sizes.push_back(std::abs(std::log(static_cast<double>(value))));
    double most = 0.01;
    if (!sizes.empty()) {
        const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 98 / 100);
        std::ranges::nth_element(sizes, at);
        most = std::max(most, std::expm1(*at));
    }
    if (most > 0.2) {
        double factor = 2.0;
        for (const double next : {2.0, 5.0, 10.0, 100.0, 1000.0})
            if (factor = next; factor >= 1.0 + most)
                break;
        return {"new over old", "", 1.0 / factor, factor, plots::Scale::logarithmic};
    }
    double share = 0.2;
    for (const double next : {0.01, 0.02, 0.05, 0.1, 0.2})
        if (share = next; share >= most * 0.999)
            break;
    return {"new over old", "", 1.0 - share, 1.0 + share};
}

/// Of two low beams whose cut-offs lie notably apart; nullopt of others.
std::optional<double> cut_off_up_deg(const LampFile& tested, const LampFile& against) {
    constexpr double notable_deg = 0.1; // as well as a cut-off is found in coarse tables
    const std::optional<double> now_deg = check_intake(tested).cut_off_v_deg, before_deg = check_intake(against).cut_off_v_deg;
    return now_deg && before_deg && std::abs(*now_deg - *before_deg) > notable_deg ? std::optional(*now_deg - *before_deg) : std::nullopt;
}

LampDifference difference_of(const LampFile& tested, const LampFile& against, double noise_relative) {
    refuse_darkness(tested);
    refuse_darkness(against);
    LampDifference difference = compare_by_name(tested, against, {.noise_relative = noise_relative});
    const std::optional<double> up_deg =
        !difference.aim_up_deg && !difference.cut_off_up_deg && difference.any() ? cut_off_up_deg(tested, against) : std::nullopt;
    if (up_deg) {
        difference = compare_by_name(tested, against, {.noise_relative = noise_relative, .tested_up_deg = *up_deg});
        difference.undecided = fmt::format("its cut-off lies {:.2f} degrees {}; all else is told with both cut-offs at one height",
                                           std::abs(*up_deg), *up_deg > 0.0 ? "higher" : "lower");
    }
    difference.function = clear_function(tested);
    difference.function_against = clear_function(against);
    return difference;
}

std::vector<std::pair<std::string, std::string>> difference_lines(const LampFile& tested, const LampFile& against,
                                                                  const LampDifference& difference) {
    std::vector<std::pair<std::string, std::string>> lines{{"lamp", printable(distinct_label(tested, against), 400)},
                                                           {"against", printable(distinct_label(against, tested), 400)}};
    constexpr std::size_t max_reported = 8; // lamps of two makes differ in dozens of zones
    const std::vector<std::string> sentences = sentences_of(difference);
    for (std::size_t i = 0; i < std::min(max_reported, sentences.size()); ++i)
        lines.emplace_back("difference", sentences[i]);
    if (sentences.size() > max_reported)
        lines.emplace_back("", fmt::format("and {} more; --json has them all", sentences.size() - max_reported));
    lines.emplace_back("noise", fmt::format("{:.3g} % where there is more than a tenth of the peak; told is what exceeds {:.2f} times that",
                                            100.0 * difference.noise_relative, difference.z_limit));
    lines.emplace_back("compared",
                       fmt::format("{} with at least {:.3g} cd", counted(difference.directions, "direction"), difference.floor_cd));
    return lines;
}

Table named_places_table(const LampDifference& difference) {
    Table table{"places",
                "Named places, as filed: at a point the intensity, over a region its mean; ± is one standard error and what interpolation "
                "leaves open (digits: within the digits of the tables)",
                columns_of("place<|what it is for<|old [cd]|new [cd]|change [%]|± [%]|beyond noise<"),
                {}};
    const auto cd_cell = [](const std::optional<double>& cd) { return cd ? Cell(four_digits(*cd), *cd) : Cell(""); };
    for (const PlaceChange& found : difference.places) {
        const std::optional<double> change = found.change();
        const double error = found.uncertainty.value_or(0.0);
        const bool is_in_digits = uncertainty_text(error).starts_with("within");
        table.rows.push_back({Cell(found.place.name).hinted(found.place.source), found.place.what, cd_cell(found.old_cd),
                              cd_cell(found.new_cd), change ? Cell(signed_figure(100.0 * *change, 1), 100.0 * *change) : Cell(""),
                              !change        ? Cell("")
                              : is_in_digits ? Cell("digits", 100.0 * error)
                                             : Cell(two_digits(100.0 * error), 100.0 * error),
                              found.is_beyond_noise        ? "yes"
                              : found.not_measured.empty() ? "no"
                                                           : found.not_measured});
    }
    return table;
}

JsonPart difference_part(LampDifference& difference) {
    JsonPart part(JsonMembers{{"differs", difference.any()},
                              {"says", sentences_of(difference)},
                              {"aim_up_deg", difference.aim_up_deg, fitted_figure_members},
                              {"aim_right_deg", difference.aim_right_deg, fitted_figure_members},
                              {"cut_off_up_deg", difference.cut_off_up_deg, fitted_figure_members},
                              {"level_share", difference.level, fitted_figure_members},
                              {"zones", difference.zones, beam_zone_members},
                              {"places", difference.places, place_change_members},
                              {"traffic_side", difference.side, traffic_side_part},
                              {"traffic_side_against", difference.side_against, traffic_side_part},
                              {"function", difference.function, beam_function_part},
                              {"function_against", difference.function_against, beam_function_part},
                              {"directions", difference.directions},
                              {"noise_relative", difference.noise_relative},
                              {"z_limit", difference.z_limit},
                              {"floor_cd", difference.floor_cd}});
    part.read = [&difference, read = part.read](const CheckedJson& json) {
        read(json);
        if (difference.aim_up_deg.has_value() != difference.aim_right_deg.has_value())
            json.refuse("an aim up and to the right, or neither");
        const std::vector<CheckedJson> says = json.at("says").items(); // what is undecided among all else
        const std::vector<std::string> others = sentences_of(difference);
        std::size_t at = 0;
        while (at < others.size() && at < says.size() && says[at].text() == others[at])
            ++at;
        difference.undecided = says.size() > others.size() ? says[at].text() : "";
    };
    return part;
}

nlohmann::ordered_json difference_json(const LampDifference& difference) { return as_json(difference, difference_part); }

plots::Figure difference_figure(const LampFile& tested, const LampFile& against, const LampDifference& difference) {
    plots::Figure figure;
    figure.title = printable(distinct_label(tested, against)) + " against " + printable(distinct_label(against, tested));
    figure.subtitle = sentences_of(difference).front() + (difference.undecided.empty() ? "" : "; drawn as the files are");
    figure.height_px = 420.0;
    show_beam(figure, against.table);
    const Image<float> values = ratio(figure, tested.table, against.table, difference.floor_cd);
    const plots::Axis axis = ratio_axis(values);
    figure.colour_bar = plots::ColourBar{axis, true};
    figure.rasters.push_back(
        {plots::difference_map(values, axis, {225, 225, 225}), figure.x.from, figure.x.to, figure.y.to, figure.y.from});
    if (difference.zones.size() > max_framed)
        return figure;
    for (const BeamZone& zone : difference.zones)
        figure.series.push_back({.points = {{zone.h_from_deg, zone.v_from_deg},
                                            {zone.h_to_deg, zone.v_from_deg},
                                            {zone.h_to_deg, zone.v_to_deg},
                                            {zone.h_from_deg, zone.v_to_deg},
                                            {zone.h_from_deg, zone.v_from_deg}},
                                 .colour = {0, 0, 0},
                                 .width_px = 1.5});
    return figure;
}

} // namespace fernlicht
