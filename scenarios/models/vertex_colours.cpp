#include "scenarios/models/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>

namespace fernlicht {
namespace {

constexpr std::size_t max_colours = 64;

/// Steps of as many levels a channel as the eye takes for even: square roots.
std::array<int, 3> step_of(const glm::vec3& tint, int levels) {
    std::array<int, 3> step{};
    for (int c = 0; c < 3; ++c)
        step[static_cast<std::size_t>(c)] = static_cast<int>(std::lround(std::sqrt(tint[c]) * static_cast<float>(levels)));
    return step;
}

struct Group {
    std::vector<std::size_t> triangles;
    glm::dvec3 light{0.0}; ///< tint times area
    double area = 0.0;
};

std::map<std::array<int, 3>, Group> grouped(const TriangleSoup& soup, const std::vector<std::size_t>& members, int levels) {
    std::map<std::array<int, 3>, Group> groups;
    for (const std::size_t t : members) {
        const SoupTriangle& triangle = soup.triangles[t];
        const auto at = [&](std::size_t i) { return soup.vertices[triangle.corners[i]].position_m; };
        const double area = std::max(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))), 1e-30);
        Group& group = groups[step_of(triangle.tint, levels)];
        group.triangles.push_back(t);
        group.light += area * glm::dvec3(triangle.tint);
        group.area += area;
    }
    return groups;
}

} // namespace

void colour_faces(TriangleSoup& soup, std::vector<Material>& materials) {
    std::map<std::uint32_t, std::vector<std::size_t>> tinted; // by material; those with white faces among them, too
    for (const SoupTriangle& triangle : soup.triangles)
        if (std::min({triangle.tint.r, triangle.tint.g, triangle.tint.b}) < 1.0F - 1e-4F)
            tinted[triangle.material];
    for (std::size_t t = 0; !tinted.empty() && t < soup.triangles.size(); ++t)
        if (const auto found = tinted.find(soup.triangles[t].material); found != tinted.end())
            found->second.push_back(t);
    for (const auto& [material, members] : tinted) {
        int levels = 32;
        auto groups = grouped(soup, members, levels);
        while (groups.size() > max_colours)
            groups = grouped(soup, members, levels = levels * 3 / 4);
        std::size_t number = 0;
        const Material plain = materials[material];
        for (const auto& [step, group] : groups) {
            Material coloured = plain;
            coloured.albedo = glm::vec3(glm::dvec3(plain.albedo) * group.light / group.area);
            if (number > 0)
                coloured.name += fmt::format(" (colour {})", number + 1);
            const auto index = number == 0 ? material : static_cast<std::uint32_t>(materials.size());
            for (const std::size_t t : group.triangles)
                soup.triangles[t].material = index;
            if (number++ == 0)
                materials[index] = coloured;
            else
                materials.push_back(coloured);
        }
    }
}

} // namespace fernlicht
