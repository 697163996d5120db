#include "report_files.h"
#include "runner/experiments/run/page_parts.h"
#include "runner/experiments/run/page_plots.h"
#include "runner/experiments/run/page_signals.h"
#include "runner/experiments/run/report_writers.h"
#include "runner/files/clean_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

/// Of pictures as they lie on disk; base64 makes a third more of it. Larger pages open slowly.
constexpr std::size_t embedded_bytes = std::size_t{48} << 20;

/// What people call the drive; its name where it has no title.
const std::string& shown_name(const ComparedDrive& drive) {
    const std::string& title = drive.variants.front()->title;
    return title.empty() ? drive.name : title;
}

std::string title_of(const std::vector<ComparedDrive>& drives) {
    std::string title;
    for (const ComparedDrive& drive : drives)
        title += (title.empty() ? "" : ", ") + short_text(shown_name(drive), 90);
    return title.empty() ? "Nothing was played" : short_text(title, 160);
}

data plots_part(const ComparedDrive& drive) {
    data part, reaches{List::list};
    bool has_reaches = false;
    const auto add = [&](data& list, const std::string& svg) {
        if (!svg.empty())
            list.push_back(svg);
        return !svg.empty();
    };
    const std::vector<double> limits_lx = plotted_limits_lx(drive);
    for (const ExtentPlane plane : {ExtentPlane::road, ExtentPlane::target})
        for (const double limit_lx : limits_lx)
            has_reaches = add(reaches, reach_svg(drive, plane, limit_lx)) || has_reaches;
    data speeds{List::list}, timings{List::list};
    part.set("has_reaches", has_reaches);
    part.set("reaches", reaches);
    add(speeds, speed_svg(drive));
    for (const std::string& svg : car_svgs(drive))
        add(speeds, svg);
    part.set("speeds", speeds);
    data seen{List::list};
    bool has_seen = false;
    for (const std::string& svg : seeing_svgs(drive))
        has_seen = add(seen, svg) || has_seen;
    data controlled{List::list};
    bool has_controlled = false;
    for (const std::string& svg : control_svgs(drive))
        has_controlled = add(controlled, svg) || has_controlled;
    part.set("has_controlled", has_controlled);
    part.set("controlled", controlled);
    data signals{List::list};
    const std::vector<std::string> of_signals = signal_svgs(drive);
    for (const std::string& svg : of_signals)
        add(signals, svg);
    part.set("has_signals", !of_signals.empty());
    part.set("has_signal_light", of_signals.size() > drive.variants.front()->bus.signals.size());
    part.set("signals", signals);
    part.set("signal_table", signal_table(drive));
    part.set("signal_sentence", signal_sentence(drive));
    part.set("has_seen", has_seen);
    part.set("seen", seen);
    const data passes = timing_table(drive);
    part.set("has_timing", add(timings, timing_svg(drive)) || passes.is_non_empty_list()); // short runs have tables alone
    part.set("timings", timings);
    part.set("passes", passes);
    part.set("throughput", throughput_table(drive));
    return part;
}

/// "halogen against xenon, played 2024-11-21T19:30:00Z"
std::string subtitle_of(const Report& report) {
    std::vector<std::string> names;
    for (const PlayedVariant& played : report.played)
        if (std::find(names.begin(), names.end(), played.variant) == names.end())
            names.push_back(played.variant);
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : " against ") + short_text(name, 40);
    return (text.empty() ? "Played " : text + ", played ") + clean_text(report.context.started_utc);
}

data drive_part(const ComparedDrive& drive, const std::filesystem::path& folder, std::size_t& budget_bytes, std::size_t number) {
    data part;
    part.set("number", fmt::format("{}", number));
    part.set("name", short_text(drive.name, 200));
    const data headline = headline_reaches(drive);
    part.set("has_headline", !headline.is_empty_list());
    part.set("headline", headline);
    part.set("extents", extent_tables(drive));
    part.set("pictures", moments_part(drive, folder, budget_bytes));
    part.set("plots", plots_part(drive));
    part.set("columns", fmt::format("{}", drive.variants.size()));
    part.set("details", details_part(drive));
    part.set("error", error_part(drive));
    return part;
}

} // namespace

std::string report_html(const Report& report, const std::filesystem::path& folder) {
    const std::vector<ComparedDrive> drives = compared_drives(report);
    std::size_t budget_bytes = embedded_bytes;
    data page, parts{List::list};
    for (std::size_t i = 0; i < drives.size(); ++i)
        parts.push_back(drive_part(drives[i], folder, budget_bytes, i + 1));
    page.set("title", title_of(drives));
    page.set("subtitle", subtitle_of(report));
    page.set("several", drives.size() > 1);
    page.set("style", std::string(report_file("report.css")));
    page.set("script", std::string(report_file("report.js")));
    page.set("extent_table", std::string(report_file("extent_table.mustache")));
    page.set("verdict", verdict_part(report));
    page.set("drives", parts);
    if (report.live)
        page.set("live", live_part(*report.live));
    page.set("context", context_part(report.context));
    kainjow::mustache::mustache page_template{std::string(report_file("report.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("report.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
