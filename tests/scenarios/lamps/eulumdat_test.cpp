// EULUMDAT: symmetries, lamp sets, absolute values, and broken files.
#include "tests/lamps.h"
#include "tests/scenarios/lamps/lamp_trial.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tuple>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using tests::steps;

/// The parts of a file that the tests change.
struct Ldt {
    int symmetry = 1;
    std::vector<double> c{0}, gamma{0, 90, 180};
    std::vector<double> intensities{100, 100, 100}; ///< cd/klm, plane by plane
    std::string output = "100", conversion = "1", sets = "1\n1\nLED\n1000\n4000\n80\n15";

    std::string text() const {
        std::string out = fmt::format("ACME\n2\n{}\n{}\n0\n{}\n0\nreport\nWidget\n4711\nw.ldt\n2024\n", symmetry, c.size(), gamma.size());
        out += "100\n100\n50\n100\n100\n0\n0\n0\n0\n90\n" + output + "\n" + conversion + "\n0\n" + sets + "\n";
        for (int i = 0; i < 10; ++i)
            out += "0\n";
        for (const auto* list : {&c, &gamma, &intensities})
            for (const double value : *list)
                out += fmt::format("{}\n", value);
        return out;
    }
};

class Eulumdat : public LampTrial {
  protected:
    static LampReadOptions horizontal() { return {.type_c_axis = TypeCAxis::horizontal}; }
    LampFile lamp(const Ldt& ldt) const { return read("w.ldt", ldt.text(), horizontal()); }
};

TEST_F(Eulumdat, ListsCandelaPerThousandLumen) {
    Ldt ldt{.output = "80", .sets = "1\n1\nLED\n2500\n4000 K\nRa > 80\n29.50"};
    const LampFile l = lamp(ldt);
    EXPECT_EQ(std::tuple(l.format, l.name), std::tuple("EULUMDAT, Isym 1", "Widget"));
    EXPECT_NEAR(flux_lm(l.table), 4 * pi * 250, 1e-9);
    EXPECT_DOUBLE_EQ(l.declared_flux_lm.value(), 2000.0);
    EXPECT_EQ(l.labels[0], (std::pair<std::string, std::string>{"company", "ACME"}));
    EXPECT_EQ(read("w.dat", ldt.text(), horizontal()).table, l.table) << "told by content";
}

TEST_F(Eulumdat, TheConversionFactorMultiplies) {
    Ldt ldt{.conversion = "1.5"};
    EXPECT_NEAR(peak_of(lamp(ldt).table).cd, 150.0, 1e-12);
    ldt.conversion = "0";
    EXPECT_NEAR(peak_of(lamp(ldt).table).cd, 100.0, 1e-12);
}

TEST_F(Eulumdat, AbsoluteFilesHaveANegativeNumberOfLamps) {
    Ldt ldt{.sets = "1\n-1\nLED\n500\n4000\n80\n15"};
    const LampFile l = lamp(ldt);
    EXPECT_NEAR(peak_of(l.table).cd, 50.0, 1e-12);
    EXPECT_THAT(all_notes(l), HasSubstr("absolute photometry"));
}

TEST_F(Eulumdat, SeveralLampSetsAreAlternatives) {
    Ldt ldt{.sets = "2\n1\nsmall\n500\n3000\n80\n10\n2\nlarge\n1200\n3000\n80\n30"};
    EXPECT_NEAR(peak_of(lamp(ldt).table).cd, 50.0, 1e-12);
    EXPECT_THAT(all_notes(lamp(ldt)), HasSubstr("the first, 'small' with 500 lm"));
    ldt.sets = "2\n1\n2\nsmall\nlarge\n500\n1200\nwarm\ncold\n80\n80\n10\n30";
    EXPECT_NEAR(peak_of(lamp(ldt).table).cd, 50.0, 1e-12);
    EXPECT_THAT(all_notes(lamp(ldt)), HasSubstr("field by field"));
    EXPECT_THAT(all_notes(lamp(ldt)), HasSubstr("'small' with 500 lm"));
}

/// No symmetry: cd over the turn.
double lopsided(double c, double gamma) {
    return 100.0 +
           std::sin(radians(gamma)) * (30.0 * std::cos(radians(c)) + 12.0 * std::sin(radians(c)) + 7.0 * std::sin(2.0 * radians(c)));
}

template <class Form> Ldt planes(int symmetry, const std::vector<double>& stored_c, Form form) {
    Ldt ldt{.symmetry = symmetry};
    ldt.c.clear();
    for (int c = 0; c < 360; c += 15)
        ldt.c.push_back(c);
    ldt.gamma = {0, 30, 60, 90, 120, 150, 180};
    ldt.intensities.clear();
    for (const double c : stored_c)
        for (const double g : ldt.gamma)
            ldt.intensities.push_back(form(c, g));
    return ldt;
}

TEST_F(Eulumdat, EachSymmetryFillsTheTurn) {
    const auto expect_form = [&](const Ldt& ldt, auto form) {
        const LampFile l = lamp(ldt);
        ASSERT_THAT(all_notes(l), HasSubstr("Plane C 0 is taken"));
        for (double c = 0; c < 360; c += 15)
            for (const double g : ldt.gamma)
                EXPECT_NEAR(intensity_cd(l.table, -c, g - 90.0), form(c, g), 1e-9)
                    << "Isym " << ldt.symmetry << ", C " << c << ", gamma " << g;
    };
    expect_form(planes(0, steps(0, 345, 15), lopsided), lopsided);
    const auto about_0 = [](double c, double g) {
        return 100.0 + std::sin(radians(g)) * (30.0 * std::cos(radians(c)) + 8.0 * std::cos(2.0 * radians(c)));
    };
    expect_form(planes(2, steps(0, 180, 15), about_0), about_0);
    const auto quarters = [](double c, double g) { return 100.0 + 30.0 * std::sin(radians(g)) * std::cos(2.0 * radians(c)); };
    expect_form(planes(4, steps(0, 90, 15), quarters), quarters);
}

TEST_F(Eulumdat, SymmetryThreeIsStoredFromC270ThroughC0ToC90) {
    const auto about_90 = [](double c, double g) {
        return 100.0 + std::sin(radians(g)) * (40.0 * std::sin(radians(c)) + 8.0 * std::cos(2.0 * radians(c)));
    };
    const LampFile l = lamp(planes(3, steps(-90, 90, 15), about_90));
    ASSERT_THAT(all_notes(l), HasSubstr("Plane C 90 is taken as forward"));
    for (double c = 0; c < 360; c += 15)
        for (double g = 0; g <= 180; g += 30)
            EXPECT_NEAR(intensity_cd(l.table, 90.0 - c, g - 90.0), about_90(c, g), 1e-9) << "C " << c << ", gamma " << g;
}

TEST_F(Eulumdat, DecimalCommasByteOrderMarksAndOldEncodingsAreRead) {
    Ldt ldt{.intensities = {100.5, 100.25, 100.125}};
    const LampFile plain = lamp(ldt);
    std::string commas = ldt.text();
    for (std::size_t at = commas.find("\n0\n90\n180\n"); at < commas.size(); ++at)
        if (commas[at] == '.')
            commas[at] = ',';
    EXPECT_EQ(read("c.ldt", commas, horizontal()).table, plain.table);
    EXPECT_EQ(read("b.ldt", "\xef\xbb\xbf" + ldt.text(), horizontal()).table, plain.table);
    EXPECT_EQ(read("e.ldt", ldt.text() + "\n\n\r\n", horizontal()).table, plain.table);
    std::string old = ldt.text();
    old.replace(old.find("Widget"), 6, "Stra\337e \204 60"); // of Windows-1252
    EXPECT_EQ(read("o.ldt", old, horizontal()).name, "Straße „ 60");
}

TEST_F(Eulumdat, ASinglePlaneIsRotationalWhateverTheSymmetrySays) {
    Ldt ldt{.symmetry = 0};
    EXPECT_NEAR(flux_lm(lamp(ldt).table), 4 * pi * 100, 1e-9);
}

TEST_F(Eulumdat, MessagesNameTheLine) {
    const auto complaint = [&](auto change) {
        Ldt ldt;
        change(ldt);
        return refusal("x.ldt", ldt.text());
    };
    const auto line = [&](std::size_t number, const std::string& content) {
        std::string text = Ldt{}.text(), out;
        std::size_t n = 1;
        for (std::size_t at = 0; at < text.size(); ++n) {
            const std::size_t end = text.find('\n', at);
            out += (n == number ? content : text.substr(at, end - at)) + "\n";
            at = end + 1;
        }
        return refusal("x.ldt", out);
    };
    EXPECT_THAT(refusal("x.ldt", ""), HasSubstr("x.ldt: is empty"));
    EXPECT_THAT(line(2, "LED"), HasSubstr("x.ldt:2: type (Ityp): found 'LED'"));
    EXPECT_THAT(line(3, "7"), HasSubstr("x.ldt:3: symmetry (Isym): found 7, expected a whole number from 0 to 4"));
    EXPECT_THAT(line(4, "1000000000"), HasSubstr("x.ldt:4: number of C planes (Mc): found 1000000000"));
    EXPECT_THAT(line(4, "-1"), HasSubstr("found -1"));
    EXPECT_THAT(line(6, "1e9"), HasSubstr("x.ldt:6: number of gamma angles (Ng)"));
    EXPECT_THAT(line(6, "4000000"), HasSubstr("the file ends before it"));
    EXPECT_THAT(line(26, "1000000000"), HasSubstr("x.ldt:26: number of lamp sets: found 1000000000, expected a whole number from 1 to 20"));
    EXPECT_THAT(line(26, "-1"), HasSubstr("x.ldt:26"));
    EXPECT_THAT(line(29, "bright"), HasSubstr("x.ldt:27: lamp sets: found '1' lamps of 'bright' lm"));
    EXPECT_THAT(line(29, "nan"), HasSubstr("found a lamp flux of nan lm"));
    EXPECT_THAT(line(29, "0"), HasSubstr("expected a flux above 0"));
    EXPECT_THAT(line(44, "91 deg"), HasSubstr("x.ldt:44: gamma angle: found '91 deg'"));
    EXPECT_THAT(line(45, "181"), HasSubstr("x.ldt:45: gamma angle: found 181, expected an angle from 0 to 180"));
    EXPECT_THAT(line(47, "nan"), HasSubstr("x.ldt:47: intensity: found 'nan', expected a finite number"));
    EXPECT_THAT(line(47, "-inf"), HasSubstr("x.ldt:47: intensity: found '-inf'"));
    EXPECT_THAT(line(47, "-50"), HasSubstr("x.ldt:47: intensity at horizontal 0, vertical 0: is -50 cd"));
    EXPECT_THAT(complaint([](Ldt& l) {
                    l.symmetry = 4, l.c = {0, 90};
                }),
                HasSubstr("Mc): found 2, expected a multiple of 4 for symmetry 4"));
    EXPECT_THAT(complaint([](Ldt& l) { l.intensities.pop_back(); }), HasSubstr("x.ldt:48: intensity: the file ends before it"));
    EXPECT_THAT(complaint([](Ldt& l) { l.gamma = {0, 90, 90}, l.intensities = {1, 2, 3}; }), HasSubstr("the angle 90 is given twice"));
    EXPECT_THAT(complaint([](Ldt& l) {
                    l.gamma = {90, 90, 90}, l.intensities = {1, 1, 1};
                }),
                HasSubstr("gamma angles: found 1 of them, expected at least 2"));
}

TEST_F(Eulumdat, NoPrefixOfAGoodFileIsReadAndNothingMakesItFallOver) {
    const std::string good = Ldt{}.text();
    const std::size_t last_number = good.rfind('\n', good.size() - 2) + 1;
    for (std::size_t n = 0; n <= last_number; ++n)
        EXPECT_THAT(refusal("p.ldt", good.substr(0, n)), HasSubstr("p.ldt")) << n;
    EXPECT_EQ(refusal("p.ldt", good), "");
    must_survive_random_bytes("r.ldt", "", 11);
    must_survive_random_bytes("r.ldt", "ACME\n2\n0\n2\n0\n3\n0\n", 12);
    must_survive_changed_bytes("r.ldt", planes(4, steps(0, 90, 15), [](double, double g) { return g; }).text(), 13);
}

// Type C: symmetries, open and closed turns, and where the beam points.

class CPlanes : public LampTrial {
  protected:
    /// A file of type C with I = form(C, gamma).
    template <class Form>
    LampFile lamp(const std::vector<double>& c, const std::vector<double>& gamma, Form form, TypeCAxis axis = TypeCAxis::horizontal) const {
        std::string text = fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} {} 1 2 0 0 0\n1 1 0\n{}\n{}\n", gamma.size(), c.size(),
                                       fmt::join(gamma, " "), fmt::join(c, " "));
        for (const double ci : c)
            for (const double g : gamma)
                text += fmt::format("{}\n", form(ci, g));
        return read("c.ies", text, LampReadOptions{.type_c_axis = axis});
    }
};

/// Not symmetric in any way: a lobe about C 30, gamma 80.
double lobe(double c, double gamma) {
    const double a = radians(c - 30.0), g = radians(gamma), g0 = radians(80.0);
    const double cosine = std::sin(g) * std::sin(g0) * std::cos(a) + std::cos(g) * std::cos(g0);
    return 100.0 + 900.0 * std::exp(8.0 * (cosine - 1.0));
}

TEST_F(CPlanes, RotationalSymmetryNeedsTwoColumns) {
    const LampFile l = lamp({0}, steps(0, 180, 5), [](double, double) { return 75.0; });
    EXPECT_EQ(l.table.h_deg, (std::vector<double>{-180, 180}));
    EXPECT_NEAR(flux_lm(l.table), 4 * pi * 75, 1e-9);
    // A single plane that is listed as both 0 and 360.
    const LampFile both = lamp({0, 360}, steps(0, 180, 5), [](double, double g) { return 10.0 + g; });
    EXPECT_EQ(both.table.h_deg, (std::vector<double>{-180, 180}));
}

TEST_F(CPlanes, AllPlanesAreUsedAndCRunsAgainstTheClockSeenFromAbove) {
    const LampFile l = lamp(steps(0, 360, 10), steps(0, 180, 5), lobe);
    EXPECT_THAT(all_notes(l), HasSubstr("Plane C 0 is taken as forward"));
    // Seen from above with forward up the page, C 30 lies 30 degrees to the left.
    EXPECT_NEAR(intensity_cd(l.table, -30.0, -10.0), lobe(30, 80), 1e-9);
    EXPECT_NEAR(intensity_cd(l.table, 30.0, -10.0), lobe(330, 80), 1e-9);
    EXPECT_NEAR(intensity_cd(l.table, 180.0, 0.0), lobe(180, 90), 1e-9);
    EXPECT_NEAR(intensity_cd(l.table, -180.0, 0.0), lobe(180, 90), 1e-9);
}

TEST_F(CPlanes, ForwardIsTheQuarterNearestToTheLight) {
    const LampFile l = lamp(steps(0, 355, 5), steps(0, 180, 5), [](double c, double g) { return lobe(c - 70.0, g); });
    EXPECT_THAT(all_notes(l), HasSubstr("Plane C 90 is taken as forward")); // the lobe lies at C 100
    EXPECT_NEAR(intensity_cd(l.table, -10.0, -10.0), lobe(30, 80), 1e-9);
    const LampFile back = lamp(steps(0, 355, 5), steps(0, 180, 5), [](double c, double g) { return lobe(c + 100.0, g); });
    EXPECT_THAT(all_notes(back), HasSubstr("Plane C 270 is taken as forward")); // at C 290
    EXPECT_NEAR(intensity_cd(back.table, -20.0, -10.0), lobe(30, 80), 1e-9);
}

TEST_F(CPlanes, SymmetriesFillTheTurn) {
    const auto even = [](double c, double g) { return 50.0 + 20.0 * std::cos(2.0 * radians(c)) * std::sin(radians(g)); };
    const auto about_0 = [](double c, double g) { return 50.0 + 20.0 * std::cos(radians(c)) * std::sin(radians(g)); };
    const auto about_90 = [](double c, double g) { return 50.0 + 20.0 * std::sin(radians(c)) * std::sin(radians(g)); };
    const auto same = [&](const LampFile& folded, const LampFile& full) {
        for (double h = -180.0; h <= 180.0; h += 15.0)
            for (double v = -90.0; v <= 90.0; v += 15.0)
                EXPECT_NEAR(intensity_cd(folded.table, h, v), intensity_cd(full.table, h, v), 1e-9) << h << ", " << v;
        EXPECT_NEAR(flux_lm(folded.table), flux_lm(full.table), 1e-9);
    };
    const auto gamma = steps(0, 180, 15);
    same(lamp(steps(0, 90, 15), gamma, even), lamp(steps(0, 360, 15), gamma, even));
    same(lamp(steps(0, 180, 15), gamma, about_0), lamp(steps(0, 360, 15), gamma, about_0));
    same(lamp(steps(90, 270, 15), gamma, about_90), lamp(steps(0, 360, 15), gamma, about_90));
    same(lamp(steps(0, 345, 15), gamma, lobe), lamp(steps(0, 360, 15), gamma, lobe));
    same(lamp(steps(-180, 180, 15), gamma, lobe), lamp(steps(0, 360, 15), gamma, lobe));
}

TEST_F(CPlanes, TheTurnClosesAcrossAMissing360AndAWideHoleHasNoData) {
    const auto gamma = steps(0, 180, 10);
    for (const double last : {350.0, 355.0}) {
        const LampFile l = lamp(steps(0, last, last == 350.0 ? 10.0 : 5.0), gamma, [](double, double) { return 30.0; });
        EXPECT_NEAR(flux_lm(l.table), 4 * pi * 30, 1e-9) << last;
    }
    const LampFile l = lamp(steps(0, 270, 10), steps(0, 180, 10), [](double, double) { return 30.0; });
    EXPECT_THAT(all_notes(l), HasSubstr("leave 90 degrees of the turn open"));
    EXPECT_NEAR(flux_lm(l.table), 0.75 * 4 * pi * 30, 1e-9);
}

TEST_F(CPlanes, TwoAnswersForOneDirectionAreNoted) {
    const LampFile l = lamp({0, 90, 180, 270, 360}, {0, 90, 180}, [](double c, double) { return c == 360 ? 7.0 : 5.0; });
    EXPECT_THAT(all_notes(l), HasSubstr("differ by up to 2 cd"));
    EXPECT_NEAR(flux_lm(l.table), 4 * pi * 5, 1e-9);
}

/// A beam along gamma 0, leaning to C 90 and less so to C 0.
double downlight(double c, double gamma) {
    const double g = radians(gamma), x = std::sin(g) * std::cos(radians(c)), y = std::sin(g) * std::sin(radians(c));
    return gamma > 90.0 ? 0.0 : 1300.0 * std::pow(std::cos(g), 4.0) * std::exp(0.3 * x + 0.9 * y);
}

TEST_F(CPlanes, ABeamAlongTheNadirIsTurnedForward) {
    const LampFile l = lamp(steps(0, 330, 30), steps(0, 90, 5), downlight, TypeCAxis::automatic);
    EXPECT_THAT(all_notes(l), HasSubstr("gamma 0 is taken as forward"));
    const Peak peak = peak_of(l.table);
    EXPECT_NEAR(peak.h_deg, 0.0, 8.0);
    EXPECT_GT(peak.v_deg, 4.0) << "C 90 is up";
    const auto plane = [](double g) { return downlight(90, g); };
    EXPECT_NEAR(intensity_cd(l.table, 0.0, 30.0), plane(30), 1.5);
    EXPECT_NEAR(intensity_cd(l.table, 0.0, -30.0), downlight(270, 30), 1.5);
    EXPECT_NEAR(intensity_cd(l.table, 30.0, 0.0), downlight(0, 30), 1.5) << "C 0 is right";
    EXPECT_NEAR(intensity_cd(l.table, -30.0, 0.0), downlight(180, 30), 1.5);
    EXPECT_EQ(intensity_cd(l.table, 120.0, 0.0), 0.0) << "behind";
}

/// The whole, a cone, and half of one, that end in light.
TEST_F(CPlanes, TurningKeepsTheFluxAndTheOptionOutvotesTheLight) {
    const auto kept = [&](const std::vector<double>& c, const std::vector<double>& gamma) { // of what is not resampled
        return flux_lm(lamp(c, gamma, downlight, TypeCAxis::nadir).table) / flux_lm(lamp(c, gamma, downlight).table);
    };
    EXPECT_NEAR(kept(steps(0, 330, 30), steps(0, 90, 5)), 1.0, 1e-3);
    for (const double turn : {360.0, 187.5})
        for (const double step : {2.5, 7.5})
            EXPECT_NEAR(kept(steps(0, turn, 7.5), steps(0, 37.5, step)), 1.0, 2e-4) << turn << " " << step;
    const LampFile l = lamp(steps(0, 330, 30), steps(0, 90, 5), downlight);
    EXPECT_LT(peak_of(l.table).v_deg, -60.0);
}

TEST_F(CPlanes, ADarkLampIsDarkWhereverItPoints) {
    const auto dark = [](double, double) { return 0.0; };
    EXPECT_EQ(flux_lm(lamp(steps(0, 330, 30), steps(0, 90, 5), dark, TypeCAxis::automatic).table), 0.0);
    EXPECT_EQ(flux_lm(lamp({0}, {0, 90}, dark, TypeCAxis::nadir).table), 0.0);
}

TEST_F(CPlanes, TwoPolesAreALampAndOnePlaceIsNone) {
    const auto form = [](double, double g) { return 100.0 - g / 2.0; };
    const LampFile l = lamp({0}, {0, 180}, form, TypeCAxis::nadir);
    for (const double g : {0.0, 30.0, 90.0})
        EXPECT_NEAR(intensity_cd(l.table, 0.0, g), form(0, g), 0.1) << g;
    EXPECT_NEAR(intensity_cd(l.table, 180.0, 0.0), 10.0, 1e-9);
    EXPECT_THAT(refusal("c.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 1e-9\n0\n10 10\n"), HasSubstr("c.ies"));
}

} // namespace
} // namespace fernlicht
