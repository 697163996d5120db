// Bringing tables of other systems of angles onto the goniometer: what it costs.
#include "scenarios/lamps/goniometer.h"
#include "tests/scenarios/lamps/lamp_trial.h"

#include <cstddef>

namespace fernlicht {
namespace {

class Goniometer : public LampTrial {};

/// Light between 0 and 95 degrees about the beam: two thirds of the goniometer's half a million cells have no data. Each of them used to be
/// looked at 64 times, which took three seconds.
TEST_F(Goniometer, LooksLittleAtCellsWithoutData) {
    std::string text = "ACME\n2\n1\n1\n0\n3\n0\nreport\nWidget\n4711\nw."
                       "ldt\n2024\n100\n100\n50\n100\n100\n0\n0\n0\n0\n90\n100\n1\n0\n1\n1\nLED\n1000\n4000\n80\n15\n";
    for (int i = 0; i < 10; ++i)
        text += "0\n";
    const LampFile lamp = read("w.ldt", text + "0\n0\n90\n95\n1\n2\n3\n");
    std::size_t lookups = 0;
    AngleSystem system = lamp.measured.value().system;
    system.to_native = [&lookups, to_native = system.to_native](double h, double v) {
        ++lookups;
        return to_native(h, v);
    };
    LampFile again;
    bring_onto_goniometer(lamp.measured->table, system, again);
    ASSERT_GT(again.table.cd.size(), 400'000U);
    EXPECT_LT(lookups, 20 * again.table.cd.size());
    EXPECT_EQ(again.table, lamp.table);
    EXPECT_NEAR(flux_lm(again.table), 11.387, 0.001) << "as with 64 looks at every cell";
}

} // namespace
} // namespace fernlicht
