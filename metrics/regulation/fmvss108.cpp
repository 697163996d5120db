// FMVSS 108 (49 CFR 571.108), headlamps: upper beams (table XVIII) and lower beams (tables XIX a to c), every column. Candela.
// A column is one headlighting system's; M columns are for lamps aimed mechanically, V columns for lamps aimed by their cut-off.
#include "metrics/regulation/rows.h"
#include "scenarios/lamps/mounted_lamp.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double none = -1.0; ///< an empty cell

/// One printed row and its cells.
template <std::size_t columns> struct TableLine {
    RowKind kind;
    const char* name;
    std::vector<Direction> places; ///< of kind point: each a row of its own
    std::array<double, columns> max, min;
};

constexpr std::array<const char*, 6> upper_columns{"UB1", "UB2", "UB3", "UB4", "UB5", "UB6"};

const std::array<double, 6> no_upper{none, none, none, none, none, none};

const std::vector<TableLine<6>>& table_18() {
    constexpr auto p = RowKind::point;
    static const std::vector<TableLine<6>> lines{
        {p, "2U-V", {{0, 2}}, no_upper, {1500, 1500, 1000, 750, 750, 1500}},
        {p, "1U-3", {{-3, 1}, {3, 1}}, no_upper, {5000, 5000, 2000, 3000, 2000, 5000}},
        {p, "H-V", {{0, 0}}, {70000, 75000, 75000, 60000, 15000, 70000}, {40000, 40000, 20000, 18000, 7000, 40000}},
        {p, "H-3", {{-3, 0}, {3, 0}}, no_upper, {15000, 15000, 10000, 12000, 3000, 15000}},
        {p, "H-6", {{-6, 0}, {6, 0}}, no_upper, {5000, 5000, 3250, 3000, 2000, 5000}},
        {p, "H-9", {{-9, 0}, {9, 0}}, no_upper, {3000, 3000, 1500, 2000, 1000, 3000}},
        {p, "H-12", {{-12, 0}, {12, 0}}, no_upper, {1500, 1500, 750, 750, 750, 1500}},
        {p, "1.5D-V", {{0, -1.5}}, no_upper, {5000, 5000, 5000, 3000, 2000, 5000}},
        {p, "1.5D-9", {{-9, -1.5}, {9, -1.5}}, no_upper, {2000, 2000, 1500, 1250, 750, 1000}},
        {p, "2.5D-V", {{0, -2.5}}, no_upper, {2500, 2500, 2500, 1500, 1000, none}},
        {p, "2.5D-12", {{-12, -2.5}, {12, -2.5}}, no_upper, {1000, 1000, 750, 600, 400, none}},
        {p, "4D-V", {{0, -4}}, {5000, 12000, 5000, 5000, 2500, 5000}, no_upper},
    };
    return lines;
}

constexpr std::array<const char*, 9> lower_columns{"LB1M", "LB1V", "LB2M", "LB2V", "LB3M", "LB3V", "LB4M", "LB4V", "LB5M"};

std::array<double, 9> all_lower(double cd) { return {cd, cd, cd, cd, cd, cd, cd, cd, cd}; }

const std::vector<TableLine<9>>& table_19() {
    constexpr auto p = RowKind::point, line = RowKind::segment;
    constexpr double far = 90.0; // "to L" and "to R" have no end in the text: as far as the same table goes, 90 degrees
    const auto no = all_lower(none);
    static const std::vector<TableLine<9>> lines{
        {RowKind::zone, "10U-90U, 90L-90R", rectangle(-90, 90, 10, 90), all_lower(125), no},
        {p, "4U-8", {{-8, 4}, {8, 4}}, no, all_lower(64)},
        {p, "2U-4L", {{-4, 2}}, no, all_lower(135)},
        {line, "1.5U, 1R to 3R", {{1, 1.5}, {3, 1.5}}, no, all_lower(200)},
        {line, "1.5U, 1R to R", {{1, 1.5}, {far, 1.5}}, all_lower(1400), no},
        {line, "1U, 1.5L to L", {{-1.5, 1}, {-far, 1}}, all_lower(700), no},
        {line, "0.5U, 1.5L to L", {{-1.5, 0.5}, {-far, 0.5}}, all_lower(1000), no},
        {line, "0.5U, 1R to 3R", {{1, 0.5}, {3, 0.5}}, all_lower(2700), all_lower(500)},
        {p, "H-V", {{0, 0}}, {5000, 5000, none, none, none, none, none, 5000, 5000}, no},
        {p, "H-4L", {{-4, 0}}, no, all_lower(135)},
        {p, "H-8L", {{-8, 0}}, no, all_lower(64)},
        {line, "0.5D, 1.5L to L", {{-1.5, -0.5}, {-far, -0.5}}, {3000, none, 3000, none, 2500, none, 2500, none, 3000}, no},
        {p,
         "0.5D-1.5R",
         {{1.5, -0.5}},
         {20000, none, 20000, none, 20000, none, 20000, none, 20000},
         {10000, none, 10000, none, 8000, none, 8000, none, 10000}},
        {p, "0.6D-1.3R", {{1.3, -0.6}}, no, {none, 10000, none, 10000, none, 10000, none, 10000, none}},
        {p, "0.86D-V", {{0, -0.86}}, no, {none, 4500, none, 4500, none, 4500, none, 4500, none}},
        {p,
         "0.86D-3.5L",
         {{-3.5, -0.86}},
         {none, 12000, none, 12000, none, 12000, none, 12000, none},
         {none, 1800, none, 1800, none, 1800, none, 1800, none}},
        {p, "1D-6L", {{-6, -1}}, no, {1000, none, 1000, none, 750, none, 750, none, 1000}},
        {p, "1.5D-2R", {{2, -1.5}}, no, all_lower(15000)},
        {p, "1.5D-9", {{-9, -1.5}, {9, -1.5}}, no, {1000, none, 1000, none, 750, none, 750, none, 1000}},
        {p, "2D-9", {{-9, -2}, {9, -2}}, no, {none, 1250, none, 1250, none, 1250, none, 1250, none}},
        {p, "2D-15", {{-15, -2}, {15, -2}}, no, {850, 1000, 850, 1000, 700, 1000, 700, 1000, 850}},
        {p, "2.5D-V", {{0, -2.5}}, no, {none, none, none, none, none, none, none, 2500, 2500}},
        {p, "2.5D-12", {{-12, -2.5}, {12, -2.5}}, no, {none, none, none, none, none, none, none, 1000, 1000}},
        {p, "4D-V", {{0, -4}}, {7000, 10000, none, none, none, none, none, 10000, 7000}, no},
        {p, "4D-4R", {{4, -4}}, all_lower(12500), no},
        {p, "4D-20", {{-20, -4}, {20, -4}}, no, {none, 300, none, 300, none, 300, none, 300, none}},
    };
    return lines;
}

template <std::size_t columns> void add_column(Regulation& r, const std::vector<TableLine<columns>>& lines, std::size_t column) {
    for (const TableLine<columns>& line : lines) {
        const double max = line.max[column], min = line.min[column];
        if (max == none && min == none)
            continue;
        const Limits limits{min == none ? 0.0 : min, max == none ? no_limit : max};
        if (line.kind == RowKind::point && line.places.size() == 2) {
            r.rows.push_back(point(std::string(line.name) + "L", line.places[0].h_deg, line.places[0].v_deg, limits));
            r.rows.push_back(point(std::string(line.name) + "R", line.places[1].h_deg, line.places[1].v_deg, limits));
            continue;
        }
        RegulationRow row = point(line.name, 0, 0, limits);
        row.kind = line.kind;
        row.places = line.places;
        r.rows.push_back(row);
    }
}

Regulation made(std::string column, const char* what, AimRule aim) {
    std::string title = fmt::format("FMVSS 108, {} {}", what, column);
    for (char& c : column)
        c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return {.id = "fmvss108-" + column,
            .title = std::move(title),
            .edition = "49 CFR 571.108, annual edition of 1 October 2025",
            .source = "one published transcription of the tables' pictures, made twice (US and Canadian prints)",
            .receiver = fmvss_receiver,
            .aim = aim,
            .row_re_aim_deg = 0.25, // S14.2.5.5
            .mirrors = false,
            .notes = {fmt::format("FMVSS measures at {} V: scale a filament lamp's file measured at {} V by {:.3f}", fmvss_voltage_v,
                                  un_voltage_v, filament_flux_factor(fmvss_voltage_v, un_voltage_v))},
            .sureness = Sureness::two_prints};
}

} // namespace

std::vector<Regulation> fmvss108_regulations() {
    std::vector<Regulation> all;
    for (std::size_t column = 0; column < lower_columns.size(); ++column) {
        const std::string name = lower_columns[column];
        const bool visual = name.back() == 'V';
        for (const AimRule aim : visual ? std::vector{AimRule::vol, AimRule::vor} : std::vector{AimRule::as_is}) {
            Regulation r = made(name, "lower beam", aim);
            if (visual) {
                r.id += aim == AimRule::vol ? "-vol" : "-vor";
                r.title += aim == AimRule::vol ? ", aimed by the cut-off on the left (VOL)" : ", aimed by the cut-off on the right (VOR)";
            } else {
                r.title += ", aimed mechanically";
                r.aim_note = "aimed mechanically: the file's H-V is the lamp's mechanical axis";
            }
            r.notes.emplace_back("rows without an end in the text (to L, to R) are taken to 90 degrees");
            add_column(r, table_19(), column);
            all.push_back(std::move(r));
        }
    }
    for (std::size_t column = 0; column < upper_columns.size(); ++column) {
        Regulation r = made(upper_columns[column], "upper beam", AimRule::as_is);
        r.aim_note = "as aimed with the lower beam or mechanically; a separate one aimed by eye: `--aim maximum`";
        add_column(r, table_18(), column);
        all.push_back(std::move(r));
    }
    return all;
}

} // namespace fernlicht
