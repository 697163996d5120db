#include "scenarios/lamps/measured_grid.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/lamp_text.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace fernlicht {
namespace {

/// Swaps the two axes: rows become columns.
MeasuredGrid transposed(const MeasuredGrid& grid) {
    MeasuredGrid out{grid.v_deg, grid.h_deg, std::vector<double>(grid.cd.size()), grid.v_line, grid.h_line};
    for (std::size_t v = 0; v < grid.v_deg.size(); ++v)
        for (std::size_t h = 0; h < grid.h_deg.size(); ++h)
            out.cd[h * grid.v_deg.size() + v] = grid.cd[v * grid.h_deg.size() + h];
    return out;
}

void put_rows_in_order(MeasuredGrid& grid, const char* axis, const std::filesystem::path& file, Notes& notes) {
    const auto strictly_rising = [](const std::vector<double>& a) {
        return std::adjacent_find(a.begin(), a.end(), std::greater_equal<>()) == a.end();
    };
    if (strictly_rising(grid.v_deg))
        return;
    std::vector<std::size_t> order(grid.v_deg.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return grid.v_deg[a] < grid.v_deg[b]; });
    const std::size_t width = grid.h_deg.size();
    const auto row = [&](std::size_t i) { return grid.cd.begin() + static_cast<std::ptrdiff_t>(i * width); };
    std::vector<double> angles, cd;
    cd.reserve(grid.cd.size());
    std::size_t repeated = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double angle = grid.v_deg[order[i]];
        if (!angles.empty() && angle == angles.back()) {
            if (!std::equal(row(order[i]), row(order[i]) + static_cast<std::ptrdiff_t>(width), row(order[i - 1])))
                throw InputError({file, grid.v_line, 0, fmt::format("{} angles", axis)},
                                 fmt::format("the angle {} is given twice with different intensities", angle), "each angle once");
            ++repeated;
            continue;
        }
        angles.push_back(angle);
        cd.insert(cd.end(), row(order[i]), row(order[i]) + static_cast<std::ptrdiff_t>(width));
    }
    if (!std::is_sorted(grid.v_deg.begin(), grid.v_deg.end()))
        notes.push_back(fmt::format("The {} angles do not ascend: sorted.", axis));
    if (repeated > 0)
        notes.push_back(fmt::format("{} {} angles are repeated with the same intensities: taken once.", repeated, axis));
    grid.v_deg = std::move(angles);
    grid.cd = std::move(cd);
}

struct Padding {
    bool low = false, high = false;
};

/// `dark(i)`: all samples at index i of the axis are 0.
template <class Dark> Padding padding_of(const std::vector<double>& axis, Dark dark) {
    constexpr double ratio = 8.0;
    const std::size_t n = axis.size();
    if (n < 3)
        return {};
    return {axis[1] - axis[0] > ratio * (axis[2] - axis[1]) && dark(0),
            axis[n - 1] - axis[n - 2] > ratio * (axis[n - 2] - axis[n - 3]) && dark(n - 1)};
}

std::vector<double> four_numbers(std::string_view text) {
    std::vector<double> out;
    for (const std::string_view word : words_of(text))
        out.push_back(number_in(word).value_or(std::numeric_limits<double>::quiet_NaN())); // refused as not ascending
    return out;
}

void refuse_negative(MeasuredGrid& grid, const std::filesystem::path& file, Notes& notes,
                     const std::function<std::size_t(std::size_t)>& line_of) {
    const auto [lowest, highest] = std::minmax_element(grid.cd.begin(), grid.cd.end());
    const auto complain = [&](std::vector<double>::iterator at, const std::string& expected) {
        const auto index = static_cast<std::size_t>(at - grid.cd.begin());
        throw InputError({file, line_of(index), 0,
                          fmt::format("intensity at horizontal {}, vertical {}", grid.h_deg[index % grid.h_deg.size()],
                                      grid.v_deg[index / grid.h_deg.size()])},
                         fmt::format("is {} cd", *at), expected);
    };
    if (!(*highest <= max_intensity_cd))
        complain(highest, fmt::format("at most {} cd", max_intensity_cd));
    if (*lowest < -1e-3 * std::max(*highest, 0.0))
        complain(lowest, "at least 0 cd");
    const auto negative = std::count_if(grid.cd.begin(), grid.cd.end(), [](double cd) { return cd < 0.0; });
    if (negative == 0)
        return;
    const std::size_t line = line_of(static_cast<std::size_t>(lowest - grid.cd.begin()));
    notes.push_back(fmt::format("{} slightly negative, down to {} cd{}: taken as 0.",
                                negative == 1 ? "1 intensity is" : fmt::format("{} intensities are", negative), *lowest,
                                line > 0 ? fmt::format(" in line {}", line) : ""));
    std::replace_if(
        grid.cd.begin(), grid.cd.end(), [](double cd) { return cd < 0.0; }, 0.0);
}

/// Marks the cells between the angles that `text` names. Throws InputError when it does not read as gaps_text writes it.
void mark_written_gaps(const std::string& text, CandelaTable& table, const InputError::Where& where) {
    if (trimmed(text) == "none")
        return;
    const std::size_t columns = table.h_deg.size() - 1, rows = table.v_deg.size() - 1;
    // The first cell whose middle lies above the angle, so that rounded angles still name the same cells.
    const auto first_above = [](const std::vector<double>& axis, double angle) {
        std::size_t low = 0, high = axis.size() - 1;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            (axis[middle] + axis[middle + 1]) / 2.0 > angle ? high = middle : low = middle + 1;
        }
        return low;
    };
    // Each rectangle as four corners, then summed up: time does not grow with rectangles times cells.
    std::vector<long> corners((rows + 1) * (columns + 1), 0);
    const auto corner = [&](std::size_t y, std::size_t x) -> long& { return corners[y * (columns + 1) + x]; };
    std::string_view rest = text;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(';'), rest.size());
        const std::vector<double> g = four_numbers(rest.substr(0, end));
        if (g.size() != 4 || !(g[0] < g[1]) || !(g[2] < g[3]))
            throw InputError(where, fmt::format("found '{}'", printable(std::string(rest.substr(0, std::min<std::size_t>(end, 200))))),
                             "none, or angles h0 h1 v0 v1 with h0 < h1 and v0 < v1");
        const std::size_t x0 = first_above(table.h_deg, g[0]), x1 = first_above(table.h_deg, g[1]);
        const std::size_t y0 = first_above(table.v_deg, g[2]), y1 = first_above(table.v_deg, g[3]);
        ++corner(y0, x0);
        ++corner(y1, x1);
        --corner(y0, x1);
        --corner(y1, x0);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    table.gaps.assign(rows * columns, 0);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x) {
            corner(y, x) += (x > 0 ? corner(y, x - 1) : 0) + (y > 0 ? corner(y - 1, x) : 0) - (x > 0 && y > 0 ? corner(y - 1, x - 1) : 0);
            table.gaps[y * columns + x] = corner(y, x) > 0;
        }
}

} // namespace

void check_and_order(MeasuredGrid& grid, const std::filesystem::path& file, Notes& notes,
                     const std::function<std::size_t(std::size_t)>& line_of) {
    refuse_negative(grid, file, notes, line_of);
    put_rows_in_order(grid, "vertical", file, notes);
    grid = transposed(grid);
    put_rows_in_order(grid, "horizontal", file, notes);
    grid = transposed(grid);
}

void check_count(const std::vector<double>& angles, const char* name, std::size_t line, const std::filesystem::path& file) {
    if (angles.size() < 2)
        throw InputError({file, line, 0, name}, fmt::format("found {} of them", angles.size()), "at least 2");
}

void check_angle_ranges(const MeasuredGrid& grid, double h_limit_deg, double v_limit_deg, const std::filesystem::path& file) {
    const auto check = [&](const std::vector<double>& angles, double limit, const char* name, std::size_t line) {
        for (const double angle : angles)
            if (std::abs(angle) > limit)
                throw InputError({file, line, 0, name}, fmt::format("found {}", angle), fmt::format("angles from -{} to {}", limit, limit));
        check_count(angles, name, line, file);
    };
    check(grid.h_deg, h_limit_deg, "horizontal angles", grid.h_line);
    check(grid.v_deg, v_limit_deg, "vertical angles", grid.v_line);
}

double cd_per_lux(double distance_m, bool planar, bool screen_angles, double h_deg, double v_deg) {
    const double facing = distance_m * distance_m;
    if (!planar)
        return facing;
    const double h = radians(h_deg), v = radians(v_deg);
    const double cosine = screen_angles ? 1.0 / std::hypot(1.0, std::tan(h), std::tan(v)) : std::cos(h) * std::cos(v);
    return facing / (cosine * cosine * cosine);
}

void finish(const MeasuredGrid& grid, const LampReadOptions& options, const std::string* written, const InputError::Where& where,
            std::optional<AngleSystem> system, LampFile& lamp) {
    CandelaTable table{grid.h_deg, grid.v_deg, grid.cd, {}, options.rule};
    if (written)
        mark_written_gaps(*written, table, where);
    else
        mark_padding(table, lamp.notes);
    if (system)
        bring_onto_goniometer(std::move(table), std::move(*system), lamp);
    else
        lamp.table = std::move(table);
}

void mark_padding(CandelaTable& table, Notes& notes) {
    const std::size_t rows = table.v_deg.size(), columns = table.h_deg.size();
    const Padding v = padding_of(table.v_deg, [&](std::size_t row) {
        const auto first = table.cd.begin() + static_cast<std::ptrdiff_t>(row * columns);
        return std::all_of(first, first + static_cast<std::ptrdiff_t>(columns), [](double cd) { return cd == 0.0; });
    });
    const Padding h = padding_of(table.h_deg, [&](std::size_t column) {
        for (std::size_t row = 0; row < rows; ++row)
            if (table.at(row, column) != 0.0)
                return false;
        return true;
    });
    if (!(v.low || v.high || h.low || h.high))
        return;
    table.gaps.resize((rows - 1) * (columns - 1), 0);
    for (std::size_t y = 0; y + 1 < rows; ++y)
        for (std::size_t x = 0; x + 1 < columns; ++x)
            if ((v.low && y == 0) || (v.high && y + 2 == rows) || (h.low && x == 0) || (h.high && x + 2 == columns))
                table.gaps[y * (columns - 1) + x] = 1;
    const auto gap = [&](const char* axis, double from, double to) {
        notes.push_back(fmt::format("{} from {} to {} degrees holds only zeros at its end: padding, no data.", axis, from, to));
    };
    if (h.low)
        gap("H", table.h_deg[0], table.h_deg[1]);
    if (h.high)
        gap("H", table.h_deg[columns - 2], table.h_deg[columns - 1]);
    if (v.low)
        gap("V", table.v_deg[0], table.v_deg[1]);
    if (v.high)
        gap("V", table.v_deg[rows - 2], table.v_deg[rows - 1]);
}

std::string gaps_text(const CandelaTable& table) {
    if (table.gaps.empty())
        return "none";
    std::vector<unsigned char> left = table.gaps;
    const std::size_t columns = table.h_deg.size() - 1, rows = table.v_deg.size() - 1;
    std::string out;
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x) {
            if (left[y * columns + x] == 0)
                continue;
            std::size_t right = x + 1, top = y + 1;
            while (right < columns && left[y * columns + right] != 0)
                ++right;
            const auto row = [&](std::size_t r, std::size_t c) { return left.begin() + static_cast<std::ptrdiff_t>(r * columns + c); };
            while (top < rows && std::find(row(top, x), row(top, right), 0) == row(top, right))
                ++top;
            for (std::size_t r = y; r < top; ++r)
                std::fill(row(r, x), row(r, right), static_cast<unsigned char>(0));
            out +=
                fmt::format("{}{} {} {} {}", out.empty() ? "" : "; ", table.h_deg[x], table.h_deg[right], table.v_deg[y], table.v_deg[top]);
        }
    return out.empty() ? "none" : out;
}

} // namespace fernlicht
