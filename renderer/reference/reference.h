// The reference: what a scene's light is, by rays, each number with its standard error. For measuring every other way to light a scene.
//
// A pixel's value is a mean over the pixel's area (Footprint::pixel), estimated from R independently scrambled nets of points
// (sampling.h): 8 of direct light, 16 of light that bounces. Their means m_r are independent and have the same distribution, however well
// each net is stratified, so that
//     mean = sum m_r / R,   error^2 = sum (m_r - mean)^2 / (R (R - 1)) * (R - 1) / (R - 3).
// The last factor makes (mean - truth) / error, which follows Student's t with R - 1 degrees of freedom, have variance 1, so that error
// bars are as wide on average as the errors are. A standard error of the naive kind, over all samples, would be too wide: stratified
// samples are not independent. Where all nets count an upright or level edge alike, direct light's bar is what one sample more would make.
//
// Where a pixel of direct light shows one surface, each net stands there with its image in the pixel's middle (antithetic variates;
// Hammersley and Morton 1956): together they are exact for light that is linear in the pixel, as it nearly is on a road.
//
// How many samples: each pixel gets a first round (16; 128 of paths), and its neighbours' first rounds, which are independent of it, decide
// whether that is enough. They are its pilot, cost nothing, and leave no bias. If their error is too large, or if one of them shows what
// the pixel may hold a sliver of, it is drawn again, from the start, with more points of other nets; so it is, too, when its own error came
// out above the target, which is seldom and leaves a bias that the tests look for. Only the last round counts. What covers a smaller part
// of a pixel than one in its number of samples, and shows in no neighbour, can still be missed by all of them; then the bar does not know.
//
// Direct: Lambert and retroreflecting surfaces, lamps as points or discs, visibility by a ray, the intensity from the candela table in
// double, the sky as a share (1 + n_z) / 2 that nothing hides, sun and moon, wet roads, fog by single scattering: the same light as the
// technique `photometric` and its twin.
#pragma once

#include "scenarios/drives/play/frame.h"
#include "scenarios/values/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace fernlicht {

namespace reference {
class EmbreeScene;
}

enum class Integrator {
    direct,
    path,
    whitted,   ///< path.h: direct, and what mirrors and glass show
    radiosity, ///< radiosity.h
    photon_map ///< photon_map.h
};

/// False for radiosity and photon_map, whose light goes straight between dry, diffuse surfaces: fog and water are refused.
bool knows_weather(Integrator integrator);

/// For Integrator::radiosity and photon_map, which solve the light of a moment before they draw it.
struct SolverSettings {
    double reach_m = 60.0;          ///< about the car: surfaces farther away keep no light, so that none comes from them
    double patch_m = 1.0;           ///< radiosity: the longest side of a patch, nearly; > 0
    int form_factor_rays = 128;     ///< radiosity: from each patch; a multiple of 16
    double residual = 1e-4;         ///< radiosity: left of the light when the iteration ends; > 0
    std::int64_t photons = 1 << 20; ///< photon map: sent out, up to 2^26 (some 100 bytes each); becomes a multiple of 16
    double radius_m = 0.25;         ///< photon map: of the disc over which light is averaged; > 0
    bool final_gather =
        true; ///< a pixel's light is gathered by rays from what was solved; false: it is taken from there, lamps' direct light apart

    bool operator==(const SolverSettings&) const = default;
};

enum class Footprint {
    pixel, ///< mean over the pixel's area
    centre ///< the one ray through the centre that a rasteriser takes; no noise but area lamps'. With Integrator::direct the double twin
};

struct ReferenceSettings {
    Integrator integrator = Integrator::direct;
    Footprint footprint = Footprint::pixel;
    double target_error = 0.005; ///< wanted standard error of a pixel's mean, relative to max(mean, floor)
    double floor_lx = 0.05, floor_cdm2 = 0.001;
    int min_samples = 16, max_samples = 4096; ///< in a pixel's mean; both become powers of two from 16 up
    int max_bounces = 1000;                   ///< path: a bound that Russian roulette, which is unbiased, never meets in practice
    int max_scatterings = 1000;               ///< path: in fog, of the light of one way; 1 is single scattering, 0 none
    double lamp_radius_m = 0.0;               ///< > 0: lamps are discs of this radius that face along their axis; 0: points
    double target_height_m = 0.25;            ///< of target_lx, above the surface
    bool shadows = true;                      ///< direct and whitted alone can leave them out
    int max_smooth = 8;                       ///< whitted: mirrors and boundaries of glass in a row
    SolverSettings solver;
    std::uint64_t seed = 1;

    bool operator==(const ReferenceSettings&) const = default;
};

/// Both empty where the result was not wanted.
struct Estimate {
    Image<float> mean, standard_error; ///< of the mean
};

/// The squares that a picture is drawn in, those at its right and lower edge cut short. A pixel asks its neighbours in the same square how
/// many samples it needs.
struct ReferenceTiles {
    int size_px = 16;            ///< 1 to 16
    std::span<const int> only{}; ///< which are drawn, counted along rows from 0; empty: all
};

/// Bits of ReferenceImage::mixed.
inline constexpr std::uint8_t several_surfaces = 1, shadow_edge = 2;

/// What was solved before the drawing.
struct Preparation {
    double seconds = 0.0;
    std::uint64_t rays = 0;
    std::size_t patches = 0;        ///< radiosity
    int sweeps = 0;                 ///< radiosity: of the iteration, the most of 16 replicates
    double residual = 0.0;          ///< radiosity: sum |b - A E| / sum E, the largest of 16 replicates
    std::size_t photons_stored = 0; ///< photon map
};

struct ReferenceImage {
    Estimate illuminance_lx;  ///< on the surface seen in the pixel, all lamps and sky; 0 where nothing is seen
    Estimate target_lx;       ///< of a target above the pixel's place that faces each lamp: sum of I / d^2, direct light with its shadows
    Estimate luminance_cdm2;  ///< towards the camera
    Image<std::uint32_t> ids; ///< mesh index + 1 seen by the ray through the centre, as Frame::ids
    Image<std::uint32_t> samples; ///< in the pixel's mean; 0: not drawn yet
    Image<std::uint8_t> mixed; ///< several_surfaces: samples met more than one mesh or material, or also nothing; shadow_edge: of some lamp
                               ///< some samples were lit and some not
    double seconds = 0.0;
    std::uint64_t rays = 0;
    bool complete = true;
    Preparation preparation; ///< included in seconds and rays
};

/// Called from the drawing thread every half second or so, and never at the same time as pixels change; at the latest when the tiles that
/// began within a second are drawn. False: stop.
using GoOn = std::function<bool(const ReferenceImage& so_far, std::size_t pixels_done)>;
/// Asked by every thread, between packets of rays and sweeps of a solver. True, from then on: stop within milliseconds and throw away the
/// tiles at hand (16 x 16 pixels, which take seconds where a pixel needs thousands of paths).
using StopAsked = std::function<bool()>;

class Reference {
  public:
    /// The scene must outlive the reference.
    explicit Reference(const Scene& scene);
    ~Reference();
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    /// Draws illuminance, target and luminance as wanted. Maps see ground surfaces only; everything casts shadows. The same bytes for any
    /// number of threads, and for a picture drawn in one go or gone on with from `from`, an incomplete picture of the same call. Of some
    /// `tiles` alone, other pixels keep 0 samples, and the picture is complete without them. Throws DeviceError (Embree, memory),
    /// std::invalid_argument for settings or tiles that make no sense, a `from` of another size, and fog or water where the integrator
    /// knows neither (knows_weather).
    ReferenceImage render(const Moment& moment, const View& view, const FrameOutputs& outputs, const ReferenceSettings& settings,
                          const GoOn& go_on = {}, ReferenceImage from = {}, const StopAsked& stop_asked = {},
                          const ReferenceTiles& tiles = {}) const;

    /// Rays' geometry about a point near the car; built when first asked for, kept until another is needed.
    std::shared_ptr<const reference::EmbreeScene> geometry(const Moment& moment) const;

  private:
    struct State;
    const Scene& scene_;
    std::unique_ptr<State> state_;
};

/// A copy in which every mesh stands in the world. Meshes of bodies that are not visible, or not among `bodies`, are empty; numbers of
/// meshes stay.
Scene posed_scene(const Scene& scene, const std::vector<Body>& bodies);

} // namespace fernlicht
