#include "scenarios/models/free_way.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

namespace fernlicht {
namespace {

constexpr double least_cell_m = 0.5, largest_scene_m = 4000.0, most_cells = 2000.0;
constexpr double faces_up = 0.7, low_m = 0.3, high_m = 2.2, kerb_m = 0.2, half_width_m = 1.25, farthest_m = 200.0;
constexpr double behind_m = 1.0, wheelbase_m = 2.7;
constexpr int headings = 24;
constexpr std::size_t most_places = 8'000;

/// visit(corners, material) of each triangle of meshes that stand in the world.
template <class Visit> void each_triangle(const Scene& scene, Visit visit) {
    for (const Mesh& mesh : scene.meshes)
        for (const Batch& batch : mesh.batches)
            for (std::uint32_t i = batch.first; i + 2 < batch.first + batch.count; i += 3) {
                glm::dvec3 corners[3];
                for (std::uint32_t k = 0; k < 3; ++k)
                    corners[k] = mesh.origin_m + glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_m);
                visit(corners, batch.material);
            }
}

bool named_road(std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::any_of(std::array{"road", "street", "lane", "asphalt"},
                               [&](const char* word) { return name.find(word) != std::string::npos; });
}

double slope(const glm::dvec3 (&c)[3]) {
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    return normal.z / std::max(glm::length(normal), 1e-30);
}

} // namespace

SceneGround::SceneGround(const Scene& scene) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    each_triangle(scene, [&](const glm::dvec3(&corners)[3], std::uint32_t) {
        for (const glm::dvec3& corner : corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    });
    if (!(low.x <= high.x))
        return;
    const glm::dvec3 middle = 0.5 * (low + high), half = glm::min(0.5 * (high - low), glm::dvec3(0.5 * largest_scene_m));
    cell_m_ = std::max(least_cell_m, 2.0 * std::max(half.x, half.y) / most_cells);
    low_x_m_ = middle.x - half.x;
    low_y_m_ = middle.y - half.y;
    across_ = static_cast<int>(2.0 * half.x / cell_m_) + 1;
    along_ = static_cast<int>(2.0 * half.y / cell_m_) + 1;
    cells_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(along_),
                  {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN()});
    add_ground(scene);
    add_obstacles(scene);
}

std::optional<std::size_t> SceneGround::index(double x_m, double y_m) const {
    const double i = std::floor((x_m - low_x_m_) / cell_m_), k = std::floor((y_m - low_y_m_) / cell_m_);
    if (!(i >= 0.0 && k >= 0.0 && i < across_ && k < along_))
        return std::nullopt;
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(i);
}

/// use(cell, height) at the middle of each cell that a triangle lies over; of steep ones at points half a cell apart.
template <class Use> void SceneGround::each_point(const glm::dvec3 (&c)[3], Use use) {
    if (std::abs(slope(c)) > 0.3) {
        const glm::dvec3 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
        const auto nearest = [&](double v, double from, int most) {
            return static_cast<int>(std::clamp((v - from) / cell_m_, 0.0, most - 1.0));
        };
        const glm::dvec3 u = c[1] - c[0], v = c[2] - c[0];
        const double area = u.x * v.y - u.y * v.x;
        for (int k = nearest(low.y, low_y_m_, along_); k <= nearest(high.y, low_y_m_, along_); ++k)
            for (int i = nearest(low.x, low_x_m_, across_); i <= nearest(high.x, low_x_m_, across_); ++i) {
                const double x = low_x_m_ + (i + 0.5) * cell_m_, y = low_y_m_ + (k + 0.5) * cell_m_, dx = x - c[0].x, dy = y - c[0].y;
                const double s = (dx * v.y - dy * v.x) / area, t = (u.x * dy - u.y * dx) / area;
                if (s >= 0.0 && t >= 0.0 && s + t <= 1.0)
                    use(cells_[static_cast<std::size_t>(k * across_ + i)], c[0].z + s * u.z + t * v.z);
            }
        return;
    }
    const double longest = std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
    const int steps = static_cast<int>(std::clamp(std::ceil(2.0 * longest / cell_m_), 1.0, 2.0 * most_cells));
    for (int i = 0; i <= steps; ++i)
        for (int k = 0; i + k <= steps; ++k) {
            const double s = static_cast<double>(i) / steps, t = static_cast<double>(k) / steps;
            const glm::dvec3 p = c[0] + s * (c[1] - c[0]) + t * (c[2] - c[0]);
            if (const auto there = index(p.x, p.y))
                use(cells_[*there], p.z);
        }
}

void SceneGround::add_ground(const Scene& scene) {
    const auto each_upward = [&](auto use) {
        each_triangle(scene, [&](const glm::dvec3(&corners)[3], std::uint32_t material) {
            if (slope(corners) >= faces_up)
                each_point(corners, [&](Cell& there, double z) { use(there, static_cast<float>(z), material); });
        });
    };
    each_upward([](Cell& there, float z, std::uint32_t) {
        if (!(there.lowest_m <= z))
            there.lowest_m = there.height_m = z;
    });
    bool any_road = false; // of what lies on the lowest, as a pavement does, the uppermost
    each_upward([&](Cell& there, float z, std::uint32_t material) {
        if (z >= there.height_m && z < there.lowest_m + static_cast<float>(low_m)) {
            there.height_m = z;
            there.road = named_road(scene.materials[material].name);
            any_road = any_road || there.road;
        }
    });
    for (Cell& there : cells_)
        there.road = there.road || !any_road;
}

void SceneGround::add_obstacles(const Scene& scene) {
    each_triangle(scene, [&](const glm::dvec3(&corners)[3], std::uint32_t) {
        each_point(corners, [&](Cell& there, double z) {
            const double above = z - static_cast<double>(there.height_m);
            there.blocked = there.blocked || (above > low_m && above < high_m);
        });
    });
}

std::optional<double> SceneGround::height_m(double x_m, double y_m) const {
    const auto there = index(x_m, y_m);
    return there && std::isfinite(cells_[*there].height_m) ? std::optional(static_cast<double>(cells_[*there].height_m)) : std::nullopt;
}

bool SceneGround::is_free(double x_m, double y_m) const {
    const auto there = index(x_m, y_m);
    return there && std::isfinite(cells_[*there].height_m) && !cells_[*there].blocked;
}

double SceneGround::free_way_m(double x_m, double y_m, double yaw_rad) const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    std::optional<double> before;
    for (double ahead = -behind_m; ahead <= farthest_m; ahead += cell_m_) {
        for (double left = -half_width_m; left <= half_width_m; left += cell_m_)
            if (!is_free(x_m + ahead * c - left * s, y_m + ahead * s + left * c))
                return std::max(ahead - cell_m_, 0.0);
        const std::optional<double> here = height_m(x_m + ahead * c, y_m + ahead * s);
        if (before && std::abs(*here - *before) > kerb_m)
            return std::max(ahead - cell_m_, 0.0);
        before = here;
    }
    return farthest_m;
}

std::optional<Pose> SceneGround::car_at(double x_m, double y_m, double yaw_rad) const {
    const std::optional<double> rear = height_m(x_m, y_m),
                                front = height_m(x_m + wheelbase_m * std::cos(yaw_rad), y_m + wheelbase_m * std::sin(yaw_rad));
    if (!rear)
        return std::nullopt;
    const double rise = front && std::abs(*front - *rear) < 0.5 * wheelbase_m ? *front - *rear : 0.0;
    return Pose{{x_m, y_m, *rear}, axes_from_angles(yaw_rad, std::atan(rise / wheelbase_m), 0.0)};
}

std::optional<Pose> SceneGround::longest_free_way() const {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (cells_[i].road && !cells_[i].blocked && std::isfinite(cells_[i].height_m))
            places.push_back(i);
    const std::size_t stride = places.size() / most_places + 1;
    const auto columns = static_cast<std::size_t>(std::max(across_, 1));
    double best = 0.0, nearest = 0.0;
    std::optional<Pose> found;
    for (std::size_t p = 0; p < places.size(); p += stride) {
        const std::size_t column = places[p] % columns, row = places[p] / columns;
        const double across = (static_cast<double>(column) + 0.5) * cell_m_, along = (static_cast<double>(row) + 0.5) * cell_m_;
        const double from_middle = std::hypot(across - 0.5 * across_ * cell_m_, along - 0.5 * along_ * cell_m_);
        for (int h = 0; h < headings; ++h) {
            const double yaw = 2.0 * pi * h / headings, way = free_way_m(low_x_m_ + across, low_y_m_ + along, yaw);
            if (way > best || (way == best && found && from_middle < nearest)) {
                best = way;
                nearest = from_middle;
                found = car_at(low_x_m_ + across, low_y_m_ + along, yaw);
            }
        }
    }
    return found;
}

void SceneGround::mark_ground(Scene& scene) const {
    std::map<std::uint32_t, std::uint32_t> as_ground; // a material's copy
    std::vector<Mesh> meshes;                         // maps show a mesh or do not
    for (const Mesh& mesh : scene.meshes)
        for (const bool ground : {false, true}) {
            Mesh part = mesh;
            part.indices.clear();
            part.batches.clear();
            for (const Batch& batch : mesh.batches) {
                const auto first = static_cast<std::uint32_t>(part.indices.size());
                for (std::uint32_t i = batch.first; i + 2 < batch.first + batch.count; i += 3) {
                    glm::dvec3 c[3];
                    for (std::uint32_t k = 0; k < 3; ++k)
                        c[k] = mesh.origin_m + glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_m);
                    const glm::dvec3 middle = (c[0] + c[1] + c[2]) / 3.0;
                    const std::optional<double> below = height_m(middle.x, middle.y);
                    if ((slope(c) > faces_up && below && std::abs(middle.z - *below) < low_m) == ground)
                        part.indices.insert(part.indices.end(), mesh.indices.begin() + i, mesh.indices.begin() + i + 3);
                }
                if (part.indices.size() == first)
                    continue;
                std::uint32_t material = batch.material;
                if (ground) {
                    const auto [copy, fresh] = as_ground.try_emplace(batch.material, static_cast<std::uint32_t>(scene.materials.size()));
                    if (fresh) {
                        scene.materials.push_back(scene.materials[batch.material]);
                        scene.materials.back().kind = SurfaceKind::terrain;
                    }
                    material = copy->second;
                }
                part.batches.push_back({material, first, static_cast<std::uint32_t>(part.indices.size()) - first});
            }
            if (!part.batches.empty())
                meshes.push_back(std::move(part));
        }
    scene.meshes = std::move(meshes);
}

} // namespace fernlicht
