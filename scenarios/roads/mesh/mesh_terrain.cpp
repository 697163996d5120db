#include "scenarios/roads/mesh/mesh_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace fernlicht {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double below_road_m = 0.05;
constexpr double storey_m = 4.0; ///< a road that much lower passes under a bridge
constexpr double inside_of_radius = 0.8;
constexpr double widening_per_m = 1.5;
constexpr double longest_terrain_cell_m = 8.0;
constexpr double widest_turn_rad = 0.15;

/// Drop of the ground below the road's edge: a verge at 6 %, a shallow ditch side, then level.
struct Column {
    double out_m, drop_m;
};
constexpr double verge_m = 1.5, ditch_end_m = 5.0;

/// A ditch in the second column: below the ground without it, in shares of its depth. Its floor is 0.5 m wide, its slopes are 1 : 1.5:
/// ours, not measured.
constexpr double ditch_depth_m = 0.5;
constexpr std::array<Column, 6> ditch_profile{Column{verge_m, 0.0}, {2.25, 0.0}, {3.0, 1.0}, {3.5, 1.0}, {4.25, 0.0}, {ditch_end_m, 0.0}};

std::array<Column, 5> columns(double width) {
    return {Column{0.0, 0.0}, Column{std::min(verge_m, width), 0.09}, Column{std::min(ditch_end_m, width), 0.35},
            Column{std::min(12.0, width), 0.45}, Column{width, 0.45}};
}

/// One point of the road's outer edge.
struct EdgePoint {
    double s_m = 0.0;
    glm::dvec3 position_m;
    double cap_m = unlimited; ///< greatest height allowed here
};

/// Where the ground is cut across: an edge point and the points outwards from it.
struct Rib {
    std::size_t edge = 0; ///< into the edge points
    double s_m = 0.0, t_m = 0.0;
    std::size_t chunk = 0; ///< of the stretch that ends here
    bool begins = false;   ///< nothing lies before it
    double width_m = 0.0;
    glm::dvec3 outward{0.0}, forward{0.0}; ///< horizontal
    double grade = 0.0;                    ///< rise along the road
    std::array<glm::dvec3, 5> points_m = {};
    std::array<double, 5> cap_m{unlimited, unlimited, unlimited, unlimited, unlimited};
};

class Side {
  public:
    Side(const SurfacePlan& plan, std::size_t road_index, const SurfaceRows& surface, bool left, const RoadMeshOptions& options)
        : plan_(plan), road_index_(road_index), left_(left), options_(options) {
        for (std::size_t i = 0; i < plan.stretches.size(); ++i)
            if (!surface.empty(i))
                follow(surface, i);
        place(options.verge_width_m);
    }

    void fit(const Footprints& footprints) {
        for (std::size_t i = 0; i + 1 < ribs_.size(); ++i) {
            if (ribs_[i + 1].begins)
                continue;
            for (std::size_t k = 0; k < 4; ++k) {
                const double cap = allowed(footprints, i, k, open_[i][k]);
                if (cap == unlimited)
                    continue;
                for (std::size_t rib : {i, i + 1})
                    for (std::size_t column : {k, k + 1})
                        ribs_[rib].cap_m[column] = std::min(ribs_[rib].cap_m[column], cap);
                if (k == 0)
                    for (std::size_t e = ribs_[i].edge; e <= ribs_[i + 1].edge; ++e)
                        edge_[e].cap_m = std::min(edge_[e].cap_m, cap);
            }
        }
    }

    void append(Scene& scene) {
        dig();
        std::optional<Chunk> chunk;
        for (std::size_t i = 0; i + 1 < ribs_.size(); ++i) {
            if (ribs_[i + 1].begins)
                continue;
            if (!chunk || ribs_[i].begins || ribs_[i + 1].chunk != ribs_[i].chunk) {
                if (chunk)
                    chunk->add_to(scene);
                const auto stretch = std::ranges::find(plan_.stretches, ribs_[i + 1].chunk, &RoadStretch::chunk);
                const std::string name = chunk_name(left_ ? "left of road" : "right of road", plan_,
                                                    static_cast<std::size_t>(stretch - plan_.stretches.begin()));
                chunk = Chunk{MeshBuilder(name, ribs_[i].points_m[0]), MeshBuilder("ditch " + name, ribs_[i].points_m[0]),
                              MeshBuilder("over the ditch " + name, ribs_[i].points_m[0])};
            }
            for (std::size_t k = 0; k < 4; ++k)
                if (!open_[i][k])
                    append_cell(k == 1 && ditch_[i] ? chunk->over_ditch : chunk->ground, i, k);
            if (ditch_[i])
                append_ditch(chunk->ditch, i);
        }
        if (chunk)
            chunk->add_to(scene);
    }

  private:
    /// Views show the ditch, maps measure the ground as it would be without one.
    struct Chunk {
        MeshBuilder ground, ditch, over_ditch;

        void add_to(Scene& scene) {
            std::move(ground).add_to(scene);
            const std::size_t first = scene.meshes.size();
            std::move(ditch).add_to(scene); // casts nothing: its rims lie in the ground that is measured
            const std::size_t measured = scene.meshes.size();
            std::move(over_ditch).add_to(scene);
            for (std::size_t i = first; i < scene.meshes.size(); ++i) {
                scene.meshes[i].casts = false;
                scene.meshes[i].measured_alone = i >= measured;
            }
        }
    };

    /// Decides between which ribs there is a ditch: of whole width, where no other road comes near.
    void dig() {
        ditch_.resize(ribs_.size());
        for (std::size_t i = 0; options_.ditch && i + 1 < ribs_.size(); ++i) {
            const auto fits = [](const Rib& rib) {
                return rib.width_m >= ditch_end_m && rib.cap_m[1] == unlimited && rib.cap_m[2] == unlimited;
            };
            if (!ribs_[i + 1].begins && !open_[i][1] && fits(ribs_[i]) && fits(ribs_[i + 1]))
                ditch_[i] = options_.ditch(*plan_.road, left_, ribs_[i].s_m, ribs_[i + 1].s_m);
        }
    }

    /// From rim to rim at a rib; it comes up where a ditch ends.
    std::array<std::pair<glm::dvec3, glm::dvec3>, ditch_profile.size()> ditch_at(std::size_t i) const {
        const Rib& rib = ribs_[i];
        const double depth = i > 0 && ditch_[i - 1] && ditch_[i] ? ditch_depth_m : 0.0;
        std::array<glm::dvec2, ditch_profile.size()> out; ///< and down
        std::array<std::pair<glm::dvec3, glm::dvec3>, ditch_profile.size()> points;
        for (std::size_t k = 0; k < out.size(); ++k) {
            const double along = (ditch_profile[k].out_m - verge_m) / (ditch_end_m - verge_m);
            points[k].first = glm::mix(rib.points_m[1], rib.points_m[2], along) - glm::dvec3(0.0, 0.0, depth * ditch_profile[k].drop_m);
            out[k] = {ditch_profile[k].out_m, rib.points_m[1].z - points[k].first.z};
        }
        // Grass lets light through: what faces away from the road is as bright as the ground would be.
        const double fall = (rib.points_m[1].z - rib.points_m[2].z) / (ditch_end_m - verge_m);
        for (std::size_t k = 0; k < out.size(); ++k) {
            const glm::dvec2 way = out[std::min(k + 1, out.size() - 1)] - out[k == 0 ? 0 : k - 1];
            points[k].second =
                glm::normalize(glm::dvec3(0.0, 0.0, 1.0) + std::min(way.y / way.x, fall) * rib.outward - rib.grade * rib.forward);
        }
        return points;
    }

    void append_ditch(MeshBuilder& builder, std::size_t i) const {
        const auto a = ditch_at(i), b = ditch_at(i + 1);
        for (std::size_t k = 0; k + 1 < a.size(); ++k) {
            triangle(builder, *ditch_[i], {a[k].first, b[k].first, a[k + 1].first}, {a[k].second, b[k].second, a[k + 1].second});
            triangle(builder, *ditch_[i], {b[k].first, b[k + 1].first, a[k + 1].first}, {b[k].second, b[k + 1].second, a[k + 1].second});
        }
    }

    bool is_wider(std::size_t a, std::size_t b) const { return left_ ? a > b : a < b; }
    /// The point of the road's edge in a row, as a stretch beside it has it.
    std::size_t outermost(const std::vector<Range>& strips) const { return left_ ? strips.back().last : strips.front().first; }
    glm::dvec3 lowered(const glm::dvec3& p, double cap) const { return {p.x, p.y, std::min(p.z, cap)}; }

    void add_edge(const Row& row, const RowPoint& point) {
        if (edge_.empty() || edge_.back().position_m != point.pose.position_m)
            edge_.push_back({row.s_m, point.pose.position_m, unlimited});
    }

    void add_rib(const Row& row, const RowPoint& point, std::size_t chunk, bool always) {
        Rib rib{.edge = edge_.size() - 1, .s_m = row.s_m, .t_m = point.t_m, .chunk = chunk};
        const glm::dvec3 forward = point.pose.forward();
        const double level = std::hypot(forward.x, forward.y);
        rib.grade = level > 1e-6 ? forward.z / level : 0.0;
        const double heading = std::atan2(forward.y, forward.x);
        rib.forward = {std::cos(heading), std::sin(heading), 0.0};
        rib.outward = (left_ ? 1.0 : -1.0) * glm::dvec3(-rib.forward.y, rib.forward.x, 0.0);
        const bool far = ribs_.empty() || rib.s_m - ribs_.back().s_m >= longest_terrain_cell_m ||
                         glm::dot(rib.forward, ribs_.back().forward) < std::cos(widest_turn_rad);
        if (always || far)
            ribs_.push_back(rib);
    }

    /// Walks along the edge; where the road gets wider or narrower at a station, along the row's own points. The rib of such a station
    /// starts at the wider of both, so that the ground joins the end of the wider row as well.
    void follow(const SurfaceRows& surface, std::size_t i) {
        const Row& from = surface.rows[i];
        const Row& to = surface.rows[i + 1];
        const std::size_t edge_from = outermost(surface.ends[i].from), edge_to = outermost(surface.ends[i].to);
        const std::size_t chunk = plan_.stretches[i].chunk;
        if (i == 0 || surface.empty(i - 1)) {
            add_edge(from, from.points[edge_from]);
            add_rib(from, from.points[edge_from], chunk, true);
            ribs_.back().begins = true;
        } else {
            const std::size_t before = outermost(surface.ends[i - 1].to);
            append_step(from, before, edge_from);
            if (is_wider(edge_from, before))
                add_rib(from, from.points[edge_from], plan_.stretches[i - 1].chunk, true);
        }
        add_edge(to, to.points[edge_to]);
        const bool last = i + 1 == plan_.stretches.size() || surface.empty(i + 1);
        const std::size_t after = last ? edge_to : outermost(surface.ends[i + 1].from);
        if (!is_wider(after, edge_to))
            add_rib(to, to.points[edge_to], chunk, last || plan_.stretches[i + 1].chunk != chunk || after != edge_to);
    }

    /// The points of a row from the edge before it to the edge after it.
    void append_step(const Row& row, std::size_t before, std::size_t after) {
        for (std::size_t k = before; k < after; ++k)
            add_edge(row, row.points[k + 1]);
        for (std::size_t k = before; k > after; --k)
            add_edge(row, row.points[k - 1]);
    }

    void place(double verge_width) {
        const Road& road = *plan_.road;
        for (Rib& rib : ribs_) {
            const double a = std::max(0.0, rib.s_m - 0.5), b = std::min(road.length_m, rib.s_m + 0.5);
            const glm::dvec3 before = plan_pose(road, a).forward(), after = plan_pose(road, b).forward();
            const double turn = std::atan2(before.x * after.y - before.y * after.x, before.x * after.x + before.y * after.y);
            const double curvature = b > a ? turn / (b - a) : 0.0; // left positive
            const double towards = left_ ? curvature : -curvature;
            rib.width_m = verge_width;
            if (towards > 1e-6)
                rib.width_m = std::clamp(inside_of_radius / towards - (left_ ? rib.t_m : -rib.t_m), 0.0, verge_width);
        }
        for (std::size_t i = 1; i < ribs_.size(); ++i)
            ribs_[i].width_m = std::min(ribs_[i].width_m, ribs_[i - 1].width_m + widening_per_m * (ribs_[i].s_m - ribs_[i - 1].s_m));
        for (std::size_t i = ribs_.size(); i-- > 1;)
            ribs_[i - 1].width_m = std::min(ribs_[i - 1].width_m, ribs_[i].width_m + widening_per_m * (ribs_[i].s_m - ribs_[i - 1].s_m));
        for (Rib& rib : ribs_) {
            const std::array<Column, 5> all = columns(rib.width_m);
            for (std::size_t k = 0; k < 5; ++k)
                rib.points_m[k] =
                    edge_[rib.edge].position_m + all[k].out_m * rib.outward - glm::dvec3(0.0, 0.0, k == 0 ? 0.0 : all[k].drop_m);
        }
        open_.assign(ribs_.size(), {false, false, false, false});
    }

    PlanQuad cell(std::size_t rib, std::size_t column) const {
        const Rib& a = ribs_[rib];
        const Rib& b = ribs_[rib + 1];
        return ground_between({a.points_m[column], b.points_m[column], b.points_m[column + 1], a.points_m[column + 1]});
    }

    /// The height that keeps the cell below every other road it lies under or over; `open` if one passes far below.
    double allowed(const Footprints& footprints, std::size_t rib, std::size_t column, bool& open) const {
        const PlanQuad ground = cell(rib, column);
        double cap = unlimited;
        footprints.near(ground, [&](const RoadFootprint& other) {
            if (other.all.lowest_m > ground.highest_m + below_road_m ||
                footprints.continues(road_index_, ribs_[rib].s_m, ribs_[rib + 1].s_m, other) || !overlap(ground, other.all, 0.01))
                return;
            if (other.all.highest_m < ground.lowest_m - storey_m)
                open = true;
            else
                cap = std::min(cap, other.all.lowest_m - below_road_m);
        });
        return cap;
    }

    glm::dvec3 normal(const Rib& rib, std::size_t column) const {
        const std::array<Column, 5> all = columns(rib.width_m);
        const std::size_t inner = column == 0 ? 0 : column - 1, outer = column == 0 ? 1 : column;
        const double width = all[outer].out_m - all[inner].out_m;
        const double fall = width > 0.01 ? (all[outer].drop_m - all[inner].drop_m) / width : 0.0;
        return glm::normalize(glm::dvec3(0.0, 0.0, 1.0) + fall * rib.outward - rib.grade * rib.forward);
    }

    /// Counter-clockwise for the left side, turned round for the right. What would lie upside down (a fold) is left out.
    void triangle(MeshBuilder& builder, std::uint32_t material, const std::array<glm::dvec3, 3>& p,
                  const std::array<glm::dvec3, 3>& n) const {
        const glm::dvec3 normal = (left_ ? 1.0 : -1.0) * glm::cross(p[1] - p[0], p[2] - p[0]);
        if (normal.z <= 1e-6)
            return;
        std::array<std::uint32_t, 3> v{};
        for (std::size_t i = 0; i < 3; ++i)
            v[i] = builder.vertex(p[i], n[i]);
        if (left_)
            builder.triangle(material, v[0], v[1], v[2]);
        else
            builder.triangle(material, v[0], v[2], v[1]);
    }

    void append_cell(MeshBuilder& builder, std::size_t i, std::size_t k) const {
        const Rib& a = ribs_[i];
        const Rib& b = ribs_[i + 1];
        const std::uint32_t material = options_.ground ? options_.ground(*plan_.road, left_, a.s_m, columns(unlimited)[k].out_m)
                                                       : index_of(k == 0 ? RoadMaterial::verge : RoadMaterial::terrain);
        const glm::dvec3 a_out = lowered(a.points_m[k + 1], a.cap_m[k + 1]), b_out = lowered(b.points_m[k + 1], b.cap_m[k + 1]);
        const glm::dvec3 na = normal(a, k), nb = normal(b, k), na_out = normal(a, k + 1), nb_out = normal(b, k + 1);
        if (k > 0) {
            const glm::dvec3 a_in = lowered(a.points_m[k], a.cap_m[k]), b_in = lowered(b.points_m[k], b.cap_m[k]);
            triangle(builder, material, {a_in, b_in, a_out}, {na, nb, na_out});
            triangle(builder, material, {b_in, b_out, a_out}, {nb, nb_out, na_out});
            return;
        }
        // The verge meets every vertex of the road's edge: a fan to the near rib's point up to the middle, then to the far one's.
        const std::size_t middle = a.edge + (b.edge - a.edge + 1) / 2;
        const auto edge = [&](std::size_t e) { return lowered(edge_[e].position_m, edge_[e].cap_m); };
        for (std::size_t e = a.edge; e < middle; ++e)
            triangle(builder, material, {edge(e), edge(e + 1), a_out}, {na, e + 1 == b.edge ? nb : na, na_out});
        triangle(builder, material, {edge(middle), b_out, a_out}, {middle == b.edge ? nb : na, nb_out, na_out});
        for (std::size_t e = middle; e < b.edge; ++e)
            triangle(builder, material, {edge(e), edge(e + 1), b_out}, {na, nb, nb_out});
    }

    const SurfacePlan& plan_;
    std::size_t road_index_;
    bool left_;
    const RoadMeshOptions& options_;
    std::vector<EdgePoint> edge_;
    std::vector<Rib> ribs_;
    std::vector<std::array<bool, 4>> open_;           ///< cells that are left out
    std::vector<std::optional<std::uint32_t>> ditch_; ///< its material, from a rib to the next
};

constexpr double far_beyond_m = 2500.0, far_below_m = 0.5;
constexpr double far_tile_m = 500.0;    // small enough to be culled
constexpr double max_far_tiles = 250.0; // each way; larger then

} // namespace

double ground_drop_m(double out_m) {
    const std::array<Column, 5> all = columns(unlimited);
    for (std::size_t k = 1; k + 1 < all.size(); ++k)
        if (out_m < all[k].out_m)
            return all[k - 1].drop_m +
                   (all[k].drop_m - all[k - 1].drop_m) * std::max(0.0, out_m - all[k - 1].out_m) / (all[k].out_m - all[k - 1].out_m);
    return all.back().drop_m;
}

void append_terrain(Scene& scene, const SurfacePlan& plan, std::size_t road_index, const SurfaceRows& surface, const Footprints& footprints,
                    const RoadMeshOptions& options) {
    if (!(options.verge_width_m > 0.0))
        return;
    for (const bool left : {false, true}) {
        Side side(plan, road_index, surface, left, options);
        side.fit(footprints);
        side.append(scene);
    }
}

void add_far_ground(Scene& scene) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Mesh& mesh : scene.meshes)
        for (const Vertex& vertex : mesh.vertices) {
            low = glm::min(low, mesh.origin_m + glm::dvec3(vertex.position_m));
            high = glm::max(high, mesh.origin_m + glm::dvec3(vertex.position_m));
        }
    if (!(low.x <= high.x))
        return;
    low -= far_beyond_m;
    high += far_beyond_m;
    const double z_m = low.z + far_beyond_m - far_below_m,
                 side_m = std::max(far_tile_m, std::max(high.x - low.x, high.y - low.y) / max_far_tiles);
    const std::vector<Material> known = road_materials();
    Material ground = *std::ranges::find(known, "terrain", &Material::name);
    ground.name = "far ground";
    ground.kind = SurfaceKind::object; // not in maps
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(std::move(ground));
    const auto half = static_cast<float>(0.5 * side_m);
    for (double x = low.x; x < high.x; x += side_m)
        for (double y = low.y; y < high.y; y += side_m) {
            Mesh tile;
            tile.name = fmt::format("far ground {:.0f} {:.0f}", x, y);
            tile.origin_m = glm::round(glm::dvec3(x + 0.5 * side_m, y + 0.5 * side_m, 0.0));
            const auto z = static_cast<float>(z_m);
            for (const auto& [dx, dy] : {std::pair(-half, -half), std::pair(half, -half), std::pair(half, half), std::pair(-half, half)})
                tile.vertices.push_back({{dx, dy, z}, {0.0F, 0.0F, 1.0F}});
            tile.indices = {0, 1, 2, 0, 2, 3};
            tile.batches = {{material, 0, 6}};
            tile.casts = false;
            scene.meshes.push_back(std::move(tile));
        }
}

} // namespace fernlicht
