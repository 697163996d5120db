// Lamps with what was done to them known: told by the names of what it was done to, and by no other.
#include "metrics/regulation/named_places.h"

#include "tests/metrics/changed_lamps.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::set<std::string> changed_places(const LampDifference& found) {
    std::set<std::string> names;
    for (const PlaceChange& change : found.places)
        if (change.is_beyond_noise)
            names.insert(change.place.name);
    return names;
}

const PlaceChange& place(const LampDifference& found, const std::string& name) {
    return *std::ranges::find(found.places, name, [](const PlaceChange& change) { return change.place.name; });
}

std::string all_said(const LampDifference& found) {
    std::string text;
    for (const std::string& sentence : sentences_of(found))
        text += sentence + "\n";
    return text;
}

TEST(NamedPlaces, StandWhereTheRegulationsPutThem) {
    const auto of = [](const std::vector<BeamPlace>& places, const std::string& name) {
        return *std::ranges::find(places, name, &BeamPlace::name);
    };
    const std::vector<BeamPlace> right = low_beam_places(), left = low_beam_places(TrafficSide::left);
    EXPECT_EQ(of(right, "75R").corners, (std::vector<Direction>{{1.15, -0.57}}));
    EXPECT_EQ(of(right, "B50L").corners, (std::vector<Direction>{{-3.43, 0.57}}));
    EXPECT_EQ(of(left, "75L").corners, (std::vector<Direction>{{-1.15, -0.57}})) << "mirrored, as the texts do it";
    EXPECT_EQ(of(left, "50V").corners, (std::vector<Direction>{{0.0, -0.86}}));
    EXPECT_EQ(of(left, "kerb shoulder").corners.front().h_deg, -2.0);
    std::set<std::string> names;
    for (const BeamPlace& one : right) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
        EXPECT_FALSE(one.what.empty() || one.source.empty()) << one.name;
    }
    EXPECT_EQ(right.size(), left.size());
}

class NamesOf : public testing::TestWithParam<const char*> {
  protected:
    CandelaTable lamp_ = shipped(GetParam());
    LampDifference found_with(const CandelaTable& changed, unsigned seed = 3) const {
        return compare_by_name(with_noise(changed, 0.01, seed), lamp_);
    }
};

TEST_P(NamesOf, AZoneHasTheNamesOfWhatLiesInItAndNoOther) {
    const LampDifference found = found_with(dimmed(lamp_, {-1.0, 3.0, -1.3, -0.3}, 0.95));
    ASSERT_EQ(found.zones.size(), 1U) << all_said(found);
    EXPECT_THAT(found.zones[0].holds, ElementsAre("75R", "50R", "50V"));
    EXPECT_EQ(found.zones[0].extent, ZoneExtent::part);
    EXPECT_THAT(sentences_of(found).front(), HasSubstr("75R, 50R and 50V 5.")) << "names first";
    // Regions of which it takes a part have another mean; nothing else has.
    const std::set<std::string> changed = changed_places(found);
    for (const char* name : {"75R", "50R", "50V"}) {
        EXPECT_TRUE(changed.contains(name)) << name;
        EXPECT_NEAR(*place(found, name).change(), -0.05, 5.0 * *place(found, name).uncertainty) << name;
    }
    for (const std::string& name : changed)
        EXPECT_TRUE((std::set<std::string>{"75R", "50R", "50V", "kerb shoulder", "zone IV"}.contains(name))) << name;
}

TEST_P(NamesOf, AZoneThatHoldsNoneIsPartOfOne) {
    const LampDifference found = found_with(dimmed(lamp_, {-8.0, -3.0, -4.0, -2.0}, 0.95));
    ASSERT_EQ(found.zones.size(), 1U) << all_said(found);
    EXPECT_TRUE(found.zones[0].holds.empty()) << all_said(found);
    EXPECT_EQ(found.zones[0].part_of, "zone I");
    EXPECT_EQ(changed_places(found), std::set<std::string>{"zone I"});
    EXPECT_THAT(sentences_of(found).front(), AllOf(HasSubstr("part of zone I 5."), HasSubstr(" % dimmer (8.")));
}

TEST_P(NamesOf, MoreForegroundIsForeground) {
    const LampDifference found = found_with(dimmed(lamp_, {-15.0, 15.0, -10.0, -4.3}, 1.3));
    ASSERT_EQ(found.zones.size(), 1U) << all_said(found);
    EXPECT_THAT(found.zones[0].holds, ElementsAre("foreground"));
    EXPECT_EQ(changed_places(found), std::set<std::string>{"foreground"});
}

TEST_P(NamesOf, AWiderBeamIsWidth) {
    CandelaTable wide = lamp_;
    for (std::size_t v = 0; v < wide.v_deg.size(); ++v)
        for (std::size_t h = 0; h < wide.h_deg.size(); ++h)
            wide.at(v, h) *= 1.0 + 0.2 * std::clamp((std::abs(wide.h_deg[h]) - 16.5) / 4.0, 0.0, 1.0);
    const LampDifference found = found_with(wide);
    EXPECT_EQ(changed_places(found), (std::set<std::string>{"width left", "width right"})) << all_said(found);
    std::set<std::string> held;
    for (const BeamZone& zone : found.zones)
        held.insert(zone.holds.begin(), zone.holds.end());
    EXPECT_EQ(held, (std::set<std::string>{"width left", "width right"})) << all_said(found);
}

TEST_P(NamesOf, ARaisedCutOffLightsWhatItWasToKeepDark) {
    const LampDifference found = compare_by_name(with_noise(raised_cut_off(lamp_, 0.2), 0.002, 3), lamp_); // B50L gains 2 %
    ASSERT_TRUE(found.cut_off_up_deg) << all_said(found);
    const std::set<std::string> changed = changed_places(found);
    for (const char* name : {"B50L", "zone III", "HV"}) {
        EXPECT_TRUE(changed.contains(name)) << name;
        EXPECT_GT(*place(found, name).change(), 0.0) << name;
    }
    for (const char* name : {"25L", "25R", "zone I", "foreground"})
        EXPECT_FALSE(changed.contains(name)) << name;
}

INSTANTIATE_TEST_SUITE_P(Shipped, NamesOf, testing::Values("halogen-low", "xenon-low"),
                         [](const auto& lamp) { return std::string(lamp.param).substr(0, std::string(lamp.param).find('-')); });

TEST(NamedPlaces, LightAllOverOrBelowTheCutOffIsCalledSo) {
    const CandelaTable halogen = shipped("halogen-low");
    const LampDifference makes = compare_by_name(shipped("xenon-low"), halogen);
    EXPECT_THAT(all_said(makes), AllOf(HasSubstr("all light below the cut-off 111"), HasSubstr("within the digits of the tables"),
                                       Not(HasSubstr("±0.00")), Not(HasSubstr("±0 %"))));
    const LampDifference even = compare_by_name(dimmed(halogen, {-90.0, 90.0, -90.0, -0.9}, 1.2), halogen);
    ASSERT_EQ(even.zones.size(), 1U) << all_said(even);
    EXPECT_EQ(even.zones[0].extent, ZoneExtent::below_cut_off);
}

TEST(NamedPlaces, KnowTheSideOfTheRoad) {
    const CandelaTable right = shipped("halogen-low"), left = mirrored(right);
    EXPECT_EQ(traffic_side_of(right), TrafficSide::right);
    EXPECT_EQ(traffic_side_of(left), TrafficSide::left);
    EXPECT_EQ(traffic_side_of(shipped("halogen-high")), TrafficSide::unknown);
    const LampDifference same = compare_by_name(dimmed(left, {-3.0, 1.0, -1.3, -0.3}, 0.95), left);
    ASSERT_EQ(same.zones.size(), 1U) << all_said(same);
    EXPECT_THAT(same.zones[0].holds, ElementsAre("75L", "50L", "50V"));
    EXPECT_THAT(sentences_of(compare_by_name(left, right)).front(), HasSubstr("made for left-hand traffic, the other lamp for right-hand"));
    EXPECT_TRUE(compare_by_name(right, right).side_against == TrafficSide::right);
}

TEST(NamedPlaces, HighBeamsHaveTheirOwn) {
    const LampDifference found = compare_by_name(shipped("xenon-high"), shipped("halogen-high"));
    EXPECT_EQ(found.places.front().place.name, "HV");
    EXPECT_GT(*place(found, "H-3L").change(), 0.0);
    EXPECT_TRUE(std::ranges::none_of(found.places, [](const PlaceChange& change) { return change.place.name == "B50L"; }));
}

TEST(NamedPlaces, OneThatIsMoreThanNoiseIsADifference) {
    const CandelaTable lamp = shipped("halogen-low");
    LampDifference none = compare_by_name(lamp, lamp);
    EXPECT_FALSE(none.any());
    none.places.front().is_beyond_noise = true;
    none.places.front().new_cd = 1.1 * *none.places.front().old_cd;
    EXPECT_TRUE(none.any());
    EXPECT_EQ(sentences_of(none), std::vector<std::string>{"kerb shoulder 10.0 % brighter (within the digits of the tables)"});
}

} // namespace
} // namespace fernlicht
