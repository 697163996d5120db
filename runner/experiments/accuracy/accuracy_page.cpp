#include "report_files.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/write/page_base.h"

#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

data row_part(const WorkPrecision& diagram, std::size_t i, const Standing& standing) {
    const WorkPrecisionRow& row = diagram.rows[i];
    data part;
    part.set("number", fmt::format("{}", i + 1));
    part.set("label", clean_text(row.label) + (row.note.empty() ? "" : " (" + clean_text(row.note) + ")"));
    part.set("error", claimed_text(row, diagram.error_unit));
    part.set("spread", row.error ? fmt::format("{} … {}", two_digits(row.error->low), two_digits(row.error->high)) : "");
    part.set("floor", row.error && row.floor > 0.0 ? two_digits(row.floor) : "");
    part.set("time", row.seconds ? time_text(row.seconds->value) : "not measured");
    part.set("memory", row.bytes ? fmt::format("{:.1f}", static_cast<double>(*row.bytes) / (1 << 20)) : "");
    part.set("standing", row.why_not.empty() ? standing_text(standing) : clean_text(row.why_not));
    return part;
}

std::string capitalised(std::string text) {
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    return text;
}

data diagram_part(const WorkPrecision& diagram) {
    data part, rows{List::list}, notes{List::list};
    const std::vector<Standing> standing = standings(diagram.rows);
    part.set("title", clean_text(diagram.title));
    part.set("error_name", clean_text(diagram.error_name));
    part.set("time_name", clean_text(diagram.time_name));
    part.set("svg", work_precision_svg(diagram));
    for (std::size_t i = 0; i < diagram.rows.size(); ++i)
        rows.push_back(row_part(diagram, i, standing[i]));
    for (const std::string& note : diagram.notes)
        notes.push_back(capitalised(clean_text(note)));
    part.set("rows", rows);
    part.set("notes", notes);
    return part;
}

std::string quantiles_text(const std::optional<PixelErrors>& errors, const std::string& why_not) {
    if (!errors || errors->pixels == 0)
        return why_not.empty() ? "no light there" : "not measured";
    return fmt::format("{} / {} / {}", two_digits(100.0 * errors->error.median), two_digits(100.0 * errors->error.p95),
                       two_digits(100.0 * errors->error.p99));
}

data configuration_part(const ConfigurationResult& found, const DriveAccuracy& drive) {
    data part;
    part.set("label", clean_text(name_of(found.configuration)));
    part.set("road", quantiles_text(found.road, found.no_illuminance));
    part.set("view", quantiles_text(found.whole, found.no_illuminance));
    part.set("target", quantiles_text(found.target, found.no_target));
    part.set("luminance", quantiles_text(found.luminance, found.no_luminance));
    if (found.road && found.road->pixels > 0) {
        const PixelErrors& e = *found.road;
        part.set("beyond", fmt::format("{:.1f} / {:.1f} / {:.1f}", e.percent_beyond[0], e.percent_beyond[1], e.percent_beyond[2]));
        part.set("worst", fmt::format("{} % at {}, {} of frame {}", two_digits(100.0 * e.worst.error), e.worst.x, e.worst.y,
                                      drive.moments.at(static_cast<std::size_t>(e.worst.picture)).first));
        part.set("dark", e.dark_pixels > 0 ? fmt::format("{} lx", two_digits(e.dark_error.p95)) : "");
    }
    std::string reach;
    for (const ReachError& error : found.reach)
        reach += (reach.empty() ? "" : " / ") + (error.why_not.empty() ? signed_figure(error.worst_m, 2) : std::string("–"));
    part.set("reach", reach);
    return part;
}

data drive_part(const DriveAccuracy& drive) {
    data part, rows{List::list};
    part.set("title", short_text(drive.title, 160));
    part.set("variant", short_text(drive.variant, 40));
    part.set("has_choice", !drive.shadow_choice.empty());
    part.set("choice", clean_text(drive.shadow_choice));
    part.set("reference",
             fmt::format("{:.1f} s, {:.1f} million rays, {:.0f} samples a pixel in the median, {:.0f} at most", drive.reference.seconds,
                         1e-6 * static_cast<double>(drive.reference.rays), drive.reference.median_samples, drive.reference.most_samples));
    for (const ConfigurationResult& found : drive.configurations)
        rows.push_back(configuration_part(found, drive));
    part.set("rows", rows);
    data prices{List::list};
    for (const Simplification& price : drive.simplifications)
        if (price.errors && price.errors->pixels > 0) {
            const PixelErrors& e = *price.errors;
            data row;
            row.set("name", price.name);
            row.set("errors", quantiles_text(price.errors, ""));
            row.set("mean", two_digits(100.0 * e.mean));
            row.set("beyond", fmt::format("{:.1f} / {:.1f} / {:.1f}", e.percent_beyond[0], e.percent_beyond[1], e.percent_beyond[2]));
            prices.push_back(row);
        }
    part.set("has_prices", !prices.is_empty_list());
    part.set("prices", prices);
    part.set("has_twin", drive.twin && drive.twin->flat);
    if (drive.twin && drive.twin->flat) {
        const TwinAgreement& twin = *drive.twin;
        part.set("twin",
                 fmt::format("{} pixels differ by {:.1e} in the median, {:.1e} for 99 % of them, {:.1e} at worst; of {} pixels where ln E "
                             "changes by more than 50 a radian {} lie within gradient times 6e-6 rad plus rounding",
                             twin.flat->pixels, twin.flat->error.median, twin.flat->error.p99, twin.flat->worst.error,
                             twin.steep_of_bound ? twin.steep_of_bound->pixels : 0, twin.steep_within));
    }
    return part;
}

} // namespace

std::string accuracy_html(const AccuracyResult& result) {
    data page, drives{List::list}, diagrams{List::list};
    for (const WorkPrecision& diagram : result.diagrams)
        diagrams.push_back(diagram_part(diagram));
    for (const DriveAccuracy& drive : result.drives)
        drives.push_back(drive_part(drive));
    page.set("style", std::string(report_file("report.css")));
    page.set("started", clean_text(result.context.started_utc));
    page.set("interrupted", clean_text(result.interrupted));
    page.set("is_interrupted", !result.interrupted.empty());
    data missing{List::list};
    for (const std::string& what : result.missing)
        missing.push_back(clean_text(what));
    page.set("has_missing", !result.missing.empty());
    page.set("missing", missing);
    page.set("diagrams", diagrams);
    page.set("drives", drives);
    page.set("context", context_part(result.context));
    kainjow::mustache::mustache page_template{std::string(report_file("accuracy.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("accuracy.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
