#include "renderer/gl/scene/scene_buffers.h"

#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numeric>
#include <tuple>

namespace fernlicht::gl {
namespace {

constexpr double cell_m = 256.0;
constexpr double flat_within_m = 1e-3;
constexpr double bridge_height_m = 3.0, bridge_beside_m = 60.0;

struct GpuVertex {
    glm::vec3 position_m, normal;
    std::uint32_t material;
    glm::vec2 uv;
};

struct GpuMaterial { // std430, as in scene.vert.glsl
    glm::vec4 albedo, emission, retro, blend, tint, gloss;
};

glm::vec3 shown(const glm::vec3& c, bool encoded) {
    const auto curve = [&](float v) { return encoded ? static_cast<float>(photometry::srgb_encoded(static_cast<double>(v))) : v; };
    return {curve(c.r), curve(c.g), curve(c.b)};
}

GpuMaterial packed(const Material& m, bool encoded) {
    return {{shown(m.albedo, encoded), m.retro_rl},
            {m.emission_cdm2, static_cast<float>(std::max(m.texture, 0))},
            {m.retro_reference_rad, 1.0F / m.retro_falloff_rad, m.texture < 0 ? 0.0F : 1.0F + static_cast<float>(m.texture_mode),
             gets_wet(m.kind) ? 1.0F : 0.0F},
            {shown(m.blend_colour, encoded), 0.0F},
            {glm::vec3(retro_tint(m)), 0.0F},
            {m.gloss, m.gloss_roughness, m.retro_wet, 0.0F}};
}

SurfaceClass class_of(const Material& m) {
    return {m.texture < 0 ? 0 : 1 + static_cast<int>(m.texture_mode),
            m.retro_rl > 0.0F,
            m.emission_cdm2 != glm::vec3(0.0F),
            false,
            is_tinted(m),
            m.gloss > 0.0F,
            m.retro_rl > 0.0F && m.retro_wet > 0.0F};
}

std::int64_t cell_of(double m) { return static_cast<std::int64_t>(std::floor(m / cell_m)); }

GroundTriangle ground_triangle(const std::array<glm::vec3, 3>& at, const std::array<glm::vec3, 3>& normals) {
    // The interpolated normal is at least as long as the least cosine to any unit vector, here the corners' mean.
    const glm::vec3 sum = normals[0] + normals[1] + normals[2];
    const float sum_length = std::max(glm::length(sum), 1e-3F);
    float least = 1.0F;
    for (const glm::vec3& n : normals)
        least = std::min(least, glm::dot(n, sum) / sum_length);
    least = std::max(least, 0.05F);
    GroundTriangle triangle{{at[0], at[1], at[2]}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 n = normals[i] / least;
        triangle.normals[i] = {n, std::min({glm::dot(n, at[0]), glm::dot(n, at[1]), glm::dot(n, at[2])})};
    }
    return triangle;
}

bool is_same_shape(const Mesh& a, const Mesh& b) {
    const auto same_vertex = [](const Vertex& p, const Vertex& q) {
        return p.position_m == q.position_m && p.normal == q.normal && p.uv == q.uv;
    };
    const auto same_batch = [](const Batch& p, const Batch& q) {
        return p.material == q.material && p.first == q.first && p.count == q.count;
    };
    return a.origin_m == b.origin_m && a.casts == b.casts && a.closed == b.closed && a.indices == b.indices &&
           std::ranges::equal(a.batches, b.batches, same_batch) && std::ranges::equal(a.vertices, b.vertices, same_vertex);
}

/// The root of `i` in a forest of parents, with the path halved on the way.
std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

} // namespace

SceneBuffers::SceneBuffers(Context& context, const Scene& scene, bool encoded, bool lit_by_cpu) : context_(context) {
    std::vector<GpuVertex> vertices;
    std::vector<GLuint> indices;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    std::vector<std::size_t> first_pieces;                                                ///< of each mesh
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> known_bodies; ///< meshes by vertices and indices
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t number = first_pieces.size();
        first_pieces.push_back(pieces_.size());
        if (mesh.body >= 0) {
            std::vector<std::size_t>& alike = known_bodies[{mesh.vertices.size(), mesh.indices.size()}];
            const auto same = std::ranges::find_if(alike, [&](std::size_t i) { return is_same_shape(scene.meshes[i], mesh); });
            if (same != alike.end()) { // drawn from the same vertices
                for (std::size_t k = first_pieces[*same]; k < first_pieces[*same + 1]; ++k) {
                    Piece piece = pieces_[k];
                    piece.body = mesh.body;
                    piece.mesh = static_cast<std::uint32_t>(number);
                    resting_.emplace_back(static_cast<std::uint32_t>(pieces_.size()), piece);
                    pieces_.push_back(std::move(piece));
                }
                continue;
            }
            alike.push_back(number);
        }
        std::map<SurfaceClass, std::vector<std::pair<std::uint32_t, std::uint32_t>>> by_class; ///< corners: vertex of the mesh, material
        bool ground = true;
        for (const Batch& batch : mesh.batches) {
            const Material& material = scene.materials.at(batch.material);
            ground = ground && is_ground(material.kind);
            SurfaceClass surface = class_of(material);
            surface.moving = mesh.body >= 0;
            auto& corners = by_class[surface];
            for (std::uint32_t k = batch.first; k < batch.first + batch.count; ++k)
                corners.emplace_back(mesh.indices.at(k), batch.material);
        }
        ground = ground && mesh.body < 0;
        for (const auto& [surface, corners] : by_class) {
            if (corners.empty())
                continue;
            Piece piece;
            piece.origin_m = mesh.origin_m;
            piece.surface = surface;
            piece.ground = ground;
            piece.casts = mesh.casts;
            piece.closed = mesh.closed;
            piece.measured_alone = mesh.measured_alone;
            piece.body = mesh.body;
            piece.mesh = static_cast<std::uint32_t>(&mesh - scene.meshes.data());
            piece.first_index = static_cast<GLuint>(indices.size());
            piece.index_count = static_cast<GLuint>(corners.size());
            piece.base_vertex = static_cast<GLint>(vertices.size());
            // A vertex is copied for each material that uses it, so that the material can travel with it.
            std::map<std::pair<std::uint32_t, std::uint32_t>, GLuint> copied;
            glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
            std::vector<bool> is_last; ///< of a triangle, by vertex of the piece
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const auto& corner = corners[k];
                const bool ends = lit_by_cpu && k % 3 == 2;
                auto [it, fresh] = copied.try_emplace(corner, static_cast<GLuint>(is_last.size()));
                if (ends && !fresh && is_last[it->second]) {
                    it->second = static_cast<GLuint>(is_last.size());
                    fresh = true;
                }
                if (fresh) {
                    is_last.push_back(false);
                    const Vertex& vertex = mesh.vertices.at(corner.first);
                    vertices.push_back({vertex.position_m, vertex.normal, corner.second, vertex.uv});
                    piece.min_up = std::min(piece.min_up, static_cast<double>(vertex.normal.z));
                    low = glm::min(low, glm::dvec3(vertex.position_m));
                    high = glm::max(high, glm::dvec3(vertex.position_m));
                }
                indices.push_back(it->second);
                if (ends) {
                    is_last[it->second] = true;
                    const auto before = [&](std::size_t back) {
                        return indices[indices.size() - back] + static_cast<std::uint32_t>(piece.base_vertex);
                    };
                    surfaces_.others.resize(vertices.size());
                    surfaces_.others[before(1)] = {before(3), before(2)};
                }
            }
            piece.vertex_count = static_cast<GLuint>(is_last.size());
            piece.centre_m = 0.5 * (low + high);
            piece.radius_m = 0.5 * glm::length(high - low);
            piece.lowest_m = mesh.origin_m.z + low.z;
            piece.highest_m = mesh.origin_m.z + high.z;
            lowest = std::min(lowest, piece.lowest_m);
            highest = std::max(highest, piece.highest_m);
            piece.first_plane = planes_.size();
            for (std::size_t k = 0; ground && k + 2 < corners.size(); k += 3) {
                const auto at = [&, &of = corners](std::size_t i) { return mesh.vertices[of[k + i].first].position_m; };
                const glm::vec3 n = glm::cross(at(1) - at(0), at(2) - at(0));
                if (const float length = glm::length(n); length > 0.0F) {
                    planes_.emplace_back(n / length, -glm::dot(n / length, at(0)));
                    ground_.push_back(ground_triangle({at(0), at(1), at(2)},
                                                      {mesh.vertices[corners[k].first].normal, mesh.vertices[corners[k + 1].first].normal,
                                                       mesh.vertices[corners[k + 2].first].normal}));
                }
            }
            piece.planes = planes_.size() - piece.first_plane;
            std::vector<glm::dvec3> places;
            for (const auto& corner : corners)
                places.emplace_back(mesh.vertices[corner.first].position_m);
            piece.corners_m = box_round(places);
            // A car is one.
            piece.bodies_m = ground || mesh.body >= 0 || mesh.whole ? std::vector{piece.corners_m} : boxes_round_bodies(places);
            if (std::find(classes_.begin(), classes_.end(), surface) == classes_.end())
                classes_.push_back(surface);
            const glm::dvec3 centre = piece.origin_m + piece.centre_m;
            if (piece.body >= 0) {
                resting_.emplace_back(static_cast<std::uint32_t>(pieces_.size()), piece);
            } else {
                cells_[{cell_of(centre.x), cell_of(centre.y)}].push_back(static_cast<std::uint32_t>(pieces_.size()));
                largest_radius_m_ = std::max(largest_radius_m_, piece.radius_m);
            }
            pieces_.push_back(piece);
        }
    }
    if (lit_by_cpu)
        for (const GpuVertex& v : vertices)
            surfaces_.corners.push_back({v.position_m, v.normal, v.material});
    flat_ = resting_.empty() && (pieces_.empty() || highest - lowest < flat_within_m);
    find_bridges();
    std::vector<GpuMaterial> materials;
    for (const Material& material : scene.materials)
        materials.push_back(packed(material, encoded));

    vertices_ = make_buffer(context, vertices);
    indices_ = make_buffer(context, indices);
    materials_ = make_buffer(context, materials);
    layout_ = make_vertex_array(context);
    const GladGLContext& gl = context.gl;
    gl.VertexArrayVertexBuffer(layout_, 0, vertices_, 0, sizeof(GpuVertex));
    gl.VertexArrayElementBuffer(layout_, indices_);
    gl.VertexArrayBindingDivisor(layout_, 1, 1);
    const auto attribute = [&](GLuint location, GLint size, std::size_t offset, GLuint binding) {
        gl.EnableVertexArrayAttrib(layout_, location);
        gl.VertexArrayAttribFormat(layout_, location, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
        gl.VertexArrayAttribBinding(layout_, location, binding);
    };
    attribute(0, 3, offsetof(GpuVertex, position_m), 0);
    attribute(1, 3, offsetof(GpuVertex, normal), 0);
    attribute(3, 4, 0, 1);
    attribute(4, 2, offsetof(GpuVertex, uv), 0);
    gl.EnableVertexArrayAttrib(layout_, 2);
    gl.VertexArrayBindingDivisor(layout_, 2, 1);
    gl.VertexArrayAttribFormat(layout_, 5, 4, GL_FLOAT, GL_FALSE, offsetof(PieceExtra, turn));
    gl.VertexArrayAttribBinding(layout_, 5, 2);
    gl.VertexArrayAttribIFormat(layout_, 6, 4, GL_UNSIGNED_INT, offsetof(PieceExtra, traffic));
    gl.VertexArrayAttribBinding(layout_, 6, 2);
    gl.VertexArrayAttribIFormat(layout_, 2, 1, GL_UNSIGNED_INT, offsetof(GpuVertex, material));
    gl.VertexArrayAttribBinding(layout_, 2, 0);
    textures_ = upload_surface_textures(context, scene.textures, encoded, texture_bytes_);
    context.check("uploading the scene");
}

bool SceneBuffers::has(bool (*property)(const SurfaceClass&)) const { return std::any_of(classes_.begin(), classes_.end(), property); }

std::vector<glm::vec3> SceneBuffers::corners_of(const Piece& piece) const {
    const GladGLContext& gl = context_.gl;
    std::vector<GLuint> indices(piece.index_count);
    gl.GetNamedBufferSubData(indices_, static_cast<GLintptr>(piece.first_index * sizeof(GLuint)),
                             static_cast<GLsizeiptr>(indices.size() * sizeof(GLuint)), indices.data());
    std::vector<GpuVertex> vertices(indices.empty() ? 0 : *std::ranges::max_element(indices) + std::size_t{1});
    gl.GetNamedBufferSubData(vertices_, static_cast<GLintptr>(static_cast<std::size_t>(piece.base_vertex) * sizeof(GpuVertex)),
                             static_cast<GLsizeiptr>(vertices.size() * sizeof(GpuVertex)), vertices.data());
    context_.check("reading back a piece");
    std::vector<glm::vec3> corners;
    for (const GLuint i : indices)
        corners.push_back(vertices[i].position_m);
    return corners;
}

const std::vector<std::uint32_t>& SceneBuffers::near(const glm::dvec3& ego_m) const {
    const Cell here{cell_of(ego_m.x), cell_of(ego_m.y)};
    if (near_cell_ == here)
        return near_;
    near_cell_ = here;
    near_.clear();
    const auto cells = static_cast<std::int64_t>(std::ceil((farthest_drawn_m + largest_radius_m_) / cell_m)) + 1;
    for (auto column = cells_.lower_bound({here.first - cells, std::numeric_limits<std::int64_t>::min()});
         column != cells_.end() && column->first.first <= here.first + cells; ++column)
        if (std::abs(column->first.second - here.second) <= cells)
            near_.insert(near_.end(), column->second.begin(), column->second.end());
    std::ranges::sort(near_);
    for (const auto& [index, piece] : resting_)
        if (static_cast<std::size_t>(piece.body) < bodies_.size() && bodies_[static_cast<std::size_t>(piece.body)].visible)
            near_.push_back(index);
    return near_;
}

void SceneBuffers::place(const std::vector<Body>& bodies) {
    if (resting_.empty())
        return;
    const auto same = [](const Body& a, const Body& b) { return a.pose == b.pose && a.visible == b.visible; };
    if (bodies_.size() == bodies.size() && std::ranges::equal(bodies_, bodies, same))
        return;
    bodies_ = bodies;
    near_cell_.reset();
    ++placed_;
    for (const auto& [index, resting] : resting_) {
        if (static_cast<std::size_t>(resting.body) >= bodies.size())
            continue;
        const Pose& pose = bodies[static_cast<std::size_t>(resting.body)].pose;
        Piece& piece = pieces_[index];
        const auto turn = [&](Corners& corners, const Corners& from) {
            for (std::size_t i = 0; i < corners.size(); ++i)
                corners[i] = pose.axes * from[i];
        };
        piece.origin_m = to_parent(pose, resting.origin_m);
        piece.centre_m = pose.axes * resting.centre_m;
        piece.lowest_m = piece.origin_m.z + piece.centre_m.z - piece.radius_m;
        piece.highest_m = piece.origin_m.z + piece.centre_m.z + piece.radius_m;
        turn(piece.corners_m, resting.corners_m);
        for (std::size_t i = 0; i < resting.bodies_m.size(); ++i)
            turn(piece.bodies_m[i], resting.bodies_m[i]);
        const glm::dquat q = glm::quat_cast(pose.axes);
        piece.turn = glm::vec4(q.x, q.y, q.z, q.w);
    }
}

void SceneBuffers::bind(GLuint places, GLuint extras) const {
    const GladGLContext& gl = context_.gl;
    gl.VertexArrayVertexBuffer(layout_, 1, places, 0, sizeof(glm::vec4));
    for (const GLuint location : {5U, 6U})
        extras != 0 ? gl.EnableVertexArrayAttrib(layout_, location) : gl.DisableVertexArrayAttrib(layout_, location);
    if (extras != 0)
        gl.VertexArrayVertexBuffer(layout_, 2, extras, 0, sizeof(PieceExtra));
    gl.BindVertexArray(layout_);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, materials_);
    if (textures_ != 0)
        gl.BindTextureUnit(surface_texture_unit, textures_);
}

/// Ground that lies above other ground within 60 m: there, light that passes through the upper sheet from its lit side would reach the
/// lower one. Everywhere else a sheet that faces the lamp shades nothing (see shadow_maps.h).
void SceneBuffers::find_bridges() {
    std::map<std::pair<int, int>, std::vector<std::size_t>> cells; // 128 m
    const auto cell = [](double x) { return static_cast<int>(std::floor(x / 128.0)); };
    const auto around = [&](const Piece& p, double margin, auto visit) {
        const glm::dvec3 c = p.origin_m + p.centre_m;
        const double r = p.radius_m + margin;
        for (int x = cell(c.x - r); x <= cell(c.x + r); ++x)
            for (int y = cell(c.y - r); y <= cell(c.y + r); ++y)
                visit(std::pair(x, y));
    };
    for (std::size_t i = 0; i < pieces_.size(); ++i)
        if (pieces_[i].ground)
            around(pieces_[i], 0.0, [&](const auto& key) { cells[key].push_back(i); });
    for (Piece& upper : pieces_) {
        if (!upper.ground)
            continue;
        const glm::dvec3 c = upper.origin_m + upper.centre_m;
        around(upper, bridge_beside_m, [&](const auto& key) {
            const auto known = cells.find(key);
            if (known == cells.end())
                return;
            for (const std::size_t i : known->second) {
                const Piece& lower = pieces_[i];
                const glm::dvec3 d = lower.origin_m + lower.centre_m - c;
                const bool near = std::hypot(d.x, d.y) < upper.radius_m + lower.radius_m + bridge_beside_m;
                upper.above_ground = upper.above_ground || (near && lower.lowest_m < upper.lowest_m - bridge_height_m);
            }
        });
    }
}

Corners box_round(const std::vector<glm::dvec3>& triangles) {
    // Strips of road have long edges along the road: the longest edge is tried beside the world's axes, the smallest floor wins.
    glm::dvec2 longest(1.0, 0.0);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        if (next < triangles.size())
            if (const glm::dvec2 edge(triangles[next] - triangles[i]); glm::length(edge) > glm::length(longest))
                longest = edge;
    }
    Box best;
    glm::dvec2 best_along(1.0, 0.0);
    double smallest = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& along : {glm::dvec2(1.0, 0.0), glm::normalize(longest)}) {
        Box box; // in the turned frame
        for (const glm::dvec3& p : triangles)
            box.add({p.x * along.x + p.y * along.y, -p.x * along.y + p.y * along.x, p.z});
        if (const double floor = (box.high.x - box.low.x) * (box.high.y - box.low.y); floor < smallest) {
            smallest = floor;
            best = box;
            best_along = along;
        }
    }
    Corners corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double x = (i & 1U) != 0 ? best.high.x : best.low.x, y = (i & 2U) != 0 ? best.high.y : best.low.y;
        corners[i] = {x * best_along.x - y * best_along.y, x * best_along.y + y * best_along.x, (i & 4U) != 0 ? best.high.z : best.low.z};
    }
    return corners;
}

std::vector<Corners> boxes_round_bodies(const std::vector<glm::dvec3>& triangles) {
    std::vector<std::size_t> parent(triangles.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    std::map<std::tuple<double, double, double>, std::size_t> places;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::size_t first = places.try_emplace({triangles[i].x, triangles[i].y, triangles[i].z}, i).first->second;
        parent[root_of(parent, i)] = root_of(parent, first);
        parent[root_of(parent, i)] = root_of(parent, i - i % 3);
    }
    std::map<std::size_t, std::vector<glm::dvec3>> bodies;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        bodies[root_of(parent, i)].push_back(triangles[i]);
    std::vector<Corners> boxes;
    for (const auto& [root, body] : bodies)
        boxes.push_back(box_round(body));
    return boxes;
}

} // namespace fernlicht::gl
