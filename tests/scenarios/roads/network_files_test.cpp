// Real road files by others: every one is read or refused in one sentence, and what is read is finite everywhere.
#include "scenarios/roads/road_network.h"
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

TEST(NetworkFiles, EachIsFiniteEverywhere) {
    const auto files = road_files(std::filesystem::path(FERNLICHT_SHARED_DATA) / "roads");
    if (files.empty())
        GTEST_SKIP() << "no road files in " << FERNLICHT_SHARED_DATA;
    for (const auto& file : files) {
        SCOPED_TRACE(file.string());
        try {
            const RoadNetwork network = read_opendrive(file);
            expect_finite(network);
        } catch (const InputError& error) {
            EXPECT_FALSE(std::string(error.what()).empty());
        }
    }
}

} // namespace
} // namespace fernlicht
