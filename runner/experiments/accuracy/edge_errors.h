// How accurate pictures are where surfaces and shadows end: what the one ray through a pixel's centre is worth there, and what a shadow
// method adds.
#pragma once

#include "renderer/reference/reference.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace fernlicht {

/// Pixels as a picture by areas marks them: with the edge of a shadow alone; of several surfaces; and marked with neither, within two
/// pixels of one that is. No light decides which pixel counts where, so that none is chosen by which side of an edge it is on.
enum class EdgePixels { shadow, surfaces, beside, all };

/// Sums of light, not means of shares: of a pixel of which an edge covers the part c, the ray through the centre tells 1 or 0 where c is
/// right. Its error's mean is 0 then, but that of its error as a share of c, above a half and below, is ln 2 - 1: 31 % too dark.
struct LightAtEdges {
    std::size_t pixels = 0;
    double mean = 0.0;                ///< sum of (tested - right) / sum of right; above 0 the picture is too bright
    double mean_standard_error = 0.0; ///< squares of 16 x 16 pixels taken for independent
    double absolute = 0.0;            ///< sum of |tested - right| / sum of right
    double mean_of_shares = 0.0;      ///< of (tested - right) / right, pixels that have the floor
    double beyond_ray = 0.0;          ///< sum of (tested - ray through the centre) / sum of right
    double beyond_ray_standard_error = 0.0;
};

struct EdgeRow {
    std::string way;
    LightAtEdges shadow, surfaces, beside, all;
};

/// Takes pictures one by one, of illuminances, all of one size.
class EdgeErrorFold {
  public:
    /// `floor_lx`: of mean_of_shares.
    EdgeErrorFold(std::string way, double floor_lx) : way_(std::move(way)), floor_lx_(floor_lx) {}

    /// `ray`: the same view by the one exact ray through each centre; `areas`: by the pixels' areas, with its marks.
    void add(const Image<float>& tested, const Image<float>& ray, const ReferenceImage& areas);
    EdgeRow finish() const;

  private:
    struct Sums {
        double error = 0.0, beyond_ray = 0.0, right = 0.0;
    };
    struct Kind {
        std::size_t pixels = 0, lit = 0;
        double absolute = 0.0, shares = 0.0;
        std::map<std::array<int, 3>, Sums> squares; ///< by picture, row and column
    };
    LightAtEdges error_of(EdgePixels pixels) const;

    std::string way_;
    double floor_lx_;
    int pictures_ = 0;
    std::map<EdgePixels, Kind> kinds_;
};

} // namespace fernlicht
