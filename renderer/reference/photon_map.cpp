#include "renderer/reference/photon_map.h"

#include "renderer/reference/pixel_estimate.h"
#include "renderer/reference/sampling.h"
#include "renderer/reference/scattering.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tbb/parallel_for.h>

namespace fernlicht::reference {
namespace {

constexpr std::uint64_t photon_seed = 0x9407035ULL; ///< apart from the pixels' nets
constexpr std::uint32_t photons_a_question = 256;   ///< whether to go on: about a millisecond
constexpr double plane_share = 0.3, min_cosine = 0.7;

/// Cells are two radii wide: a sphere meets at most two each way.
glm::ivec3 cell_at(const glm::dvec3& point_m, double radius_m) { return glm::ivec3(glm::floor(point_m / (2.0 * radius_m))); }

} // namespace

void PhotonEmission::add(Emitter emitter) {
    if (!(emitter.flux_lm > 0.0))
        return;
    emitter.up_to_lm = (emitters_.empty() ? 0.0 : emitters_.back().up_to_lm) + emitter.flux_lm;
    emitters_.push_back(emitter);
}

void PhotonEmission::add_lamp(const LitLamp& lamp, int index) {
    if (!(lamp.intensity_factor > 0.0))
        return;
    const CandelaTable& table = lamp.file->table;
    for (std::size_t v = 0; v + 1 < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h + 1 < table.h_deg.size(); ++h) {
            if (!table.gaps.empty() && table.gaps[v * (table.h_deg.size() - 1) + h] != 0)
                continue;
            Emitter cell{.lamp = index,
                         .h0_rad = radians(std::max(table.h_deg[h], -90.0)),
                         .h1_rad = radians(std::min(table.h_deg[h + 1], 90.0)),
                         .sin_v0 = std::sin(radians(table.v_deg[v])),
                         .sin_v1 = std::sin(radians(table.v_deg[v + 1]))};
            const double mean_cd = 0.25 * (table.at(v, h) + table.at(v, h + 1) + table.at(v + 1, h) + table.at(v + 1, h + 1));
            cell.flux_lm = lamp.intensity_factor * mean_cd * std::max(0.0, cell.h1_rad - cell.h0_rad) * (cell.sin_v1 - cell.sin_v0);
            add(cell);
        }
}

PhotonEmission::PhotonEmission(const Shot& shot) : reach_m_(shot.settings.solver.reach_m) {
    for (std::size_t i = 0; i < shot.moment.lamps.size(); ++i)
        add_lamp(shot.moment.lamps[i], static_cast<int>(i));
    const Scene& scene = shot.embree.scene();
    if (std::ranges::any_of(scene.materials, [](const Material& m) { return luminance(glm::dvec3(m.emission_cdm2)) > 0.0; }))
        for (const Facet& facet : facets_within(shot.embree, shot.car_m, reach_m_)) {
            const double l = luminance(glm::dvec3(scene.materials[facet.material].emission_cdm2));
            if (l <= 0.0)
                continue;
            add({.flux_lm = pi * l * facet.area_m2, .facet = static_cast<int>(shining_.size())});
            shining_.push_back(facet);
        }
    if (const DirectLight* direct = shot.moment.daylight.direct())
        add({.flux_lm = pi * reach_m_ * reach_m_ * direct->illuminance_lx, .direct = true});
    add({.flux_lm = 2.0 * pi * reach_m_ * reach_m_ * shot.moment.daylight.horizontal_illuminance_lx});
}

PhotonStart PhotonEmission::start(const Shot& shot, const SamplePoint& point) const {
    const double all_lm = emitters_.back().up_to_lm, drawn = point.pair(0).x * all_lm;
    const auto found = std::upper_bound(emitters_.begin(), emitters_.end() - 1, drawn,
                                        [](double value, const Emitter& emitter) { return value < emitter.up_to_lm; });
    const Emitter& emitter = *found;
    const double inverse_p = all_lm / emitter.flux_lm;
    const glm::dvec2 first = point.pair(1), second = point.pair(2);
    if (emitter.lamp >= 0) {
        const LitLamp& lamp = shot.moment.lamps[static_cast<std::size_t>(emitter.lamp)];
        const double h = emitter.h0_rad + (emitter.h1_rad - emitter.h0_rad) * first.x,
                     sin_v = emitter.sin_v0 + (emitter.sin_v1 - emitter.sin_v0) * first.y,
                     cos_v = std::sqrt(std::max(0.0, 1.0 - sin_v * sin_v)),
                     cd = lamp.intensity_factor * intensity_cd(lamp.file->table, degrees(h), degrees(std::asin(sin_v))),
                     solid_angle = (emitter.h1_rad - emitter.h0_rad) * (emitter.sin_v1 - emitter.sin_v0);
        const glm::dvec3 direction =
            lamp.pose.forward() * (cos_v * std::cos(h)) - lamp.pose.left() * (cos_v * std::sin(h)) + lamp.pose.up() * sin_v;
        return {{lamp_point_m(shot, lamp, point, 3), direction}, lamp.colour.linear_srgb * (cd * solid_angle * inverse_p), true};
    }
    if (emitter.facet >= 0) {
        const Facet& facet = shining_[static_cast<std::size_t>(emitter.facet)];
        const SurfaceHit hit = facet.anywhere(first);
        const glm::dvec3 l(shot.embree.scene().materials[facet.material].emission_cdm2);
        return {{EmbreeScene::raised(hit), sample_cosine(facet.facet_normal, second)}, l * (pi * facet.area_m2 * inverse_p), false};
    }
    if (emitter.direct) {
        const glm::dvec3 towards = shot.moment.daylight.direct()->towards();
        const auto [u, v] = across(towards);
        const glm::dvec2 disc = on_disc(second) * reach_m_;
        const glm::dvec3 from_m = shot.car_m + towards * reach_m_ + u * disc.x + v * disc.y;
        const bool seen = shot.embree.visible(from_m, from_m + towards * sun_distance_m);
        return {{from_m, -towards}, glm::dvec3(seen ? emitter.flux_lm * inverse_p : 0.0), true};
    }
    const double z = first.x, across_z = std::sqrt(std::max(0.0, 1.0 - z * z)), turn = 2.0 * pi * first.y;
    const glm::dvec3 up{across_z * std::cos(turn), across_z * std::sin(turn), z};
    const auto [u, v] = across(up);
    const glm::dvec2 disc = on_disc(second) * reach_m_;
    return {{shot.car_m + up * reach_m_ + u * disc.x + v * disc.y, -up}, glm::dvec3(emitter.flux_lm * inverse_p), false};
}

/// Cells in a row along x have successive numbers. 21 bits each way.
std::uint64_t PhotonMap::cell_of(const glm::ivec3& cell) const {
    const auto bits = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & ((1U << 21) - 1); };
    return bits(cell.z) << 42 | bits(cell.y) << 21 | bits(cell.x);
}

bool PhotonMap::counts(Way way, Part part) { return part == Part::all || (part == Part::caustic ? way == Way::caustic : way != Way::lamp); }

PhotonMap::Map PhotonMap::sent_out(const Shot& shot, const PhotonEmission& emission, std::size_t replicate, std::uint32_t count) const {
    Map map;
    const PointNet net(mixed(mixed(shot.settings.seed, photon_seed), replicate));
    std::vector<Photon> photons;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % photons_a_question == 0)
            shot.leave_if_asked();
        const SamplePoint point{net, i};
        const PhotonStart start = emission.start(shot, point);
        const glm::dvec3 flux = start.flux_lm / static_cast<double>(count);
        if (flux == glm::dvec3(0.0))
            continue;
        Ray ray = start.ray;
        glm::dvec3 weight(1.0);
        bool specular = false, straight = start.from_lamp; // from a lamp over smooth surfaces alone
        std::size_t pair = PhotonEmission::pairs;
        for (int bounce = 0; bounce < shot.settings.max_bounces; ++bounce, pair += 2) {
            ++map.rays;
            const std::optional<SurfaceHit> hit = shot.embree.cast(ray);
            if (!hit)
                break;
            const Surface surface = surface_at(shot, *hit, -ray.direction);
            if (surface.is_dark())
                break;
            if (!surface.is_glass() && glm::length(hit->point_m - shot.car_m) < reach_m_)
                photons.push_back({glm::vec3(hit->point_m), glm::vec3(hit->facet_normal), glm::vec3(flux * weight),
                                   !straight     ? Way::other
                                   : bounce == 0 ? Way::lamp
                                                 : Way::caustic});
            if (!go_on_from(surface, point, pair, ray, weight, specular))
                break;
            straight &= specular;
        }
    }
    std::vector<std::uint64_t> cells(photons.size());
    for (std::size_t i = 0; i < photons.size(); ++i)
        cells[i] = cell_of(cell_at(glm::dvec3(photons[i].place_m), radius_m_));
    std::vector<std::uint32_t> order(photons.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return cells[a] != cells[b] ? cells[a] < cells[b] : a < b; });
    for (const std::uint32_t i : order) {
        map.photons.push_back(photons[i]);
        map.cells.push_back(cells[i]);
    }
    return map;
}

PhotonMap::PhotonMap(const Shot& shot, Preparation& preparation)
    : radius_m_(shot.settings.solver.radius_m), reach_m_(shot.settings.solver.reach_m), maps_(replicate_count) {
    const PhotonEmission emission(shot);
    if (emission.is_dark())
        return;
    const auto each = static_cast<std::uint32_t>((shot.settings.solver.photons + static_cast<std::int64_t>(replicate_count) - 1) /
                                                 static_cast<std::int64_t>(replicate_count));
    tbb::parallel_for(std::size_t{0}, replicate_count, [&](std::size_t r) { maps_[r] = sent_out(shot, emission, r, each); });
    for (const Map& map : maps_) {
        preparation.rays += map.rays;
        preparation.photons_stored += map.photons.size();
    }
}

glm::dvec3 PhotonMap::irradiance(const SurfaceHit& hit, Part part, std::size_t replicate) const {
    const Map& map = maps_[replicate];
    const double r2 = radius_m_ * radius_m_;
    const glm::ivec3 low = cell_at(hit.point_m - radius_m_, radius_m_), high = cell_at(hit.point_m + radius_m_, radius_m_);
    glm::dvec3 sum(0.0);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y) {
            const auto begin = std::ranges::lower_bound(map.cells, cell_of({low.x, y, z}));
            const std::uint64_t last = cell_of({high.x, y, z});
            for (auto it = begin; it != map.cells.end() && *it <= last; ++it) {
                const Photon& photon = map.photons[static_cast<std::size_t>(it - map.cells.begin())];
                const glm::dvec3 away = glm::dvec3(photon.place_m) - hit.point_m;
                const double d2 = glm::dot(away, away);
                if (d2 >= r2 || !counts(photon.way, part) || std::abs(glm::dot(away, hit.facet_normal)) > plane_share * radius_m_ ||
                    glm::dot(glm::dvec3(photon.normal), hit.facet_normal) < min_cosine)
                    continue;
                sum += glm::dvec3(photon.flux_lm) * (1.0 - d2 / r2);
            }
        }
    return sum * (2.0 / (pi * r2));
}

glm::dvec3 PhotonMap::flux_lm(Part part) const {
    glm::dvec3 sum(0.0);
    for (const Map& map : maps_)
        for (const Photon& photon : map.photons)
            if (counts(photon.way, part))
                sum += glm::dvec3(photon.flux_lm);
    return sum / static_cast<double>(maps_.size());
}

} // namespace fernlicht::reference
