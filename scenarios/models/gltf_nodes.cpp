#include "scenarios/models/gltf_nodes.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace fernlicht {
namespace {

constexpr double largest = 1e9;

glm::dmat4 local_transform(const GltfEntry& node) {
    glm::dmat4 m(1.0);
    if (const auto matrix = node.find("matrix")) {
        const std::vector<double> v = matrix->numbers(16);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                m[column][row] = v[static_cast<std::size_t>(4 * column + row)];
        if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
            matrix->refuse("found a matrix that is no affine transform", "a last row of 0 0 0 1");
    } else {
        if (const auto translation = node.find("translation")) {
            const std::vector<double> v = translation->numbers(3);
            m = glm::translate(m, {v[0], v[1], v[2]});
        }
        if (const auto rotation = node.find("rotation")) {
            const std::vector<double> v = rotation->numbers(4);
            const glm::dquat q(v[3], v[0], v[1], v[2]);
            if (!(glm::length(q) > 1e-6 && glm::length(q) < 1e6))
                rotation->refuse("a quaternion that is not 0");
            m *= glm::mat4_cast(glm::normalize(q));
        }
        if (const auto scale = node.find("scale")) {
            const std::vector<double> v = scale->numbers(3);
            m = glm::scale(m, {v[0], v[1], v[2]});
        }
    }
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(m[column][row]) < largest))
                node.refuse(fmt::format("a transform with {}", m[column][row]), "numbers below 1e9");
    return m;
}

/// Indices of the nodes to begin with: of the default scene, of the first, or all that are nobody's children.
std::vector<std::size_t> first_nodes(const GltfEntry& root, const std::vector<bool>& has_parent) {
    std::vector<std::size_t> first;
    const std::size_t scenes = root.list_size("scenes");
    if (scenes > 0) {
        const auto chosen = root.find("scene");
        const GltfEntry scene = root.at("scenes", chosen ? chosen->index(scenes, "scenes") : 0);
        for (const GltfEntry& node : scene.list("nodes"))
            first.push_back(node.index(has_parent.size(), "nodes"));
        return first;
    }
    for (std::size_t i = 0; i < has_parent.size(); ++i)
        if (!has_parent[i])
            first.push_back(i);
    return first;
}

} // namespace

void walk_nodes(const GltfEntry& root, const std::function<void(const GltfEntry&, const glm::dmat4&)>& visit) {
    const std::size_t count = root.list_size("nodes");
    std::vector<std::vector<std::size_t>> children(count);
    std::vector<bool> has_parent(count), met(count);
    for (std::size_t i = 0; i < count; ++i)
        for (const GltfEntry& child : root.at("nodes", i).list("children")) {
            const std::size_t index = child.index(count, "nodes");
            if (has_parent[index] || index == i)
                child.refuse(fmt::format("node {}, which {}", index, index == i ? "is its own child" : "has a parent already"), "a tree");
            has_parent[index] = true;
            children[i].push_back(index);
        }
    std::vector<std::pair<std::size_t, glm::dmat4>> waiting;
    const std::vector<std::size_t> first = first_nodes(root, has_parent);
    for (auto it = first.rbegin(); it != first.rend(); ++it)
        waiting.emplace_back(*it, glm::dmat4(1.0));
    // One parent each at most: what is met twice is a root named twice, or stands in a cycle that a scene leads into.
    while (!waiting.empty()) {
        const auto [index, parent] = waiting.back();
        waiting.pop_back();
        const GltfEntry node = root.at("nodes", index);
        if (met[index])
            node.refuse("it is reached twice", "a tree of nodes");
        met[index] = true;
        const glm::dmat4 world = parent * local_transform(node);
        visit(node, world);
        for (auto it = children[index].rbegin(); it != children[index].rend(); ++it)
            waiting.emplace_back(*it, world);
    }
    for (std::size_t i = 0; i < count && root.list_size("scenes") == 0; ++i)
        if (!met[i])
            root.at("nodes", i).refuse("it is its own ancestor", "a tree of nodes");
}

} // namespace fernlicht
