#include "scenarios/lamps/raw_grid.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

struct ListedValue {
    double h, v, value;
    std::uint32_t line;
};

bool is_column_name(const std::string& column) { return column.find_first_not_of("0123456789") != std::string::npos; }

/// The column's place, from 0.
std::size_t column_of(const std::string& column, const std::vector<std::string_view>& heading, std::size_t width, const GridLines& in) {
    if (is_column_name(column)) {
        const auto found = std::ranges::find(heading, column);
        if (found == heading.end())
            throw InputError(in.where(), fmt::format("no column is called '{}'", printable(column)),
                             fmt::format("names of columns, separated by {}, with those of the recipe among them", in.delimiter_name()));
        return static_cast<std::size_t>(found - heading.begin());
    }
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), number);
    if (error != std::errc{} || end != column.data() + column.size() || number < 1 || number > width)
        throw InputError(in.where(), fmt::format("found {} cells", width),
                         fmt::format("column {}, which the recipe names, separated by {}", printable(column), in.delimiter_name()));
    return number - 1;
}

std::vector<ListedValue> read_listed(const GridRecipe& recipe, GridLines& in) {
    std::vector<std::string_view> heading, cells;
    if (is_column_name(recipe.columns.h) || is_column_name(recipe.columns.v) || is_column_name(recipe.columns.value))
        if (!in.next(heading))
            throw InputError(in.where(), "the file ends before the list", "a line with the names of columns");
    std::vector<ListedValue> values;
    std::size_t width = heading.size();
    std::optional<std::size_t> h, v, value;
    while (in.next(cells)) {
        width = width == 0 ? cells.size() : width;
        if (!h) {
            h = column_of(recipe.columns.h, heading, width, in);
            v = column_of(recipe.columns.v, heading, width, in);
            value = column_of(recipe.columns.value, heading, width, in);
        }
        if (cells.size() != width)
            throw InputError(in.where(), fmt::format("found {} cells", cells.size()),
                             fmt::format("{} separated by {}, as in the lines before{}", width, in.delimiter_name(), in.doubt()));
        refuse_too_many(values.size() + 1, in);
        values.push_back({in.number_of(cells, *h, "horizontal angle"), in.number_of(cells, *v, "vertical angle"),
                          intensity_of([&] { return in.number_of(cells, *value, "value"); }), static_cast<std::uint32_t>(in.number())});
    }
    if (values.empty())
        throw InputError(in.where(), "the file ends before the list", "lines with a horizontal angle, a vertical one and a value");
    return values;
}

std::vector<double> listed_angles(const std::vector<ListedValue>& values, double ListedValue::*angle) {
    std::vector<double> angles;
    for (const ListedValue& one : values)
        angles.push_back(one.*angle);
    std::ranges::sort(angles);
    angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
    return angles;
}

RawGrid grid_of_list(const std::vector<ListedValue>& values, const GridLines& in, Notes& notes) {
    const InputError::Where end = in.where();
    RawGrid raw{
        {listed_angles(values, &ListedValue::h), listed_angles(values, &ListedValue::v), {}, values.front().line, values.front().line}, {}};
    const std::size_t columns = raw.grid.h_deg.size(), all = columns * raw.grid.v_deg.size();
    if (all / columns != raw.grid.v_deg.size() || all > 4 * values.size() + 1000)
        throw InputError(
            end, fmt::format("found {} values at {} horizontal and {} vertical angles", values.size(), columns, raw.grid.v_deg.size()),
            "a grid: a value for each pair of them" + in.doubt());
    raw.grid.cd.assign(all, std::numeric_limits<double>::quiet_NaN());
    raw.lines.assign(all, 0);
    std::size_t repeated = 0;
    const auto place = [](const std::vector<double>& axis, double angle) {
        return static_cast<std::size_t>(std::ranges::lower_bound(axis, angle) - axis.begin());
    };
    for (const ListedValue& one : values) {
        const std::size_t at = place(raw.grid.v_deg, one.v) * columns + place(raw.grid.h_deg, one.h);
        if (raw.lines[at] > 0 && raw.grid.cd[at] != one.value)
            throw InputError({end.file, one.line, 0, {}},
                             fmt::format("the direction {}, {} is given twice with different values", one.h, one.v),
                             fmt::format("each direction once; first in line {}{}", raw.lines[at], in.doubt()));
        repeated += raw.lines[at] > 0 ? 1U : 0U;
        raw.grid.cd[at] = one.value;
        raw.lines[at] = one.line;
    }
    if (const auto missing = std::ranges::find(raw.lines, 0U); missing != raw.lines.end()) {
        const auto at = static_cast<std::size_t>(missing - raw.lines.begin());
        throw InputError(end,
                         fmt::format("{} of {} directions are missing, the first of them {}, {}", std::ranges::count(raw.lines, 0U), all,
                                     raw.grid.h_deg[at % columns], raw.grid.v_deg[at / columns]),
                         "a grid: a value for each pair of angles" + in.doubt());
    }
    if (repeated > 0)
        notes.push_back(fmt::format("{} directions are repeated with the same values: taken once.", repeated));
    return raw;
}

} // namespace

RawGrid read_list_grid(const GridRecipe& recipe, GridLines& in, Notes& notes) { return grid_of_list(read_listed(recipe, in), in, notes); }

} // namespace fernlicht
