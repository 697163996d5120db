#include "renderer/reference/solved_light.h"

#include "renderer/reference/path.h"
#include "renderer/reference/photon_map.h"
#include "renderer/reference/radiosity.h"
#include "renderer/reference/scattering.h"

#include <chrono>

namespace fernlicht::reference {
namespace {

/// What arrives along a ray. `feelers`: lamps' direct light on the surface met by feelers; else as the solution holds it.
glm::dvec3 arriving_from_solution(const Shot& shot, std::size_t lane, const SamplePoint& point, std::size_t pair, Ray ray, bool feelers,
                                  std::uint64_t& rays) {
    const std::optional<Surface> met = cast_past_smooth(shot, point, pair + shot.moment.lamps.size(), ray, rays);
    if (!met)
        return sky_luminance(shot.moment, ray.direction);
    if (met->is_dark())
        return glm::dvec3(0.0);
    const glm::dvec3 e = shot.solved->irradiance(met->hit, feelers ? Part::without_lamps : Part::all, lane);
    glm::dvec3 sum = met->response.emission_cdm2 + met->response.albedo * e / pi;
    if (feelers)
        sum += lamps_on(shot, *met, point, pair, rays);
    return sum / (1.0 - met->mirror);
}

void add_irradiance(const Shot& shot, Part part, PacketLight& light) {
    for (const std::size_t i : lanes_of(light.hit)) {
        const glm::dvec3 e = shot.solved->irradiance(light.hits[i], part, i);
        light.illuminance_lx[i] += luminance(e);
        if (shot.outputs.luminance)
            light.luminance_cdm2[i] += luminance(light.responses[i].albedo * e / pi);
    }
}

} // namespace

std::shared_ptr<const SolvedLight> solve_light(const Shot& shot, Preparation& preparation) {
    const auto start = std::chrono::steady_clock::now();
    std::shared_ptr<const SolvedLight> solved;
    if (shot.settings.integrator == Integrator::radiosity)
        solved = std::make_shared<const Radiosity>(shot, preparation);
    else if (shot.settings.integrator == Integrator::photon_map)
        solved = std::make_shared<const PhotonMap>(shot, preparation);
    preparation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return solved;
}

void add_solved_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light) {
    const auto arriving = [&](bool feelers) {
        return [&shot, feelers](std::size_t lane, const SamplePoint& point, std::size_t pair, const Ray& ray, std::uint64_t& rays) {
            return arriving_from_solution(shot, lane, point, pair, ray, feelers, rays);
        };
    };
    if (shot.settings.solver.final_gather) {
        add_bounced_light(shot, points, arriving(false), light);
        add_irradiance(shot, Part::caustic, light);
    } else {
        add_irradiance(shot, Part::without_lamps, light);
    }
    add_smooth_light(shot, points, arriving(true), light);
}

} // namespace fernlicht::reference
