// Lamps of pixels or segments that dim one by one: what light each gives, and how it follows what it is told.
#pragma once

#include "scenarios/lamps/candela_table.h"

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace fernlicht {

/// Goniometer angles in degrees.
struct AngleBox {
    double left_deg = 0.0, right_deg = 0.0, bottom_deg = 0.0, top_deg = 0.0;
    bool operator==(const AngleBox&) const = default;
};

/// Pixels that are all alike, in columns and rows over a field of angles. A pixel's light is its rectangle blurred by a Gaussian, so that
/// equal pixels together light the field evenly, but for its borders.
struct PixelRaster {
    int columns = 1, rows = 1;
    AngleBox field;                                ///< of all pixels, without the blur
    double spread_h_deg = 0.1, spread_v_deg = 0.1; ///< the Gaussian's standard deviation, > 0
    std::vector<double> cd;                        ///< by pixel: intensity of a field all of whose pixels have it
    double crosstalk = 0.0;                        ///< share of a pixel's light that leaves by its four neighbours, to equal parts; 0 to 1
};

struct PixelSegment {
    std::string name;
    CandelaTable table;
    AngleBox lights; ///< directions in which it is meant to be dark for others
};

/// How a level that is asked for, 0 to 1, becomes light.
struct PixelAnswer {
    double latency_s = 0.0;
    double slew_per_s = std::numeric_limits<double>::infinity(); ///< of the level
    int steps = 0;                                               ///< between dark and full; 0: any level
    double exponent = 1.0;                                       ///< light is level to the power of it, > 0
    bool operator==(const PixelAnswer&) const = default;
};

/// Pixels are counted as in a picture, from the top left along the rows; segments as they are listed.
struct PixelParts {
    std::vector<PixelRaster> raster;    ///< one, or none
    std::vector<PixelSegment> segments; ///< without a raster
    std::vector<CandelaTable> base;     ///< of what is always on: one, or none
    std::vector<std::size_t> dead;      ///< dark whatever they are asked for
    PixelAnswer answer;
};

class PixelLamp {
  public:
    static constexpr std::size_t most_samples = 4'000'000; ///< of its table
    static constexpr std::size_t most_segments = 1000;

    /// Throws std::invalid_argument for neither raster nor segments, both, or a table of more than most_samples.
    explicit PixelLamp(PixelParts parts);

    std::size_t count() const { return dead_.size(); }
    const PixelParts& parts() const { return parts_; }
    const PixelAnswer& answer() const { return parts_.answer; }
    AngleBox lights(std::size_t pixel) const; ///< a pixel's rectangle, a segment's own
    /// The light of these levels, count() of them within 0..1: base plus the sum over pixels of level^exponent times what the pixel shines.
    /// A raster's samples are exact; between them light runs linearly, as in every table. The axes are always the same.
    CandelaTable table(std::span<const float> levels) const;
    PixelLamp mirrored() const; ///< H -> -H; a pixel's number stays with its place in the picture, a segment's with the segment

  private:
    /// What one sample of an axis takes of the raster's columns or rows.
    struct Share {
        int first = 0;
        std::vector<double> of;
    };
    struct Patch { ///< of a segment: where it is lit, on the table's axes
        std::size_t h = 0, v = 0, columns = 0, rows = 0;
        std::vector<double> cd;
    };
    std::vector<double> light_of(std::span<const float> levels) const;
    void add_raster(const std::vector<double>& light, CandelaTable& table) const;

    PixelParts parts_;
    CandelaTable dark_; ///< axes, and the base
    std::vector<Share> across_, up_;
    std::vector<Patch> patches_;
    std::vector<bool> dead_;
};

} // namespace fernlicht
