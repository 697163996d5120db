#include "scenarios/lamps/raw_grid.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::size_t axis_count(const GridAxis& axis, const GridLines& in, double from, double to, const InputError::Where& where) {
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
    const std::size_t count = axis_count(axis, in, from, to, where);
    std::vector<double> angles(count);
    const bool edges = axis.samples == GridSamples::centres;
    const double step = (to - from) / static_cast<double>(edges ? count : count - 1);
    for (std::size_t i = 0; i < count; ++i)
        angles[i] = rounded_angle(from + step * (static_cast<double>(i) + (edges ? 0.5 : 0.0)));
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
                             fmt::format("{}{}, separated by {}{}", leading_ + across_.size(),
                                         leading_ > 0
                                             ? fmt::format(": one of the {} and a value for each of the {}", down_name_, across_name_)
                                             : fmt::format(": a value for each of the {}", across_name_),
                                         in_.delimiter_name(), in_.doubt()));
        if (expected_lines_ > 0 && rows_ == expected_lines_)
            throw InputError(in_.where(), "the grid goes on",
                             fmt::format("its end after {} lines, one for each of the {}", expected_lines_, down_name_));
        refuse_too_many(raw_.grid.cd.size() + across_.size(), in_);
        if (leading_ > 0)
            down_.push_back(in_.number_of(cells, 0, down_name_));
        for (std::size_t i = leading_; i < cells.size(); ++i)
            raw_.grid.cd.push_back(intensity_of([&] { return in_.number_of(cells, i, "value"); }));
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
            throw InputError(
                where, fmt::format("found {} cells, and {} in line {}", heading_.size(), cells.size(), first_line_),
                fmt::format("{} separated by {}, then as many values in each line{}", across_name_, in_.delimiter_name(), in_.doubt()));
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

RawGrid transposed_raw(const RawGrid& raw) {
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

} // namespace

void refuse_too_many(std::size_t values, const GridLines& in) {
    if (values > max_lamp_samples)
        throw InputError(in.where(), "the grid goes on", fmt::format("at most {} values", max_lamp_samples));
}

RawGrid read_matrix_grid(const std::filesystem::path& file, const GridRecipe& recipe, GridLines& in) {
    if (recipe.layout == GridLayout::matrix)
        return MatrixReading(in, recipe.h, recipe.v, "horizontal angles", "vertical angles", file).read();
    return transposed_raw(MatrixReading(in, recipe.v, recipe.h, "vertical angles", "horizontal angles", file).read());
}

} // namespace fernlicht
