// Road extent of each moment, twice over: from a rendered lux map and from the double-precision twin.
// Illuminance at named points ahead of the car, from the drawn lux image and from the twin.
#pragma once

#include "runner/play/play.h"

namespace fernlicht {

/// Where a grid point lies between pixel centres: right of and below this pixel by these shares.
struct PixelPlace {
    int x = 0, y = 0;
    double fx = 0.0, fy = 0.0;
};

struct PixelPlaces {
    std::vector<PixelPlace> places;             ///< row-major, as the grid has them
    std::vector<std::pair<int, int>> between_y; ///< of each of the grid's rows: first and last row of pixels that it meets
};

/// What the extents of one moment are measured in.
struct ExtentDrawing {
    Moment moment;
    ExtentGrid grid;
    View view;
    PixelPlaces pixels;  ///< of the grid's points in the view
    Frame frame;         ///< its lux images are empty where the technique computes none
    bool nudged = false; ///< whether the twin is asked for what nudges do
};

/// After its view: where the grid's points lie in it, and so where anybody looks.
void place_pixels(ExtentDrawing& drawing);

class ExtentFold {
  public:
    /// The drive must ask for an extent. Drive and route must outlive the fold. `nudges`: of which the twin tells the effect.
    ExtentFold(const Drive& drive, const Route& route, const Nudges& nudges = {}) : drive_(drive), route_(route), nudges_(nudges) {}

    /// By the thread that draws.
    ExtentDrawing draw(const Moment& moment, const Draw& draw) const;
    /// By any thread. No rendered extents of a plane whose lux image is empty.
    ExtentRow measure(const ExtentDrawing& drawing) const;
    /// Only what is measured in the frame's pictures.
    std::vector<LaneExtent> rendered(const ExtentDrawing& drawing) const;

  private:
    const Drive& drive_;
    const Route& route_;
    Nudges nudges_;
};

/// The smallest map view of this moment that covers the grid, at most 0.25 m a pixel where 1024 pixels a side allow.
View map_over(const ExtentGrid& grid, const Moment& moment);

/// A map of 3 x 3 pixels of a centimetre each, the point in the middle one.
View map_around(const glm::dvec3& point_m, const Moment& moment);

class ProbeFold {
  public:
    ProbeFold(const Drive& drive, const Route& route, const Nudges& nudges = {})
        : drive_(drive), route_(route), nudges_(nudges), found_(drive.probes.size()) {}

    void add(const Moment& moment, const Draw& draw);
    /// For each probe NAME: probe_NAME_lx (drawn) and probe_NAME_twin_lx, medians over the drive; probe_NAME_min_lx and _max_lx (drawn).
    /// Not drawn: probes above the surface, and all by a technique without illuminance. Probes beside the pavement have no twin.
    Readings finish() const;

  private:
    struct Series {
        std::vector<double> drawn, twin;
        std::array<std::vector<double>, nudge_kinds> nudged; ///< of the twin
        bool beside_road = false; ///< beyond the pavement at some moment: what is drawn there is the verge, which the twin does not know
        bool not_drawn = false;   ///< the technique computes no illuminance
        bool near_field = false;  ///< nearer to a lamp than its photometric distance at some moment
    };
    const Drive& drive_;
    const Route& route_;
    Nudges nudges_;
    std::vector<Series> found_;
};

} // namespace fernlicht
