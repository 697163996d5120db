#include "scenarios/lamps/grid_recipe.h"

#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/yaml/library_file.h"
#include "scenarios/yaml/yaml_entry.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>

namespace fernlicht {
namespace {

constexpr int most_header_lines = 1000;
constexpr double most_of_number = 1.0e9;

bool is_list_layout(const void* recipe) { return static_cast<const GridRecipe*>(recipe)->layout == GridLayout::list; }
bool is_matrix_layout(const void* recipe) { return !is_list_layout(recipe); }

void check_header_number(const YamlMap& keys, const HeaderNumber& number) {
    if (number.number && (keys.find("line") || keys.find("word")))
        keys.entry().refuse("a number beside a place in the file", "one of them");
    if (!number.number && (number.line == 0 || number.word == 0))
        keys.entry().refuse("half a place", "a number, or line and word");
}

const Fields<HeaderNumber>& header_number_fields() {
    static const Fields<HeaderNumber> fields =
        Fields<HeaderNumber>{
            field("number", 1, &HeaderNumber::number, range(-most_of_number, most_of_number), "itself; in short it stands without the key"),
            field("line", 2, &HeaderNumber::line, range(1, most_header_lines), "of the file that has it, from 1"),
            field("word", 3, &HeaderNumber::word, range(1, most_header_lines), "in that line, from 1; blanks and , ; : = part words"),
        }
            .checked(check_header_number)
            .defined_as("recipe_number");
    return fields;
}

void check_grid_axis(const YamlMap& keys, const GridAxis& axis) {
    if (axis.step && axis.count.given())
        keys.entry().refuse("a step beside a count", "one of them");
    if (!axis.step && !axis.count.given())
        keys.refuse_missing("step", "step or count");
    if (!axis.from.given() || !axis.to.given())
        keys.refuse_missing(axis.from.given() ? "to" : "from", "from and to");
    if (axis.from.number && axis.to.number && *axis.from.number == *axis.to.number)
        keys.entry().refuse("an axis from and to the same place", "two places");
}

const Fields<GridAxis>& grid_axis_fields() {
    static const Fields<GridAxis> fields =
        Fields<GridAxis>{
            field("from", 1, &GridAxis::from, header_number_fields(), "the first angle, a number or a place in the file")
                .short_for("number"),
            field("to", 2, &GridAxis::to, header_number_fields(), "the last").short_for("number"),
            field("step", 3, &GridAxis::step, above(0.0, most_of_number), "from one to the next; or count"),
            field("count", 4, &GridAxis::count, header_number_fields(), "how many there are").short_for("number"),
            field("samples", 5, &GridAxis::samples, words({"ends", "centres"}),
                  "from and to are the outermost samples, or the outer edges of cells with samples in their centres"),
        }
            .checked(check_grid_axis)
            .defined_as("recipe_axis");
    return fields;
}

const Fields<HeaderWord>& header_word_fields() {
    static const Fields<HeaderWord> fields{
        field("line", 1, &HeaderWord::line, range(1, most_header_lines), "of the file, from 1").required(),
        field("word", 2, &HeaderWord::word, range(1, most_header_lines), "in that line, from 1; blanks and , ; : = part words"),
        field("is", 3, &HeaderWord::is, any(), "the word that must stand there").required(),
        field("means", 4, &HeaderWord::means, any(), "what it says, for the refusal of a file with another word"),
    };
    return fields;
}

const Fields<GridColumns>& grid_column_fields() {
    static const Fields<GridColumns> fields{
        field("h", 1, &GridColumns::h, any(), "number of the column, from 1, or its name in the line that begins the list"),
        field("v", 2, &GridColumns::v, any(), "the same"),
        field("value", 3, &GridColumns::value, any(), "the same"),
    };
    return fields;
}

void read_version(const YamlEntry& entry, GridRecipe& recipe) {
    recipe.version = entry.whole(0, 1'000'000);
    if (recipe.version != 1)
        entry.refuse("1, the version of recipes that this program knows");
}

void check_recipe(const YamlMap& keys, const GridRecipe& recipe) {
    const bool places = recipe.angle_unit == AngleUnit::m || recipe.angle_unit == AngleUnit::mm;
    const auto none = [&](const char* key, const char* found) {
        if (const auto given = keys.find(key))
            given->refuse(found, "none");
    };
    if (recipe.delimiter == CellDelimiter::comma && recipe.decimal == DecimalSign::comma)
        keys.require("decimal").refuse("decimal commas where commas part the cells", "another delimiter");
    if (places && recipe.angles != GridAngles::screen)
        keys.require("angle_unit").refuse("places on a wall without `angles: screen`", "angles: screen beside it");
    if ((recipe.unit == GridUnit::lx || places) && !recipe.distance_m.given())
        keys.refuse_missing("distance_m", "the distance at which it was measured");
    if (recipe.unit != GridUnit::lx && !places)
        none("distance_m", "a distance without lux or places on a wall");
    if (recipe.unit != GridUnit::lx)
        none("screen", "a screen without lux");
    if (recipe.unit == GridUnit::cd_per_klm && !recipe.flux_lm.given())
        keys.refuse_missing("flux_lm", "the flux that the intensities are for, lm");
}

} // namespace

const Fields<GridRecipe>& grid_recipe_fields() {
    using Recipe = GridRecipe;
    static const Fields<Recipe> fields =
        Fields<Recipe>{
            field("layout", 1, &Recipe::layout, words({"matrix", "transposed", "list"}),
                  "matrix: a line for each V; transposed: a line for each H; list: a line for each direction")
                .required(),
            field("fernlicht_recipe", 2, &Recipe::version, range(1, 1), "version of this format").required().read_by(read_version),
            field("title", 3, &Recipe::title, any(), "for people; the file's name by default"),
            field("note", 4, &Recipe::note, any(), "is said of every lamp that is read by it"),
            field("delimiter", 5, &Recipe::delimiter, words({"comma", "semicolon", "tab", "blanks"}), "what parts the cells of a line")
                .required(),
            field("decimal", 6, &Recipe::decimal, words({"point", "comma"}), "the decimal sign"),
            field("comment", 7, &Recipe::comment, any(), "lines that begin so are skipped; none by default"),
            field("header_ends_with", 8, &Recipe::header_ends_with, any(), "the header ends with the line that begins so"),
            field("header_lines", 9, &Recipe::header_lines, range(0, most_header_lines),
                  "lines of the header: from the file's beginning, or after header_ends_with"),
            field("ends_before", 10, &Recipe::ends_before, any(), "the grid ends before the line that begins so; else with the file"),
            list("require", 11, &Recipe::require, 0, 100, header_word_fields(), "words that the file must have"),
            field("h", 12, &Recipe::h, grid_axis_fields(), "horizontal angles that do not stand in the file beside the values")
                .heard_if(is_matrix_layout),
            field("v", 13, &Recipe::v, grid_axis_fields(), "vertical ones").heard_if(is_matrix_layout),
            field("columns", 14, &Recipe::columns, grid_column_fields(), "which columns of a list are which").heard_if(is_list_layout),
            field("unit", 15, &Recipe::unit, words({"cd", "kcd", "lx", "cd/klm"}), "of the values").required(),
            field("factor", 16, &Recipe::factor, above(0.0, 1.0e9), "on all values"),
            field("distance_m", 17, &Recipe::distance_m, header_number_fields(), "of sensor or wall, for lx and for places on a wall")
                .short_for("number"),
            field("screen", 18, &Recipe::screen, words({"spherical", "planar"}),
                  "lux with the sensor facing the lamp, or in a wall square to its axis"),
            field("flux_lm", 19, &Recipe::flux_lm, header_number_fields(), "declared flux; for cd/klm what the values are for")
                .short_for("number"),
            field("angles", 20, &Recipe::angles, words({"type-a", "type-b", "screen"}),
                  "H about the vertical axis and V = asin(y), as on the UN goniometer; IES type B; as read off a flat wall"),
            field("angle_unit", 21, &Recipe::angle_unit, words({"deg", "rad", "percent", "m", "mm"}),
                  "percent: 100 tan(angle); m and mm: places on a wall"),
            field("h_positive", 22, &Recipe::h_positive, words({"right", "left"}), "where H is positive, seen from the lamp"),
            field("v_positive", 23, &Recipe::v_positive, words({"up", "down"}), "where V is positive"),
            field("h_zero_deg", 24, &Recipe::h_zero_deg, range(-90.0, 90.0), "where the file's H 0 lies, to the right"),
            field("v_zero_deg", 25, &Recipe::v_zero_deg, range(-90.0, 90.0), "where its V 0 lies, upwards"),
        }
            .block()
            .checked(check_recipe);
    return fields;
}

GridRecipe read_grid_recipe(const std::filesystem::path& file, FilesRead& opened) {
    const YamlValue document = parse_yaml(to_utf8(read_file(file, opened, std::size_t{1} << 20)), file);
    GridRecipe recipe = read_fields(grid_recipe_fields(), YamlEntry(document, file, ""));
    if (recipe.title.empty())
        recipe.title = file.stem().string();
    return recipe;
}

std::filesystem::path recipe_file(const std::string& given, const std::filesystem::path& folder, const InputError::Where& where) {
    return library_file("recipe", given, folder, where);
}

} // namespace fernlicht
