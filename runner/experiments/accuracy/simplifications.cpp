#include "runner/experiments/accuracy/technique_sweep.h"

#include "renderer/projected_beam.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>

namespace fernlicht {
namespace {

constexpr double farthest_m = 120.0, cell_m2 = 0.04;

/// What one lamp does at a point of the road.
struct LampThere {
    const LitLamp* lamp = nullptr;
    double cd = 0.0, cosine = 0.0, d_m = 0.0, d_by_vertices_m = 0.0;
    glm::dvec3 w{0.0}; ///< from the lamp in its own space
};
using Lamps = std::vector<LampThere>;

/// The thesis's textures of a lamp's beam, in float and in steps.
struct Textures {
    ProjectedBeam fine, steps;
};
using TexturesOf = std::map<const LampFile*, Textures>;

double textured_cd(const ProjectedBeam& beam, const LampThere& at) {
    if (at.w.z <= 0.0)
        return 0.0;
    const TangentWindow& window = beam.window;
    return 625.0 * at.lamp->intensity_factor *
           projected_lx(beam, (at.w.x / at.w.z - window.left) / (window.right - window.left),
                        (at.w.y / at.w.z - window.bottom) / (window.top - window.bottom));
}

constexpr std::array formulas{"no cosine",
                              "1 + d^2 for d^2",
                              "1 + d for d^2",
                              "one lamp's distance for all",
                              "distance from the triangle's vertices",
                              "beam texture 512 x 128, float",
                              "beam texture 512 x 128, 8 bits",
                              "as published: no cosine, 1 + d^2, distance from vertices, 8 bits"};

/// What one of the lamps brings by each of the formulas.
std::array<double, formulas.size()> lx_by_formula(const LampThere& l, const Lamps& all_lamps, const TexturesOf& textures) {
    const auto squared = [](double d) { return d * d; };
    const Textures& own = textures.at(l.lamp->file.get());
    const double fine_cd = textured_cd(own.fine, l), steps_cd = textured_cd(own.steps, l);
    return {l.cd / squared(l.d_m),
            l.cd * l.cosine / (1.0 + squared(l.d_m)),
            l.cd * l.cosine / (1.0 + l.d_m),
            l.cd * l.cosine / squared(all_lamps.front().d_m),
            l.cd * l.cosine / squared(l.d_by_vertices_m),
            fine_cd * l.cosine / squared(l.d_m),
            steps_cd * l.cosine / squared(l.d_m),
            steps_cd / (1.0 + squared(l.d_by_vertices_m))};
}

struct Corner {
    glm::dvec3 point_m, normal;
};

/// Lamps from the left to the right, as the published techniques take them.
std::vector<const LitLamp*> from_left(const Moment& moment) {
    std::vector<const LitLamp*> lamps;
    for (const LitLamp& lamp : moment.lamps)
        if (lamp.intensity_factor > 0.0)
            lamps.push_back(&lamp);
    std::ranges::stable_sort(lamps, std::ranges::greater{},
                             [&](const LitLamp* lamp) { return to_local(moment.ego, lamp->pose.position_m).y; });
    return lamps;
}

/// Calls `at` with points spread evenly over a triangle (the R2 sequence of Roberts 2018, folded), each with its share of the area.
void spread_points(const std::array<Corner, 3>& t, const std::function<void(const glm::dvec3& shares, double area_m2)>& at) {
    constexpr double g = 1.32471795724474602596;
    const double area_m2 = 0.5 * glm::length(glm::cross(t[1].point_m - t[0].point_m, t[2].point_m - t[0].point_m));
    const int count = std::max(1, static_cast<int>(std::ceil(area_m2 / cell_m2)));
    for (int i = 0; i < count; ++i) {
        double u = std::fmod(0.5 + i / g, 1.0), v = std::fmod(0.5 + i / (g * g), 1.0);
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        at({1.0 - u - v, u, v}, area_m2 / count);
    }
}

class Prices {
  public:
    explicit Prices(const Stage& stage) : stage_(stage), folds_(formulas.size()) {}

    void add(const Moment& moment, int picture) {
        const std::vector<const LitLamp*> lamps = from_left(moment);
        for (const LitLamp* lamp : lamps)
            if (!textures_.contains(lamp->file.get()))
                textures_[lamp->file.get()] = {make_projected_beam(lamp->file->table, {512, 128, 32}),
                                               make_projected_beam(lamp->file->table, eight_bit_texels)};
        for (std::size_t m = 0; m < stage_.scene.meshes.size() && !lamps.empty(); ++m)
            if (is_road(stage_.scene, static_cast<std::uint32_t>(m + 1)))
                add_mesh(stage_.scene.meshes[m], moment, lamps, picture);
    }

    std::vector<Simplification> finish() const {
        std::vector<Simplification> all;
        for (std::size_t i = 0; i < folds_.size(); ++i)
            all.push_back({formulas[i], folds_[i].finish()});
        return all;
    }

  private:
    void add_mesh(const Mesh& mesh, const Moment& moment, const std::vector<const LitLamp*>& lamps, int picture) {
        for (const Batch& batch : mesh.batches)
            for (std::uint32_t k = batch.first; k + 2 < batch.first + batch.count; k += 3) {
                std::array<Corner, 3> corners;
                for (std::uint32_t c = 0; c < 3; ++c) {
                    const Vertex& vertex = mesh.vertices[mesh.indices[k + c]];
                    corners[c] = {mesh.origin_m + glm::dvec3(vertex.position_m), glm::dvec3(vertex.normal)};
                }
                if (std::ranges::all_of(corners,
                                        [&](const Corner& c) { return glm::distance(c.point_m, moment.ego.position_m) < farthest_m; }))
                    spread_points(corners,
                                  [&](const glm::dvec3& shares, double area_m2) { add_point(corners, shares, area_m2, lamps, picture); });
            }
    }

    void add_point(const std::array<Corner, 3>& corners, const glm::dvec3& shares, double area_m2, const std::vector<const LitLamp*>& lamps,
                   int picture) {
        glm::dvec3 point_m(0.0), normal(0.0);
        for (int c = 0; c < 3; ++c) {
            point_m += shares[c] * corners[static_cast<std::size_t>(c)].point_m;
            normal += shares[c] * corners[static_cast<std::size_t>(c)].normal;
        }
        normal = glm::normalize(normal);
        Lamps there;
        double truth = 0.0;
        for (const LitLamp* lamp : lamps) {
            const glm::dvec3 to_lamp = lamp->pose.position_m - point_m;
            LampThere l{lamp, intensity_towards_cd(*lamp, point_m), photometry::incidence(normal, to_lamp), glm::length(to_lamp), 0.0, {}};
            for (int c = 0; c < 3; ++c)
                l.d_by_vertices_m += shares[c] * glm::distance(corners[static_cast<std::size_t>(c)].point_m, lamp->pose.position_m);
            l.w = photometry::lamp_space(-to_lamp, -lamp->pose.left(), lamp->pose.up(), lamp->pose.forward());
            truth += l.cd * l.cosine / (l.d_m * l.d_m);
            there.push_back(l);
        }
        std::array<double, formulas.size()> lx{};
        for (const LampThere& l : there)
            for (std::size_t i = 0; const double one : lx_by_formula(l, there, textures_))
                lx[i++] += one;
        for (std::size_t i = 0; i < folds_.size(); ++i)
            folds_[i].add({lx[i], truth, 0.0, area_m2, picture, 0, 0});
    }

    const Stage& stage_;
    TexturesOf textures_;
    std::vector<PixelErrorFold> folds_;
};

} // namespace

std::vector<Simplification> price_simplifications(const Stage& stage, const std::vector<Moment>& moments) {
    Prices prices(stage);
    for (std::size_t m = 0; m < moments.size(); ++m)
        prices.add(moments[m], static_cast<int>(m));
    return prices.finish();
}

} // namespace fernlicht
