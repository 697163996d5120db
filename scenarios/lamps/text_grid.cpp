#include "scenarios/lamps/text_grid.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/raw_grid.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

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

double positive_of_header(const HeaderNumber& number, const char* name, const GridLines& in, const std::filesystem::path& path) {
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
    const double factor = recipe.factor * (recipe.unit == GridUnit::kcd          ? 1000.0
                                           : recipe.unit == GridUnit::cd_per_klm ? flux_lm / 1000.0
                                                                                 : 1.0);
    for (std::size_t v = 0; v < grid.v_deg.size(); ++v)
        for (std::size_t h = 0; h < grid.h_deg.size(); ++h)
            grid.cd[v * grid.h_deg.size() + h] *=
                factor * (recipe.unit == GridUnit::lx ? cd_per_lux(distance_m, planar, screen_angles, grid.h_deg[h], grid.v_deg[v]) : 1.0);
}

void check_grid_ranges(const MeasuredGrid& grid, const GridRecipe& recipe, const std::filesystem::path& path) {
    const bool wall = recipe.angles == GridAngles::screen || (recipe.unit == GridUnit::lx && recipe.screen == GridScreen::planar);
    const bool type_b = recipe.angles == GridAngles::type_b;
    check_angle_ranges(grid, wall ? most_wall_deg : type_b ? 90.0 : 180.0, wall ? most_wall_deg : type_b ? 180.0 : 90.0, path);
}

void shift_axis(std::vector<double>& axis, double by_deg) {
    for (double& angle : axis)
        angle = by_deg == 0.0 ? angle : rounded_angle(angle + by_deg);
}

} // namespace

LampFile read_text_grid(const std::filesystem::path& path, std::string_view text, const GridRecipe& recipe, const LampReadOptions& options,
                        FilesRead opened) {
    LampFile lamp{.name = path.stem().string(),
                  .format = fmt::format("text grid, recipe '{}'", printable(recipe.title, 100)),
                  .opened = std::move(opened)};
    GridLines in(path, text, recipe);
    const double distance_m = recipe.distance_m.given() ? positive_of_header(recipe.distance_m, "distance_m", in, path) : 0.0;
    if (recipe.flux_lm.given())
        lamp.declared_flux_lm = positive_of_header(recipe.flux_lm, "flux_lm", in, path);
    RawGrid raw = recipe.layout == GridLayout::list ? read_list_grid(recipe, in, lamp.notes) : read_matrix_grid(path, recipe, in);
    MeasuredGrid& grid = raw.grid;
    to_degrees(grid.h_deg, recipe.angle_unit, distance_m, recipe.h_positive == HorizontalSign::left);
    to_degrees(grid.v_deg, recipe.angle_unit, distance_m, recipe.v_positive == VerticalSign::down);
    let_axes_rise(raw);
    check_grid_ranges(grid, recipe, path);
    to_candela(grid, recipe, distance_m, lamp.declared_flux_lm.value_or(0.0));
    shift_axis(grid.h_deg, recipe.h_zero_deg);
    shift_axis(grid.v_deg, recipe.v_zero_deg);
    check_and_order(grid, path, lamp.notes, [&](std::size_t at) { return raw.lines[at]; });
    check_grid_ranges(grid, recipe, path); // where they lie now; repeated angles may have left a single one
    finish(grid, options, nullptr, {},
           recipe.angles == GridAngles::type_b   ? std::optional(type_b())
           : recipe.angles == GridAngles::screen ? std::optional(flat_screen())
                                                 : std::nullopt,
           lamp);
    if (!recipe.note.empty())
        lamp.notes.push_back(recipe.note);
    return lamp;
}

} // namespace fernlicht
