#include "renderer/reference/photon_emission.h"

#include "renderer/reference/sampling.h"
#include "renderer/reference/surface_response.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {

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

} // namespace fernlicht::reference
