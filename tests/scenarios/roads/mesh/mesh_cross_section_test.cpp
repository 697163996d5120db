// Strips of a cross-section: side by side, in the right colours, dashes where they belong.
#include "scenarios/roads/mesh/mesh_cross_section.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <cmath>

namespace fernlicht {
namespace {

Lane lane_across(int id, const char* type, double width) {
    Lane lane;
    lane.id = id;
    lane.type = type;
    if (id != 0)
        lane.widths.push_back({0.0, width, 0.0, 0.0, 0.0});
    return lane;
}

RoadMark mark(MarkKind kind, const char* colour = "white") {
    RoadMark mark;
    mark.kind = kind;
    mark.colour = colour;
    return mark;
}

/// 100 m, two driving lanes of 3 m; `centre` between them, `edge` at the right.
Road road_with(MarkKind centre, MarkKind edge) {
    Road road;
    road.length_m = 100.0;
    PlanElement element;
    element.length_m = 100.0;
    road.plan.push_back(element);
    LaneSection section;
    section.end_m = 100.0;
    section.lanes = {lane_across(1, "driving", 3.0), lane_across(0, "none", 0.0), lane_across(-1, "driving", 3.0)};
    section.lanes[1].marks.push_back(mark(centre));
    section.lanes[2].marks.push_back(mark(edge));
    road.sections.push_back(section);
    return road;
}

void expect_side_by_side(const std::vector<Strip>& strips) {
    for (std::size_t i = 0; i < strips.size(); ++i) {
        EXPECT_LE(strips[i].right_t_m, strips[i].left_t_m);
        if (i > 0) {
            EXPECT_DOUBLE_EQ(strips[i].right_t_m, strips[i - 1].left_t_m);
        }
    }
}

double painted_width(const std::vector<Strip>& strips) {
    double width = 0.0;
    for (const Strip& strip : strips)
        if (strip.material == RoadMaterial::marking_white || strip.material == RoadMaterial::marking_yellow)
            width += strip.left_t_m - strip.right_t_m;
    return width;
}

TEST(MeshCrossSection, BrokenLineIsThereInDashesOnly) {
    const Road road = road_with(MarkKind::broken, MarkKind::none);
    const SectionProfile profile(road, road.sections[0]);
    EXPECT_NEAR(painted_width(profile.strips(2.0, 2.0)), 0.12, 1e-12); // 4 m dash, 8 m gap
    EXPECT_EQ(painted_width(profile.strips(6.0, 6.0)), 0.0);
    EXPECT_NEAR(painted_width(profile.strips(13.0, 13.0)), 0.12, 1e-12);
    EXPECT_EQ(profile.strips(6.0, 6.0).size(), 1U) << "lanes of one material are one strip";
}

TEST(MeshCrossSection, EveryDashBeginsAndEndsAtAStation) {
    const Road road = road_with(MarkKind::broken, MarkKind::none);
    std::vector<double> stations;
    SectionProfile(road, road.sections[0]).append_stations(stations);
    for (const double expected : {0.0, 4.0, 12.0, 16.0, 96.0, 100.0})
        EXPECT_NE(std::find(stations.begin(), stations.end(), expected), stations.end()) << expected;
}

TEST(MeshCrossSection, EdgeLineStaysOnTheRoad) {
    const Road road = road_with(MarkKind::none, MarkKind::solid);
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    EXPECT_DOUBLE_EQ(strips.front().right_t_m, -3.0);
    EXPECT_NEAR(painted_width(strips), 0.12, 1e-12);
}

TEST(MeshCrossSection, DoubleLinesHaveAGapOfTheirWidth) {
    const Road road = road_with(MarkKind::solid_solid, MarkKind::none);
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    EXPECT_NEAR(painted_width(strips), 0.24, 1e-12);
    ASSERT_GE(strips.size(), 5U); // asphalt, line, gap, line, asphalt
    const Strip& gap = strips[2];
    EXPECT_EQ(gap.material, RoadMaterial::asphalt);
    EXPECT_NEAR(gap.left_t_m - gap.right_t_m, 0.12, 1e-12);
    EXPECT_NEAR(gap.right_t_m, -0.06, 1e-12);
}

TEST(MeshCrossSection, SolidBrokenHasTheSolidLineOnTheLeftOfTheCentre) {
    const Road road = road_with(MarkKind::solid_broken, MarkKind::none);
    const std::vector<Strip> in_gap = SectionProfile(road, road.sections[0]).strips(6.0, 6.0);
    EXPECT_NEAR(painted_width(in_gap), 0.12, 1e-12);
    for (const Strip& strip : in_gap)
        if (strip.material == RoadMaterial::marking_white) {
            EXPECT_GT(strip.right_t_m, 0.0);
        }
}

TEST(MeshCrossSection, PaintWiderThanItsLanesIsCutNotOverlapped) {
    Road road = road_with(MarkKind::solid, MarkKind::solid);
    road.sections[0].lanes[2].widths[0].a = 0.1;
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    EXPECT_DOUBLE_EQ(strips.front().right_t_m, -0.1);
    EXPECT_DOUBLE_EQ(strips.back().left_t_m, 3.0);
}

TEST(MeshCrossSection, DashesFinerThanAPictureAreSolid) {
    Road road = road_with(MarkKind::broken, MarkKind::none);
    road.sections[0].lanes[1].marks[0].stripes.push_back({0.12, 1e-6, 1e-6, 0.0, 0.0});
    const SectionProfile profile(road, road.sections[0]);
    std::vector<double> stations;
    profile.append_stations(stations);
    EXPECT_LT(stations.size(), 20U);
    EXPECT_NEAR(painted_width(profile.strips(33.0, 33.0)), 0.12, 1e-12);
}

TEST(MeshCrossSection, RaisedSidewalkHasAKerbFace) {
    Road road = road_with(MarkKind::none, MarkKind::none);
    Lane walk = lane_across(-2, "sidewalk", 2.0);
    walk.heights.push_back({0.0, 0.12, 0.15});
    road.sections[0].lanes.push_back(walk);
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    const auto face = std::find_if(strips.begin(), strips.end(), [](const Strip& s) { return s.kerb_face && s.right_h_m != s.left_h_m; });
    ASSERT_NE(face, strips.end());
    EXPECT_DOUBLE_EQ(face->right_t_m, -3.0);
    EXPECT_DOUBLE_EQ(face->right_h_m, 0.12);
    EXPECT_DOUBLE_EQ(face->left_h_m, 0.0);
    EXPECT_DOUBLE_EQ(strips.front().right_h_m, 0.15);
}

} // namespace
} // namespace fernlicht
