#include "renderer/reference/reference.h"

#include "renderer/reference/pixel_estimate.h"
#include "renderer/reference/solved_light.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <limits>
#include <mutex>
#include <span>
#include <stdexcept>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace fernlicht {
namespace {

/// Origins of rays' geometry stand on a grid of this width, so that they do not depend on what was drawn before.
constexpr double origin_grid_m = 128.0;
/// Wanted between calls of go_on.
constexpr double batch_s = 0.5;
/// A batch grows on tiles that see the sky and then meets those that need thousands of samples: what has not begun by then waits.
constexpr double latest_start_s = 1.0, no_limit_s = std::numeric_limits<double>::infinity();
constexpr std::size_t first_batch = 4;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void check(const ReferenceSettings& s) {
    const auto fail = [](const char* what) { throw std::invalid_argument(std::string("reference: ") + what); };
    if (!(s.target_error > 0.0) || !(s.floor_lx > 0.0) || !(s.floor_cdm2 > 0.0))
        fail("target error and floors must be above 0");
    if (s.min_samples < 1 || s.max_samples < s.min_samples || s.max_samples > (1 << 24))
        fail("samples must be 1 <= least <= most <= 2^24");
    if (s.max_scatterings < 0)
        fail("scatterings must be at least 0");
    if (s.max_bounces < 1 || !(s.lamp_radius_m >= 0.0) || !std::isfinite(s.target_height_m))
        fail("bounces must be at least 1, a lamp's radius at least 0, a target's height finite");
    if (s.max_smooth < 0 || s.max_smooth > 64)
        fail("smooth surfaces in a row must be 0 to 64");
    if (!s.shadows && s.integrator != Integrator::direct && s.integrator != Integrator::whitted && s.integrator != Integrator::path)
        fail("shadows cannot be left out of light that is solved");
    const SolverSettings& solver = s.solver;
    if (!(solver.reach_m > 0.0 && solver.reach_m <= 2000.0) || !(solver.patch_m >= 0.001) || !std::isfinite(solver.patch_m) ||
        !(solver.radius_m >= 0.001 && solver.radius_m <= 100.0) || !(solver.residual > 0.0))
        fail("a solver's reach must be above 0 and at most 2000 m, patches at least 1 mm, photons' radius 1 mm to 100 m, residual above 0");
    if (solver.form_factor_rays < 1 || solver.form_factor_rays > (1 << 20) || solver.photons < 1 || solver.photons > (1 << 26))
        fail("form factor rays must be 1 to 2^20, photons 1 to 2^26");
}

void check_materials(const Scene& scene) {
    for (const Material& m : scene.materials) {
        const float albedo = std::max({m.albedo.x, m.albedo.y, m.albedo.z});
        if (!(m.mirror >= 0.0F) || m.mirror + albedo > 1.0F + 1e-6F) // rounding of two floats that add up to 1
            throw std::invalid_argument("material " + m.name + ": mirror and albedo must be at least 0 and together at most 1");
        if (m.glass_index != 0.0F && (!(m.glass_index >= 1.0F) || albedo > 0.0F || m.mirror > 0.0F))
            throw std::invalid_argument("material " + m.name + ": glass has an index of at least 1, and neither albedo nor mirror");
    }
}

ReferenceImage empty_image(const View& view, const FrameOutputs& outputs) {
    ReferenceImage image;
    for (const auto& [has_output, estimate] :
         {std::pair(outputs.illuminance, &image.illuminance_lx), std::pair(outputs.target, &image.target_lx),
          std::pair(outputs.luminance, &image.luminance_cdm2)})
        if (has_output)
            estimate->mean = estimate->standard_error = Image<float>(view.width_px, view.height_px);
    image.ids = Image<std::uint32_t>(view.width_px, view.height_px);
    image.samples = Image<std::uint32_t>(view.width_px, view.height_px);
    image.mixed = Image<std::uint8_t>(view.width_px, view.height_px);
    return image;
}

void check_from(const ReferenceImage& from, const ReferenceImage& empty) {
    const auto same = [](const auto& a, const auto& b) { return a.width() == b.width() && a.height() == b.height(); };
    if (!same(from.samples, empty.samples) || !same(from.ids, empty.ids) || !same(from.mixed, empty.mixed) ||
        !same(from.illuminance_lx.mean, empty.illuminance_lx.mean) || !same(from.target_lx.mean, empty.target_lx.mean) ||
        !same(from.luminance_cdm2.mean, empty.luminance_cdm2.mean))
        throw std::invalid_argument("reference: the picture to go on with is of another size or has other results");
}

struct Corner {
    int x, y;
};

std::vector<Corner> corners_of(const ReferenceTiles& tiles, const ReferenceImage& image) {
    if (tiles.size_px < 1 || tiles.size_px > reference::tile_px)
        throw std::invalid_argument(fmt::format("reference: tiles of {} pixels, not of 1 to {}", tiles.size_px, reference::tile_px));
    std::vector<Corner> all;
    for (int y = 0; y < image.samples.height(); y += tiles.size_px)
        for (int x = 0; x < image.samples.width(); x += tiles.size_px)
            all.push_back({x, y});
    if (tiles.only.empty())
        return all;
    std::vector<Corner> chosen;
    for (const int number : tiles.only) {
        if (number < 0 || static_cast<std::size_t>(number) >= all.size())
            throw std::invalid_argument(fmt::format("reference: tile {} of {}", number, all.size()));
        chosen.push_back(all[static_cast<std::size_t>(number)]);
    }
    return chosen;
}

/// Takes away those that are drawn.
void keep_open(std::vector<Corner>& tiles, const ReferenceImage& image) {
    std::erase_if(tiles, [&](const Corner& tile) { return image.samples.at(tile.x, tile.y) != 0; });
}

/// Draws tiles, the first for certain, others if they can begin in time. Which were drawn tells the picture; what is in them does not
/// depend on it. Returns the rays cast.
std::uint64_t draw_batch(const reference::Shot& shot, std::span<const Corner> tiles, int size_px, ReferenceImage& image, double latest_s) {
    std::atomic<std::uint64_t> rays = 0;
    const auto start = std::chrono::steady_clock::now();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            if (i == 0 || seconds_since(start) < latest_s)
                rays += reference::draw_tile(shot, tiles[i].x, tiles[i].y, size_px, image);
    });
    return rays;
}

std::size_t pixels_done(const ReferenceImage& image) {
    return image.samples.size() - static_cast<std::size_t>(std::ranges::count(image.samples.pixels(), 0U));
}

} // namespace

bool knows_weather(Integrator integrator) { return integrator != Integrator::radiosity && integrator != Integrator::photon_map; }

Scene posed_scene(const Scene& scene, const std::vector<Body>& bodies) {
    Scene posed = scene;
    for (Mesh& mesh : posed.meshes) {
        if (mesh.body < 0)
            continue;
        const auto body = static_cast<std::size_t>(mesh.body);
        mesh.body = -1;
        if (body >= bodies.size() || !bodies[body].visible) {
            mesh.vertices.clear();
            mesh.indices.clear();
            mesh.batches.clear();
            continue;
        }
        const Pose& pose = bodies[body].pose;
        mesh.origin_m = to_parent(pose, mesh.origin_m);
        for (Vertex& vertex : mesh.vertices) {
            vertex.position_m = glm::vec3(pose.axes * glm::dvec3(vertex.position_m));
            vertex.normal = glm::vec3(pose.axes * glm::dvec3(vertex.normal));
        }
    }
    return posed;
}

struct Reference::State {
    std::mutex mutex;
    std::shared_ptr<const reference::EmbreeScene> geometry;
    std::shared_ptr<const Scene> posed; ///< where bodies move: the scene with them where they are
    std::vector<Body> bodies;
};

Reference::Reference(const Scene& scene) : scene_(scene), state_(std::make_unique<State>()) {}
Reference::~Reference() = default;

std::shared_ptr<const reference::EmbreeScene> Reference::geometry(const Moment& moment) const {
    const glm::dvec3 origin_m = glm::round(moment.ego.position_m / origin_grid_m) * origin_grid_m;
    const std::lock_guard lock(state_->mutex);
    const bool moves = std::ranges::any_of(scene_.meshes, [](const Mesh& mesh) { return mesh.body >= 0; });
    const auto same = [](const Body& a, const Body& b) { return a.pose == b.pose && a.visible == b.visible; };
    const bool moved = moves && (!state_->posed || !std::ranges::equal(state_->bodies, moment.bodies, same));
    if (!state_->geometry || state_->geometry->origin_m() != origin_m || moved) {
        state_->geometry.reset();
        if (moved) {
            state_->posed = std::make_shared<const Scene>(posed_scene(scene_, moment.bodies));
            state_->bodies = moment.bodies;
        }
        if (moves) // rays' geometry holds on to the scene that it points into
            state_->geometry = std::shared_ptr<const reference::EmbreeScene>(new reference::EmbreeScene(*state_->posed, origin_m),
                                                                             [posed = state_->posed](const auto* made) { delete made; });
        else
            state_->geometry = std::make_shared<const reference::EmbreeScene>(scene_, origin_m);
    }
    return state_->geometry;
}

ReferenceImage Reference::render(const Moment& moment, const View& view, const FrameOutputs& outputs, const ReferenceSettings& settings,
                                 const GoOn& go_on, ReferenceImage from, const StopAsked& stop_asked, const ReferenceTiles& tiles) const {
    TraceSpan span("reference", "reference");
    if (span)
        span.tell("view", view.name);
    check(settings);
    if (!knows_weather(settings.integrator) && (moment.weather.extinction_per_m > 0.0 || moment.weather.wetness > 0.0))
        throw std::invalid_argument("reference: fog or water for radiosity or photon map; direct, whitted and path know them");
    check_materials(scene_);
    const auto start = std::chrono::steady_clock::now();
    const auto embree = geometry(moment);
    Moment lit = moment; // lamps of others light as the own do
    lit.lamps.insert(lit.lamps.end(), moment.other_lamps.begin(), moment.other_lamps.end());
    reference::Shot shot(*embree, lit, view, outputs, settings);
    shot.stop_asked = stop_asked;
    ReferenceImage image = empty_image(view, outputs);
    if (!from.samples.empty()) {
        check_from(from, image);
        image = std::move(from);
    }
    const double seconds_before = image.seconds;
    image.preparation = {};
    const auto told = [&] {
        image.seconds = seconds_before + seconds_since(start);
        return !go_on || go_on(image, pixels_done(image));
    };
    try {
        shot.solved = reference::solve_light(shot, image.preparation);
    } catch (const reference::Stopped&) {
        image.complete = false;
        told();
        return image;
    }
    image.rays += image.preparation.rays;
    std::vector<Corner> open = corners_of(tiles, image);
    keep_open(open, image);
    std::size_t batch = go_on ? first_batch : open.size();
    bool goes_on = true;
    while (goes_on && !open.empty()) {
        const auto batch_start = std::chrono::steady_clock::now();
        image.rays += draw_batch(shot, std::span(open).first(std::min(batch, open.size())), tiles.size_px, image,
                                 go_on ? latest_start_s : no_limit_s);
        batch = std::clamp(static_cast<std::size_t>(static_cast<double>(batch) * batch_s / std::max(seconds_since(batch_start), 1e-3)),
                           batch / 4 + 1, 2 * batch);
        keep_open(open, image);
        const bool stopped = stop_asked && stop_asked(); // before go_on, which then knows of it
        goes_on = told() && !stopped;
    }
    image.complete = open.empty();
    return image;
}

} // namespace fernlicht
