// Invariants of the road mesh on our own roads and on every real file at hand.
#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/roads/mesh_checks.h"
#include "tests/scenarios/roads/opendrive_text.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <tuple>

namespace fernlicht {
namespace {

using namespace mesh_checks;
using namespace opendrive_text;

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void expect_well_formed(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        SCOPED_TRACE(mesh.name);
        std::size_t covered = 0;
        for (const Batch& batch : mesh.batches) {
            EXPECT_LT(batch.material, scene.materials.size());
            EXPECT_EQ(batch.first, covered) << "batches follow one another";
            covered += batch.count;
        }
        EXPECT_EQ(covered, mesh.indices.size());
        for (const std::uint32_t index : mesh.indices)
            ASSERT_LT(index, mesh.vertices.size());
        for (const Vertex& vertex : mesh.vertices) {
            ASSERT_TRUE(finite(vertex.position_m) && finite(vertex.normal));
            ASSERT_NEAR(glm::length(vertex.normal), 1.0F, 1e-5F);
            const glm::dvec3 world = mesh.origin_m + glm::dvec3(vertex.position_m);
            ASSERT_EQ(on_lattice(world), world) << "neighbouring meshes agree only on the lattice";
        }
    }
}

bool is_face(const Triangle& triangle) { return triangle.material == index_of(RoadMaterial::kerb); }

/// Counts of what must not be on a road's surface.
struct Faults {
    std::size_t downward = 0, turned = 0, without_area = 0;
};

Faults faults(const std::vector<Triangle>& surface) {
    Faults found;
    for (const Triangle& triangle : surface) {
        const glm::dvec3 across = triangle.cross();
        if (triangle.area() < 1e-7) { // 0.1 mm by 2 mm
            ++found.without_area;
            continue;
        }
        found.downward += !is_face(triangle) && across.z < -0.01 * glm::length(across) ? 1U : 0U;
        for (const glm::dvec3& normal : triangle.normals)
            if (glm::dot(across, normal) < 0.0) {
                ++found.turned;
                break;
            }
    }
    return found;
}

void expect_sound(const RoadNetwork& network, const Scene& scene) {
    for (const Road& road : network.roads) {
        SCOPED_TRACE("road " + road.id);
        const std::vector<Triangle> surface = triangles(scene, "road " + road.id + " s ");
        const Topology found = topology(surface);
        EXPECT_EQ(found.crowded_edges, 0U);
        EXPECT_EQ(found.euler, static_cast<std::int64_t>(found.parts)) << "a crack or a T-junction";
        const Faults wrong = faults(surface);
        EXPECT_EQ(std::tuple(wrong.downward, wrong.turned, wrong.without_area), std::tuple(0U, 0U, 0U));
    }
}

TEST(RoadMesh, LibraryRoadsAreSound) {
    const auto files = road_files(library_roads);
    ASSERT_GE(files.size(), 5U);
    for (const auto& file : files) {
        SCOPED_TRACE(file.filename());
        const RoadNetwork network = read_opendrive(file);
        EXPECT_TRUE(network.warnings.empty()) << network.warnings.front();
        const Scene scene = build_scene(network);
        expect_well_formed(scene);
        expect_sound(network, scene);
        const Scene tracked = build_scene(network, {.surface = {.wheel_tracks = true}});
        expect_well_formed(tracked);
        expect_sound(network, tracked);
        EXPECT_TRUE(std::ranges::any_of(tracked.meshes, [](const Mesh& mesh) {
            return std::ranges::any_of(mesh.batches,
                                       [](const Batch& batch) { return batch.material == index_of(track_material(track_levels - 1)); });
        }));
    }
}

// How far triangles lie from the surface that they stand for, measured through the inverse of surface_pose.

struct NearestPlace {
    double s_m = 0.0, t_m = 0.0;
    double off_surface_m = 0.0; ///< along the surface's normal, positive above
    bool found = false;
};

/// (s, t) under a point near the surface, by walking along the surface's own axes. Not found where that does not settle: beyond the
/// road's ends, and where the road is folded about the centre of a bend.
NearestPlace nearest_place(const RoadNetwork& network, const Road& road, const glm::dvec3& point, double s_m) {
    NearestPlace place{.s_m = s_m};
    for (int step = 0; step < 80; ++step) {
        const Pose pose = surface_pose(network, road, place.s_m, place.t_m);
        const glm::dvec3 miss = point - pose.position_m;
        const double along = glm::dot(miss, pose.forward()), across = glm::dot(miss, pose.left());
        place.off_surface_m = glm::dot(miss, pose.up());
        if (std::abs(along) < 1e-5 && std::abs(across) < 1e-5) {
            place.found = true;
            return place;
        }
        place.s_m = std::clamp(place.s_m + 0.6 * along, 0.0, road.length_m);
        place.t_m += across;
    }
    return place;
}

/// "road 12 s 120-180" -> 120 and 180.
std::pair<double, double> stations_of(const std::string& mesh_name) {
    const std::size_t at = mesh_name.rfind(" s ");
    const std::size_t dash = mesh_name.find('-', at);
    return {std::stod(mesh_name.substr(at + 3)), std::stod(mesh_name.substr(dash + 1))};
}

struct Distances {
    std::size_t samples = 0, lost = 0;
    double greatest_m = 0.0;
    glm::dvec3 where{0.0};
};

/// Samples every `stride`-th triangle of the mesh that is not a kerb's, at its middle and the middles of its sides.
Distances distances(const RoadNetwork& network, const Road& road, const Scene& scene, const Mesh& mesh, std::size_t stride) {
    Distances result;
    Scene one{.materials = scene.materials};
    one.meshes.push_back(mesh);
    const auto [from, to] = stations_of(mesh.name);
    std::vector<Pose> guides;
    const int steps = std::max(1, static_cast<int>(2.0 * (to - from)));
    for (int i = 0; i <= steps; ++i)
        guides.push_back(surface_pose(network, road, from + (to - from) * i / steps, 0.0));
    std::size_t count = 0;
    for (const Triangle& triangle : triangles(one, "")) {
        if (count++ % stride != 0 || triangle.material == index_of(RoadMaterial::kerb))
            continue;
        const auto& p = triangle.corners;
        for (const glm::dvec3& point : {(p[0] + p[1] + p[2]) / 3.0, (p[0] + p[1]) / 2.0, (p[1] + p[2]) / 2.0, (p[2] + p[0]) / 2.0}) {
            std::size_t nearest = 0;
            for (std::size_t i = 1; i < guides.size(); ++i)
                if (glm::distance(guides[i].position_m, point) < glm::distance(guides[nearest].position_m, point))
                    nearest = i;
            const NearestPlace place = nearest_place(network, road, point, from + (to - from) * static_cast<double>(nearest) / steps);
            ++result.samples;
            if (!place.found) {
                ++result.lost;
            } else if (std::abs(place.off_surface_m) > result.greatest_m) {
                result.greatest_m = std::abs(place.off_surface_m);
                result.where = point;
            }
        }
    }
    return result;
}

/// Roads whose last point is their first: their surface is a ring, whose Euler number is 0, and no disc.
bool closed(const RoadNetwork& network, const Road& road) {
    return glm::distance(surface_pose(network, road, 0.0, 0.0).position_m, surface_pose(network, road, road.length_m, 0.0).position_m) <
           0.01;
}

/// Files that are meant to be invalid; the reader's tests deal with them.
bool meant_to_fail(const std::filesystem::path& file) {
    const std::string path = file.string();
    return path.find("invalid") != std::string::npos || path.find("negative") != std::string::npos;
}

double greatest_distance_m(const RoadNetwork& network, const Scene& scene, std::size_t& samples, std::size_t stride = 1) {
    double worst = 0.0;
    for (const Road& road : network.roads) {
        const bool heights =
            std::ranges::any_of(road.sections, [](const LaneSection& section) { // kerbs stand above what is measured against
                return std::ranges::any_of(section.lanes, [](const Lane& lane) { return !lane.heights.empty(); });
            });
        for (const Mesh& mesh : scene.meshes)
            if (!heights && mesh.name.rfind("road " + road.id + " s ", 0) == 0) {
                const Distances found = distances(network, road, scene, mesh, stride);
                samples += found.samples - found.lost;
                worst = std::max(worst, found.greatest_m);
            }
    }
    return worst;
}

TEST(RoadMesh, ChordErrorIsKeptAndFollowsTheOption) {
    for (const auto& file : road_files(library_roads)) {
        SCOPED_TRACE(file.filename());
        const RoadNetwork network = read_opendrive(file);
        std::size_t samples = 0;
        EXPECT_LE(greatest_distance_m(network, build_scene(network), samples), 0.005);
        EXPECT_GT(samples, 1000U);
    }
    const RoadNetwork network = library_road("country.xodr");
    std::size_t samples = 0;
    RoadMeshOptions coarse, fine;
    coarse.chord_error_m = 0.05;
    fine.chord_error_m = 0.0005;
    const double coarse_m = greatest_distance_m(network, build_scene(network, coarse), samples);
    EXPECT_GT(coarse_m, 0.005) << "no finer than asked for";
    EXPECT_LE(coarse_m, 0.05);
    EXPECT_LE(greatest_distance_m(network, build_scene(network, fine), samples),
              0.0005 + 2e-5); // the lattice rounds by 15 micrometres an axis
}

/// Triangles of one kind found by where they lie in plan.
class PlanIndex {
  public:
    explicit PlanIndex(const std::vector<Triangle>& all) : all_(all) {
        for (std::uint32_t i = 0; i < all.size(); ++i) {
            const auto& p = all[i].corners;
            const glm::dvec3 low = glm::min(glm::min(p[0], p[1]), p[2]), high = glm::max(glm::max(p[0], p[1]), p[2]);
            for (std::int64_t x = tile(low.x); x <= tile(high.x); ++x)
                for (std::int64_t y = tile(low.y); y <= tile(high.y); ++y)
                    tiles_[{x, y}].push_back(i);
        }
    }
    /// The greatest height at (x, y) that is not above `ceiling`; -1e9 where there is none.
    double height_below(const glm::dvec3& at, double ceiling) const {
        double found = -1e9;
        const auto here = tiles_.find({tile(at.x), tile(at.y)});
        if (here == tiles_.end())
            return found;
        for (const std::uint32_t i : here->second) {
            const auto& p = all_[i].corners;
            const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0], d = at - p[0];
            const double area = a.x * b.y - a.y * b.x;
            if (std::abs(area) < 1e-9)
                continue;
            const double u = (d.x * b.y - d.y * b.x) / area, v = (a.x * d.y - a.y * d.x) / area, z = p[0].z + u * a.z + v * b.z;
            if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && z <= ceiling)
                found = std::max(found, z);
        }
        return found;
    }

  private:
    static std::int64_t tile(double v) { return static_cast<std::int64_t>(std::floor(v / 8.0)); }
    const std::vector<Triangle>& all_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> tiles_;
};

/// Points of road surfaces that ground lies on.
std::size_t buried_points(const Scene& scene, std::size_t& points) {
    std::vector<Triangle> ground = triangles(scene, "left of road");
    const std::vector<Triangle> right = triangles(scene, "right of road");
    ground.insert(ground.end(), right.begin(), right.end());
    const PlanIndex index(ground);
    std::size_t buried = 0;
    for (const Triangle& triangle : triangles(scene, "road ")) {
        const glm::dvec3 middle = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
        ++points;
        buried += index.height_below(middle, middle.z + 3.0) > middle.z + 0.002 ? 1U : 0U;
    }
    return buried;
}

TEST(RoadMesh, GroundLiesBelowEveryRoad) {
    for (const auto& file : road_files(library_roads)) {
        SCOPED_TRACE(file.filename());
        std::size_t points = 0;
        EXPECT_EQ(buried_points(build_scene(read_opendrive(file)), points), 0U);
        EXPECT_GT(points, 1000U);
    }
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

std::vector<std::filesystem::path> valid_shared_roads() {
    std::vector<std::filesystem::path> files = road_files(shared_roads);
    std::erase_if(files, [](const auto& file) { return meant_to_fail(file) || (sanitized && std::filesystem::file_size(file) > 100'000); });
    return files;
}

/// Surfaces that jump (an elevation record 1 or 2 m above the one before) or fold over themselves: no triangles can follow them.
bool jumps_or_folds(const std::filesystem::path& file) {
    static const std::set<std::string> names{"performance_avoid_redundant_info_elevation_valid.xodr",
                                             "performance_avoid_redundant_info_line_geometry_valid.xodr", "mixed_roads.xodr", "Town03.xodr",
                                             "slope_up_leaning_right.xodr"};
    return names.contains(file.filename().string());
}

/// Real files in four parts, so that they can be looked at in parallel. Under the sanitizers one of three, without the largest: the others
/// take the same paths, only more often.
class RealRoads : public testing::TestWithParam<std::size_t> {};

TEST_P(RealRoads, AreSoundKeepTheChordErrorAndStandAboveTheGround) {
    const auto files = valid_shared_roads();
    if (files.empty())
        GTEST_SKIP() << "no roads in " << shared_roads;
    for (std::size_t i = GetParam(); i < files.size(); i += sanitized ? 12 : 4) {
        SCOPED_TRACE(files[i].filename());
        RoadNetwork network;
        ASSERT_NO_THROW(network = read_opendrive(files[i]));
        const Scene scene = build_scene(network);
        expect_well_formed(scene);
        std::size_t triangle_count = 0, samples = 0, points = 0;
        double length_m = 0.0;
        for (const Mesh& mesh : scene.meshes)
            triangle_count += mesh.indices.size() / 3;
        for (const Road& road : network.roads)
            length_m += road.length_m;
        EXPECT_LT(static_cast<double>(triangle_count), 20000.0 + 130.0 * length_m);
        if (!jumps_or_folds(files[i])) {
            EXPECT_LE(greatest_distance_m(network, scene, samples, 5), 0.005);
        }
        const std::size_t buried = buried_points(scene, points);
        EXPECT_LE(static_cast<double>(buried), 0.001 * static_cast<double>(points)) << points;
        std::erase_if(network.roads, [&](const Road& road) { return closed(network, road); });
        expect_sound(network, scene);
    }
}
INSTANTIATE_TEST_SUITE_P(Shared, RealRoads, testing::Range<std::size_t>(0, 4));

TEST(RoadMesh, FarFromTheOriginNothingChanges) {
    RoadNetwork here = library_road("country.xodr");
    RoadNetwork there = here;
    const glm::dvec3 moved(680000.0, 5400000.0, 0.0); // UTM
    for (Road& road : there.roads)
        for (PlanElement& element : road.plan) {
            element.x_m += moved.x;
            element.y_m += moved.y;
        }
    const Scene a = build_scene(here), b = build_scene(there);
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        ASSERT_EQ(a.meshes[i].vertices.size(), b.meshes[i].vertices.size()) << a.meshes[i].name;
        for (std::size_t k = 0; k < a.meshes[i].vertices.size(); ++k) {
            const glm::dvec3 p = a.meshes[i].origin_m + glm::dvec3(a.meshes[i].vertices[k].position_m) + moved;
            const glm::dvec3 q = b.meshes[i].origin_m + glm::dvec3(b.meshes[i].vertices[k].position_m);
            ASSERT_LE(glm::distance(p, q), 6e-5) << a.meshes[i].name << ": more than one step of the lattice in each axis";
        }
    }
}

} // namespace
} // namespace fernlicht
