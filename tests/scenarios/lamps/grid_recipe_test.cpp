// Recipes themselves: their keys, those that ship, and how a lamp names one.
#include "scenarios/yaml/library_file.h"
#include "tests/scenarios/drives/yaml_schema_check.h"
#include "tests/scenarios/lamps/recipe_trial.h"
#include "tests/shipped.h"

#include <fmt/format.h>
#include <fstream>
#include <regex>
#include <sstream>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class Recipe : public RecipeTrial {
  protected:
    std::string refused(const std::string& keys) const {
        FilesRead opened;
        return tests::refusal_of([&] { read_grid_recipe(write("recipe.yaml", recipe_text(keys)), opened); }, "");
    }
    static std::string content(const std::filesystem::path& file) {
        std::ostringstream text;
        text << std::ifstream(file).rdbuf();
        return text.str();
    }
    /// What an editor would say of it.
    static std::string violation(const std::string& yaml) {
        static SchemaCheck check{json::parse(std::ifstream(shipped_library / "../recipe.schema.json"))};
        return check.violation(to_json(parse_yaml(yaml, "test.yaml")));
    }
    const std::string csv = "layout: matrix\ndelimiter: comma\nunit: cd\n";
};

TEST_F(Recipe, KeysAreChecked) {
    ASSERT_EQ(refused(csv), "");
    const struct {
        std::string keys, said;
    } cases[] = {
        {csv + "decimals: comma", "recipe.yaml:5:1: decimals: unknown key, expected 'decimal', the nearest known key"},
        {csv + "v_positiv: down", "'v_positive', the nearest"},
        {csv + "h: {from: 0, too: 1, step: 1}", "h.too: unknown key, expected 'to', the nearest"},
        {csv + "decimal: comma", "recipe.yaml:5:10: decimal: decimal commas where commas part the cells, expected another delimiter"},
        {"layout: table\ndelimiter: tab\nunit: cd", "layout: found 'table', expected one of matrix, transposed, list"},
        {"delimiter: tab\nunit: cd", "layout: missing"},
        {"layout: matrix\nunit: cd", "delimiter: missing"},
        {"layout: matrix\ndelimiter: tab", "unit: missing"},
        {"layout: matrix\ndelimiter: tab\nunit: lux", "unit: found 'lux', expected one of cd, kcd, lx, cd/klm (nearest: 'lx')"},
        {"layout: matrix\ndelimiter: tab\nunit: lx", "distance_m: missing, expected the distance at which it was measured"},
        {"layout: matrix\ndelimiter: tab\nunit: cd/klm", "flux_lm: missing"},
        {csv + "distance_m: 25", "distance_m: a distance without lux or places on a wall, expected none"},
        {csv + "screen: planar", "screen: a screen without lux, expected none"},
        {csv + "angle_unit: mm\ndistance_m: 25", "angle_unit: places on a wall without `angles: screen`"},
        {csv + "angle_unit: mm\nangles: screen", "distance_m: missing"},
        {csv + "columns: {h: 1}", "columns: a key that layout 'matrix' does not use"},
        {"layout: list\ndelimiter: tab\nunit: cd\nh: {from: 0, to: 1, step: 1}", "h: a key that layout 'list' does not use"},
        {csv + "h: {from: 0, to: 1}", "h.step: missing, expected step or count"},
        {csv + "h: {from: 0, to: 1, step: 1, count: 2}", "h: a step beside a count, expected one of them"},
        {csv + "h: {from: 0, step: 1}", "h.to: missing, expected from and to"},
        {csv + "h: {from: 1, to: 1, step: 1}", "h: an axis from and to the same place"},
        {csv + "h: {from: {line: 3}, to: 1, step: 1}", "h.from: half a place, expected a number, or line and word"},
        {csv + "h: {from: {line: 3, word: 1, number: 2}, to: 1, step: 1}", "h.from: a number beside a place in the file"},
        {csv + "h: {from: 0, to: 1, step: -1}", "h.step: found '-1', expected a number above 0"},
        {csv + "require: [{line: 1}]", "require[0].is: missing"},
    };
    for (const auto& c : cases)
        EXPECT_THAT(refused(c.keys), HasSubstr(c.said)) << c.keys;
    FilesRead opened;
    EXPECT_THAT(tests::refusal_of([&] { read_grid_recipe(write("r.yaml", "fernlicht_recipe: 2\n" + csv), opened); }),
                HasSubstr("expected 1, the version of recipes that this program knows"));
    EXPECT_THAT(tests::refusal_of([&] { read_grid_recipe(write("r.yaml", csv), opened); }), HasSubstr("fernlicht_recipe: missing"));
}

TEST_F(Recipe, EveryKeyOfTheExampleMisspeltIsRefusedByReaderAndSchema) {
    const std::string example = content(shipped_library / "../recipe.example.yaml");
    FilesRead opened;
    ASSERT_EQ(read_grid_recipe(write("example.yaml", example), opened).v_zero_deg, -0.57);
    const std::regex key(R"(([a-z_]{2,}): )");
    int keys = 0;
    EXPECT_EQ(violation(example), "");
    for (std::sregex_iterator match(example.begin(), example.end(), key), end; match != end; ++match) {
        const auto at = static_cast<std::size_t>(match->position(1));
        const std::size_t line = example.rfind('\n', at) + 1;
        if (example.substr(line, at - line).find('#') != std::string::npos)
            continue;
        std::string misspelt = example;
        misspelt.insert(at + 1, "q");
        EXPECT_THAT(tests::refusal_of([&] { read_grid_recipe(write("example.yaml", misspelt), opened); }), HasSubstr("unknown key"))
            << match->str(1);
        EXPECT_NE(violation(misspelt), "") << match->str(1);
        ++keys;
    }
    EXPECT_GE(keys, 35);
}

/// By hand: 3 columns and 2 lines of cells from edge to edge, the lowest first.
TEST_F(Recipe, OfSpeosReadsWhatItsManualDescribes) {
    const std::string axes = "1\n2\n-3\t3\t-2\t2\n3\t2\n", values = "10\t20\t30\t\n40\t50\t60\t\n";
    const auto by_name = [&](const std::string& name) { return LampReadOptions{.recipe = recipe_file(name, folder_, {})}; };
    const LampFile basic = read("map.txt", "0\n1\t1\n" + axes + values, by_name("speos-type-a"));
    EXPECT_EQ(basic.table, (CandelaTable{{-2, 0, 2}, {-1, 1}, {10, 20, 30, 40, 50, 60}, {}, BetweenSamples::linear_cd}));
    EXPECT_EQ(basic.format, "text grid, recipe 'Speos XMP as TXT, SAE type A'");
    EXPECT_THAT(all_notes(basic), HasSubstr("look at the picture"));
    const std::string layer = "-1\t1\t500\nlayer0\n";
    EXPECT_EQ(read("map.txt", "3\n1\t1\n" + axes + layer + values, by_name("speos-type-a-extended")).table, basic.table);
    EXPECT_THAT(refusal("map.txt", "3\n1\t1\n" + axes + layer + values, by_name("speos-type-a")),
                HasSubstr("map.txt:1: word 1: found '3', expected '0' (basic map), as the recipe says"));
    EXPECT_THAT(refusal("map.txt", "0\n0\t1\n" + axes + values, by_name("speos-type-a")), HasSubstr("found '0', expected '1' (intensity)"));
    EXPECT_THAT(
        refusal("map.txt", "3\n1\t1\n" + axes + "-1\t2\t1\t1\nlayer0\n" + values + "layer1\n" + values, by_name("speos-type-a-extended")),
        HasSubstr("map.txt:11: found 1 cells, expected 3"))
        << "of several layers none is chosen in silence";
}

TEST_F(Recipe, AllThatShipAreGoodAndSayWhereTheirLayoutIsPublic) {
    ASSERT_FALSE(library_names("recipe").empty());
    for (const std::string& name : library_names("recipe")) {
        FilesRead opened;
        const std::filesystem::path file = recipe_file(name, folder_, {});
        EXPECT_EQ(file, (shipped_library / "recipes" / (name + ".yaml")).lexically_normal());
        EXPECT_NO_THROW(read_grid_recipe(file, opened)) << name;
        EXPECT_EQ(violation(content(file)), "") << name;
        EXPECT_THAT(content(file), HasSubstr("https://")) << name;
    }
}

TEST_F(Recipe, AFileComesBeforeAShippedName) {
    const auto file = write("speos-type-a", recipe_text(csv));
    EXPECT_EQ(recipe_file("speos-type-a", folder_, {}), file);
    EXPECT_EQ(recipe_file(file.string(), "/", {}), file);
    EXPECT_THAT(tests::refusal_of([&] {
                    recipe_file("speos-tipe-a", folder_, {{}, 0, 0, "--recipe"});
                }),
                AllOf(HasSubstr("--recipe: there is no file"), HasSubstr("and no recipe of that name, expected a recipe file, or one of "),
                      HasSubstr("(nearest: 'speos-type-a')")));
}

TEST_F(Recipe, IsForTextGridsAlone) {
    const std::string grid = ",0,1\n0,1,2\n1,3,4\n";
    const LampReadOptions options = by(csv);
    const LampFile ies = read_lamp(shipped_library / "lamps/halogen-low.ies", options);
    EXPECT_EQ(ies.table, read_lamp(shipped_library / "lamps/halogen-low.ies").table);
    EXPECT_EQ(read("m.csv", grid, options).table.cd, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(read("m.csv", "# unit: lx\n,0,1\n0,1,2\n1,3,4\n", by(csv + "comment: '#'")).table.cd, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_THAT(refusal("m.txt", grid),
                HasSubstr("beam texture (.png, .exr); other text grids need a recipe that says how they are laid out"));
    EXPECT_THAT(refusal("m.csv", "V;0;1\n0;1;2\n1;3;4\n"), HasSubstr("other text grids need a recipe"));
    EXPECT_THAT(refusal("m.txt", grid, {.recipe = folder_ / "none.yaml"}), HasSubstr("none.yaml"));
    LampReadOptions mirrored = options;
    mirrored.mirrored = true;
    EXPECT_EQ(read("m.txt", grid, mirrored).table.cd, (std::vector<double>{2, 1, 4, 3}));
}

} // namespace
} // namespace fernlicht
