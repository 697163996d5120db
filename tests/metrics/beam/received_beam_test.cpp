// The receiver's mean and the extremes against closed forms.
#include "metrics/regulation/row_check.h"
#include "tests/lamps.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using tests::steps, tests::table_of;

const Receiver square{Receiver::Shape::square, 0.15}, disc{Receiver::Shape::disc, 0.5};

TEST(ReceivedCd, IsTheClosedFormOfKnownLights) {
    const CandelaTable constant = table_of({-5, 0, 5}, {-5, 0.3, 5}, [](double, double) { return 1234.0; });
    const CandelaTable ramp = table_of(steps(-5, 5, 0.7), steps(-5, 5, 0.3), [](double h, double v) { return 5000 + 300 * h - 70 * v; });
    for (const Receiver& receiver : {square, disc, Receiver{}})
        for (const Direction d : {Direction{0, 0}, {1.234, -0.57}, {-3.43, 0.57}}) {
            EXPECT_NEAR(*received_cd(constant, receiver, d), 1234.0, 1e-9);
            EXPECT_NEAR(*received_cd(ramp, receiver, d), 5000 + 300 * d.h_deg - 70 * d.v_deg, 1e-8);
        }
    // Of x^2, a square of side a adds a^2/12 to the centre and a disc of radius r adds r^2/4; a table of step s that runs straight adds
    // s^2/6 on average over whole steps. In H the receiver is wider by 1 / cos V: none at V = 0.
    const double step = 0.001;
    const CandelaTable h2 = table_of(steps(-1, 1, step), {-1, 0, 1}, [](double h, double) { return 1e6 * h * h; });
    const CandelaTable v2 = table_of({-1, 0, 1}, steps(-1, 1, step), [](double, double v) { return 1e6 * v * v; });
    const double straight = 1e6 * step * step / 6.0;
    EXPECT_NEAR(*received_cd(h2, square, {0.2, 0}), 1e6 * (0.04 + 0.15 * 0.15 / 12.0) + straight, 1.0);
    EXPECT_NEAR(*received_cd(v2, square, {0, -0.3}), 1e6 * (0.09 + 0.15 * 0.15 / 12.0) + straight, 1.0);
    EXPECT_NEAR(*received_cd(h2, disc, {0.2, 0}), 1e6 * (0.04 + 0.0625 / 4.0) + straight, 1.0);
    EXPECT_NEAR(*received_cd(v2, disc, {0, -0.3}), 1e6 * (0.09 + 0.0625 / 4.0) + straight, 1.0);
    // A step from 0 to 1000 cd through the middle of a cell border: half the light, whatever the receiver.
    CandelaTable t = table_of({-5, 5}, {-5, 0, 0.000001, 5}, [](double, double v) { return v > 0.0 ? 1000.0 : 0.0; });
    EXPECT_NEAR(*received_cd(t, square, {0, 0}), 500.0, 0.01);
    EXPECT_NEAR(*received_cd(t, disc, {0, 0}), 500.0, 0.01);
    EXPECT_NEAR(*received_cd(t, square, {0, 0.15 / 8.0}), 625.0, 0.01);
    // The part of a disc above a chord at -r/2: 1 - 1/3 + sqrt(3)/(4 pi) = 0.80450
    EXPECT_NEAR(*received_cd(t, disc, {0, 0.125}), 804.498890, 0.01);
}

TEST(ReceivedCd, OfLogarithmicLightIsTheIntegralOfTheExponential) {
    CandelaTable t = table_of({-5, 5}, {-5, 5}, [](double, double v) { return std::exp(2.0 * v); });
    t.rule = BetweenSamples::log_cd;
    const double a = 0.15; // mean of exp(2 v) over v +- a/2: exp(2 v) sinh(a) / a; ln I changes by 0.3, and 0.3^4 / 4320 = 1.9e-6
    EXPECT_NEAR(*received_cd(t, square, {0, 1}) / (std::exp(2.0) * std::sinh(a) / a), 1.0, 2e-6);
}

TEST(ReceivedCd, LeavesOutWhatHasNoData) {
    const CandelaTable t = table_of({-1, 0, 1}, {-1, 0, 1}, [](double, double) { return 700.0; });
    EXPECT_FALSE(received_cd(t, square, {1.01, 0}));
    EXPECT_NEAR(*received_cd(t, square, {1.0, 1.0}), 700.0, 1e-9); // three quarters of the receiver look past the table
    EXPECT_NEAR(*received_cd(t, disc, {1.0, -1.0}), 700.0, 1e-9);
}

TEST(ReceivedBeam, AimTurnsTheBeamAndTwoLampsGiveHalfTheirSum) {
    const CandelaTable a = table_of(steps(-5, 5, 1), steps(-5, 5, 1), [](double h, double) { return 1000 + 100 * h; });
    const CandelaTable b = table_of(steps(-5, 5, 1), steps(-5, 5, 1), [](double, double v) { return 3000 + 10 * v; });
    EXPECT_NEAR(*ReceivedBeam({{&a, {0.5, 0}}}, square).at({1, 0}), 1050, 1e-9); // what was at 0.5 is at 1
    EXPECT_NEAR(*ReceivedBeam({{&a, {}}, {&b, {0, 1}}}, square).at({1, 2}), (1100 + 3010) / 2.0, 1e-9);
    EXPECT_FALSE(ReceivedBeam({{&a, {}}, {&b, {2, 0}}}, square).at({-4, 0}));
}

// A cone of 10 cd per degree with its tip at (1.03, -0.47): found on a segment that passes it by at 0.13 degrees, and in a zone.
TEST(Extremes, AreFoundWhereTheyAre) {
    const double h0 = 1.03, v0 = -0.47;
    const CandelaTable cone =
        table_of(steps(-4, 4, 0.05), steps(-3, 3, 0.05), [&](double h, double v) { return 1000 - 100 * std::hypot(h - h0, v - v0); });
    const ReceivedBeam beam({{&cone, {}}}, Receiver{});
    const Extremes on = extremes_on(beam, {-3, -0.6}, {3, -0.6});
    EXPECT_NEAR(on.highest->where.h_deg, h0, 0.03);
    EXPECT_NEAR(on.highest->cd, 1000 - 100 * 0.13, 0.3);
    EXPECT_NEAR(on.lowest->cd, 1000 - 100 * std::hypot(4.03, 0.13), 0.3);
    EXPECT_DOUBLE_EQ(on.lowest->where.h_deg, -3.0);
    const Extremes in = extremes_in(beam, {{-2, -2}, {3, -2}, {3, 2}, {-2, 2}});
    EXPECT_NEAR(in.highest->where.h_deg, h0, 0.03);
    EXPECT_NEAR(in.highest->where.v_deg, v0, 0.03);
    EXPECT_EQ(in.lowest->where, (Direction{-2, 2}));
    // With the tip outside, the border nearest to it is highest: the triangle's side h + v = 0 at (0.75, -0.75).
    const Extremes triangle = extremes_in(beam, {{-2, -2}, {2, -2}, {-2, 2}});
    EXPECT_NEAR(triangle.highest->where.h_deg, 0.75, 0.04);
    EXPECT_NEAR(triangle.highest->cd, 1000 - 100 * (h0 + v0) / std::sqrt(2.0), 0.3);
}

TEST(Extremes, AReceiverSmearsASpotNarrowerThanItself) {
    CandelaTable t = table_of(steps(-3, 3, 0.05), steps(-3, 3, 0.05), [](double, double) { return 100.0; });
    t.at(60, 60) = 1100.0; // a pyramid 0.1 degrees wide: volume 1000 * 0.05^2 over the receiver's 0.15^2
    const Extremes in = extremes_in(ReceivedBeam({{&t, {}}}, square), {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}});
    EXPECT_NEAR(in.highest->cd, 100.0 + 1000.0 * 0.05 * 0.05 / (0.15 * 0.15), 0.01);
    EXPECT_NEAR(in.highest->where.h_deg, 0.0, 0.05);
}

TEST(Extremes, TellWhatIsNotCovered) {
    const CandelaTable t = table_of(steps(-5, 5, 1), steps(-5, 5, 1), [](double h, double) { return 100 + h; });
    const ReceivedBeam beam({{&t, {}}}, square);
    EXPECT_TRUE(extremes_on(beam, {-4, 0}, {4, 0}).all_covered);
    const Extremes partly = extremes_on(beam, {-9, 0}, {4, 0});
    EXPECT_FALSE(partly.all_covered);
    EXPECT_NEAR(partly.highest->cd, 104.0, 1e-9);
    const Extremes nowhere = extremes_in(beam, {{6, 0}, {8, 0}, {8, 2}});
    EXPECT_FALSE(nowhere.all_covered);
    EXPECT_FALSE(nowhere.highest || nowhere.lowest);
}

} // namespace
} // namespace fernlicht
