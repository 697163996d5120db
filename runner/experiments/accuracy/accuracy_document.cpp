#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/findings/figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

Cell percent(double share) { return {two_digits(100.0 * share), 100.0 * share}; }

/// The share that 95 % of the pixels keep, or why there is none.
Cell p95_of(const std::optional<PixelErrors>& errors, const std::string& why_not) {
    if (!errors || errors->pixels == 0)
        return why_not.empty() ? "no light there" : "not measured";
    return percent(errors->error.p95);
}

std::string beyond_words(const PixelErrors& e) {
    return fmt::format("{:.1f} / {:.1f} / {:.1f}", e.percent_beyond[0], e.percent_beyond[1], e.percent_beyond[2]);
}

std::string reach_words(const ConfigurationResult& found, Surface surface) {
    std::string text;
    for (const double threshold_lx : measured_thresholds_lx)
        for (const ReachError& error : found.reach)
            if (error.surface == surface && error.threshold_lx == threshold_lx)
                text += (text.empty() ? "" : " / ") + (error.why_not.empty() ? fmt::format("{:+.2f}", error.worst_m) : std::string("-"));
    return text;
}

Table errors_table(const DriveAccuracy& drive) {
    Table table{
        "errors-" + drive.drive,
        "Errors where there is light: illuminance on the road, in the whole view and on targets above the road, and luminance",
        columns_of("rendered by<|road: median [%]|road: 95 % [%]|road: 99 % [%]|road: worst pixel [%]|road: beyond 1 / 5 / 20 % [% of "
                   "its area]|view: 95 % [%]|target: 95 % [%]|luminance: 95 % [%]|worst error of reach: road [1 / 5 lx, m]|worst "
                   "error of reach: target [1 / 5 lx, m]|a frame: time [ms]|a frame: textures [MiB]"),
        {}};
    for (const ConfigurationResult& found : drive.configurations) {
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{name_of(found.configuration)});
        if (found.road && found.road->pixels > 0) {
            const PixelErrors& e = *found.road;
            const double p95 = 100.0 * (e.below_floor() ? e.floor.p95 : e.error.p95);
            cells.insert(cells.end(), {percent(e.error.median), Cell((e.below_floor() ? "< " : "") + two_digits(p95), p95),
                                       percent(e.error.p99), percent(e.worst.error), beyond_words(e)});
        } else {
            cells.insert(cells.end(), 5, p95_of(found.road, found.no_illuminance));
        }
        cells.push_back(p95_of(found.whole, found.no_illuminance));
        cells.push_back(p95_of(found.target, found.no_target));
        cells.push_back(p95_of(found.luminance, found.no_luminance));
        cells.emplace_back(reach_words(found, Surface::road));
        cells.emplace_back(reach_words(found, Surface::target));
        const auto time = time_of(found.samples.frame_s);
        const auto work = typical_work(found.work);
        cells.push_back(time ? Cell(fmt::format("{:.2f}", 1e3 * time->value), time->value) : Cell("not measured"));
        cells.push_back(work ? Cell(mib_text(work->texture_bytes), static_cast<double>(work->texture_bytes)) : Cell(""));
    }
    return table;
}

/// Where each way errs most, and what it makes of places that are almost dark.
Table places_table(const DriveAccuracy& drive) {
    Table table{"places-" + drive.drive,
                "Where the errors on the road lie",
                {{.head = "rendered by", .words = true}, {"below 0.05 lx, 95 %", "lx"}, {.head = "worst pixel", .words = true}},
                {},
                true,
                true};
    for (const ConfigurationResult& found : drive.configurations)
        if (found.road && found.road->pixels > 0) {
            const PixelErrors& e = *found.road;
            table.rows.push_back({name_of(found.configuration),
                                  e.dark_pixels > 0 ? Cell(two_digits(e.dark_error.p95), e.dark_error.p95) : Cell(""),
                                  fmt::format("{} % at {}, {} of frame {}", two_digits(100.0 * e.worst.error), e.worst.x, e.worst.y,
                                              drive.moments.at(static_cast<std::size_t>(e.worst.picture)).first)});
        }
    return table;
}

Table simplifications_table(const DriveAccuracy& drive) {
    Table table{
        "simplifications-" + drive.drive,
        "What each simplification of the published techniques costs by itself: the right equation with one thing changed, in double "
        "precision on the road's triangles",
        columns_of("changed<|median [%]|95 % [%]|99 % [%]|mean, signed [%]|beyond 1 / 5 / 20 % [% of the area]"),
        {}};
    for (const Simplification& price : drive.simplifications)
        if (price.errors && price.errors->pixels > 0) {
            const PixelErrors& e = *price.errors;
            table.rows.push_back(
                {price.name, percent(e.error.median), percent(e.error.p95), percent(e.error.p99), percent(e.mean), beyond_words(e)});
        }
    return table;
}

std::string twin_words(const TwinAgreement& twin) {
    std::string text = fmt::format(
        "photometric against the double twin, which takes the one ray that a rasteriser takes: {} pixels differ by {:.1e} in the median, "
        "{:.1e} for 99 % of them, {:.1e} at worst",
        twin.flat->pixels, twin.flat->error.median, twin.flat->error.p99, twin.flat->worst.error);
    if (twin.steep_of_bound)
        text +=
            fmt::format("; of {} pixels where ln E changes by more than 50 a radian {} lie within gradient times 6e-6 rad plus "
                        "rounding, 99 % have at most {:.2g} of it, the worst {:.2g}",
                        twin.steep_of_bound->pixels, twin.steep_within, twin.steep_of_bound->error.p99, twin.steep_of_bound->worst.error);
    return text +
           fmt::format("; left out: {} pixels of several surfaces, {} with a shadow's edge.", twin.several_surfaces, twin.shadow_edges);
}

/// Signed errors with twice their standard errors.
Table edges_table(const DriveAccuracy& drive) {
    std::string columns = "by<";
    for (const char* const of : {"all", "shadows' edges", "several surfaces", "beside"})
        columns += fmt::format("|{}: pixels|{}: mean, signed [%]|{}: beyond the one ray [%]|{}: mean of shares [%]", of, of, of, of);
    Table table{
        "edges-" + drive.drive,
        "Light where shadows and surfaces end, on pixels that the reference marks and within two pixels of them: sums of light, and "
        "for comparison the mean of errors in shares",
        columns_of(columns),
        {},
        true,
        true};
    const auto signed_percent = [](double share, double standard_error) {
        return Cell(fmt::format("{:+.2f} +- {:.2f}", 100.0 * share, 200.0 * standard_error), 100.0 * share);
    };
    for (const EdgeRow& row : drive.edges) {
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{row.way});
        for (const LightAtEdges* e : {&row.all, &row.shadow, &row.surfaces, &row.beside})
            cells.insert(cells.end(), {Cell(fmt::format("{}", e->pixels), static_cast<double>(e->pixels)),
                                       signed_percent(e->mean, e->mean_standard_error),
                                       signed_percent(e->beyond_ray, e->beyond_ray_standard_error), percent(e->mean_of_shares)});
    }
    return table;
}

Section drive_section(const DriveAccuracy& drive) {
    Section section{drive.title, {}};
    section.blocks.emplace_back(
        fmt::format("{}, {}: {}. The reference took {:.1f} s, {:.1f} million rays, {:.0f} samples a pixel in the median, {:.0f} at most.",
                    drive.drive, drive.lamp_set, counted(drive.moments.size(), "moment"), drive.reference.seconds,
                    1e-6 * static_cast<double>(drive.reference.rays), drive.reference.median_samples, drive.reference.max_samples));
    if (!drive.shadow_choice.empty())
        section.blocks.emplace_back("Shadows where no method is named: " + drive.shadow_choice + ".");
    if (const auto note = point_lamps_note(drive))
        section.blocks.emplace_back("Note: " + *note + ".");
    if (drive.others_shine)
        section.blocks.emplace_back(
            "Note: lamps of other vehicles and of streets shine, in the reference too; of the techniques photometric and "
            "photometric-unpruned alone render their light, and the others' errors include it.");
    section.blocks.emplace_back(errors_table(drive));
    section.blocks.emplace_back(places_table(drive));
    if (drive.twin && drive.twin->flat)
        section.blocks.emplace_back(twin_words(*drive.twin));
    if (!drive.edges.empty())
        section.blocks.emplace_back(edges_table(drive));
    if (Table prices = simplifications_table(drive); !prices.rows.empty())
        section.blocks.emplace_back(std::move(prices));
    return section;
}

} // namespace

Document document(const AccuracyResult& result) {
    Document document{"Error against run time", {}};
    document.sections.push_back(
        {"",
         {"Each point is one way to render: its error and its cost. For filled points, on the line, no other way is both faster and more "
          "accurate; for hollow ones the list names one that is, with \xE2\x80\x9Cperhaps\xE2\x80\x9D where bars overlap or too few "
          "times were taken to be sure. In the shaded band errors are smaller than the reference's own, and none is claimed."}});
    if (const std::string disturbed = disturbance_text(result.others, result.cores); !disturbed.empty())
        document.sections.front().blocks.emplace_back("Warning: " + disturbed + ".");
    for (const WorkPrecision& diagram : result.diagrams)
        document.sections.push_back(work_precision_section(diagram));
    for (const DriveAccuracy& drive : result.drives)
        document.sections.push_back(drive_section(drive));
    return document;
}

} // namespace fernlicht
