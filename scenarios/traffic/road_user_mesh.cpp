#include "scenarios/traffic/road_user_mesh.h"

#include "scenarios/models/model.h"
#include "scenarios/models/road_user_bodies.h"

#include <array>
#include <map>
#include <tuple>

namespace fernlicht {
namespace {

/// Reflectances of car paint, as often seen: white, silver, grey, black, blue, red.
constexpr std::array<glm::vec3, 6> paints{
    glm::vec3(0.65F), glm::vec3(0.38F), glm::vec3(0.17F), glm::vec3(0.04F), glm::vec3(0.05F, 0.1F, 0.25F), glm::vec3(0.3F, 0.03F, 0.03F)};

std::size_t name_sum(const std::string& name) {
    std::size_t sum = 0;
    for (const char c : name)
        sum = sum * 31 + static_cast<unsigned char>(c);
    return sum;
}
std::size_t paint_of(const std::string& name) { return name_sum(name) % paints.size(); }
/// Independent of the paint.
std::uint32_t draw_of(const std::string& name) { return static_cast<std::uint32_t>(name_sum(name) / paints.size() % 6); }

Model body_of(const RoadUser& user, bool dressed) {
    const BodySize size{user.size_m, user.rear_m, paints[paint_of(user.name)], dressed, draw_of(user.name)};
    static constexpr Model (*bodies[])(const BodySize&) = {car_body,        van_body,     truck_body,      bus_body,
                                                           motorcycle_body, bicycle_body, pedestrian_body, plain_body}; // by RoadUserKind
    return bodies[static_cast<std::size_t>(user.kind)](size);
}

/// What users must have in common to look the same.
using Look = std::tuple<std::string, RoadUserKind, double, double, double, double, std::size_t, std::uint32_t>;
Look look_of(const RoadUser& user, bool dressed) {
    return {user.model.string(), user.kind,   user.size_m.x,       user.size_m.y,
            user.size_m.z,       user.rear_m, paint_of(user.name), dressed ? draw_of(user.name) : 0};
}
Look look_of_file(const RoadUser& user) { return {user.model.string(), {}, user.model_yaw_rad, user.model_scale, 0.0, 0.0, 0, 0}; }

} // namespace

void add_road_users(Scene& scene, std::span<const RoadUser> users, FilesRead& opened, bool dressed) {
    std::map<Look, std::pair<std::size_t, std::size_t>> known; ///< first and last mesh of those that came first
    for (std::size_t i = 0; i < users.size(); ++i) {
        const std::size_t before = scene.meshes.size();
        const Look look = users[i].model.empty() ? look_of(users[i], dressed) : look_of_file(users[i]);
        if (const auto same = known.find(look); same != known.end()) {
            for (std::size_t k = same->second.first; k < same->second.second; ++k)
                scene.meshes.push_back(Mesh(scene.meshes[k]));
        } else {
            const Model model = users[i].model.empty() ? body_of(users[i], dressed) : read_model(users[i].model);
            opened.insert(opened.end(), model.opened.begin(), model.opened.end());
            add_model(scene, model, {{}, axes_from_angles(users[i].model_yaw_rad, 0.0, 0.0)}, users[i].model_scale, SurfaceKind::vehicle);
            known.emplace(look, std::pair(before, scene.meshes.size()));
        }
        for (std::size_t k = before; k < scene.meshes.size(); ++k) {
            scene.meshes[k].name = users[i].name;
            scene.meshes[k].body = static_cast<int>(i);
        }
    }
    if (!users.empty())
        unify_texture_sizes(scene);
}

} // namespace fernlicht
