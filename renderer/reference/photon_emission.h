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
#include "renderer/reference/shot.h"

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

} // namespace fernlicht::reference
