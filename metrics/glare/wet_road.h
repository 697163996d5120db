// Light of lamps that a film of water on the road, or the facets of a dry one, mirror to an eye or onto a target: the mirror image with
// Fresnel's share (water: n = 1.333), spread to a streak along the road by the film's roughness. Luminance of the road as in pictures
// (photometry.glsl, wet_mirrored: facets of GGX, alpha 0.15 (scene.h), Smith's shadowing), integrated over the road between lamp and point,
// times the wetness. Dry, a glossy pavement's facets (facet_mirrored) times its gloss; of a partly wet road the film alone.
//
// Validity: roads that are level between both; the film of pictures is ours, not measured, and all depends on it. A smooth one, standing
// water, mirrors a low beam's foreground into an oncoming eye as the bare mirror image does, 50 m away some 17 times as much as this film:
// tests/metrics/glare/weather_glare_test.cpp holds the limit. Spray and the water on the windscreen are left out.
#pragma once

#include "metrics/glare/glare.h"
#include "scenarios/roads/road_surface.h"
#include "scenarios/values/scene.h"

#include <string>
#include <vector>

namespace fernlicht {

/// The road as a plane through the places of two cars on it, or of a car and whatever else stands there.
struct RoadPlane {
    glm::dvec3 point_m{0.0}, up{0.0, 0.0, 1.0};
    double bend_rad = 0.0; ///< how much its slope along the line between them changes from one to the other
};
/// Poses have z up from the road's surface. Where both are one place: the plane there.
RoadPlane road_plane(const Pose& from, const Pose& to);

/// A mirror that bends up or down gathers or spreads the light: 0.5 degrees over 50 m change it by some 10 %. Beyond it nothing is told.
inline constexpr double max_mirror_bend_rad = radians(0.5);
/// Something is mirrored.
bool mirrors(const Weather& weather, Pavement pavement);
/// Why light by way of the road is not known; "" where it is, and on a dry road.
std::string why_no_mirror(const Weather& weather, const RoadPlane& plane);

/// Patches of the road into which a lamp's streak is cut; their sum is within 3 % of the integral.
inline constexpr std::size_t streak_patches = 36;
/// For each lamp `streak_patches` of the road as the point meets them: facing illuminance with the extinction of both ways, distance from
/// the patch. Nothing of lamps or to points below the plane. None where nothing mirrors. `roughness` of the film, > 0: towards 0 all
/// patches of a lamp come to lie where its mirror image shows, and add up to I F / d^2 with d the way of the light and I the intensity
/// along it.
std::vector<SeenLamp> lamps_in_road(const std::vector<LitLamp>& lamps, const Weather& weather, const RoadPlane& plane,
                                    const glm::dvec3& point_m, Pavement pavement = Pavement::standard, double roughness = wet_roughness);

struct RoadLight {
    std::vector<SeenLamp> patches; ///< lamps_in_road()
    std::string unknown;           ///< why_no_mirror()
};
/// Of a moment on the route, to a point so far along it: dark where the patch lies beside the pavement.
RoadLight light_by_road(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point_m,
                        Pavement pavement = Pavement::standard);
/// The same, dark where a crest hides the lamp, too.
RoadLight light_over_road(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point_m,
                          Pavement pavement = Pavement::standard);

/// The light of others by way of the road to an eye, as traffic_glare(): in the plane between each lamp's car and the own one, of a lamp
/// that is fixed in the world in that under the own car. A box hides it that stands before the patch.
struct TrafficByRoad {
    std::vector<GlareSource> sources;
    std::string unknown;
};
TrafficByRoad traffic_by_road(const Moment& moment, const glm::dvec3& eye_m, const glm::dvec3& gaze, const std::vector<BodyBox>& boxes,
                              Pavement pavement = Pavement::standard);

} // namespace fernlicht
