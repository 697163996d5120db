#include "scenarios/lamps/text_grid.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/grid_lines.h"
#include "scenarios/lamps/measured_grid.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

/// As the file has it: its own signs, units and origin.
struct RawGrid {
    MeasuredGrid grid;
    std::vector<std::uint32_t> lines; ///< of each value
};

void refuse_too_many(std::size_t values, const GridLines& in) {
    if (values > max_lamp_samples)
        throw InputError(in.where(), "the grid goes on", fmt::format("at most {} values", max_lamp_samples));
}

double rounded(double angle) { return std::round(angle * 1e9) / 1e9 + 0.0; } // steps of 0.1 stay short in print

std::size_t count_of(const GridAxis& axis, const GridLines& in, double from, double to, const InputError::Where& where) {
    const bool edges = axis.samples == GridSamples::centres;
    const double count = axis.step ? std::abs(to - from) / *axis.step + (edges ? 0.0 : 1.0) : in.number_of(axis.count, "count");
    const double whole = std::round(count);
    if (axis.step && std::abs(count - whole) > 1e-6)
        throw InputError(where, fmt::format("steps of {} from {} miss {}", *axis.step, from, to), "steps that meet it");
    if (!(whole >= 2.0 && whole <= static_cast<double>(max_lamp_samples)) || (!axis.step && count != whole))
        throw InputError(where, fmt::format("found {} of them", count), fmt::format("a whole number from 2 to {}", max_lamp_samples));
    return static_cast<std::size_t>(whole);
}

/// The angles that the recipe gives, or the file's header for it.
std::vector<double> declared_axis(const GridAxis& axis, const GridLines& in, const InputError::Where& where) {
    const double from = in.number_of(axis.from, "from"), to = in.number_of(axis.to, "to");
    if (from == to)
        throw InputError(where, fmt::format("found angles from {} to {}", from, to), "an axis of some width");
    const std::size_t count = count_of(axis, in, from, to, where);
    std::vector<double> angles(count);
    const bool edges = axis.samples == GridSamples::centres;
    const double step = (to - from) / static_cast<double>(edges ? count : count - 1);
    for (std::size_t i = 0; i < count; ++i)
        angles[i] = rounded(from + step * (static_cast<double>(i) + (edges ? 0.5 : 0.0)));
    return angles;
}

/// A line of values for each angle of `down`, a column for each of `across`.
class MatrixReading {
  public:
    MatrixReading(GridLines& in, const std::optional<GridAxis>& across, const std::optional<GridAxis>& down, std::string across_name,
                  std::string down_name, const std::filesystem::path& file)
        : in_(in), across_name_(std::move(across_name)), down_name_(std::move(down_name)), leading_(down ? 0 : 1) {
        if (across)
            across_ = declared_axis(*across, in, {file, 0, 0, across_name_});
        if (down)
            down_ = declared_axis(*down, in, {file, 0, 0, down_name_});
        expected_lines_ = down_.size();
    }

    RawGrid read() {
        std::vector<std::string_view> cells;
        if (across_.empty()) {
            if (!in_.next(heading_))
                refuse_end(fmt::format("a line of {}", across_name_));
            heading_line_ = in_.number();
        }
        while (in_.next(cells))
            take(cells);
        if (rows_ == 0 || rows_ < expected_lines_)
            refuse_end(expected_lines_ > 0 ? fmt::format("{} lines of values, one for each of the {}", expected_lines_, down_name_)
                                           : std::string("lines of values"));
        raw_.grid = {across_, down_, std::move(raw_.grid.cd), heading_line_, first_line_};
        return std::move(raw_);
    }

  private:
    [[noreturn]] void refuse_end(const std::string& expected) const {
        throw InputError(in_.where(), fmt::format("the grid ends after {} lines of values", rows_), expected);
    }

    void take(const std::vector<std::string_view>& cells) {
        if (rows_ == 0)
            begin(cells);
        if (cells.size() != leading_ + across_.size())
            throw InputError(in_.where(), fmt::format("found {} cells", cells.size()),
                             fmt::format("{}{}, parted by {}{}", leading_ + across_.size(),
                                         leading_ > 0 ? fmt::format(": one of the {} and a value for each of the {}", down_name_, across_name_)
                                                      : fmt::format(": a value for each of the {}", across_name_),
                                         in_.delimiter_name(), in_.doubt()));
        if (expected_lines_ > 0 && rows_ == expected_lines_)
            throw InputError(in_.where(), "the grid goes on",
                             fmt::format("its end after {} lines, one for each of the {}", expected_lines_, down_name_));
        refuse_too_many(raw_.grid.cd.size() + across_.size(), in_);
        if (leading_ > 0)
            down_.push_back(in_.number_of(cells, 0, down_name_));
        for (std::size_t i = leading_; i < cells.size(); ++i)
            raw_.grid.cd.push_back(in_.number_of(cells, i, "value"));
        raw_.lines.resize(raw_.grid.cd.size(), static_cast<std::uint32_t>(in_.number()));
        ++rows_;
    }

    /// The first line of values says how many angles its heading has; what stands before them there is a corner.
    void begin(const std::vector<std::string_view>& cells) {
        first_line_ = in_.number();
        if (!across_.empty())
            return;
        const InputError::Where where{in_.where().file, heading_line_, 0, across_name_};
        const std::size_t values = cells.size() - std::min(cells.size(), leading_);
        const std::size_t corner = heading_.size() - std::min(heading_.size(), values);
        const bool fits = values > 0 && heading_.size() >= values && (corner == leading_ || corner == 0 || is_text(corner));
        if (!fits)
            throw InputError(where, fmt::format("found {} cells, and {} in line {}", heading_.size(), cells.size(), first_line_),
                             fmt::format("{} parted by {}, then as many values in each line{}", across_name_, in_.delimiter_name(), in_.doubt()));
        for (std::size_t i = corner; i < heading_.size(); ++i)
            across_.push_back(in_.number_of(heading_[i], where));
        const bool steady = std::ranges::adjacent_find(across_, std::ranges::greater_equal{}) == across_.end() ||
                            std::ranges::adjacent_find(across_, std::ranges::less_equal{}) == across_.end();
        if (!steady && !in_.doubt().empty())
            throw InputError(where, "the angles neither rise nor fall", "angles in order" + in_.doubt());
    }

    bool is_text(std::size_t corner) const { // "V \ H" in three words
        return std::all_of(heading_.begin(), heading_.begin() + static_cast<std::ptrdiff_t>(corner),
                           [](std::string_view word) { return !number_in(word); });
    }

    GridLines& in_;
    std::string across_name_, down_name_;
    std::size_t leading_; ///< cells before the values
    std::size_t expected_lines_ = 0, rows_ = 0, heading_line_ = 0, first_line_ = 0;
    std::vector<std::string_view> heading_;
    std::vector<double> across_, down_;
    RawGrid raw_;
};

RawGrid transposed_of(const RawGrid& raw) {
    const MeasuredGrid& from = raw.grid;
    RawGrid out{{from.v_deg, from.h_deg, std::vector<double>(from.cd.size()), from.v_line, from.h_line},
                std::vector<std::uint32_t>(raw.lines.size())};
    for (std::size_t v = 0; v < from.v_deg.size(); ++v)
        for (std::size_t h = 0; h < from.h_deg.size(); ++h) {
            out.grid.cd[h * from.v_deg.size() + v] = from.cd[v * from.h_deg.size() + h];
            out.lines[h * from.v_deg.size() + v] = raw.lines[v * from.h_deg.size() + h];
        }
    return out;
}

struct ListedValue {
    double h, v, value;
    std::uint32_t line;
};

bool is_name(const std::string& column) { return column.find_first_not_of("0123456789") != std::string::npos; }

/// The column's place, from 0.
std::size_t column_of(const std::string& column, const std::vector<std::string_view>& heading, std::size_t width, const GridLines& in) {
    if (is_name(column)) {
        const auto found = std::ranges::find(heading, column);
        if (found == heading.end())
            throw InputError(in.where(), fmt::format("no column is called '{}'", printable(column)),
                             fmt::format("names of columns, parted by {}, with those of the recipe among them", in.delimiter_name()));
        return static_cast<std::size_t>(found - heading.begin());
    }
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(column.data(), column.data() + column.size(), number);
    if (error != std::errc{} || end != column.data() + column.size() || number < 1 || number > width)
        throw InputError(in.where(), fmt::format("found {} cells", width),
                         fmt::format("column {}, which the recipe names, parted by {}", printable(column), in.delimiter_name()));
    return number - 1;
}

std::vector<ListedValue> read_values(const GridRecipe& recipe, GridLines& in) {
    std::vector<std::string_view> heading, cells;
    if (is_name(recipe.columns.h) || is_name(recipe.columns.v) || is_name(recipe.columns.value))
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
                             fmt::format("{} parted by {}, as in the lines before{}", width, in.delimiter_name(), in.doubt()));
        refuse_too_many(values.size() + 1, in);
        values.push_back({in.number_of(cells, *h, "horizontal angle"), in.number_of(cells, *v, "vertical angle"),
                          in.number_of(cells, *value, "value"), static_cast<std::uint32_t>(in.number())});
    }
    if (values.empty())
        throw InputError(in.where(), "the file ends before the list", "lines with a horizontal angle, a vertical one and a value");
    return values;
}

std::vector<double> angles_of(const std::vector<ListedValue>& values, double ListedValue::*angle) {
    std::vector<double> angles;
    for (const ListedValue& one : values)
        angles.push_back(one.*angle);
    std::ranges::sort(angles);
    angles.erase(std::ranges::unique(angles).begin(), angles.end());
    return angles;
}

RawGrid grid_of(const std::vector<ListedValue>& values, const GridLines& in, Notes& notes) {
    const InputError::Where end = in.where();
    RawGrid raw{{angles_of(values, &ListedValue::h), angles_of(values, &ListedValue::v), {}, values.front().line, values.front().line}, {}};
    const std::size_t columns = raw.grid.h_deg.size(), all = columns * raw.grid.v_deg.size();
    if (all / columns != raw.grid.v_deg.size() || all > 4 * values.size() + 1000)
        throw InputError(end, fmt::format("found {} values at {} horizontal and {} vertical angles", values.size(), columns, raw.grid.v_deg.size()),
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
            throw InputError({end.file, one.line, 0, {}}, fmt::format("the direction {}, {} is given twice with different values", one.h, one.v),
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

RawGrid read_raw(const std::filesystem::path& path, const GridRecipe& recipe, GridLines& in, Notes& notes) {
    if (recipe.layout == GridLayout::list)
        return grid_of(read_values(recipe, in), in, notes);
    if (recipe.layout == GridLayout::matrix)
        return MatrixReading(in, recipe.h, recipe.v, "horizontal angles", "vertical angles", path).read();
    return transposed_of(MatrixReading(in, recipe.v, recipe.h, "vertical angles", "horizontal angles", path).read());
}

/// To degrees right and up, about the file's own origin.
void to_degrees(std::vector<double>& angles, AngleUnit unit, double distance_m, bool turned) {
    for (double& angle : angles) {
        switch (unit) {
        case AngleUnit::deg:
            break;
        case AngleUnit::rad:
            angle = degrees(angle);
            break;
        case AngleUnit::percent:
            angle = degrees(std::atan(angle / 100.0));
            break;
        case AngleUnit::m:
            angle = degrees(std::atan(angle / distance_m));
            break;
        case AngleUnit::mm:
            angle = degrees(std::atan(angle / 1000.0 / distance_m));
            break;
        }
        angle = (turned ? -angle : angle) + 0.0; // never -0
    }
}

double positive(const HeaderNumber& number, const char* name, const GridLines& in, const std::filesystem::path& path) {
    const double value = in.number_of(number, name);
    if (!(value > 0.0))
        throw InputError({path, static_cast<std::size_t>(number.line), 0, name}, fmt::format("found {}", value), "a number above 0");
    return value;
}

/// An axis that falls all along is turned round without a word: the recipe's signs say so, or the file's order.
void let_axes_rise(RawGrid& raw) {
    const auto falls = [](const std::vector<double>& axis) {
        return axis.size() > 1 && std::ranges::adjacent_find(axis, std::ranges::less_equal{}) == axis.end();
    };
    MeasuredGrid& grid = raw.grid;
    const auto columns = static_cast<std::ptrdiff_t>(grid.h_deg.size());
    const auto turn_rows = [&](auto& of) {
        for (auto row = of.begin(); row != of.end(); row += columns)
            std::reverse(row, row + columns);
    };
    if (falls(grid.v_deg)) { // all of it back to front, then each row again
        std::ranges::reverse(grid.v_deg);
        std::ranges::reverse(grid.cd);
        std::ranges::reverse(raw.lines);
        turn_rows(grid.cd);
        turn_rows(raw.lines);
    }
    if (falls(grid.h_deg)) {
        std::ranges::reverse(grid.h_deg);
        turn_rows(grid.cd);
        turn_rows(raw.lines);
    }
}

/// Of a value in the recipe's unit, in candela.
void to_candela(MeasuredGrid& grid, const GridRecipe& recipe, double distance_m, double flux_lm) {
    const bool planar = recipe.screen == GridScreen::planar, screen_angles = recipe.angles == GridAngles::screen;
    const double factor = recipe.factor * (recipe.unit == GridUnit::kcd ? 1000.0 : recipe.unit == GridUnit::cd_per_klm ? flux_lm / 1000.0 : 1.0);
    for (std::size_t v = 0; v < grid.v_deg.size(); ++v)
        for (std::size_t h = 0; h < grid.h_deg.size(); ++h)
            grid.cd[v * grid.h_deg.size() + h] *=
                factor * (recipe.unit == GridUnit::lx ? cd_per_lux(distance_m, planar, screen_angles, grid.h_deg[h], grid.v_deg[v]) : 1.0);
}

void check_ranges(const MeasuredGrid& grid, const GridRecipe& recipe, const std::filesystem::path& path) {
    const bool wall = recipe.angles == GridAngles::screen || (recipe.unit == GridUnit::lx && recipe.screen == GridScreen::planar);
    const bool type_b = recipe.angles == GridAngles::type_b;
    check_angle_ranges(grid, wall ? most_wall_deg : type_b ? 90.0 : 180.0, wall ? most_wall_deg : type_b ? 180.0 : 90.0, path);
}

void shift(std::vector<double>& axis, double by_deg) {
    for (double& angle : axis)
        angle = by_deg == 0.0 ? angle : rounded(angle + by_deg);
}

} // namespace

LampFile read_text_grid(const std::filesystem::path& path, std::string_view text, const GridRecipe& recipe, const LampReadOptions& options,
                        FilesRead opened) {
    LampFile lamp{.name = path.stem().string(), .format = fmt::format("text grid, {}", printable(recipe.title, 100)), .opened = std::move(opened)};
    GridLines in(path, text, recipe);
    const double distance_m = recipe.distance_m.given() ? positive(recipe.distance_m, "distance_m", in, path) : 0.0;
    if (recipe.flux_lm.given())
        lamp.declared_flux_lm = positive(recipe.flux_lm, "flux_lm", in, path);
    RawGrid raw = read_raw(path, recipe, in, lamp.notes);
    MeasuredGrid& grid = raw.grid;
    to_degrees(grid.h_deg, recipe.angle_unit, distance_m, recipe.h_positive == HorizontalSign::left);
    to_degrees(grid.v_deg, recipe.angle_unit, distance_m, recipe.v_positive == VerticalSign::down);
    let_axes_rise(raw);
    check_ranges(grid, recipe, path);
    to_candela(grid, recipe, distance_m, lamp.declared_flux_lm.value_or(0.0));
    shift(grid.h_deg, recipe.h_zero_deg);
    shift(grid.v_deg, recipe.v_zero_deg);
    check_and_order(grid, path, lamp.notes, [&](std::size_t at) { return raw.lines[at]; });
    check_ranges(grid, recipe, path); // where they lie now; repeated angles may have left a single one
    finish(grid, options, nullptr, {}, recipe.angles == GridAngles::type_b   ? std::optional(type_b())
                                       : recipe.angles == GridAngles::screen ? std::optional(flat_screen())
                                                                             : std::nullopt,
           lamp);
    if (!recipe.note.empty())
        lamp.notes.push_back(recipe.note);
    return lamp;
}

} // namespace fernlicht
