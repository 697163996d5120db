#include "renderer/gl/lamps_in_fog.h"

#include "renderer/gl/device/program.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

constexpr double nearest_pass_m = 1e-3;
constexpr GLuint lamps_at = 6, beams_at = 7; // bindings in lamps_in_fog.glsl

/// No ray of the picture passes nearer by a place than this; relative to the car.
double apart_m(const Camera& camera, const glm::dvec3& place_m) {
    const glm::dvec3 to_place = place_m - camera.eye_m;
    const double distance = glm::length(to_place), half = std::atan(std::hypot(camera.half_extent.x, camera.half_extent.y)),
                 beside = std::atan2(glm::length(glm::cross(camera.axis, to_place)), glm::dot(camera.axis, to_place)) - half;
    return beside >= 0.5 * pi ? distance : std::max(distance * std::sin(std::max(beside, 0.0)), nearest_pass_m);
}

/// The most luminance that the lamp can add along any ray that passes it no nearer than `apart`.
double max_airlight_cdm2(const LitLamp& lamp, const Beam& beam, const Weather& weather, double distance_m, double apart) {
    return rounding * weather.extinction_per_m * weather.scattering_albedo * lamp.intensity_factor * beam.bounds.most() *
           photometry::henyey_greenstein(1.0, weather.asymmetry) * pi / apart * air_transmittance(weather, distance_m);
}

} // namespace

int LampsInFog::beam_offset(const Beam& beam) {
    const auto [known, fresh] = offsets_.try_emplace(beam.id, static_cast<int>(cd_.size()));
    if (fresh) {
        cd_.insert(cd_.end(), beam.grid.cd.begin(), beam.grid.cd.end());
        cd_buffer_.fill(context_, cd_);
    }
    return known->second;
}

void LampsInFog::set(const Moment& moment, const Camera& camera) {
    packed_.clear();
    left_out_ = 0;
    min_cdm2_ = static_cast<float>(min_airlight_cdm2(moment.min_traffic_lx));
    if (moment.weather.extinction_per_m <= 0.0)
        return;
    for (const LitLamp& lamp : moment.other_lamps) {
        if (!(lamp.intensity_factor > 0.0))
            continue;
        const Beam& beam = beams_.of(lamp.file);
        const glm::dvec3 at_m = lamp.pose.position_m - moment.ego.position_m;
        const double most = max_airlight_cdm2(lamp, beam, moment.weather, glm::length(at_m - camera.eye_m), apart_m(camera, at_m));
        if (pruned_ && most <= static_cast<double>(min_cdm2_)) {
            ++left_out_;
            continue;
        }
        const BeamTexture& g = beam.grid;
        packed_.push_back({four(at_m, rounding * beam.bounds.most() * lamp.intensity_factor), four(-lamp.pose.left()), four(lamp.pose.up()),
                           four(lamp.pose.forward()), four(lamp.colour.linear_srgb, lamp.intensity_factor),
                           glm::vec4(g.h_first_rad, g.v_first_rad, 1.0 / g.h_step_rad, 1.0 / g.v_step_rad),
                           glm::vec4(beam_offset(beam), g.width, g.height, 0.0)});
    }
    if (!packed_.empty())
        lamp_buffer_.fill(context_, packed_);
    else if (lamp_buffer_.buffer == 0) // for a shader that finds no lamps to look at
        lamp_buffer_.fill(context_, std::vector<Packed>(1)), cd_buffer_.fill(context_, std::vector<float>(1));
}

void LampsInFog::bind() const {
    if (lamp_buffer_.buffer == 0)
        return;
    context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, lamps_at, lamp_buffer_.buffer);
    context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, beams_at, cd_buffer_.buffer);
}

} // namespace fernlicht::gl
