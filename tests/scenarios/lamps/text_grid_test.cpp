// Text grids by recipes: files worked out by hand, our own lamp in layouts of all kinds, and what must be refused.
#include "tests/scenarios/lamps/recipe_trial.h"
#include "tests/shipped.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

const CandelaTable by_hand{{-10, 0, 10}, {-1, 2}, {1.5, 2, 3, 4, 5, 6.25}, {}, BetweenSamples::linear_cd};

class TextGrid : public RecipeTrial {};

TEST_F(TextGrid, AMatrixHasALineForEachV) {
    const LampFile lamp = read_by("title: Our goniometer\nlayout: matrix\ndelimiter: semicolon\ndecimal: comma\nunit: cd\n",
                                  "V\\H;-10;0;10\n-1;1,5;2;3\n2;4;5;6,25\n");
    EXPECT_EQ(lamp.table, by_hand);
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.format, "text grid, recipe 'Our goniometer'");
    EXPECT_THAT(lamp.notes, testing::IsEmpty());
    ASSERT_EQ(lamp.opened.size(), 2U);
    EXPECT_EQ(lamp.opened[0].path, folder_ / "lamp.txt");
    EXPECT_EQ(lamp.opened[1].path, folder_ / "recipe.yaml");
}

TEST_F(TextGrid, TheSameTableInOtherLayouts) {
    const struct {
        const char *keys, *text;
    } cases[] = {
        {"layout: transposed\ndelimiter: comma\nunit: cd", ",-1,2\n-10,1.5,4\n0,2,5\n10,3,6.25\n"},
        {"layout: matrix\ndelimiter: tab\nunit: cd", "\t-10\t0\t10\t\r\n-1\t1.5\t2\t3\t\r\n\r\n2\t4\t\"5\"\t6.25\t\r\n"},
        {"layout: matrix\ndelimiter: blanks\nunit: cd", "V \\ H  -10 0\t10\n -1  1.5 2 3\n  2  4 5 6.25\n"},
        {"layout: matrix\ndelimiter: blanks\nunit: cd", "-10 0 10\n-1 1.5 2 3\n2 4 5 6.25\n"}, // no corner
        {"layout: matrix\ndelimiter: blanks\nunit: cd", "0 10 0 -10\n2 6.25 5 4\n-1 3 2 1.5\n"},
        {"layout: matrix\ndelimiter: comma\nunit: cd\nv_positive: down\nh_positive: left", ",10,0,-10\n1,1.5,2,3\n-2,4,5,6.25\n"},
        {"layout: list\ndelimiter: comma\nunit: cd", "0,2,5\n-10,-1,1.5\n0,-1,2\n10,-1,3\n-10,2,4\n10,2,6.25\n"},
        {"layout: list\ndelimiter: tab\nunit: cd\ncolumns: {h: B, v: \"A [deg]\", value: 4}",
         "A [deg]\tB\tn\tI\n-1\t-10\t1\t1.5\n-1\t0\t2\t2\n-1\t10\t3\t3\n2\t-10\t4\t4\n2\t0\t5\t5\n2\t10\t6\t6.25\n"},
        {"layout: matrix\ndelimiter: blanks\nunit: cd\nh: {from: -10, to: 10, step: 10}\nv: {from: 2, to: -1, count: 2}",
         "4 5 6.25\n1.5 2 3\n"},
        {"layout: matrix\ndelimiter: blanks\nunit: cd\nh: {from: -15, to: 15, step: 10, samples: centres}", "-1 1.5 2 3\n2 4 5 6.25\n"},
        {"layout: transposed\ndelimiter: blanks\nunit: cd\nv: {from: -1, to: 2, step: 3}", "-10 1.5 4\n0 2 5\n10 3 6.25\n"},
        {"layout: matrix\ndelimiter: blanks\nunit: kcd\nfactor: 10", "-10 0 10\n-1 1.5e-4 2e-4 3e-4\n2 4e-4 5e-4 6.25e-4\n"},
        {"layout: matrix\ndelimiter: blanks\nunit: cd/klm\nflux_lm: 500", "-10 0 10\n-1 3 4 6\n2 8 10 12.5\n"},
        {"layout: matrix\ndelimiter: blanks\nunit: lx\ndistance_m: 10", "-10 0 10\n-1 .015 .02 .03\n2 .04 .05 .0625\n"},
        {"layout: matrix\ndelimiter: comma\nunit: cd\nh_zero_deg: 5\nv_zero_deg: -1", ",-15,-5,5\n0,1.5,2,3\n3,4,5,6.25\n"},
        {"layout: matrix\ndelimiter: comma\nunit: cd\nheader_lines: 2\ncomment: '!'\nends_before: '[E'",
         "Lamp, no 7\n\n,-10,0,10\n! noise\n-1,1.5,2,3\n2,4,5,6.25\n[End]\n3,1,2,3\n"},
        {"layout: matrix\ndelimiter: comma\nunit: cd\nheader_ends_with: '[Data]'\nheader_lines: 1\n"
         "require: [{line: 1, word: 4, is: cd, means: candela}]",
         "Unit: I in cd\nanything\n [Data] 2 x 3\nH:\n,-10,0,10\n-1,1.5,2,3\n2,4,5,6.25"},
    };
    for (const auto& c : cases) {
        const CandelaTable table = table_by(c.keys, c.text);
        EXPECT_EQ(table.h_deg, by_hand.h_deg) << c.keys;
        EXPECT_EQ(table.v_deg, by_hand.v_deg) << c.keys;
        ASSERT_EQ(table.cd.size(), by_hand.cd.size()) << c.keys;
        for (std::size_t i = 0; i < table.cd.size(); ++i)
            EXPECT_NEAR(table.cd[i], by_hand.cd[i], 1e-12) << c.keys;
    }
}

TEST_F(TextGrid, TheHeaderMayHaveAxesDistanceAndFlux) {
    const std::string keys = "layout: matrix\ndelimiter: semicolon\ndecimal: comma\nheader_lines: 5\nunit: lx\nscreen: planar\n"
                             "distance_m: {line: 1, word: 2}\nflux_lm: {line: 2, word: 1}\n"
                             "h: {from: {line: 3, word: 2}, to: {line: 3, word: 3}, count: {line: 5, word: 1}}\n"
                             "v: {from: {line: 4, word: 2}, to: {line: 4, word: 3}, count: {line: 5, word: 2}}\n";
    const std::string header = "Distance: 12,5 m\n1000,5\nH;-30;30\nV=0;10\n3;2\n";
    const LampFile lamp = read_by(keys, header + "1;2;3\n4;5;6\n");
    EXPECT_EQ(lamp.table.h_deg, (std::vector<double>{-30, 0, 30}));
    EXPECT_EQ(lamp.table.v_deg, (std::vector<double>{0, 10}));
    EXPECT_EQ(lamp.declared_flux_lm, 1000.5);
    EXPECT_DOUBLE_EQ(lamp.table.at(0, 1), 2 * 156.25);
    EXPECT_NEAR(lamp.table.at(1, 2), 6 * 156.25 / std::pow(std::cos(radians(30.0)) * std::cos(radians(10.0)), 3.0), 1e-9);
    EXPECT_THAT(refusal_by(keys, header + "1;2;3\n"), HasSubstr("lamp.txt:6: the grid ends after 1 lines of values, expected 2 lines"));
    EXPECT_THAT(refusal_by(keys, header + "1;2;3\n4;5;6\n7;8;9\n"),
                HasSubstr("lamp.txt:8: the grid goes on, expected its end after 2 lines"));
    EXPECT_THAT(refusal_by(keys, header + "1;2\n4;5\n"),
                HasSubstr("lamp.txt:6: found 2 cells, expected 3: a value for each of the horizontal"));
    EXPECT_THAT(refusal_by(keys, "Distance: -12,5 m\n1\nH;-30;30\nV=0;10\n3;2\n1;2;3\n4;5;6\n"),
                HasSubstr("lamp.txt:1: distance_m: found -12.5, expected a number above 0"));
    EXPECT_THAT(refusal_by(keys, "Distance:\n"), HasSubstr("lamp.txt:1: the file ends in its header"));
    EXPECT_THAT(refusal_by(keys, "Distance:\n1\n2\n3\n4\n"), HasSubstr("lamp.txt:1: found 1 words, expected word 2, which `distance_m`"));
    EXPECT_THAT(refusal_by(keys, "Distance: 1\n1\nH;-30;30\nV=0;10\n3,5;2\n1;2;3\n"),
                HasSubstr("found 3.5 of them, expected a whole number"));
    EXPECT_THAT(refusal_by(keys, "Distance: 1\n1\nH;-30;30\nV=0;10\n4e9;2\n1;2;3\n"),
                HasSubstr("expected a whole number from 2 to 16777216"));
}

TEST_F(TextGrid, AngleUnitsAndSystems) {
    const std::string lines = "-10 0 10\n0 1 2 3\n10 4 5 6\n";
    const std::string keys = "layout: matrix\ndelimiter: blanks\nunit: cd\n";
    EXPECT_NEAR(table_by(keys + "angle_unit: percent", lines).h_deg[2], degrees(std::atan(0.1)), 1e-12);
    EXPECT_NEAR(table_by(keys + "angle_unit: rad", "-.1 0 .1\n0 1 2 3\n.1 4 5 6\n").v_deg[1], degrees(0.1), 1e-12);
    const LampFile wall = read_by(keys + "angles: screen\nangle_unit: m\ndistance_m: 25", lines);
    ASSERT_TRUE(wall.measured);
    EXPECT_NEAR(wall.measured->table.v_deg[1], degrees(std::atan(0.4)), 1e-12);
    EXPECT_THAT(all_notes(wall), HasSubstr("Resampled from flat screen"));
    EXPECT_NEAR(read_by(keys + "angles: screen\nangle_unit: mm\ndistance_m: 0.025", lines).measured->table.v_deg[1],
                degrees(std::atan(0.4)), 1e-12);
    // The same file as IES, type B: one table in the end.
    const LampFile type_b = read_by(keys + "angles: type-b", lines);
    const LampFile ies = read("b.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 3 2 2 0 0 0\n1 1 0\n0 10\n-10 0 10\n1 4\n2 5\n3 6\n");
    EXPECT_EQ(type_b.table, ies.table);
}

/// Our halogen low beam as a lab might hand it over.
class ShippedAsText : public RecipeTrial {
  protected:
    const LampFile ies_ = read_lamp(shipped_library / "lamps/halogen-low.ies");

    struct Form {
        std::string separator = ";";
        bool decimal_comma = false, transposed = false, top_first = false;
        double (*angle)(double) = [](double deg) { return deg; };
        double v_sign = 1.0, h_sign = 1.0;
        double (*value)(double cd, double h, double v) = [](double cd, double, double) { return cd; };
    };
    static std::string number(double value, const Form& form) {
        std::string text = fmt::format("{}", value);
        if (form.decimal_comma)
            std::ranges::replace(text, '.', ',');
        return text;
    }
    double cell(const Form& form, std::size_t v, std::size_t h) const {
        return form.value(ies_.table.at(v, h), ies_.table.h_deg[h], ies_.table.v_deg[v]);
    }
    std::string matrix(const Form& form) const {
        const CandelaTable& t = ies_.table;
        const std::vector<double>&across = form.transposed ? t.v_deg : t.h_deg, &down = form.transposed ? t.h_deg : t.v_deg;
        const double across_sign = form.transposed ? form.v_sign : form.h_sign, down_sign = form.transposed ? form.h_sign : form.v_sign;
        std::string text = "V/H";
        for (const double a : across)
            text += form.separator + number(across_sign * form.angle(a), form);
        text += "\n";
        for (std::size_t i = 0; i < down.size(); ++i) {
            const std::size_t row = form.top_first ? down.size() - 1 - i : i;
            text += number(down_sign * form.angle(down[row]), form);
            for (std::size_t j = 0; j < across.size(); ++j)
                text += form.separator + number(form.transposed ? cell(form, j, row) : cell(form, row, j), form);
            text += "\n";
        }
        return text;
    }
    std::string list(const Form& form) const {
        std::string text = "no" + form.separator + "I" + form.separator + "V" + form.separator + "H\n";
        for (std::size_t h = 0; h < ies_.table.h_deg.size(); ++h)
            for (std::size_t v = 0; v < ies_.table.v_deg.size(); ++v)
                text +=
                    fmt::format("{1}{0}{2}{0}{3}{0}{4}\n", form.separator, v, number(cell(form, v, h), form),
                                number(form.v_sign * form.angle(ies_.table.v_deg[v]), form), number(form.angle(ies_.table.h_deg[h]), form));
        return text;
    }
    /// Angles within `deg`, intensities within `relative`.
    void expect_same(const LampFile& lamp, double deg, double relative, const std::string& what) const {
        const CandelaTable &a = lamp.table, &b = ies_.table;
        ASSERT_EQ(a.h_deg.size(), b.h_deg.size()) << what;
        ASSERT_EQ(a.v_deg.size(), b.v_deg.size()) << what;
        double worst_deg = 0.0, worst = 0.0;
        for (std::size_t h = 0; h < a.h_deg.size(); ++h)
            worst_deg = std::max(worst_deg, std::abs(a.h_deg[h] - b.h_deg[h]));
        for (std::size_t v = 0; v < a.v_deg.size(); ++v)
            worst_deg = std::max(worst_deg, std::abs(a.v_deg[v] - b.v_deg[v]));
        for (std::size_t i = 0; i < a.cd.size(); ++i)
            worst = std::max(worst, std::abs(a.cd[i] - b.cd[i]) / std::max(b.cd[i], 1.0));
        EXPECT_LE(worst_deg, deg) << what;
        EXPECT_LE(worst, relative) << what;
        EXPECT_EQ(a.gaps, b.gaps) << what;
        EXPECT_THAT(lamp.notes, testing::IsEmpty()) << what;
    }
};

TEST_F(ShippedAsText, ComesBackAsTheIesFileHasIt) {
    const std::string cd = "unit: cd\nlayout: matrix\n";
    expect_same(read_by(cd + "delimiter: semicolon", matrix({})), 0.0, 0.0, "plain");
    expect_same(read_by(cd + "delimiter: comma", matrix({.separator = ","})), 0.0, 0.0, "CSV");
    expect_same(read_by(cd + "delimiter: semicolon\ndecimal: comma", matrix({.decimal_comma = true})), 0.0, 0.0, "decimal comma");
    expect_same(read_by(cd + "delimiter: tab\ndecimal: comma\nv_positive: down",
                        matrix({.separator = "\t", .decimal_comma = true, .top_first = true, .v_sign = -1.0})),
                0.0, 0.0, "V down positive, top first");
    expect_same(read_by(cd + "delimiter: blanks\nh_positive: left", matrix({.separator = "  ", .h_sign = -1.0})), 0.0, 0.0,
                "H to the left");
    expect_same(read_by("unit: cd\nlayout: transposed\ndelimiter: semicolon", matrix({.transposed = true})), 0.0, 0.0, "transposed");
    expect_same(read_by("unit: cd\nlayout: list\ndelimiter: comma\ncolumns: {h: H, v: V, value: I}", list({.separator = ","})), 0.0, 0.0,
                "list by names");
    expect_same(read_by("unit: cd\nlayout: list\ndelimiter: semicolon\ndecimal: comma\nheader_lines: 1\ncolumns: {h: 4, v: 3, value: 2}\n"
                        "v_positive: down",
                        list({.decimal_comma = true, .v_sign = -1.0})),
                0.0, 0.0, "list by numbers");
}

TEST_F(ShippedAsText, ComesBackToRoundingInOtherUnits) {
    const std::string keys = "layout: matrix\ndelimiter: semicolon\n";
    const auto percent = [](double deg) { return 100.0 * std::tan(radians(deg)); };
    const auto rad = [](double deg) { return radians(deg); };
    expect_same(read_by(keys + "unit: lx\ndistance_m: 25", matrix({.value = [](double i, double, double) { return i / 625.0; }})), 0.0,
                1e-15, "lux at 25 m, facing the lamp");
    const auto on_wall = [](double i, double h, double v) {
        return i / 625.0 * std::pow(std::cos(radians(h)) * std::cos(radians(v)), 3.0);
    };
    expect_same(read_by(keys + "unit: lx\ndistance_m: 25\nscreen: planar", matrix({.value = on_wall})), 0.0, 1e-12,
                "lux in a wall at 25 m");
    expect_same(read_by(keys + "unit: cd\nangle_unit: percent", matrix({.angle = percent})), 1e-12, 0.0, "percent");
    expect_same(read_by(keys + "unit: cd\nangle_unit: rad", matrix({.angle = rad})), 1e-12, 0.0, "rad");
    expect_same(read_by(keys + "unit: cd/klm\nflux_lm: 1500", matrix({.value = [](double i, double, double) { return i / 1.5; }})), 0.0,
                1e-15, "cd per 1000 lm");
}

/// Intensities of the wall are the IES file's, at each direction of the wall's own samples.
TEST_F(ShippedAsText, OfAWallAgreesWithTheIesFileWhereItWasMeasured) {
    std::string text = "mm";
    const auto places = [](double from_mm, double to_mm, double step_mm) {
        std::vector<double> out;
        for (double at = from_mm; at <= to_mm; at += step_mm)
            out.push_back(at);
        return out;
    };
    const std::vector<double> xs = places(-3000.0, 3000.0, 100.0), ys = places(-1500.0, 500.0, 50.0);
    const auto angles = [](double x, double y) {
        return std::pair(degrees(std::atan2(x, 25000.0)), degrees(std::atan2(y, std::hypot(x, 25000.0))));
    };
    for (const double x : xs)
        text += fmt::format("\t{}", x);
    for (const double y : ys) {
        text += fmt::format("\n{}", -y); // positive downwards
        for (const double x : xs) {
            const auto [h, v] = angles(x, y);
            const double cosine = 25000.0 / std::hypot(x, y, 25000.0);
            text += fmt::format("\t{}", intensity_cd(ies_.table, h, v) / 625.0 * cosine * cosine * cosine);
        }
    }
    const LampFile lamp = read_by("layout: matrix\ndelimiter: tab\nunit: lx\ndistance_m: 25\nscreen: planar\nangles: screen\n"
                                  "angle_unit: mm\nv_positive: down",
                                  text);
    double worst = 0.0;
    for (const double x : xs)
        for (const double y : ys)
            if (std::abs(x) < 3000.0 && y > -1500.0 && y < 500.0) {
                const auto [h, v] = angles(x, y);
                worst = std::max(worst, std::abs(intensity_cd(lamp.table, h, v) - intensity_cd(ies_.table, h, v)));
            }
    EXPECT_LE(worst, 0.001 * peak_of(ies_.table).cd) << "what bringing a wall onto H and V may cost";
}

TEST_F(TextGrid, WhatIsNotAsTheRecipeSaysIsRefused) {
    const std::string csv = "layout: matrix\ndelimiter: comma\nunit: cd\n", list = "layout: list\ndelimiter: comma\nunit: cd\n";
    const std::string semicolon = "layout: matrix\ndelimiter: semicolon\nunit: cd\n", german = semicolon + "decimal: comma\n";
    const struct {
        std::string keys, text, said;
    } cases[] = {
        {csv, ",0,1\n0,1\n",
         "lamp.txt:1: horizontal angles: found 3 cells, and 2 in line 2, expected horizontal angles separated by commas"},
        {csv, ",0,1\n0,1,2\n1,3\n",
         "lamp.txt:3: found 2 cells, expected 3: one of the vertical angles and a value for each of the horizontal"},
        {csv, ",0,1\n0,1.5,2\n1,3,4,5\n", "lamp.txt:3: found 4 cells, expected 3"},
        {csv, ",0,1\n0,1,2\n1,3,many\n", "lamp.txt:3: value in column 3: found 'many', expected a finite number"},
        {csv, ",0,1\n0,1,2\n1,3,nan\n", "lamp.txt:3: value in column 3: found 'nan', expected a finite number"},
        {csv, ",0,1\n0,1,2\n1,3,inf\n", "found 'inf'"},
        {csv, ",0,1\n0,1,2\n1,,3\n", "lamp.txt:3: value in column 2: found '', expected a finite number"},
        {csv, ",0,one\n0,1,2\n1,3,4\n", "lamp.txt:1: horizontal angles: found 'one'"},
        {csv, ",0,1\nlow,1,2\n1,3,4\n", "lamp.txt:2: vertical angles in column 1: found 'low'"},
        {csv, ",0.5,0.5\n0,1,2\n1,3,4\n", "lamp.txt:1: horizontal angles: the angle 0.5 is given twice with different intensities"},
        {csv, ",0,1\n0.5,1,2\n0.5,3,4\n", "vertical angles: the angle 0.5 is given twice with different intensities"},
        {csv, ",0,1\n0,1,2\n", "lamp.txt:2: vertical angles: found 1 of them, expected at least 2"},
        {csv, "V,1\n0,1\n1,2\n", "horizontal angles: found 1 of them, expected at least 2"},
        {csv, ",0,1\n0,1,2\n95,3,4\n", "vertical angles: found 95, expected angles from -90 to 90"},
        {csv, ",0,1\n0,1,-2\n1,3,4\n", "lamp.txt:2: intensity at horizontal 1, vertical 0: is -2 cd"},
        {csv, ",0,1\n0,1,1e13\n1,3,4\n", "cd, expected at most"},
        {csv, "\n\n", "the grid ends after 0 lines of values, expected a line of horizontal angles"},
        {csv, ",0,1\n", "lamp.txt:1: the grid ends after 0 lines of values, expected lines of values"},
        {csv, "V;0;1\n0;1;2\n1;3;4\n",
         "lamp.txt:1: horizontal angles: found 1 cells, and 1 in line 2, expected horizontal angles separated by commas"},
        // decimal signs
        {csv, ",-1,5,0,0,1,5\n-1,0,7,5,8,0\n1,5,2,5,3,5\n", "numbers with decimal commas cannot be separated by commas"},
        {csv, ",-10,0,0,0,10,0\n-1,3,5,20,1,4,0\n1,3,5,21,1,4,0\n",
         "lamp.txt:1: horizontal angles: the angles neither rise nor fall, expected angles in order; numbers with decimal commas cannot "
         "be"},
        {csv, ",0,1\n0,1,2\n1,3,5,4\n",
         "lamp.txt:3: found 4 cells, expected 3: one of the vertical angles and a value for each of the "
         "horizontal angles, separated by commas; numbers with decimal commas cannot be separated by commas"},
        {list, "0,5,1,5,100,0\n0,5,2,5,110,0\n", "is given twice with different values, expected each direction once; first in line"},
        {list, "0,5,1,100\n0,2,100\n",
         "lamp.txt:2: found 3 cells, expected 4 separated by commas, as in the lines before; numbers with decimal"},
        {semicolon, "V;0;1\n0;1;2\n1;3,5;4\n",
         "lamp.txt:3: value in column 2: found '3,5', expected a number with a decimal point, as the recipe"},
        {german, "V;0;1\n0;1;2\n1;3.5;4\n",
         "lamp.txt:3: value in column 2: found '3.5', expected a number with a decimal comma, as the recipe"},
        {german, "V;0;1\n0;1;2\n1;1.003,5;4\n", "found '1.003,5', expected a number with a decimal comma"},
        // lists
        {list, "0,0,1\n0,1,2\n1,0,3\n", "lamp.txt:3: 1 of 4 directions are missing, the first of them 1, 1, expected a grid"},
        {list, "0,0,1\n0,1,2\n1,0,3\n1,1,4\n0,0,1.5\n", "lamp.txt:5: the direction 0, 0 is given twice with different values"},
        {list, "0,0\n0,1\n", "lamp.txt:1: found 2 cells, expected column 3, which the recipe names, separated by commas"},
        {list + "columns: {h: H, v: V, value: I}", "H,V,E\n0,0,1\n", "no column is called 'I'"},
        {list, "", "lamp.txt"},
        {list, "# nothing\n", "column 2, which the recipe names"},
        // header
        {csv + "header_lines: 9", ",0,1\n0,1,2\n1,3,4\n",
         "lamp.txt:3: the file ends in its header, expected 9 lines of it, as the recipe says"},
        {csv + "header_ends_with: '[Data]'", ",0,1\n0,1,2\n",
         "no line ends the header, expected one that begins with '[Data]', as the recipe"},
        {csv + "header_lines: 1\nrequire: [{line: 1, word: 2, is: cd, means: candela}]", "unit = lx\n,0,1\n0,1,2\n1,3,4\n",
         "lamp.txt:1: word 2: found 'lx', expected 'cd' (candela), as the recipe says"},
        {csv + "require: [{line: 8, is: cd}]", ",0,1\n",
         "lamp.txt:1: the file ends here, expected line 8, which `require` of the recipe names"},
        {csv + "h: {from: 0, to: 1, step: 0.3}", "0,1,2\n1,3,4\n",
         "horizontal angles: steps of 0.3 from 0 miss 1, expected steps that meet it"},
        {csv + "h: {from: 0, to: 1, count: 3}", "0,1,2\n1,3,4\n", "lamp.txt:1: found 3 cells, expected 4"},
        {semicolon + "angles: screen", "V;0;90\n0;1;2\n1;3;4\n", "horizontal angles: found 90, expected angles from -89 to 89"},
    };
    for (const auto& c : cases)
        EXPECT_THAT(refusal_by(c.keys, c.text), HasSubstr(c.said)) << c.keys << c.text;
}

TEST_F(TextGrid, OddsAndEndsAreNoted) {
    const std::string keys = "layout: list\ndelimiter: comma\nunit: cd\nnote: Lamp was cold.\n";
    const LampFile lamp = read_by(keys, "0,0,1\n0,1,2\n1,0,3\n1,1,4000\n0,0,1\n1,2,-1\n0,2,0\n");
    EXPECT_THAT(all_notes(lamp), HasSubstr("1 directions are repeated with the same values: taken once."));
    EXPECT_THAT(all_notes(lamp), HasSubstr("1 intensity is slightly negative, down to -1 cd in line 6"));
    EXPECT_THAT(all_notes(lamp), HasSubstr("Lamp was cold."));
    EXPECT_THAT(all_notes(read_by("layout: matrix\ndelimiter: semicolon\nunit: cd", ";0;2;1\n0;1;2;3\n1;4;5;6\n")),
                HasSubstr("The horizontal angles do not ascend: sorted."));
    // Windows-1252, as instruments write it.
    EXPECT_EQ(table_by("layout: list\ndelimiter: tab\nunit: cd\ncolumns: {h: \"H [\u00b0]\", v: V, value: I}",
                       "H [\xb0]\tV\tI\n0\t0\t1\n0\t1\t2\n1\t0\t3\n1\t1\t4\n")
                  .cd,
              (std::vector<double>{1, 3, 2, 4}));
}

TEST_F(TextGrid, NothingMakesItFallOver) {
    const std::string keys =
        "layout: matrix\ndelimiter: semicolon\ndecimal: comma\nunit: cd\nheader_lines: 1\nflux_lm: {line: 1, word: 2}\n";
    const std::string good = "flux; 500,5\nV;-1,5;0;2\n-1;1;2;3\n0;4;5;6\n2;7;8;9,5\n";
    ASSERT_EQ(refusal_by(keys, good), "");
    const LampReadOptions options = by(keys);
    const auto must_not = [&](const std::string& content) {
        const std::string complaint = refusal("lamp.txt", content, options);
        if (!complaint.empty()) {
            EXPECT_THAT(complaint, HasSubstr("lamp.txt"));
        }
    };
    for (std::size_t n = 0; n < good.size(); ++n)
        must_not(good.substr(0, n));
    std::mt19937 random(7);
    std::uniform_int_distribution<std::size_t> place(0, good.size() - 1), byte(0, 255);
    for (int i = 0; i < 400; ++i) {
        std::string content = good;
        content[place(random)] = static_cast<char>(byte(random));
        must_not(content);
    }
    for (int i = 0; i < 100; ++i) {
        std::string content;
        for (std::size_t n = byte(random); n > 0; --n)
            content += static_cast<char>(byte(random));
        must_not(content);
    }
    must_not(std::string("\xff\xfeV\0;\0", 6)); // UTF-16
    EXPECT_THAT(
        refusal_by(
            "layout: matrix\ndelimiter: blanks\nunit: cd\nh: {from: 0, to: 1, count: 16777216}\nv: {from: 0, to: 1, count: 16777216}",
            "1 2\n"),
        HasSubstr("found 2 cells, expected 16777216"));
    EXPECT_THAT(refusal_by("layout: list\ndelimiter: blanks\nunit: cd",
                           [] {
                               std::string scattered; // each value at angles of its own
                               for (int i = 0; i < 5000; ++i)
                                   scattered += fmt::format("{} {} 1\n", 0.001 * i, 0.002 * i);
                               return scattered;
                           }()),
                HasSubstr("found 5000 values at 5000 horizontal and 5000 vertical angles, expected a grid"));
}

} // namespace
} // namespace fernlicht
