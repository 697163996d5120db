#include "runner/experiments/importance/importance_result.h"
#include "runner/findings/figures.h"
#include "runner/findings/plots/isocandela.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

std::string value_text(const ImportanceResult& result) {
    if (!result.value.measured())
        return "not measured: " + result.why_not;
    const std::string figure = with_bound(result.value, four_digits(*result.value.figure()));
    return result.unit == "1" ? figure : fmt::format("{} {}", figure, result.unit);
}

Cell signed_cell(double value) {
    const double size = std::abs(value);
    return {signed_figure(value, size >= 10.0 ? 1 : size >= 1.0 ? 2 : size >= 0.1 ? 3 : 5), value};
}

/// The isocandela lines of a beam over what a spot of light in it changes.
plots::Figure spot_figure(const ImportanceResult& result, const ImportanceMap& beam, const SpotMap& map, const std::string& title) {
    plots::Figure figure;
    figure.title = title;
    figure.subtitle =
        fmt::format("{}: what 1000 cd more change, in a round spot about each direction, {:g}° wide at half its height; lines: "
                    "lux at 25 m as it is",
                    fmt::join(beam.lamps, ", "), result.spot_deg);
    figure.width_px = 1040.0;
    const double step_deg = map.h_deg[1] - map.h_deg[0], row_deg = map.v_deg[1] - map.v_deg[0];
    const plots::AngleWindow window{map.h_deg.front() - 0.5 * step_deg, map.h_deg.back() + 0.5 * step_deg,
                                    map.v_deg.front() - 0.5 * row_deg, map.v_deg.back() + 0.5 * row_deg};
    figure.x = {"H, right positive", "°", window.left_deg, window.right_deg};
    figure.y = {"V, up positive", "°", window.bottom_deg, window.top_deg};
    plots::fit_height(figure, window);
    const Image<float> values = image_of_map(map);
    double most = 0.0;
    for (const float value : values.pixels())
        most = std::max(most, std::abs(static_cast<double>(value)));
    const double end = most > 0.0 ? most : 1.0;
    figure.colour_bar = plots::ColourBar{{"change for 1000 cd", result.unit, -end, end}, true};
    figure.rasters.push_back(
        {plots::difference_map(values, figure.colour_bar->axis), window.left_deg, window.right_deg, window.top_deg, window.bottom_deg});
    const plots::Grid lux = plots::lux_over(beam.file->table, window);
    for (const double level : plots::isocandela_levels_lx(peak_of(beam.file->table).cd))
        figure.isolines.push_back({plots::number(level) + " lx", plots::isolines(lux, level), {120, 120, 120}, 1.0});
    figure.marks.push_back({plots::Mark::Across::at_x, 0.0, "V-V"});
    figure.marks.push_back({plots::Mark::Across::at_y, 0.0, "H-H"});
    for (const ImportanceSpot& spot : result.spots)
        if (&map == &beam.of_reading && spot.lamps == beam.lamps)
            figure.notes.push_back({spot.h_deg, spot.v_deg, "", {20, 20, 20}, true});
    return figure;
}

Table spot_table(const ImportanceResult& result) {
    const std::string& unit = result.unit;
    Table table{
        "spots",
        fmt::format("Where light matters most: {:g} cd more in a round spot there, {:g}° wide at half its height, in all lamps of the "
                    "file. Foretold by the gradient; found: the drive read again with it",
                    result.spot_cd, result.spot_deg),
        columns_of(fmt::format("lamps<|file<|H [°]|V [°]|intensity there [cd]|foretold [{0}]|found [{0}]", unit)),
        {}};
    for (const ImportanceSpot& spot : result.spots)
        table.rows.push_back({fmt::format("{}", fmt::join(spot.lamps, ", ")),
                              spot.file,
                              {figure(spot.h_deg, 2), spot.h_deg},
                              {figure(spot.v_deg, 2), spot.v_deg},
                              {four_digits(spot.cd_there), spot.cd_there},
                              signed_cell(spot.foretold),
                              spot.found.number()   ? signed_cell(*spot.found.number())
                              : spot.found.figure() ? Cell(with_bound(spot.found, signed_cell(*spot.found.figure()).text))
                                                    : Cell("not measured")});
    return table;
}

Table lamp_table(const ImportanceResult& result) {
    Table table{"lamps",
                "What 1 % more light of a lamp changes, in every direction; and the sample of its table that matters most",
                columns_of(fmt::format("lamp<|file<|1 % more [{0}]|samples that matter|H [°]|V [°]|1000 cd more in it [{0}]", result.unit)),
                {}};
    for (const ImportanceLamp& lamp : result.lamps)
        table.rows.push_back({lamp.lamp,
                              lamp.file,
                              signed_cell(lamp.per_percent),
                              {fmt::format("{}", lamp.samples), static_cast<double>(lamp.samples)},
                              {figure(lamp.h_deg, 2), lamp.h_deg},
                              {figure(lamp.v_deg, 2), lamp.v_deg},
                              signed_cell(1000.0 * lamp.per_cd)});
    return table;
}

Table decider_table(const ImportanceResult& result) {
    Table table{"moments",
                "The moments that decide the reading; share: what a change of the moment's figure changes of the reading",
                columns_of(fmt::format("tick|time [s]|along the route [m]|figure [{}]|share", result.figure_unit)),
                {}};
    for (const ImportanceMoment& moment : result.deciders)
        table.rows.push_back({{fmt::format("{}", moment.tick), static_cast<double>(moment.tick)},
                              {figure(moment.time_s, 2), moment.time_s},
                              {figure(moment.distance_m, 1), moment.distance_m},
                              {four_digits(*moment.figure.figure()), *moment.figure.figure()},
                              {figure(moment.share, 3), moment.share}});
    return table;
}

Table check_table(const ImportanceResult& result) {
    Table table{
        "check",
        fmt::format("The tables of all lamps changed at random and smoothly, by at most so much, and the drive read again: {} changes "
                    "of each size, root mean square",
                    result.checks.front().count),
        columns_of(fmt::format("size [%]|change found [{0}]|foretold less found [{0}]|as a share of it [%]|worst [{0}]", result.unit)),
        {}};
    for (const ImportanceCheck& check : result.checks)
        table.rows.push_back({{plots::number(100.0 * check.size), 100.0 * check.size},
                              {two_digits(check.found_rms), check.found_rms},
                              {two_digits(check.error_rms), check.error_rms},
                              {two_digits(100.0 * check.error_share()), 100.0 * check.error_share()},
                              {two_digits(check.worst_error), check.worst_error}});
    return table;
}

std::vector<std::string> sentences_of(const ImportanceResult& result) {
    std::vector<std::string> sentences;
    if (!result.checks.empty()) {
        const std::optional<double> size = linear_to(result);
        sentences.push_back(
            size ? fmt::format("The gradient foretells changes of the tables of up to {:g} % within {:g} % of what they change",
                               100.0 * *size, 100.0 * linear_share)
                 : "The gradient foretells none of the sizes tried: the reading has a bend here, as where another moment or "
                   "another end of the light decides after the smallest change");
        if (!agrees(result))
            sentences.push_back(fmt::format("Changes of {:g} % are foretold no better than within {:g} %: look at the moments around",
                                            100.0 * result.checks.front().size, 100.0 * result.checks.front().error_share()));
    }
    sentences.emplace_back("By the twin: without shadows. Aim, levels and lamp control stay as they are");
    return sentences;
}

} // namespace

Image<float> image_of_map(const SpotMap& map) {
    Image<float> image(static_cast<int>(map.h_deg.size()), static_cast<int>(map.v_deg.size()));
    for (std::size_t v = 0; v < map.v_deg.size(); ++v)
        for (std::size_t h = 0; h < map.h_deg.size(); ++h)
            image.at(static_cast<int>(h), static_cast<int>(map.v_deg.size() - 1 - v)) = static_cast<float>(1000.0 * map.at(v, h));
    return image;
}

Document document(const ImportanceResult& result) {
    Document document{"Where in the beam it matters", {}};
    Section& top = document.sections.emplace_back(Section{result.title + ", " + result.lamp_set, {}});
    top.verdict = !result.value.number() ? "not_measured" : result.checks.empty() ? "none" : agrees(result) ? "pass" : "fail";
    top.blocks.emplace_back(
        fmt::format("`{}` over {}: {}.", result.reading, counted(static_cast<std::size_t>(result.moments), "moment"), value_text(result)));
    if (!result.decided()) {
        top.blocks.emplace_back(result.value.number() ? "No light decides it: it stays as it is with every small change of the lamps."
                                                      : "What is not a number has no gradient.");
        return document;
    }
    top.blocks.emplace_back(spot_table(result));
    top.blocks.emplace_back(Listing(sentences_of(result)));
    Section& more = document.sections.emplace_back();
    for (std::size_t i = 0; i < result.maps.size(); ++i) {
        const ImportanceMap& map = result.maps[i];
        const std::string suffix = result.maps.size() > 1 ? fmt::format("-{}", i + 1) : "";
        more.blocks.emplace_back(Plot{"importance" + suffix, spot_figure(result, map, map.of_reading, "What decides " + result.reading)});
        if (!result.mean_gradient.empty() && result.moments > 1)
            more.blocks.emplace_back(
                Plot{"importance-mean" + suffix, spot_figure(result, map, map.of_mean, "The same of the mean over all moments")});
    }
    more.blocks.emplace_back(lamp_table(result));
    more.blocks.emplace_back(decider_table(result));
    if (!result.checks.empty())
        more.blocks.emplace_back(check_table(result));
    return document;
}

} // namespace fernlicht
