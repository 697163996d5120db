// Small OpenDRIVE files for tests, written into a folder of their own; our roads, and those of others.
#pragma once

#include "scenarios/roads/road_network.h"
#include "tests/trial.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht::opendrive_text {

inline const std::filesystem::path library_roads = FERNLICHT_SOURCE_DIR "/scenarios/library/roads";
inline const std::filesystem::path shared_roads = FERNLICHT_SHARED_DATA "/roads";

inline RoadNetwork library_road(const char* name) { return read_opendrive(library_roads / name); }

/// All road files below a folder, by name; none where it does not exist.
inline std::vector<std::filesystem::path> road_files(const std::filesystem::path& folder) { return tests::files_below(folder, {".xodr"}); }

inline RoadNetwork network_of(const std::string& content) { return read_opendrive(tests::written("road.xodr", content)); }

inline std::string file(const std::string& roads, const std::string& header = R"(<header revMajor="1" revMinor="7"/>)") {
    return R"(<?xml version="1.0" encoding="UTF-8"?>)"
           "\n<OpenDRIVE>\n" +
           header + "\n" + roads + "\n</OpenDRIVE>\n";
}

struct RoadText {
    std::string id = "1", length = "100", attributes, link;
    std::string plan = R"(<geometry s="0" x="0" y="0" hdg="0" length="100"><line/></geometry>)";
    std::string profiles; ///< elevationProfile and lateralProfile
    std::string lanes;    ///< empty: two_lanes()
    std::string rest;     ///< objects, signals
};

inline std::string lane(int id, const std::string& width = "3.5", const std::string& link = {}, const std::string& type = "driving") {
    return fmt::format(R"(<lane id="{}" type="{}"><link>{}</link><width sOffset="0" a="{}" b="0" c="0" d="0"/></lane>)", id, type, link,
                       width);
}

inline std::string section(double s, const std::string& left, const std::string& right, const std::string& centre = R"(<lane id="0"/>)") {
    return fmt::format(R"(<laneSection s="{}"><left>{}</left><center>{}</center><right>{}</right></laneSection>)", s, left, centre, right);
}

inline std::string two_lanes() { return section(0.0, lane(1), lane(-1)); }

inline std::string road(const RoadText& r) {
    return fmt::format(
        "<road id=\"{}\" length=\"{}\" {}>\n<link>{}</link>\n<planView>\n{}\n</planView>\n{}\n<lanes>{}</lanes>\n{}</road>\n", r.id,
        r.length, r.attributes.empty() ? "junction=\"-1\"" : r.attributes, r.link, r.plan, r.profiles,
        r.lanes.empty() ? two_lanes() : r.lanes, r.rest);
}

inline std::string geometry(double s, double x, double y, double heading, double length, const std::string& shape = "<line/>") {
    return fmt::format(R"(<geometry s="{}" x="{}" y="{}" hdg="{}" length="{}">{}</geometry>)", s, x, y, heading, length, shape);
}

} // namespace fernlicht::opendrive_text
