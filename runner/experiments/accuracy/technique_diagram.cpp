#include "metrics/statistics/statistics.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// `moments`: of the drive's sweep.
WorkPrecisionRow row_of(const ConfigurationResult& found, std::size_t moments) {
    const Configuration& c = found.configuration;
    WorkPrecisionRow row;
    row.label = name_of(c);
    row.parameters = {{"technique", c.technique},
                      {"resolution", fmt::format("{}x{}", c.width_px, c.height_px)},
                      {"shadow maps", fmt::format("{}x{}", c.shadows.width, c.shadows.height)},
                      {"shadows", std::string(name(c.shadows.method))},
                      {"beams", beams_text(c.beams)}};
    if (c.beams == eight_bit_texels && c.varied == "beams")
        row.note = "thesis";
    if (found.moments < moments)
        row.note += fmt::format("{}{} of {} moments", row.note.empty() ? "" : ", ", found.moments, moments);
    row.why_not = found.no_illuminance;
    if (found.road && found.road->pixels > 0) {
        const auto [least, most] = std::ranges::minmax(found.road_p95);
        const double p95 = found.road->error.p95;
        row.error = {100.0 * p95, 100.0 * std::min(p95, least), 100.0 * std::max(p95, most)};
        row.floor = 100.0 * found.road->floor.p95;
    } else if (row.why_not.empty()) {
        row.why_not = "no road in view has 0.05 lx";
    }
    row.seconds = time_of(found.samples.frame_s);
    if (!row.seconds && row.why_not.empty())
        row.why_not = "the sweep ended before times were taken";
    if (const auto work = typical_work(found.work))
        row.bytes = work->texture_bytes;
    return row;
}

/// Over the time a frame.
WorkPrecision new_diagram(const DriveAccuracy& drive, const std::string& name, const std::string& title, const char* error_name,
                          const char* error_unit, std::string note) {
    WorkPrecision diagram;
    diagram.name = name;
    diagram.title = fmt::format("{}: {}, {}", title, drive.drive, drive.lamp_set);
    diagram.error_name = error_name;
    diagram.error_unit = error_unit;
    diagram.time_name = "time a frame";
    diagram.notes.push_back(std::move(note));
    return diagram;
}

void add_point_lamps_note(WorkPrecision& diagram, const DriveAccuracy& drive) {
    if (auto note = point_lamps_note(drive))
        diagram.notes.push_back(std::move(*note));
}

/// Edges of shadows are too few pixels for the 95 % that others are held to: what a pixel is off by counts here, wherever it is.
WorkPrecision view_diagram(const DriveAccuracy& drive, const char* name, const char* title) {
    WorkPrecision diagram =
        new_diagram(drive, name + drive.drive, title, "pixels of the view off by more than 20 %", "%",
                    "illuminance in the driver's view where the reference has at least 0.05 lx, beyond its noise: edges of shadows, and of "
                    "things, whose pixels the reference averages");
    add_point_lamps_note(diagram, drive);
    return diagram;
}

WorkPrecisionRow view_row_of(const ConfigurationResult& found, std::size_t moments, std::string label) {
    WorkPrecisionRow row = row_of(found, moments);
    row.label = std::move(label);
    row.floor = 0.0;
    if (found.whole && found.whole->pixels > 0)
        row.error = exactly(found.whole->percent_beyond[2]);
    return row;
}

bool has_shadow_methods(const DriveAccuracy& drive) {
    return std::ranges::any_of(drive.configurations,
                               [](const ConfigurationResult& found) { return found.configuration.varied == "shadow method"; });
}

/// Beside photometric by other shadow methods the drive's own is named, too.
std::string label_among_methods(Configuration c) {
    if (c.technique == "photometric" && c.varied.empty())
        c.varied = "shadow method";
    return name_of(c);
}

/// Of the drive's own shadow method.
std::string own_method_note(const DriveAccuracy& drive) {
    const auto own =
        std::ranges::find_if(drive.configurations, [](const ConfigurationResult& found) { return found.configuration.varied.empty(); });
    return own == drive.configurations.end()
               ? "the drive's own shadow method is not among those that were rendered"
               : fmt::format("shadows where no method is named: {}, the drive's own{}", name(own->configuration.shadows.method),
                             drive.shadow_choice.empty() ? "" : " (" + drive.shadow_choice + ")");
}

/// What the bars of times are.
std::string times_note(const DriveAccuracy& drive) {
    std::optional<Interval> time;
    for (const ConfigurationResult& found : drive.configurations)
        if (const auto of = time_of(found.samples.frame_s); of && (!time || of->samples < time->samples))
            time = of;
    return time ? "times are " + timings_text(*time) : "times were not taken";
}

/// At one resolution: error of illuminance on the road (95 % of the pixels) over time a frame; bars: the moments' least and most, the
/// median's 95 % interval or, of fewer than six rounds, their least and most.
WorkPrecision techniques_diagram(const DriveAccuracy& drive, int width_px, int height_px) {
    WorkPrecision diagram =
        new_diagram(drive, fmt::format("techniques-{}-{}x{}", drive.drive, width_px, height_px), "Techniques",
                    "lux error on the road, 95 % of the pixels", "%",
                    fmt::format("{}; errors of illuminance in the driver's view where the reference has at least 0.05 lx, bars from the "
                                "least to the most of the moments",
                                counted(drive.moments.size(), "moment")));
    diagram.title += fmt::format(", {} x {} pixels", width_px, height_px);
    diagram.floor_name = "noise of the reference";
    diagram.notes.push_back(times_note(drive));
    add_point_lamps_note(diagram, drive);
    const bool methods = has_shadow_methods(drive);
    if (methods)
        diagram.notes.push_back(own_method_note(drive));
    for (const ConfigurationResult& found : drive.configurations)
        if (found.configuration.width_px == width_px && found.configuration.height_px == height_px) {
            diagram.rows.push_back(row_of(found, drive.moments.size()));
            if (methods)
                diagram.rows.back().label = label_among_methods(found.configuration);
        }
    for (const auto& [configuration, why] : drive.refused)
        if (configuration.width_px == width_px && configuration.height_px == height_px) {
            WorkPrecisionRow& row = diagram.rows.emplace_back();
            row.label = name_of(configuration);
            row.why_not = why;
        }
    return diagram;
}

/// The same ways at more than one resolution: worst error of reach over time a frame.
WorkPrecision resolutions_diagram(const DriveAccuracy& drive) {
    WorkPrecision diagram =
        new_diagram(drive, "resolutions-" + drive.drive, "Resolutions", "worst error of reach, 1 and 5 lx", "m",
                    "reach on the own lane's centre, on the road and, where the technique has it, on targets, against the reference's "
                    "finest map; maps for reach have as many pixels each way as the view has, in the same ratio");
    add_point_lamps_note(diagram, drive);
    for (const ConfigurationResult& found : drive.configurations) {
        const auto others = std::ranges::count_if(drive.configurations, [&](const ConfigurationResult& other) {
            return other.configuration.technique == found.configuration.technique &&
                   (other.configuration.varied.empty() || other.configuration.varied == "resolution");
        });
        if (others < 2 || (!found.configuration.varied.empty() && found.configuration.varied != "resolution"))
            continue;
        WorkPrecisionRow row = row_of(found, drive.moments.size());
        row.label = fmt::format("{}, {}x{}", found.configuration.technique, found.configuration.width_px, found.configuration.height_px);
        row.floor = 0.0;
        row.error.reset();
        std::vector<double> sizes;
        for (const ReachError& error : found.reach)
            if (error.why_not.empty())
                sizes.push_back(std::abs(error.worst_m));
        if (const auto spread = spread_of(sizes))
            row.error = {spread->maximum, spread->minimum, spread->maximum};
        else if (row.why_not.empty())
            row.why_not = "no moment has a reach that ends on the road";
        diagram.rows.push_back(std::move(row));
    }
    return diagram;
}

/// The same way with other shadow maps: pixels of the view that are off by more than a fifth over time a frame.
WorkPrecision shadow_maps_diagram(const DriveAccuracy& drive) {
    WorkPrecision diagram = view_diagram(drive, "shadow-maps-", "Shadow maps");
    for (const ConfigurationResult& found : drive.configurations) {
        const Configuration& c = found.configuration;
        if (c.technique == "photometric" && (c.varied.empty() || c.varied == "shadow maps"))
            diagram.rows.push_back(view_row_of(found, drive.moments.size(), fmt::format("{} x {}", c.shadows.width, c.shadows.height)));
    }
    return diagram;
}

/// By the same measure all techniques, and photometric by each shadow method, at the drive's resolution; no rows where no methods were
/// tried.
WorkPrecision shadow_methods_diagram(const DriveAccuracy& drive) {
    WorkPrecision diagram = view_diagram(drive, "shadow-methods-", "Shadow methods and techniques");
    if (!has_shadow_methods(drive))
        return diagram;
    diagram.notes.push_back(own_method_note(drive));
    for (const ConfigurationResult& found : drive.configurations)
        if (const Configuration& c = found.configuration; c.varied.empty() || c.varied == "shadow method")
            diagram.rows.push_back(view_row_of(found, drive.moments.size(), label_among_methods(c)));
    return diagram;
}

} // namespace

std::optional<Interval> time_of(const std::vector<double>& seconds) {
    const std::optional<Spread> spread = spread_of(seconds);
    if (!spread)
        return std::nullopt;
    if (const auto interval = median_interval(seconds))
        return Interval{spread->median, interval->low, interval->high, spread->count, true};
    return Interval{spread->median, spread->minimum, spread->maximum, spread->count};
}

std::optional<std::string> point_lamps_note(const DriveAccuracy& drive) {
    const auto soft = std::ranges::find_if(drive.configurations, [](const ConfigurationResult& found) {
        const std::string& technique = found.configuration.technique;
        return found.configuration.shadows.method == ShadowMethod::soft_map && technique.starts_with("photometric") &&
               technique != "photometric-naive";
    });
    if (soft == drive.configurations.end())
        return std::nullopt;
    return fmt::format("lamps are points in the reference: the half shadows of soft-map, whose lamps are discs of {:g} cm radius, count as "
                       "its errors here; `fernlicht shadows` holds it against discs (discs %)",
                       100.0 * soft->configuration.shadows.lamp_radius_m);
}

std::vector<WorkPrecision> sweep_diagrams(const DriveAccuracy& drive) {
    std::vector<std::pair<int, int>> sizes;
    for (const ConfigurationResult& found : drive.configurations)
        if (const std::pair size(found.configuration.width_px, found.configuration.height_px);
            std::ranges::find(sizes, size) == sizes.end())
            sizes.push_back(size);
    std::vector<WorkPrecision> diagrams;
    for (const auto& [width_px, height_px] : sizes) {
        WorkPrecision diagram = techniques_diagram(drive, width_px, height_px);
        if (diagrams.empty() || diagram.rows.size() > 2) // two that only show what resolution costs are in the other diagram
            diagrams.push_back(std::move(diagram));
    }
    if (WorkPrecision diagram = resolutions_diagram(drive); sizes.size() > 1 && !diagram.rows.empty())
        diagrams.push_back(std::move(diagram));
    for (WorkPrecision diagram : {shadow_maps_diagram(drive), shadow_methods_diagram(drive)})
        if (diagram.rows.size() > 1)
            diagrams.push_back(std::move(diagram));
    return diagrams;
}

} // namespace fernlicht
