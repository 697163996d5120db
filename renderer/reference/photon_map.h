// Photon mapping (H. W. Jensen, "Global Illumination using Photon Maps", Rendering Techniques 1996).
//
// Photons go from lamps, sky and shining surfaces from surface to surface as paths do (scattering.h), with Russian
// roulette, and leave their flux at every surface within reach that is not glass. Illuminance at a point is
//     E = sum 2 / (pi r^2) (1 - d^2 / r^2) flux    over photons closer than r,
// a kernel whose integral over a flat disc is 1 (Epanechnikov), of those that lie within 0.3 r of the surface's plane on a surface that
// faces the same way (cosine above 0.7). Sixteen maps, each of a sixteenth of the photons, from independent scrambled nets.
//
// Bias: what varies over the radius r is smoothed (by the Laplacian of E times r^2 / 12, and a shadow's edge over 2 r); nearer than r to
// the surface's end photons are missing, down to a half of the light on its edge and a quarter in its corner; light from beyond the reach,
// and the sky's that things beyond it would hide. All of it goes to 0 with r and the reach, and noise goes with 1 / (r sqrt(photons)).
//
// Where photons start and what flux they carry: lamps by their candela tables, surfaces by their own light, the sky.
//
// An emitter is a cell of a lamp's table, a shining triangle, sun or moon, or the sky over the reach. One is drawn with a probability p in
// proportion to its flux (for cells an estimate: the mean of the corners times the solid angle, which is above 0 wherever there is light;
// only in the half-space before the lamp), then a start within it evenly, over the solid angle of a cell, the area of a triangle with a
// cosine, the upper half of directions and a disc as wide as the reach across them. The flux carried is what the start stands for over its
// density, so that its mean is exact: for a lamp the table's flux (candela_table.h: flux_lm) before it, for a triangle pi L A, for the sky
// E_h / pi * 2 pi * pi reach^2, of which a level surface within gets E_h, and for sun and moon E pi reach^2, on a disc across their light
// from where they are seen.
#pragma once

#include "renderer/reference/patches.h"
#include "renderer/reference/solved_light.h"

namespace fernlicht::reference {

struct PhotonStart {
    Ray ray{glm::dvec3(0.0), glm::dvec3(0.0)}; ///< relative to the geometry's origin
    glm::dvec3 flux_lm{0.0};                   ///< linear sRGB with Y in lm; of the whole when one photon were sent
    bool from_lamp = false;                    ///< or from sun or moon
};

class PhotonEmission {
  public:
    explicit PhotonEmission(const Shot& shot);

    bool is_dark() const { return emitters_.empty(); }
    /// Pairs of the point that a start takes.
    static constexpr std::size_t pairs = 4;
    PhotonStart start(const Shot& shot, const SamplePoint& point) const;

  private:
    struct Emitter {
        double flux_lm = 0.0, up_to_lm = 0.0; ///< estimate; sum up to and with this one
        int lamp = -1;                        ///< a cell of its table, or
        int facet = -1;                       ///< a triangle, or
        bool direct = false;                  ///< sun or moon, or none of these: the sky
        double h0_rad = 0.0, h1_rad = 0.0, sin_v0 = 0.0, sin_v1 = 0.0;
    };
    void add_lamp(const LitLamp& lamp, int index);
    void add(Emitter emitter);

    std::vector<Emitter> emitters_;
    std::vector<Facet> shining_;
    double reach_m_ = 0.0;
};

class PhotonMap : public SolvedLight {
  public:
    PhotonMap(const Shot& shot, Preparation& preparation);

    glm::dvec3 irradiance(const SurfaceHit& hit, Part part, std::size_t replicate) const override;

    /// Flux that photons left, direct and all, mean of the replicates, linear sRGB with Y in lm: what the surfaces get per second.
    glm::dvec3 flux_lm(Part part) const;

  private:
    enum class Way : std::uint8_t { lamp, caustic, other };
    struct Photon {
        glm::vec3 place_m, normal, flux_lm;
        Way way;
    };
    struct Map {
        std::vector<Photon> photons;      ///< in the order of their cells
        std::vector<std::uint64_t> cells; ///< of each
        std::uint64_t rays = 0;
    };
    static bool counts(Way way, Part part);
    std::uint64_t cell_of(const glm::ivec3& cell) const;
    Map sent_out(const Shot& shot, const PhotonEmission& emission, std::size_t replicate, std::uint32_t count) const;

    double radius_m_, reach_m_;
    std::vector<Map> maps_; ///< of each replicate
};

} // namespace fernlicht::reference
