#include "runner/experiments/run/run_document.h"
#include "runner/experiments/run/run_plots.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

Cell share_cell(double share, double floor) {
    return {share < floor ? "< " + two_digits(100.0 * floor) : two_digits(100.0 * share), 100.0 * share};
}

/// With the interval that holds it, where tiles stand for the picture and it is no noise.
Cell p95_cell(const PixelErrors& errors) {
    Cell cell = share_cell(errors.error.p95, errors.floor.p95);
    if (errors.p95_between && !errors.below_floor())
        cell.text += fmt::format(" ({} to {})", two_digits(100.0 * errors.p95_between->low), two_digits(100.0 * errors.p95_between->high));
    return cell;
}

void add_error_row(Table& table, const Cell& lamp, const char* where, const std::optional<PixelErrors>& errors,
                   const std::string& why_not) {
    std::vector<Cell>& row = table.rows.emplace_back(std::vector<Cell>{lamp, where});
    if (!errors || errors->pixels == 0) {
        row.emplace_back("not measured: " + (why_not.empty() ? "no light there" : why_not));
        return;
    }
    const ErrorQuantiles &e = errors->error, &f = errors->floor;
    row.insert(row.end(), {share_cell(e.median, f.median),
                           p95_cell(*errors),
                           share_cell(e.p99, f.p99),
                           {two_digits(100.0 * f.p95), 100.0 * f.p95},
                           {signed_figure(100.0 * errors->mean, 2), 100.0 * errors->mean}});
}

/// A row a plane, a cell a limit.
void add_reach_rows(Table& table, const Cell& lamp, const DriveError& error) {
    for (const Surface surface : {Surface::road, Surface::target}) {
        std::vector<Cell> row{lamp, surface_name(surface)};
        for (const ReachError& reach : error.reach)
            if (reach.surface == surface)
                row.emplace_back(reach.why_not.empty() ? signed_figure(reach.median_m, 2) + " / " + signed_figure(reach.worst_m, 2)
                                                       : reach.why_not);
        if (!error.reach.empty())
            table.rows.push_back(std::move(row));
    }
}

std::string compared_words(const PlayedCell& played) {
    const DriveError& error = played.error;
    if (!error.measured())
        return "not measured: " + error.not_measured;
    const std::string discs =
        error.lamp_radius_m > 0.0
            ? fmt::format(", with lamps that are discs of {:g} cm radius, as soft-map renders them (for reach, points)",
                          100.0 * error.lamp_radius_m)
            : ""; // where lamps of the reference are no points
    const std::string tiles =
        error.tiles < error.tiles_of
            ? fmt::format(". Compared were {} of {} tiles of 4 × 4 pixels, drawn at random; in brackets: where the 95 % would "
                          "lie, with 95 % confidence, had all been",
                          error.tiles, error.tiles_of)
            : "";
    return fmt::format("{} against the reference in {} at {} × {} pixels{}{}. Comparing took {} s; {}", played.technique,
                       counted(error.ticks.size(), "moment"), error.width_px, error.height_px, discs, tiles, figure(error.seconds, 1),
                       played.throughput.view_s  ? fmt::format("a frame of the run takes {}", time_text(*played.throughput.view_s))
                       : played.no_times.empty() ? "too few moments were played to time a frame"
                                                 : "times are not measured: " + played.no_times);
}

} // namespace

void add_accuracy(const ComparedDrive& drive, Sections& sections) {
    Listing sentences;
    Table errors{drive.name + "-errors",
                 "",
                 columns_of("lamp<|where<|median [%]|95 % of the pixels [%]|99 % [%]|floor of the 95 % [%]|mean, signed [%]"),
                 {}};
    Table reaches{
        drive.name + "-reach-errors",
        "Error of reach on the own lane’s centre in these moments, against the reference at the same places: median / worst, m; above 0: "
        "rendered too far",
        columns_of("lamp<|on<"),
        {}};
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const PlayedCell& played = *drive.lamp_sets[i];
        const DriveError& error = played.error;
        if (!error.measured() && error.not_measured.empty())
            continue; // the run ended before, or was told to leave it out
        const Cell lamp = lamp_cell(drive, i);
        sentences.items.push_back(lamp.text + ": " + compared_words(played));
        if (!error.measured())
            continue;
        add_error_row(errors, lamp, "illuminance, road", error.road, "");
        add_error_row(errors, lamp, "illuminance, targets above it", error.target, error.no_target);
        add_error_row(errors, lamp, "illuminance, whole view", error.whole, "");
        add_error_row(errors, lamp, "luminance, whole view", error.luminance, error.no_luminance);
        if (reaches.columns.size() == 2)
            for (const ReachError& reach : error.reach)
                if (reach.surface == Surface::road)
                    reaches.columns.push_back({fmt::format("{:g} lx", reach.threshold_lx)});
        add_reach_rows(reaches, lamp, error);
    }
    if (sentences.items.empty())
        return;
    Section& section =
        sections.emplace_back(Section{"Error against run time",
                                      {"As rendered against the reference, which traces rays in double precision and knows its "
                                       "own noise: nothing is claimed below its floor. Errors are shares of the light, and only pixels "
                                       "count where the reference has at least 0.05 lx, or 0.001 cd/m².",
                                       sentences},
                                      3});
    if (!errors.rows.empty())
        section.blocks.emplace_back(std::move(errors));
    if (!reaches.rows.empty())
        section.blocks.emplace_back(std::move(reaches));
    add_plot(section, drive.name + "-error", error_figure(drive));
}

} // namespace fernlicht
