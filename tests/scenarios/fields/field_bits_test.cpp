// What hashes of inputs are taken over: neither names of keys nor fields at their defaults, but every value that is another.
#include "scenarios/fields/field_bits.h"

#include "scenarios/fields/field.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

struct Lid {
    std::string name;
    double width_m = 0.1;
    int knobs = 1;
};

struct Pot {
    double height_m = 0.2;
    std::optional<Lid> lid;
    std::vector<Lid> spare_lids;
    std::vector<double> handles_m{0.1, 0.1};
    bool has_spout = false;
};

const Fields<Lid>& lid_fields() {
    static const Fields<Lid> fields{field("width_m", 1, &Lid::width_m, range(0.0, 1.0), "across")};
    return fields;
}
const Fields<Pot>& pot_fields() {
    static const Fields<Pot> fields{field("height_m", 1, &Pot::height_m, range(0.0, 1.0), "inside"),
                                    field("lid", 2, &Pot::lid, lid_fields(), "its own"),
                                    named("spare_lids", 3, &Pot::spare_lids, 9, lid_fields(), "others")};
    return fields;
}

/// The same structs, as a later version describes them: renamed, in another order, with more fields.
const Fields<Lid>& later_lid_fields() {
    static const Fields<Lid> fields{field("knobs", 2, &Lid::knobs, range(0.0, 3.0), "to lift it by"),
                                    field("diameter_m", 1, &Lid::width_m, range(0.0, 1.0), "across")};
    return fields;
}
const Fields<Pot>& later_pot_fields() {
    static const Fields<Pot> fields{
        field("has_spout", 5, &Pot::has_spout, any(), "to pour"), named("other_lids", 3, &Pot::spare_lids, 9, later_lid_fields(), "others"),
        field("cover", 2, &Pot::lid, later_lid_fields(), "its own"), field("depth_m", 1, &Pot::height_m, range(0.0, 1.0), "inside"),
        field("handles_m", 4, &Pot::handles_m, numbers(0, 2, 0.0, 1.0), "")};
    return fields;
}

std::vector<Pot> pots() {
    std::vector<Pot> all(7);
    all[1].height_m = 0.3;
    all[2].lid.emplace();
    all[3].lid = Lid{"", 0.2};
    all[4].spare_lids = {{"old"}};
    all[5].spare_lids = {{"new"}};
    all[6].spare_lids = {{"old", 0.2}, {"new"}};
    return all;
}

TEST(FieldBits, AreNothingAtDefaults) {
    EXPECT_EQ(field_bits(pot_fields(), &pots()[0]), "");
    EXPECT_EQ(field_bits(later_pot_fields(), &pots()[0]), "");
}

TEST(FieldBits, AreThoseOfRenamedAndAddedFields) {
    for (const Pot& pot : pots())
        EXPECT_EQ(field_bits(pot_fields(), &pot), field_bits(later_pot_fields(), &pot));
}

TEST(FieldBits, DifferWithEveryValue) {
    const std::vector<Pot> all = pots();
    for (const Pot& a : all)
        for (const Pot& b : all)
            EXPECT_EQ(field_bits(pot_fields(), &a) == field_bits(pot_fields(), &b), &a == &b) << &a - all.data() << " " << &b - all.data();
    Pot pot;
    pot.handles_m = {0.1};
    EXPECT_EQ(field_bits(later_pot_fields(), &pot), "4=[3fb999999999999a,]\n");
    pot.handles_m = {0.1, 0.1};
    pot.has_spout = true;
    EXPECT_EQ(field_bits(later_pot_fields(), &pot), "5=1\n");
}

} // namespace
} // namespace fernlicht
