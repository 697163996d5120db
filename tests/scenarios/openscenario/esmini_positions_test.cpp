#include "scenarios/openscenario/play_story.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "scenarios/values/xml_file.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

namespace fernlicht::osc {
namespace {

namespace fs = std::filesystem;

struct Place {
    std::string entity;
    std::size_t second;
    double x_m, y_m;
};

/// Positions that esmini computed by steps of 0.01 s, one a second; its files give millimetres.
std::map<std::string, std::vector<Place>> esmini_positions() {
    std::map<std::string, std::vector<Place>> out;
    std::ifstream in(std::string(FERNLICHT_SOURCE_DIR) + "/tests/scenarios/openscenario/esmini-positions.csv");
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        std::string scenario, entity, time, x, y;
        std::getline(fields, scenario, ',');
        std::getline(fields, entity, ',');
        std::getline(fields, time, ',');
        std::getline(fields, x, ',');
        std::getline(fields, y, ',');
        out[scenario].push_back({entity, static_cast<std::size_t>(to_number(time).value()), to_number(x).value(), to_number(y).value()});
    }
    return out;
}

double largest_difference_m(const PlayedStory& played, const std::vector<Place>& places) {
    double largest = 0.0;
    for (const Place& place : places)
        for (const PlayedEntity& entity : played.entities) {
            const std::size_t at = place.second * 100;
            if (entity.entity.name != place.entity || at >= entity.samples.size())
                continue;
            const glm::dvec3& here = entity.samples[at].position_m;
            const double apart = std::hypot(here.x - place.x_m, here.y - place.y_m);
            if (std::getenv("FERNLICHT_STORY_TABLE") && std::string_view(std::getenv("FERNLICHT_STORY_TABLE")) == "all")
                std::printf("   %s %zu s: %.3f %.3f, esmini %.3f %.3f: %.3f\n", place.entity.c_str(), place.second, here.x, here.y,
                            place.x_m, place.y_m, apart);
            largest = std::max(largest, apart);
        }
    return largest;
}

/// The differences that are larger, and why, stand in docs/openscenario.md.
TEST(EsminiPositions, AgreeWithinFiveCentimetresOverTheDrive) {
    const fs::path folder = fs::path(FERNLICHT_SHARED_DATA) / "scenarios/esmini__esmini";
    if (!fs::is_directory(folder))
        GTEST_SKIP() << "no scenarios in " << folder;
    int compared = 0;
    for (const auto& [scenario, places] : esmini_positions()) {
        const Storyboard story =
            read_storyboard(folder / scenario, {.lenient = true, .road_folders = {fs::path(FERNLICHT_SHARED_DATA) / "roads"}});
        const PlayedStory played = play_story(story, read_opendrive(story.road_file), {.step_s = 0.01, .most_s = 30.0});
        const double apart = largest_difference_m(played, places);
        if (std::getenv("FERNLICHT_STORY_TABLE"))
            std::printf("%-75s %6.1f s %8.4f m\n", scenario.c_str(), static_cast<double>(played.ticks() - 1) * 0.01, apart);
        else
            EXPECT_LE(apart, 0.05) << scenario;
        ++compared;
    }
    EXPECT_GE(compared, 10);
}

} // namespace
} // namespace fernlicht::osc
