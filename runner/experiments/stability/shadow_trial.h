// The shadows of a drawn frame compared with rays in double precision, and the bodies that cast them.
#pragma once

#include "runner/experiments/stability/trial.h"

#include <array>
#include <random>

namespace fernlicht::stability {

/// What a method may take for a surface's place, for a caster's and for the lamp's: pixels whose rays from all of these do not agree are in
/// doubt and not judged. Distances d are from the lamp.
struct ShadowTolerance {
    double raise_m = 0.0, raise_share = 0.0; ///< looked up from up to twice max(raise_m, raise_share d) above the surface, along its normal
    double aside_m = 1e-4, aside_share = 2e-5; ///< and from so far aside as the lamp sees it: m + share d
    double gap_m = 0.0, gap_share = 0.0;       ///< a shadow may begin so far behind its caster
    double lamp_radius_m = 0.0;                ///< the lamp is a disc across its axis
    double map_begins_m = 0.0;                 ///< casters that reach nearer to the lamp's plane may be missing
    bool ground_alone = false;                 ///< shadows fall on ground alone, and what stands there is not judged
};

/// Of a map's look-ups: raised by three halves of a texel, which is weighed with its neighbours. `texel`: as a tangent.
ShadowTolerance map_shadow_tolerance(double texel);
/// Of hulls that are exact but for a gap behind their casters.
ShadowTolerance volume_shadow_tolerance();

struct ShadowTally {
    int lit = 0, dark = 0; ///< pixels of which rays leave no doubt; with several lamps those that all light, or some do not
    int acne = 0;          ///< drawn darker than the lamps that surely shine there
    int leaks = 0;         ///< drawn brighter than the lamps that may shine there
    int unsure = 0, not_finite = 0;
    std::string first_wrong;

    int wrong() const { return acne + leaks + not_finite; }
    void add(const ShadowTally& other);
    std::string text() const;
};

/// A scene drawn by a shadow method and without shadows. The scene must outlive it.
class ShadowTrial {
  public:
    ShadowTrial(StabilityBench& bench, const Scene& scene, const ShadowSettings& settings);

    /// Draws the illuminance and judges each pixel that shows what the ray sees, lit as it sees it. `seen_from`: where rays to the lamps
    /// end instead, one a lamp.
    ShadowTally tally(const Moment& moment, const View& view, const ShadowTolerance& tolerance,
                      const std::vector<glm::dvec3>& seen_from = {});

  private:
    const Scene& scene_;
    Renderer renderer_, unshadowed_;
};

enum class Tried { light_and_shadow, either };
/// A tally without what is to be tried is not finite.
void judge_tally(Found& worst, const ShadowTally& tally, const std::string& where, Tried tried = Tried::light_and_shadow);

ShadowSettings shadows_by(ShadowMethod method);
/// Even light to so many degrees to each side, and up and down: 10 000 cd.
CandelaTable even_table(double half_width_deg, double half_height_deg);

using Triangles = std::vector<std::array<glm::dvec3, 3>>;
/// One mesh with flat normals by each triangle's winding; triangles without area get one upwards.
void add_triangles(Scene& scene, const std::string& name, std::uint32_t material, const glm::dvec3& origin_m, const Triangles& triangles);
/// Corners of a box about 0, outwards.
Triangles box(const glm::dvec3& half_m, double yaw_rad = 0.0);
Triangles turned_round(Triangles triangles);

/// Numbers by chance, the same on every machine. Compilers order the arguments of a call as they like: draw into braces or variables.
class Chance {
  public:
    explicit Chance(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
    int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }

  private:
    std::mt19937_64 engine_;
};

} // namespace fernlicht::stability
