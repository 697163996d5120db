#include "scenarios/drives/play/place_street_lamps.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <set>

namespace fernlicht {
namespace {

constexpr double pole_drawn_m = 4.0, ///< of a pole whose file says no height, as the road's mesh has it
    below_top_m = 0.1, above_top_m = 0.05;
constexpr std::size_t most_named = 8;

std::string without_case(std::string text) {
    for (char& c : text)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

bool is_asked_for(const StreetLampRow& row, const RoadObject& object) {
    const std::string type = without_case(object.type), name = without_case(object.name);
    return std::ranges::any_of(row.on_objects, [&](const std::string& given) {
        const std::string word = without_case(given);
        return type == word || name.find(word) != std::string::npos;
    });
}

StreetLampPlace place_on(const StreetLampRow& row, const RoadNetwork& network, const Road& road, const RoadObject& object) {
    const Pose ground = surface_pose(network, road, object.s_m, object.t_m);
    const glm::dvec3 up(0.0, 0.0, 1.0),
        forward = glm::normalize(glm::dvec3(ground.forward().x, ground.forward().y, 0.0)); // poles stand upright
    const double own_m = object.height_m > 0.0 ? object.height_m : pole_drawn_m;
    const bool has_arm = row.arm_m > street_lamp_least_arm_m;
    return {fmt::format("object {} ({}) of road {}", object.id, object.name.empty() ? object.type : object.name, road.id),
            {ground.position_m + object.z_offset_m * up, {forward, glm::cross(up, forward), up}},
            object.t_m,
            row.height_m > 0.0 ? row.height_m
            : has_arm          ? std::max(own_m - below_top_m, 0.5)
                               : own_m + above_top_m,
            own_m};
}

/// Types and names that the road's objects have, for a sentence.
std::string what_stands_there(const RoadNetwork& network) {
    std::set<std::string> words;
    for (const Road& road : network.roads)
        for (const RoadObject& object : road.objects)
            for (const std::string& word : {object.type, object.name})
                if (!word.empty())
                    words.insert(word);
    std::string list;
    std::size_t named = 0;
    for (const std::string& word : words) {
        if (named++ == most_named)
            return list + fmt::format(" and {} more", words.size() - most_named);
        list += (list.empty() ? "'" : ", '") + word + "'";
    }
    return list.empty() ? "a road with objects: this one has none" : "one of the road's objects: " + list;
}

} // namespace

void find_street_lamps(Drive& drive, const RoadNetwork& network) {
    for (StreetLampRow& row : drive.street_lamps) {
        if (row.on_objects.empty())
            continue;
        row.found.emplace();
        for (const Road& road : network.roads)
            for (const RoadObject& object : road.objects)
                if (is_asked_for(row, object))
                    row.found->push_back(place_on(row, network, road, object));
        if (row.found->empty())
            throw InputError({drive.file, 0, 0, "street_lamps." + row.name + ".on_objects"},
                             "found no object of such a type or name in " + drive.road_file.filename().string(),
                             what_stands_there(network));
    }
}

} // namespace fernlicht
