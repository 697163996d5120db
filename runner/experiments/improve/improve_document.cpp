#include "runner/experiments/improve/improve_result.h"
#include "runner/findings/figures.h"
#include "runner/findings/plots/isocandela.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

Cell value_cell(const Value& value) {
    if (!value.measured())
        return "not measured";
    return {with_bound(value, four_digits(*value.figure())), *value.figure()};
}

/// By how much a reading moved; "" where it is no number.
Cell moved_cell(const Value& to, const Value& from) {
    if (!to.number() || !from.number())
        return "";
    const double by = *to.number() - *from.number(), size = std::abs(by);
    return {signed_figure(by, size >= 10.0 ? 1 : size >= 1.0 ? 2 : size >= 0.1 ? 3 : 4), by};
}

std::string sought_text(const ImprovedReading& line) {
    return fmt::format("{} {} {}", line.at_least ? "at least" : "at most", four_digits(line.bound), unit_of(line.reading));
}

Table reading_table(const ImproveResult& result) {
    Table table{"readings",
                "What was asked. Foretold: by the gradient before the last step; found: the drive read again with the written lamp",
                columns_of("drive<|reading`|asked<|sought<|before|foretold|found|gained|met<"),
                {}};
    for (const ImprovedReading& line : result.readings)
        table.rows.push_back({line.drive, name_of(line.reading), line.is_gain ? "gain" : "keep", sought_text(line), value_cell(line.before),
                              value_cell(line.foretold), value_cell(line.found), moved_cell(line.found, line.before),
                              line.met ? "yes" : Cell("no")});
    return table;
}

Table change_table(const ImproveResult& result) {
    Table table{"change", "The change of the candela table", columns_of("of<|H [°]|V [°]|before|after|in<"), {}};
    const auto add = [&](const char* of, const ImproveExtreme& place) {
        table.rows.push_back({of,
                              {figure(place.h_deg, 2), place.h_deg},
                              {figure(place.v_deg, 2), place.v_deg},
                              {four_digits(place.before_cd), place.before_cd},
                              {four_digits(place.after_cd), place.after_cd},
                              "cd"});
    };
    if (result.most.after_cd > result.most.before_cd)
        add("most light more", result.most);
    if (result.least.after_cd < result.least.before_cd)
        add("most light less", result.least);
    add("brightest, after", result.brightest);
    table.rows.push_back({"flux",
                          "",
                          "",
                          {four_digits(result.flux_before_lm), result.flux_before_lm},
                          {four_digits(result.flux_after_lm), result.flux_after_lm},
                          "lm"});
    table.rows.push_back({"steepest between samples",
                          "",
                          "",
                          {four_digits(result.steepest_before), result.steepest_before},
                          {four_digits(result.steepest_after), result.steepest_after},
                          "cd/°"});
    return table;
}

Table step_table(const ImproveResult& result) {
    Table table{"steps",
                "Each step: how far the change may go in it, what is foretold and what was found. One that was not better is not taken, "
                "and the next "
                "is half as long. Size: root of the integral of the relative change squared, with its bends",
                columns_of("step|longest [%]|size [°]|reading`|drive<|foretold|found|taken<"),
                {}};
    for (std::size_t k = 0; k < result.steps.size(); ++k) {
        const ImproveStep& step = result.steps[k];
        for (std::size_t i = 0; i < result.readings.size(); ++i)
            table.rows.push_back({i == 0 ? Cell(fmt::format("{}", k + 1), static_cast<double>(k + 1)) : Cell(""),
                                  i == 0 ? Cell(plots::number(100.0 * step.longest), 100.0 * step.longest) : Cell(""),
                                  i == 0 ? Cell(figure(step.size, 3), step.size) : Cell(""), name_of(result.readings[i].reading),
                                  result.readings[i].drive, value_cell(step.foretold[i]), value_cell(step.found[i]),
                                  i > 0                          ? ""
                                  : step.taken                   ? "yes"
                                  : !step.regulation_row.empty() ? Cell("no: " + step.regulation_row + " would get worse than it may")
                                                                 : Cell("no")});
    }
    table.folded = true;
    return table;
}

Table binding_table(const ImproveResult& result) {
    Table table{"binding",
                result.gain_missed ? "What stands against the gain that is missing, and what 1 % less of it would give of that gain"
                                   : "What holds the change where it is, and how much smaller its square would be with 1 % less of it",
                columns_of(result.gain_missed ? "limit<|1 % less gives of the gain [%]" : "limit<|1 % less saves of the change [%]"),
                {}};
    for (const BindingLimit& limit : result.binding)
        table.rows.push_back({limit.of, {two_digits(100.0 * limit.worth), 100.0 * limit.worth}});
    return table;
}

Table row_table(const ImproveResult& result) {
    Table table{
        "regulation",
        fmt::format("{}, by our table of it, before and after; no approval", result.regulation_title),
        columns_of("row<|limit|in<|before: found|before: margin [%]|before: verdict<|after: found|after: margin [%]|after: verdict<"),
        {}};
    const auto number = [](double value, const std::string& unit) {
        return Cell(unit == "cd" ? fmt::format("{:.0f}", value) : figure(value, 3), value);
    };
    const auto margin = [](double value) { return Cell(std::isfinite(value) ? signed_figure(100.0 * value, 1) : "", value); };
    for (const ImprovedRow& row : result.rows)
        table.rows.push_back({row.id, row.limits, row.unit.empty() ? "1" : row.unit, number(row.before, row.unit),
                              margin(row.before_margin), row.before_verdict, number(row.after, row.unit), margin(row.after_margin),
                              row.after_verdict});
    return table;
}

/// Where the change is more than a hundredth of its largest, with room round it.
plots::AngleWindow window_of(const ImproveResult& result) {
    constexpr double beside_deg = 3.0, above_deg = 1.5;
    const double most =
        std::max(std::abs(result.most.after_cd - result.most.before_cd), std::abs(result.least.after_cd - result.least.before_cd));
    const CandelaTable& table = result.before;
    plots::AngleWindow window{180.0, -180.0, 90.0, -90.0};
    for (std::size_t i = 0; i < table.cd.size(); ++i)
        if (std::abs(result.after.cd[i] - table.cd[i]) > 0.01 * most) {
            const double h = table.h_deg[i % table.h_deg.size()], v = table.v_deg[i / table.h_deg.size()];
            window = {std::min(window.left_deg, h), std::max(window.right_deg, h), std::min(window.bottom_deg, v),
                      std::max(window.top_deg, v)};
        }
    return {std::floor(window.left_deg - beside_deg), std::ceil(window.right_deg + beside_deg), std::floor(window.bottom_deg - above_deg),
            std::ceil(window.top_deg + above_deg)};
}

/// The change in colour over both beams' isocandela lines.
plots::Figure change_figure(const ImproveResult& result, const plots::AngleWindow& window) {
    plots::Figure figure;
    figure.title = "What changes";
    figure.subtitle = fmt::format("{}: candela more or less; lines: lux at 25 m, before in grey, after in black", result.lamp);
    figure.width_px = 1040.0;
    figure.x = {"H, right positive", "°", window.left_deg, window.right_deg};
    figure.y = {"V, up positive", "°", window.bottom_deg, window.top_deg};
    plots::fit_height(figure, window);
    const double step_deg = std::max(0.02, (window.right_deg - window.left_deg) / 800.0);
    const auto columns = static_cast<int>(std::ceil((window.right_deg - window.left_deg) / step_deg)),
               rows = static_cast<int>(std::ceil((window.top_deg - window.bottom_deg) / step_deg));
    Image<float> change(columns, rows);
    double most = 0.0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const double h = std::lerp(window.left_deg, window.right_deg, (x + 0.5) / columns),
                         v = std::lerp(window.top_deg, window.bottom_deg, (y + 0.5) / rows);
            const double cd = intensity_cd(result.after, h, v) - intensity_cd(result.before, h, v);
            change.at(x, y) = static_cast<float>(cd);
            most = std::max(most, std::abs(cd));
        }
    const double end = most > 0.0 ? most : 1.0;
    figure.colour_bar = plots::ColourBar{{"change", "cd", -end, end}, true};
    figure.rasters.push_back(
        {plots::difference_map(change, figure.colour_bar->axis), window.left_deg, window.right_deg, window.top_deg, window.bottom_deg});
    const auto add_lines = [&](const CandelaTable& table, plots::Colour colour, double width_px, bool named) {
        const plots::Grid lux = plots::lux_over(table, window);
        for (const double level : plots::isocandela_levels_lx(peak_of(result.after).cd))
            figure.isolines.push_back({named ? plots::number(level) + " lx" : "", plots::isolines(lux, level), colour, width_px});
    };
    add_lines(result.before, {150, 150, 150}, 1.0, false);
    add_lines(result.after, {30, 30, 30}, 1.0, true);
    figure.marks.push_back({plots::Mark::Across::at_x, 0.0, "V-V"});
    figure.marks.push_back({plots::Mark::Across::at_y, 0.0, "H-H"});
    return figure;
}

std::vector<std::string> sentences_of(const ImproveResult& result) {
    std::vector<std::string> sentences;
    for (const ImprovedReading& line : result.readings) {
        if (line.met || !line.found.number() || !line.before.number())
            continue;
        const double asked = line.bound - *line.before.number(), had = *line.found.number() - *line.before.number();
        sentences.push_back(line.is_gain ? fmt::format("{} of {}: {} {} were asked, {} are to be had within what must be kept",
                                                       name_of(line.reading), line.drive, signed_figure(asked, 2), unit_of(line.reading),
                                                       signed_figure(had, 2))
                                         : fmt::format("{} of {} is not kept", name_of(line.reading), line.drive));
    }
    for (const ImprovedRow& row : result.rows)
        if (row.before_verdict == "pass" && row.after_verdict != "pass")
            sentences.push_back(fmt::format("{} of {} passed before and does not now", row.id, result.regulation));
    const auto refused = std::ranges::find_if(result.steps.rbegin(), result.steps.rend(),
                                              [](const ImproveStep& step) { return !step.taken && !step.regulation_row.empty(); });
    if (result.gain_missed && !result.settled)
        sentences.push_back(
            refused != result.steps.rend()
                ? fmt::format("No step was found that goes farther: {} would get worse than it may", refused->regulation_row)
                : fmt::format("No step was found that goes farther within {}", counted(result.steps.size(), "step")));
    else if (result.gain_missed && !result.binding.empty())
        sentences.push_back(fmt::format("Most of all {} stands against it", result.binding.front().of));
    sentences.push_back(
        fmt::format("Every change counts against the light that is there and {} cd more; bends over less than {:g}° in H, and half of "
                    "that in V, count as much as size does. {} knots, solved by {}",
                    four_digits(result.floor_cd), result.narrowest_deg, result.variables, result.solver));
    sentences.emplace_back(
        "By the twin: without shadows. A proposal of light, not of an optic: whether a reflector or a lens can make it is not asked");
    return sentences;
}

} // namespace

Document document(const ImproveResult& result) {
    Document document{"A better beam", {}};
    Section& top = document.sections.emplace_back(Section{fmt::format("{}: {}", result.lamp, result.written), {}});
    top.verdict = improved(result) ? "pass" : "fail";
    std::vector<std::string> drives;
    for (const ImproveDrive& drive : result.drives)
        drives.push_back(
            fmt::format("{}, {}: {}", drive.title, drive.lamp_set, counted(static_cast<std::size_t>(drive.moments), "moment")));
    top.blocks.emplace_back(fmt::format("{} {}. Drives: {}.",
                                        improved(result) ? "All that was asked is met by" : "Not all that was asked is met by",
                                        "`" + result.written + "`", fmt::join(drives, "; ")));
    top.blocks.emplace_back(reading_table(result));
    if (!result.regulation.empty())
        top.blocks.emplace_back(fmt::format("{}: {} before, {} after.", result.regulation, result.verdict_before, result.verdict_after));
    top.blocks.emplace_back(Listing(sentences_of(result)));
    Section& more = document.sections.emplace_back();
    if (result.samples_changed > 0) {
        const plots::AngleWindow window = window_of(result);
        more.blocks.emplace_back(Plot{"improve", change_figure(result, window)});
        const double peak = std::max(peak_of(result.before).cd, peak_of(result.after).cd);
        more.blocks.emplace_back(Plot{"beams", FiguresBeside{plots::isocandela_diagram(result.before, "Before", window, peak),
                                                             plots::isocandela_diagram(result.after, "After", window, peak)}});
    }
    more.blocks.emplace_back(change_table(result));
    if (!result.binding.empty())
        more.blocks.emplace_back(binding_table(result));
    if (!result.rows.empty())
        more.blocks.emplace_back(row_table(result));
    more.blocks.emplace_back(step_table(result));
    return document;
}

} // namespace fernlicht
