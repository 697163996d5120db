#include "runner/findings/lamp_aim.h"

#include "runner/files/clean_text.h"
#include "runner/files/described_json.h"
#include "runner/findings/figures.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr const char* none = "\u2013";

Cell signed_cell(const std::optional<double>& value, int decimals = 2) {
    if (!value)
        return none;
    const double shown = std::abs(*value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : *value; // no -0.00
    return {signed_figure(shown, decimals), *value};
}

/// "auto to -1 %", "as-is".
std::string rule_text(const LampAim& aim) {
    return aim.cut_off_percent ? fmt::format("auto to {:g} %", *aim.cut_off_percent) : std::string("as-is");
}

std::string found_text(const LampAim& aim) {
    if (!aim.file_up_deg)
        return "nothing: " + aim.why_not;
    const std::string bound = aim.up_bound_deg > 0.0 ? fmt::format(", \u00b1{:.2f} up{}", aim.up_bound_deg,
                                                                   aim.file_right_deg && aim.right_bound_deg > 0.0
                                                                       ? fmt::format(", \u00b1{:.2f} sideways", aim.right_bound_deg)
                                                                       : "")
                                                     : "";
    return aim.by + bound + (aim.why_not.empty() ? "" : "; nothing sideways: " + aim.why_not);
}

std::string band_text(const LampAim& aim) {
    if (aim.high_beam)
        return none;
    if (!aim.band_lowest_percent)
        return "no band known";
    return fmt::format("{} \u2026 {}{}", figure(*aim.band_highest_percent, 2), figure(*aim.band_lowest_percent, 2),
                       aim.warning.empty() ? "" : ": outside");
}

/// Alike but for which lamp it is.
bool is_told_alike(LampAim a, const LampAim& b) {
    a.lamp = b.lamp;
    return a == b;
}

std::string joined_names(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

/// Indices of lamps, the alike ones together.
template <class Alike> std::vector<std::vector<std::size_t>> together(const std::vector<LampAim>& aims, Alike alike) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < aims.size(); ++i) {
        const auto same = [&](const std::vector<std::size_t>& group) { return alike(aims[group.front()], aims[i]); };
        if (const auto group = std::ranges::find_if(groups, same); group != groups.end())
            group->push_back(i);
        else
            groups.push_back({i});
    }
    return groups;
}

std::string names_in(const std::vector<LampAim>& aims, const std::vector<std::size_t>& group) {
    std::vector<std::string> names;
    for (const std::size_t i : group)
        if (std::ranges::find(names, aims[i].lamp) == names.end())
            names.push_back(aims[i].lamp);
    return joined_names(names);
}

/// With as many digits as tell the percentage from the bound that it lies beyond.
std::string told_apart(const LampAim& aim) {
    const auto text = [&](double percent, int decimals) { return fmt::format("{:+.{}f} %", percent, decimals); };
    std::string warning = aim.warning;
    const std::string rounded = text(aim.percent.value_or(0.0), 2);
    const std::size_t at = warning.find(rounded);
    if (!aim.percent || at == std::string::npos)
        return warning;
    std::string shown = rounded;
    for (const std::optional<double>& bound : {aim.band_lowest_percent, aim.band_highest_percent})
        for (int decimals = 3; bound && decimals <= 5 && std::stod(shown) == std::stod(text(*bound, 2)); ++decimals)
            shown = text(*aim.percent, decimals);
    return warning.replace(at, rounded.size(), shown);
}

} // namespace

JsonMembers lamp_aim_members(LampAim& aim) {
    return {{"lamp", aim.lamp},
            {"file", aim.file},
            {"from_s", aim.from_s},
            {"rule", one_of(aim.automatic,
                            [] {
                                return std::vector<std::string>{"as-is", "auto"};
                            })},
            {"high_beam", aim.high_beam},
            {"cut_off_percent", aim.cut_off_percent},
            {"height_m", aim.height_m},
            {"by", aim.by},
            {"file_up_deg", aim.file_up_deg},
            {"file_right_deg", aim.file_right_deg},
            {"up_bound_deg", aim.up_bound_deg},
            {"right_bound_deg", aim.right_bound_deg},
            {"why_not", or_null(aim.why_not)},
            {"turned_up_deg", aim.turned_up_deg},
            {"turned_right_deg", aim.turned_right_deg},
            {"percent", aim.percent},
            {"right_deg", aim.right_deg},
            {"band_lowest_percent", aim.band_lowest_percent},
            {"band_highest_percent", aim.band_highest_percent},
            {"warning", or_null(aim.warning)}};
}

std::vector<Column> aim_columns(const std::string& before) {
    return columns_of(before + (before.empty() ? "" : "|") +
                      "lamp<|aim<|in the file: by<|in the file: up [\u00b0]|in the file: right [\u00b0]|turned: up [\u00b0]|"
                      "turned: right [\u00b0]|on the car: up [%]|on the car: right [\u00b0]|height [m]|R48 [%]<");
}

void add_aim_rows(Table& table, const std::vector<Cell>& before, const std::vector<LampAim>& aims) {
    for (const std::vector<std::size_t>& group : together(aims, is_told_alike)) {
        const LampAim& aim = aims[group.front()];
        std::vector<Cell>& row = table.rows.emplace_back(before);
        const std::string since = aim.from_s > 0.0 ? fmt::format(", from {:g} s", aim.from_s) : "";
        row.insert(row.end(),
                   {short_text(names_in(aims, group), 60) + since, rule_text(aim), found_text(aim), signed_cell(aim.file_up_deg),
                    signed_cell(aim.file_right_deg), signed_cell(aim.turned_up_deg), signed_cell(aim.turned_right_deg),
                    signed_cell(aim.percent), signed_cell(aim.right_deg), Cell(figure(aim.height_m, 2), aim.height_m), band_text(aim)});
    }
}

std::string aim_legend() {
    return "Up and right are positive. In the file: where its cut-off lies 2.5° beside the elbow and where the elbow lies, of a high beam "
           "the middle of its maximum; turned: the lamp, by its aim; on the car: where the cut-off, or the middle, then lies, -1 % being 1 "
           "cm down in 1 m; R48: the band of UN R48, 09 series, 6.2.6.1.2, for that height over the road.";
}

std::vector<std::string> aim_warnings(const std::string& lamp_set, const std::vector<LampAim>& aims) {
    std::vector<std::string> warnings;
    for (const std::vector<std::size_t>&group : together(aims, [](const LampAim&a, const LampAim&b) { return a.warning == b.warning; }))
        if (const std::string warning = told_apart(aims[group.front()]); !warning.empty())
            warnings.push_back(fmt::format("{}, {}: {}", lamp_set, names_in(aims, group), warning));
    return warnings;
}

std::optional<AimsApart> low_beams_apart(const std::vector<LampAim>& now, const std::vector<LampAim>& before) {
    AimsApart apart;
    int found = 0;
    for (const LampAim& a : now)
        for (const LampAim& b : before)
            if (a.lamp == b.lamp && !a.high_beam && !b.high_beam && a.percent && b.percent) {
                const double up = degrees(std::atan(0.01 * *a.percent) - std::atan(0.01 * *b.percent));
                apart.most_deg = std::max(apart.most_deg, std::hypot(up, a.right_deg && b.right_deg ? *a.right_deg - *b.right_deg : 0.0));
                apart.up_deg += up;
                ++found;
            }
    apart.up_deg /= std::max(found, 1);
    return found > 0 ? std::optional(apart) : std::nullopt;
}

std::string higher_words(double up_deg) {
    constexpr double notable_deg = 0.05;
    return std::abs(up_deg) > notable_deg ? fmt::format("{:.2f}° {}", std::abs(up_deg), up_deg > 0.0 ? "higher" : "lower") : "";
}

} // namespace fernlicht
