#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/findings/figures.h"
#include "runner/write/aligned_table.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using Cells = std::vector<std::string>;

std::string percent(double share) { return two_digits(100.0 * share); }

std::string reach_text(const ConfigurationResult& found, ExtentPlane plane, double limit_lx) {
    for (const ReachError& error : found.reach)
        if (error.plane == plane && error.limit_lx == limit_lx)
            return error.why_not.empty() ? fmt::format("{:+.2f}", error.worst_m) : "-";
    return "-";
}

std::string drive_table(const DriveAccuracy& drive) {
    std::vector<Cells> lines;
    for (const ConfigurationResult& found : drive.configurations) {
        Cells cells{name_of(found.configuration)};
        if (found.road && found.road->pixels > 0) {
            const PixelErrors& e = *found.road;
            cells.insert(cells.end(), {percent(e.error.median), (e.below_floor() ? "< " + percent(e.floor.p95) : percent(e.error.p95)),
                                       percent(e.error.p99), percent(e.worst.error),
                                       fmt::format("{:.1f}/{:.1f}/{:.1f}", e.percent_beyond[0], e.percent_beyond[1], e.percent_beyond[2])});
        } else {
            cells.insert(cells.end(), {"-", "-", "-", "-", "-"});
        }
        cells.push_back(found.whole && found.whole->pixels > 0 ? percent(found.whole->error.p95) : "-");
        cells.push_back(found.target && found.target->pixels > 0 ? percent(found.target->error.p95) : "-");
        cells.push_back(found.luminance && found.luminance->pixels > 0 ? percent(found.luminance->error.p95) : "-");
        for (const ExtentPlane plane : {ExtentPlane::road, ExtentPlane::target})
            cells.push_back(reach_text(found, plane, 1.0) + " " + reach_text(found, plane, 5.0));
        const auto time = time_of(found.samples.frame_s);
        const auto work = typical_work(found.work);
        cells.push_back(time ? fmt::format("{:.2f}", 1e3 * time->value) : "-");
        cells.push_back(work ? fmt::format("{:.1f}", static_cast<double>(work->texture_bytes) / (1 << 20)) : "-");
        lines.push_back(std::move(cells));
    }
    return aligned_table("<>>>>>>>>>>>>",
                         {"drawn by", "median", "95 %", "99 %", "worst", "area > 1/5/20 %", "view", "target", "cd/m2", "reach road, m",
                          "target, m", "ms", "MiB"},
                         lines);
}

std::string simplifications_table(const DriveAccuracy& drive) {
    std::vector<Cells> lines;
    for (const Simplification& price : drive.simplifications)
        if (price.errors && price.errors->pixels > 0) {
            const PixelErrors& e = *price.errors;
            lines.push_back({price.name, percent(e.error.median), percent(e.error.p95), percent(e.mean),
                             fmt::format("{:.1f}/{:.1f}/{:.1f}", e.percent_beyond[0], e.percent_beyond[1], e.percent_beyond[2])});
        }
    return lines.empty() ? ""
                         : "\nWhat each simplification costs by itself, in double precision on the road's triangles, in %\n" +
                               aligned_table("<>>>>", {"changed", "median", "95 %", "mean, signed", "area > 1/5/20 %"}, lines);
}

std::string twin_text(const DriveAccuracy& drive) {
    if (!drive.twin || !drive.twin->flat)
        return "";
    const TwinAgreement& twin = *drive.twin;
    std::string text = fmt::format("\nphotometric against the double twin: {} pixels, error {:.1e} (median), {:.1e} (99 %), {:.1e} (worst)",
                                   twin.flat->pixels, twin.flat->error.median, twin.flat->error.p99, twin.flat->worst.error);
    if (twin.steep_of_bound)
        text += fmt::format(
            "; {} pixels where ln E changes by more than 50 a radian: {} within the bound by their gradient, 99 % have at most {:.2g} "
            "of it, the worst {:.2g}",
            twin.steep_of_bound->pixels, twin.steep_within, twin.steep_of_bound->error.p99, twin.steep_of_bound->worst.error);
    return text +
           fmt::format("; left out: {} pixels of several surfaces, {} with a shadow's edge\n", twin.several_surfaces, twin.shadow_edges);
}

/// Who is on the front, and who is beaten by whom.
std::string front_text(const WorkPrecision& diagram) {
    const std::vector<Standing> standing = standings(diagram.rows);
    std::string front, beaten, open;
    const auto add = [](std::string& list, const std::string& what) { list += (list.empty() ? "" : "; ") + what; };
    for (std::size_t i = 0; i < standing.size(); ++i) {
        const WorkPrecisionRow& row = diagram.rows[i];
        if (standing[i].on_front)
            add(front, fmt::format("{} ({}, {})", row.label, claimed_text(row, diagram.error_unit), time_text(row.seconds->value)));
        else if (standing[i].dominated_by)
            add(beaten,
                fmt::format("{} by {}{}", row.label, diagram.rows[*standing[i].dominated_by].label, standing[i].surely ? "" : ", perhaps"));
        else
            add(open, row.label + ": " + row.why_not);
    }
    std::string text = fmt::format("\n{}: {} against {}\n", diagram.title, diagram.error_name, diagram.time_name);
    for (const auto& [what, list] : {std::pair("  on the front: ", front), {"  beaten: ", beaten}, {"  not measured: ", open}})
        text += list.empty() ? "" : what + list + "\n";
    return text;
}

} // namespace

std::string accuracy_text(const AccuracyResult& result) {
    std::string text = fmt::format("{} through {}; {}, {}\n", result.context.gl_renderer, result.context.backend, result.context.cpu,
                                   counted(result.cores, "core"));
    for (const DriveAccuracy& drive : result.drives) {
        text += fmt::format("\n{}, {}: {}; the reference took {:.1f} s, {:.1f} million rays, {:.0f} samples a pixel in the median\n",
                            drive.drive, drive.variant, counted(drive.moments.size(), "moment"), drive.reference.seconds,
                            1e-6 * static_cast<double>(drive.reference.rays), drive.reference.median_samples);
        if (!drive.shadow_choice.empty())
            text += fmt::format("Shadows where no method is named: {}\n", drive.shadow_choice);
        if (const auto note = point_lamps_note(drive))
            text += fmt::format("Note: {}\n", *note);
        text += "Error of illuminance in % (road: median, 95 %, 99 %, worst pixel, % of its area beyond 1, 5 and 20 %; whole view and "
                "target: 95 %),\n"
                "of luminance (95 %), worst error of reach at 1 and 5 lx, time a frame, textures\n";
        text += drive_table(drive) + simplifications_table(drive) + twin_text(drive);
    }
    for (const WorkPrecision& diagram : result.diagrams)
        text += front_text(diagram);
    return text;
}

} // namespace fernlicht
