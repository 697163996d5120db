// Beam matrices: units, screens, separators and round trips.
#include "tests/scenarios/lamps/lamp_trial.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class BeamMatrix : public LampTrial {
  protected:
    CandelaTable table(const std::string& text) const { return read("m.csv", text).table; }
};

constexpr const char* body = "V\\H,-10,0,10\n-1,1,2,3\n0,4,5,6\n2,7,8,9\n";

TEST_F(BeamMatrix, CandelaStandAsTheyAre) {
    const LampFile lamp = read("m.csv", std::string("# unit: cd\n# a comment\n") + body);
    EXPECT_EQ(lamp.format, "beam matrix");
    EXPECT_EQ(lamp.name, "m");
    EXPECT_EQ(lamp.table, (CandelaTable{{-10, 0, 10}, {-1, 0, 2}, {1, 2, 3, 4, 5, 6, 7, 8, 9}, {}, BetweenSamples::linear_cd}));
    EXPECT_EQ(read("no-extension", std::string("# unit: cd\n") + body).table, lamp.table) << "told by content";
}

TEST_F(BeamMatrix, LuxCountWithTheSquareOfTheDistance) {
    EXPECT_DOUBLE_EQ(peak_of(table(std::string("# unit: lx\n") + body)).cd, 9 * 625.0);
    EXPECT_DOUBLE_EQ(peak_of(table(std::string("# unit: lx\n# distance_m: 10\n") + body)).cd, 900.0);
}

TEST_F(BeamMatrix, AFlatWallCostsTheCubeOfTheCosine) {
    // A lamp of 1000 cd to all sides: E on the wall is 1.6 cos^3(theta). Ignoring that is 4.7 % at 10 degrees, 21 % at 20, 54 % at 30.
    std::string lux = "# unit: lx\n# screen: planar\n# angles: goniometer\nV\\H,-30,-20,-10,0,10,20,30\n";
    for (const double v : {-20.0, -10.0, 0.0, 5.0}) {
        lux += fmt::format("{}", v);
        for (int h = -30; h <= 30; h += 10)
            lux += fmt::format(",{}", 1000.0 / 625.0 * std::pow(std::cos(radians(h)) * std::cos(radians(v)), 3.0));
        lux += "\n";
    }
    for (const double cd : table(lux).cd)
        EXPECT_NEAR(cd, 1000.0, 1e-9);
    std::string ignored = lux;
    ignored.replace(ignored.find("planar"), 6, "spherical");
    const CandelaTable wrong = table(ignored);
    for (const auto& [h, loss] : {std::pair{10.0, 0.047}, std::pair{20.0, 0.21}, std::pair{30.0, 0.54}})
        EXPECT_NEAR(1000.0 / intensity_cd(wrong, h, 0.0) - 1.0, loss, 0.005);
}

TEST_F(BeamMatrix, ScreenAnglesAreTurnedIntoTheGoniometers) {
    // A spot seen on the wall at atan(x/d) = 40, atan(y/d) = -10: its elevation above the horizontal is less than 10 degrees.
    std::string text = "# unit: cd\n# angles: screen\nV\\H";
    const auto spot = [](double a, double b) { return 1000.0 * std::exp(-(std::pow(a - 40.0, 2) + std::pow(b + 10.0, 2)) / 20.0); };
    for (int a = -50; a <= 50; ++a)
        text += fmt::format(",{}", a);
    text += "\n";
    for (int b = -30; b <= 10; ++b) {
        text += fmt::format("{}", b);
        for (int a = -50; a <= 50; ++a)
            text += fmt::format(",{}", spot(a, b));
        text += "\n";
    }
    const LampFile lamp = read("s.csv", text);
    const double elevation = degrees(std::atan2(std::tan(radians(-10.0)), std::hypot(1.0, std::tan(radians(40.0)))));
    EXPECT_NEAR(peak_of(lamp.table).h_deg, 40.0, 1e-9);
    EXPECT_NEAR(peak_of(lamp.table).v_deg, elevation, 1e-9);
    EXPECT_DOUBLE_EQ(peak_of(lamp.table).cd, 1000.0);
    EXPECT_NEAR(elevation, -7.69, 0.01);
    EXPECT_THAT(all_notes(lamp), HasSubstr("Resampled from flat screen"));
    EXPECT_EQ(intensity_cd(lamp.table, 180.0, 0.0), 0.0);
}

TEST_F(BeamMatrix, ScreenAnglesAndAPlanarScreenTogether) {
    // 1000 cd to all sides, measured in the wall over screen angles.
    std::string text = "# unit: lx\n# angles: screen\n# screen: planar\n# distance_m: 5\nV\\H,-30,0,30\n";
    for (const double b : {-20.0, 0.0, 20.0}) {
        text += fmt::format("{}", b);
        for (const double a : {-30.0, 0.0, 30.0})
            text += fmt::format(",{}", 1000.0 / 25.0 * std::pow(1.0 / std::hypot(1.0, std::tan(radians(a)), std::tan(radians(b))), 3.0));
        text += "\n";
    }
    const CandelaTable t = table(text);
    for (const double h : {-25.0, 0.0, 12.0})
        for (const double v : {-15.0, 0.0, 10.0})
            EXPECT_NEAR(intensity_cd(t, h, v), 1000.0, 1e-6);
}

TEST_F(BeamMatrix, SeparatorsAndDecimalCommas) {
    const CandelaTable expected = table("# unit: cd\nV\\H,-1.5,0\n-1,1.5,2\n0,4,5.25\n");
    EXPECT_EQ(table("# unit: cd\nV\\H;-1,5;0\n-1;1,5;2\n0;4;5,25\n"), expected);
    EXPECT_EQ(table("# unit: cd\n\t-1.5\t0\n-1\t1.5\t2\n0\t4\t5.25\n"), expected);
    EXPECT_EQ(table("# unit: cd\r\nV\\H  -1.5 0\r\n-1 1.5   2\r\n\r\n0 4 5.25\r\n"), expected);
    EXPECT_EQ(table("\xef\xbb\xbf# unit: cd\n,-1.5,0,\n-1,1.5,2,\n0,\"4\",5.25,\n"), expected);
}

TEST_F(BeamMatrix, RowsFromTheTopDownAreSorted) {
    const LampFile lamp = read("d.csv", "# unit: cd\nV\\H,-1,0\n1,7,8\n0,4,5\n-1,1,2\n");
    EXPECT_EQ(lamp.table, table("# unit: cd\nV\\H,-1,0\n-1,1,2\n0,4,5\n1,7,8\n"));
    EXPECT_THAT(all_notes(lamp), HasSubstr("vertical angles do not ascend"));
}

TEST_F(BeamMatrix, ZeroPaddingIsAGapUnlessTheFileSaysWhatIs) {
    const std::string padded = "V\\H,-1,0,1\n-90,0,0,0\n-2,5,5,5\n0,5,5,5\n2,5,5,5\n";
    EXPECT_EQ(intensity_cd(table("# unit: cd\n" + padded), 0.0, -2.1), 0.0);
    EXPECT_GT(intensity_cd(table("# unit: cd\n# gaps_deg: none\n" + padded), 0.0, -2.1), 4.9);
    EXPECT_EQ(intensity_cd(table("# unit: cd\n# gaps_deg: 0 1 0 2; -1 0 -2 0\n" + padded), 0.5, 1.0), 0.0);
    EXPECT_THAT(refusal("g.csv", "# unit: cd\n# gaps_deg: some\n" + padded), HasSubstr("g.csv:2: gaps_deg: found 'some'"));
}

TEST_F(BeamMatrix, ManyRectanglesOfGapsTakeNoMoreThanTheirText) {
    std::string text = "# unit: cd\n# gaps_deg: -1 1 -2 2";
    for (int i = 0; i < 200'000; ++i)
        text += ";-300 300 -300 300";
    text += "\nV\\H";
    for (int h = 0; h < 1500; ++h)
        text += fmt::format(",{}", h * 0.01);
    for (int v = 0; v < 1000; ++v) {
        text += fmt::format("\n{}", v * 0.01);
        for (int h = 0; h < 1500; ++h)
            text += ",1";
    }
    EXPECT_EQ(flux_lm(table(text)), 0.0); // 3e11 steps if each rectangle visited its cells
}

TEST_F(BeamMatrix, MessagesNameLineAndCell) {
    const auto complaint = [&](const std::string& text) { return refusal("x.csv", text); };
    EXPECT_THAT(complaint(""), HasSubstr("x.csv: is empty"));
    EXPECT_THAT(complaint(body), HasSubstr("x.csv:4: unit: is not given, expected a line '# unit: lx' or '# unit: cd'"));
    EXPECT_THAT(complaint(std::string("# unit: fc\n") + body), HasSubstr("x.csv:1: unit: found 'fc', expected cd or lx"));
    EXPECT_THAT(complaint(std::string("# unit: lx\n# distance: 25\n") + body),
                HasSubstr("x.csv:2: distance: is no key of a beam matrix, expected distance_m"));
    EXPECT_THAT(complaint(std::string("# unit: lx\n# distance_m: -25\n") + body), HasSubstr("x.csv:2: distance_m: found -25"));
    EXPECT_THAT(complaint(std::string("# unit: lx\n# distance_m: inf\n") + body), HasSubstr("found 'inf'"));
    EXPECT_THAT(complaint(std::string("# unit: lx\n# angles: polar\n") + body), HasSubstr("found 'polar', expected goniometer or screen"));
    EXPECT_THAT(complaint(std::string("# unit: lx\n# screen: curved\n") + body), HasSubstr("expected spherical or planar"));
    EXPECT_THAT(complaint("# unit: cd\n"), HasSubstr("the file ends before the matrix"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n"), HasSubstr("the file ends before the matrix"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n0,1\n"), HasSubstr("x.csv:3: found 2 cells, expected 3"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n0,1,2\n1,3,nan\n"), HasSubstr("x.csv:4: column 3: found 'nan'"));
    for (const char* bad : {"inf", "-inf", "1e999", "1e13"})
        EXPECT_THAT(complaint(fmt::format("# unit: cd\nV\\H,0,1\n0,1,2\n1,3,{}\n", bad)), HasSubstr("x.csv")) << bad;
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n0,1,2\n1,3,\n"), HasSubstr("x.csv:4: found 2 cells"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,one\n0,1,2\n1,3,4\n"), HasSubstr("x.csv:2: horizontal angle: found 'one'"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n0,1,2\n95,3,4\n"), HasSubstr("x.csv:3: vertical angles: found 95"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0\n0,1\n1,3\n"), HasSubstr("horizontal angles: found 1 of them, expected at least 2"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n0,1,2\n"), HasSubstr("vertical angles: found 1 of them"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n0,1,-2\n1,3,4\n"), HasSubstr("x.csv:3: intensity at horizontal 1, vertical 0: is -2 cd"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n1,1,2\n\n0,3,-4\n"),
                HasSubstr("x.csv:5: intensity at horizontal 1, vertical 0: is -4 cd"));
    EXPECT_THAT(complaint("# unit: lx\n# distance_m: 25,5\n"),
                HasSubstr("x.csv:2: distance_m: has decimal commas, expected points: write 25.5 for 25,5"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H -1,5 0 1,5\n0 1 2 3\n1 2 3 4\n"),
                HasSubstr("x.csv:2:5: has decimal commas, expected points: write -1.5 for"));
    EXPECT_THAT(complaint("# unit: cd\nV\\H,0,1\n0,1,5,2,5\n1,3,4\n"),
                HasSubstr("x.csv:3: found 5 cells, expected 3: a vertical angle and one per "
                          "horizontal angle; where numbers have decimal commas, semicolons separate"));
    EXPECT_THAT(complaint("# unit: lx\n# screen: planar\nV\\H,0,90\n0,1,2\n1,3,4\n"),
                HasSubstr("found 90, expected angles from -89 to 89"));
}

TEST_F(BeamMatrix, NothingMakesItFallOver) {
    must_survive_random_bytes("r.csv", "", 21);
    must_survive_random_bytes("r.csv", "# unit: lx\n", 22);
    must_survive_random_bytes("r.csv", "# unit: lx\nV\\H,0,1,2\n", 23);
    must_survive_changed_bytes("r.csv", std::string("# unit: lx\n# screen: planar\n# distance_m: 25\n") + body, 24);
    const std::string good = std::string("# unit: cd\n") + body;
    for (std::size_t n = 0; n < good.size(); ++n)
        must_not_fall_over("p.csv", good.substr(0, n));
}

TEST_F(BeamMatrix, RoundTripsLoseNothing) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        LampFile lamp;
        lamp.name = "round, trip; \"quoted\"";
        lamp.table = random_lamp_table(seed);
        lamp.labels = {{"MANUFAC", "Büch\ner: sons"}, {"unit", "furlong"}};
        if (seed % 2 == 0)
            lamp.declared_flux_lm = 1234.5678901234567;
        const auto path = folder_ / "trip.csv";
        write_lamp(lamp, path);
        const LampFile back = read_lamp(path);
        EXPECT_EQ(back.table, lamp.table) << seed;
        EXPECT_EQ(back.declared_flux_lm, lamp.declared_flux_lm);
        EXPECT_EQ(back.name, lamp.name);
        EXPECT_EQ(back.labels, (decltype(back.labels){{"MANUFAC", "Büch er: sons"}, {"unit", "furlong"}}));
        EXPECT_THAT(back.notes, testing::IsEmpty());
    }
}

TEST_F(BeamMatrix, OtherNamesCannotBeWritten) {
    LampFile lamp;
    lamp.table = random_lamp_table(1);
    EXPECT_THROW(write_lamp(lamp, folder_ / "lamp.txt"), InputError);
    lamp.table.cd[0] = -1.0;
    EXPECT_THROW(write_lamp(lamp, folder_ / "lamp.csv"), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
