// Real road files by others: every one is read or refused in one sentence, and what is read is finite everywhere.
#include "scenarios/roads/route.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

std::vector<std::filesystem::path> road_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(folder))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.path().extension() == ".xodr")
                files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

bool finite(const Pose& pose) {
    bool all = true;
    for (int i = 0; i < 3; ++i)
        all = all && std::isfinite(pose.position_m[i]) && std::isfinite(glm::length(pose.axes[i])) &&
              std::abs(glm::length(pose.axes[i]) - 1.0) < 1e-9;
    return all;
}

void expect_finite(const RoadNetwork& network) {
    for (const Road& road : network.roads)
        for (int i = 0; i <= 50; ++i) {
            const double s = road.length_m * i / 50.0;
            ASSERT_TRUE(finite(plan_pose(road, s))) << road.id << " s = " << s;
            const LaneSection& section = section_at(road, s);
            for (const Lane& lane : section.lanes) {
                const LaneEdges edges = lane_edges(road, section, lane.id, s);
                for (const double t : {edges.inner_t_m, edges.outer_t_m}) {
                    const Pose pose = surface_pose(network, road, s, t);
                    ASSERT_TRUE(finite(pose)) << road.id << " s = " << s << " t = " << t;
                    ASSERT_GT(pose.up().z, 0.0) << road.id << " s = " << s << " t = " << t;
                }
            }
        }
}

void expect_route(const RoadNetwork& network) {
    const Route route(network, {});
    EXPECT_GT(route.length_m(), 0.0);
    for (int i = 0; i <= 200; ++i) {
        const double distance = route.length_m() * i / 200.0;
        const Pose pose = route.pose(distance, i % 3 - 1.0);
        ASSERT_TRUE(finite(pose)) << distance;
        ASSERT_GT(pose.up().z, 0.0) << distance;
        const CrossSection cross = route.cross_section(distance);
        ASSERT_TRUE(std::any_of(cross.lanes.begin(), cross.lanes.end(), [](const RouteLane& lane) { return lane.name == "own"; }))
            << distance;
    }
}

bool has_driving_lane(const RoadNetwork& network) {
    return std::any_of(network.roads.begin(), network.roads.end(), [](const Road& road) {
        return std::any_of(road.sections[0].lanes.begin(), road.sections[0].lanes.end(),
                           [&](const Lane& lane) { return lane.id != 0 && lane.type == "driving" && travels_with_s(road, lane); });
    });
}

/// Files that break a rule of the standard may be refused; each of those is judged in opendrive_rules_test.
bool may_be_refused(const std::filesystem::path& file) { return file.string().find("qc-opendrive") != std::string::npos; }

TEST(NetworkFiles, EachIsFiniteEverywhereAndCanBeDriven) {
    const auto files = road_files(std::filesystem::path(FERNLICHT_SHARED_DATA) / "roads");
    if (files.empty())
        GTEST_SKIP() << "no road files in " << FERNLICHT_SHARED_DATA;
    int read = 0;
    for (const auto& file : files) {
        SCOPED_TRACE(file.string());
        try {
            const RoadNetwork network = read_opendrive(file);
            ++read;
            expect_finite(network);
            if (has_driving_lane(network))
                expect_route(network);
        } catch (const InputError& error) {
            EXPECT_TRUE(may_be_refused(file)) << error.what();
        }
    }
    EXPECT_GT(read, 0.9 * static_cast<double>(files.size()));
}

} // namespace
} // namespace fernlicht
