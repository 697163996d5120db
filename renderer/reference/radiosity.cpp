#include "renderer/reference/radiosity.h"

#include "renderer/reference/pixel_estimate.h"
#include "renderer/reference/scattering.h"
#include "scenarios/photometry.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace fernlicht::reference {
namespace {

/// 1.2 kB a patch and 4 bytes a ray: at most 3.3 GB.
constexpr std::size_t max_patches = 1'000'000, max_rays = std::size_t{1} << 29;
constexpr std::uint64_t radiosity_seed = 0x5ad105171ULL; ///< apart from the pixels' nets
constexpr int max_sweeps = 10'000;                       ///< a white closed room never ends

double sum_of(const glm::dvec3& rgb) { return std::abs(rgb.x) + std::abs(rgb.y) + std::abs(rgb.z); }

/// Of lamps, sun and moon.
glm::dvec3 lamps_lx(const Shot& shot, const SurfaceHit& hit, const SamplePoint& point, std::size_t pair, std::uint64_t& rays) {
    glm::dvec3 sum(0.0);
    for (const LitLamp& lamp : shot.moment.lamps) {
        const glm::dvec3 lamp_m = lamp_point_m(shot, lamp, point, pair++);
        const double cosine = photometry::incidence(hit.normal, lamp_m - hit.point_m),
                     e_perp = cosine > 0.0 ? facing_lx(lamp, lamp_m, hit.point_m) : 0.0;
        if (e_perp <= 0.0)
            continue;
        ++rays;
        if (shot.embree.visible(hit, lamp_m))
            sum += lamp.colour.linear_srgb * (e_perp * cosine);
    }
    if (const DirectLight* sun = shot.moment.daylight.direct())
        if (const double e = photometry::directional_illuminance(sun->illuminance_lx, hit.normal, sun->towards()); e > 0.0) {
            ++rays;
            if (shot.embree.visible(hit, hit.point_m + sun->towards() * sun_distance_m))
                sum += e;
        }
    return sum;
}

} // namespace

struct Radiosity::System {
    std::size_t each = 0;               ///< rays from a patch
    std::vector<glm::dvec3> given;      ///< D + S + sum F pi L
    std::vector<std::uint32_t> landing; ///< patch by patch, `each` of them
    std::vector<glm::dvec3>* lamps = nullptr;

    glm::dvec3 right_side(const std::vector<glm::dvec3>& e, const std::vector<glm::dvec3>& reflectance, std::size_t patch) const {
        glm::dvec3 sum(0.0);
        for (std::size_t k = patch * each; k < (patch + 1) * each; ++k)
            if (const std::uint32_t j = landing[k]; j != Patches::none)
                sum += reflectance[j] * e[j];
        return given[patch] + sum / static_cast<double>(each);
    }

    /// Returns the number of sweeps. The residual is that of the result.
    int solve(const Shot& shot, std::vector<glm::dvec3>& e, const std::vector<glm::dvec3>& reflectance, double& residual) const {
        const double wanted = shot.settings.solver.residual;
        e = given;
        int sweeps = 0;
        for (residual = 1.0; residual > wanted && sweeps < max_sweeps; ++sweeps) {
            shot.leave_if_asked();
            double change = 0.0, total = 0.0;
            for (std::size_t i = 0; i < e.size(); ++i) {
                const glm::dvec3 now = right_side(e, reflectance, i);
                change += sum_of(now - e[i]);
                total += sum_of(now);
                e[i] = now;
            }
            residual = total > 0.0 ? change / total : 0.0;
        }
        double left = 0.0, total = 0.0;
        for (std::size_t i = 0; i < e.size(); ++i) {
            left += sum_of(right_side(e, reflectance, i) - e[i]);
            total += sum_of(e[i]);
        }
        residual = total > 0.0 ? left / total : 0.0;
        return sweeps;
    }
};

void Radiosity::measure(const Shot& shot, std::uint32_t patch, std::vector<System>& systems, std::uint64_t& rays) {
    const std::uint64_t key = mixed(mixed(shot.settings.seed, radiosity_seed), patch);
    const Material& material = shot.embree.scene().materials[patches_.material(patch)];
    glm::dvec3 albedo(0.0);
    for (std::size_t r = 0; r < replicate_count; ++r) {
        System& system = systems[r];
        const double share = 1.0 / static_cast<double>(system.each);
        for (std::size_t k = 0; k < system.each; ++k) {
            const SamplePoint point{PointNet(mixed(key, r)), static_cast<std::uint32_t>(k)};
            const SurfaceHit from = patches_.place(patch, point.pair(0));
            albedo += response_at(shot.embree.scene(), from).albedo * (share / static_cast<double>(replicate_count));
            const glm::dvec3 lamps = lamps_lx(shot, from, point, 2, rays) * share;
            (*system.lamps)[patch] += lamps;
            system.given[patch] += lamps;
            std::uint32_t& landing = system.landing[patch * system.each + k] = Patches::none;
            Ray ray{EmbreeScene::raised(from), sample_cosine(from.normal, point.pair(1))};
            if (glm::dot(ray.direction, from.facet_normal) <= 0.0)
                continue;
            const std::optional<Surface> met = cast_past_smooth(shot, point, 2 + shot.moment.lamps.size(), ray, rays);
            if (!met)
                system.given[patch] += sky_luminance(shot.moment, ray.direction) * (pi * share);
            else if (!met->is_dark())
                landing = patches_.at(met->hit);
        }
    }
    const double rough = 1.0 - static_cast<double>(material.mirror);
    if (is_smooth(material) && (material.glass_index > 0.0F || rough <= 0.0))
        return; // no ray ever lands there
    reflectance_[patch] = albedo / rough;
    emission_lx_[patch] = glm::dvec3(material.emission_cdm2) * (pi / rough);
}

Radiosity::Radiosity(const Shot& shot, Preparation& preparation)
    : patches_(shot.embree, facets_within(shot.embree, shot.car_m, shot.settings.solver.reach_m), shot.settings.solver.patch_m,
               max_patches) {
    const std::size_t count = patches_.size(),
                      each = (static_cast<std::size_t>(shot.settings.solver.form_factor_rays) + replicate_count - 1) / replicate_count;
    if (count * each * replicate_count > max_rays)
        throw InputError({{}, 0, 0, "--form-factor-rays"}, std::to_string(count) + " patches with as many rays each as asked for",
                         "at most 2^29 rays together");
    reflectance_.resize(count, glm::dvec3(0.0)), emission_lx_.resize(count, glm::dvec3(0.0));
    all_.resize(replicate_count), lamps_.resize(replicate_count);
    std::vector<System> systems(replicate_count);
    for (std::size_t r = 0; r < replicate_count; ++r) {
        lamps_[r].resize(count, glm::dvec3(0.0));
        systems[r] = {each, std::vector<glm::dvec3>(count, glm::dvec3(0.0)), std::vector<std::uint32_t>(count * each), &lamps_[r]};
    }
    std::atomic<std::uint64_t> rays = 0;
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(count), 256), [&](const auto& range) {
        std::uint64_t cast = 0;
        for (std::uint32_t patch = range.begin(); patch < range.end(); ++patch) {
            shot.leave_if_asked();
            measure(shot, patch, systems, cast);
        }
        rays += cast;
    });
    std::array<int, replicate_count> sweeps{};
    std::array<double, replicate_count> residual{};
    tbb::parallel_for(std::size_t{0}, replicate_count, [&](std::size_t r) {
        System& system = systems[r];
        for (std::size_t k = 0; k < system.landing.size(); ++k)
            if (system.landing[k] != Patches::none)
                system.given[k / each] += emission_lx_[system.landing[k]] / static_cast<double>(each);
        sweeps[r] = system.solve(shot, all_[r], reflectance_, residual[r]);
    });
    preparation.rays += rays;
    preparation.patches = count;
    preparation.sweeps = *std::ranges::max_element(sweeps);
    preparation.residual = *std::ranges::max_element(residual);
}

glm::dvec3 Radiosity::irradiance(const SurfaceHit& hit, Part part, std::size_t replicate) const {
    const std::uint32_t patch = part == Part::caustic ? Patches::none : patches_.at(hit);
    if (patch == Patches::none)
        return glm::dvec3(0.0);
    return part == Part::all ? all_[replicate][patch] : all_[replicate][patch] - lamps_[replicate][patch];
}

} // namespace fernlicht::reference
