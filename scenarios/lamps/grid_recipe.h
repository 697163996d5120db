// How a text file of luminous intensities is laid out, said by its user: the recipe that a goniometer's own export is read by.
#pragma once

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

enum class GridLayout { matrix, transposed, list }; ///< a line for each V; a line for each H; a line for each direction
enum class CellDelimiter { comma, semicolon, tab, blanks };
enum class DecimalSign { point, comma };
enum class GridUnit { cd, kcd, lx, cd_per_klm };
enum class GridScreen { spherical, planar };       ///< lux with the sensor facing the lamp; on a wall square to the axis
enum class GridAngles { type_a, type_b, screen };  ///< the goniometer's own; IES type B; atan(x / z) and atan(y / z)
enum class AngleUnit { deg, rad, percent, m, mm }; ///< percent: 100 tan(angle); m, mm: places on a wall at distance_m
enum class GridSamples { ends, centres };          ///< `from` and `to` are the outermost samples, or the outer edges of cells
enum class HorizontalSign { right, left };         ///< where the file's H is positive
enum class VerticalSign { up, down };

/// A number that the recipe gives, or the word of the file that holds it. Lines count from the file's first, words from 1.
struct HeaderNumber {
    std::optional<double> number;
    int line = 0, word = 0;
    bool given() const { return number || line > 0; }
};

/// Angles that do not stand beside the values.
struct GridAxis {
    HeaderNumber from, to;
    std::optional<double> step; ///< above 0, whichever way the axis runs
    HeaderNumber count;         ///< instead of a step
    GridSamples samples = GridSamples::ends;
};

/// What a file must say of itself, so that no other is read by this recipe.
struct HeaderWord {
    int line = 1, word = 1;
    std::string is, means;
};

/// Each the number of a column, from 1, or its name in the line that begins the list.
struct GridColumns {
    std::string h = "1", v = "2", value = "3";
};

struct GridRecipe {
    GridLayout layout = GridLayout::matrix;
    int version = 1;
    std::string title, note; ///< for people; `note` is said of every lamp that is read by it
    CellDelimiter delimiter = CellDelimiter::tab;
    DecimalSign decimal = DecimalSign::point;
    std::string comment;          ///< lines that begin so are skipped; "": none
    std::string header_ends_with; ///< the header ends with the line that begins so
    int header_lines = 0;         ///< from the file's beginning, or after that line
    std::string ends_before;      ///< the line that begins so ends the grid; "": the file does
    std::vector<HeaderWord> require;
    std::optional<GridAxis> h, v; ///< nullopt: the angles stand in the first line and in the first column
    GridColumns columns;
    GridUnit unit = GridUnit::cd;
    double factor = 1.0;
    HeaderNumber distance_m, flux_lm;
    GridScreen screen = GridScreen::spherical;
    GridAngles angles = GridAngles::type_a;
    AngleUnit angle_unit = AngleUnit::deg;
    HorizontalSign h_positive = HorizontalSign::right;
    VerticalSign v_positive = VerticalSign::up;
    double h_zero_deg = 0.0, v_zero_deg = 0.0; ///< where the file's 0, 0 lies: right and up
};

template <class Struct> struct Fields;
const Fields<GridRecipe>& grid_recipe_fields();

/// Reads and checks a recipe, version 1 (scenarios/recipe.example.yaml explains every key). Throws InputError with file, line, column, key.
GridRecipe read_grid_recipe(const std::filesystem::path& file, FilesRead& opened);

/// The recipe's file: `given` as a path from `folder`, or else the name of one in scenarios/library/recipes. Absolute and normal. Throws
/// InputError at `where`.
std::filesystem::path recipe_file(const std::string& given, const std::filesystem::path& folder, const InputError::Where& where);

} // namespace fernlicht
