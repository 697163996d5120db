// One picture that the reference takes, and the light that a packet of its rays sees directly.
#pragma once

#include "renderer/reference/embree_scene.h"
#include "renderer/reference/reference.h"
#include "renderer/reference/sampling.h"
#include "renderer/reference/surface_response.h"

#include <vector>

namespace fernlicht::reference {

class SolvedLight;

/// Thrown where the work at hand is to be left (StopAsked).
struct Stopped {};

/// As far away as parallel light is taken to come from when a ray asks whether anything stands in its way.
inline constexpr double sun_distance_m = 1.0e4;

/// What all rays of a picture share.
struct Shot {
    Shot(const EmbreeScene& embree, const Moment& moment, const View& view, const FrameOutputs& outputs, const ReferenceSettings& settings);

    const EmbreeScene& embree;
    const Moment& moment;
    const View& view;
    FrameOutputs outputs;
    ReferenceSettings settings;
    Camera camera;
    glm::dvec3 car_m{0.0};                     ///< the car's origin, relative to the scene's
    std::shared_ptr<const SolvedLight> solved; ///< of integrators that solve before they draw
    StopAsked stop_asked;                      ///< or nothing to ask

    void leave_if_asked() const {
        if (stop_asked && stop_asked())
            throw Stopped{};
    }
    /// Through a place in the picture, relative to the scene's origin.
    Ray ray_through(double x_px, double y_px) const;
    glm::dvec3 to_eye(const glm::dvec3& point_m) const;
};

/// The point of a net that a lane stands for, or its image in the middle of all dimensions. Pair 0 is the place in the pixel, pair 1 + i
/// the place on lamp i, those after it belong to paths.
struct SamplePoint {
    PointNet net{0};
    std::uint32_t index = 0;
    bool mirrored = false;

    glm::dvec2 pair(std::size_t i) const {
        const glm::dvec2 place = net.point(index, static_cast<std::uint32_t>(i));
        return mirrored ? 1.0 - place : place;
    }
};

/// What the packet's rays met and the light that goes from lamps, sky and the surfaces' own light over these surfaces to the eye.
struct PacketLight {
    std::array<double, packet_size> illuminance_lx{}, target_lx{}, luminance_cdm2{};
    std::array<SurfaceHit, packet_size> hits;
    std::array<SurfaceResponse, packet_size> responses;
    LaneMask hit = 0;
    std::uint64_t rays = 0;
};

/// Of which lamps samples were lit, and of which they were in a shadow. One bit set each, over a pixel.
struct ShadowTally {
    std::vector<std::uint8_t> seen; ///< lamps on the surface, then lamps on the target: 1 lit, 2 in a shadow

    bool edge() const;
};

/// Lamps, sky (as a share of what a free slope sees, unless `sky` is false) and the surfaces' own light. Adds to the tally.
void light_packet(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& rays,
                  LaneMask lanes, bool sky, PacketLight& light, ShadowTally& tally);

/// Where a lamp shines from: its centre, or where it is a disc the place that a point's pair gives. Relative to the scene's origin.
glm::dvec3 lamp_point_m(const Shot& shot, const LitLamp& lamp, const SamplePoint& point, std::size_t pair);

/// I / d^2 from a lamp's point at another, lx, without what stands between. The whole lamp's intensity is taken to come from each point
/// of its disc, by the table's directions.
double facing_lx(const LitLamp& lamp, const glm::dvec3& lamp_m, const glm::dvec3& point_m);

} // namespace fernlicht::reference
