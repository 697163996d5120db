// Type C: symmetries, open and closed turns, and where the beam points.
#include "tests/scenarios/lamps/lamp_trial.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class CPlanes : public LampTrial {
  protected:
    /// A file of type C with I = form(C, gamma).
    template <class Form>
    LampFile lamp(const std::vector<double>& c, const std::vector<double>& gamma, Form form, TypeCAxis axis = TypeCAxis::automatic) const {
        std::string text = fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} {} 1 2 0 0 0\n1 1 0\n{}\n{}\n", gamma.size(), c.size(),
                                       fmt::join(gamma, " "), fmt::join(c, " "));
        for (const double ci : c)
            for (const double g : gamma)
                text += fmt::format("{}\n", form(ci, g));
        LampReadOptions options;
        options.type_c_axis = axis;
        return read("c.ies", text, options);
    }
    static std::vector<double> steps(double from, double to, double by) {
        std::vector<double> out;
        for (int i = 0; from + i * by <= to + 1e-9; ++i)
            out.push_back(from + i * by);
        return out;
    }
};

/// Not symmetric in any way: a lobe about C 30, gamma 80.
double lobe(double c, double gamma) {
    const double a = radians(c - 30.0), g = radians(gamma), g0 = radians(80.0);
    const double cosine = std::sin(g) * std::sin(g0) * std::cos(a) + std::cos(g) * std::cos(g0);
    return 100.0 + 900.0 * std::exp(8.0 * (cosine - 1.0));
}

TEST_F(CPlanes, RotationalSymmetryNeedsTwoColumns) {
    const LampFile l = lamp(
        {0}, steps(0, 180, 5), [](double, double) { return 75.0; }, TypeCAxis::horizontal);
    EXPECT_EQ(l.table.h_deg, (std::vector<double>{-180, 180}));
    EXPECT_NEAR(flux_lm(l.table), 4 * pi * 75, 1e-9);
    // A single plane that is listed as both 0 and 360.
    const LampFile both = lamp(
        {0, 360}, steps(0, 180, 5), [](double, double g) { return 10.0 + g; }, TypeCAxis::horizontal);
    EXPECT_EQ(both.table.h_deg, (std::vector<double>{-180, 180}));
}

TEST_F(CPlanes, AllPlanesAreUsedAndCRunsAgainstTheClockSeenFromAbove) {
    const LampFile l = lamp(steps(0, 360, 10), steps(0, 180, 5), lobe, TypeCAxis::horizontal);
    EXPECT_THAT(all_notes(l), HasSubstr("Plane C 0 is taken as forward"));
    // Seen from above with forward up the page, C 30 lies 30 degrees to the left.
    EXPECT_NEAR(intensity_cd(l.table, -30.0, -10.0), lobe(30, 80), 1e-9);
    EXPECT_NEAR(intensity_cd(l.table, 30.0, -10.0), lobe(330, 80), 1e-9);
    EXPECT_NEAR(intensity_cd(l.table, 180.0, 0.0), lobe(180, 90), 1e-9);
    EXPECT_NEAR(intensity_cd(l.table, -180.0, 0.0), lobe(180, 90), 1e-9);
}

TEST_F(CPlanes, ForwardIsTheQuarterNearestToTheLight) {
    const LampFile l = lamp(
        steps(0, 355, 5), steps(0, 180, 5), [](double c, double g) { return lobe(c - 70.0, g); }, TypeCAxis::horizontal);
    EXPECT_THAT(all_notes(l), HasSubstr("Plane C 90 is taken as forward")); // the lobe lies at C 100
    EXPECT_NEAR(intensity_cd(l.table, -10.0, -10.0), lobe(30, 80), 1e-9);
    const LampFile back = lamp(
        steps(0, 355, 5), steps(0, 180, 5), [](double c, double g) { return lobe(c + 100.0, g); }, TypeCAxis::horizontal);
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
    const TypeCAxis axis = TypeCAxis::horizontal;
    same(lamp(steps(0, 90, 15), gamma, even, axis), lamp(steps(0, 360, 15), gamma, even, axis));
    same(lamp(steps(0, 180, 15), gamma, about_0, axis), lamp(steps(0, 360, 15), gamma, about_0, axis));
    same(lamp(steps(90, 270, 15), gamma, about_90, axis), lamp(steps(0, 360, 15), gamma, about_90, axis));
    same(lamp(steps(0, 345, 15), gamma, lobe, axis), lamp(steps(0, 360, 15), gamma, lobe, axis));
    same(lamp(steps(-180, 180, 15), gamma, lobe, axis), lamp(steps(0, 360, 15), gamma, lobe, axis));
}

TEST_F(CPlanes, TheTurnClosesAcrossAMissing360) {
    const auto gamma = steps(0, 180, 10);
    for (const double last : {350.0, 355.0}) {
        const LampFile l = lamp(
            steps(0, last, last == 350.0 ? 10.0 : 5.0), gamma, [](double, double) { return 30.0; }, TypeCAxis::horizontal);
        EXPECT_NEAR(flux_lm(l.table), 4 * pi * 30, 1e-9) << last;
    }
}

TEST_F(CPlanes, AWideHoleHasNoData) {
    const LampFile l = lamp(
        steps(0, 270, 10), steps(0, 180, 10), [](double, double) { return 30.0; }, TypeCAxis::horizontal);
    EXPECT_THAT(all_notes(l), HasSubstr("leave 90 degrees of the turn open"));
    EXPECT_NEAR(flux_lm(l.table), 0.75 * 4 * pi * 30, 1e-9);
}

TEST_F(CPlanes, TwoAnswersForOneDirectionAreNoted) {
    const LampFile l = lamp(
        {0, 90, 180, 270, 360}, {0, 90, 180}, [](double c, double) { return c == 360 ? 7.0 : 5.0; }, TypeCAxis::horizontal);
    EXPECT_THAT(all_notes(l), HasSubstr("differ by up to 2 cd"));
    EXPECT_NEAR(flux_lm(l.table), 4 * pi * 5, 1e-9);
}

/// A beam along gamma 0, leaning to C 90 and less so to C 0.
double downlight(double c, double gamma) {
    const double g = radians(gamma), x = std::sin(g) * std::cos(radians(c)), y = std::sin(g) * std::sin(radians(c));
    return gamma > 90.0 ? 0.0 : 1300.0 * std::pow(std::cos(g), 4.0) * std::exp(0.3 * x + 0.9 * y);
}

TEST_F(CPlanes, ABeamAlongTheNadirIsTurnedForward) {
    const LampFile l = lamp(steps(0, 330, 30), steps(0, 90, 5), downlight);
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

TEST_F(CPlanes, TurningKeepsTheFlux) {
    const auto c = steps(0, 330, 30), gamma = steps(0, 90, 5);
    const double there = flux_lm(lamp(c, gamma, downlight, TypeCAxis::horizontal).table); // not resampled
    EXPECT_NEAR(flux_lm(lamp(c, gamma, downlight, TypeCAxis::nadir).table) / there, 1.0, 1e-3);
}

/// A cone, and half of one, that ends in light.
TEST_F(CPlanes, ATurnedConeThatEndsInLightKeepsItsFlux) {
    for (const double turn : {360.0, 187.5})
        for (const double step : {2.5, 7.5}) {
            const auto c = steps(0, turn, 7.5), gamma = steps(0, 37.5, step);
            const double there = flux_lm(lamp(c, gamma, downlight, TypeCAxis::horizontal).table); // not resampled
            EXPECT_NEAR(flux_lm(lamp(c, gamma, downlight, TypeCAxis::nadir).table) / there, 1.0, 2e-4) << turn << " " << step;
        }
}

TEST_F(CPlanes, TheOptionOutvotesTheLight) {
    const LampFile l = lamp(steps(0, 330, 30), steps(0, 90, 5), downlight, TypeCAxis::horizontal);
    EXPECT_LT(peak_of(l.table).v_deg, -60.0);
}

TEST_F(CPlanes, ADarkLampIsDarkWhereverItPoints) {
    const LampFile l = lamp(steps(0, 330, 30), steps(0, 90, 5), [](double, double) { return 0.0; });
    EXPECT_EQ(flux_lm(l.table), 0.0);
    EXPECT_EQ(flux_lm(lamp(
                          {0}, {0, 90}, [](double, double) { return 0.0; }, TypeCAxis::nadir)
                          .table),
              0.0);
}

} // namespace
} // namespace fernlicht
