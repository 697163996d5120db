// How far the pixels of a picture lie from a reference that has a noise of its own: in shares where there is light to speak of, in units
// where there is next to none. What lies within the reference's noise is not claimed as an error.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace fernlicht {

/// One pixel held against the reference, in the picture's unit (lx, cd/m2).
struct ComparedPixel {
    double tested = 0.0, reference = 0.0;
    double standard_error = 0.0;   ///< of `reference`
    std::optional<double> area_m2; ///< of the surface that the pixel shows; 0: takes no part in shares of area; nullopt: pixels are counted
    int picture = 0, x = 0, y = 0;
};

struct ErrorRule {
    /// Where the reference is at least this, errors are shares of it; below, they are absolute. > 0.
    double relative_from = 0.05;
    /// An error of fewer standard errors of the reference than this may be the reference's own (2: 95 % of a normal distribution).
    double sure = 2.0;
};

/// The errors beyond which area is counted: 1, 5 and 20 %.
inline constexpr std::array<double, 3> counted_errors{0.01, 0.05, 0.20};

struct WorstPixel {
    double error = 0.0; ///< share or absolute, as the list that it stands in
    double tested = 0.0, reference = 0.0;
    int picture = 0, x = 0, y = 0;
};

/// Quantiles over pixels by linear interpolation between order statistics (type 7 of Hyndman and Fan 1996).
struct ErrorQuantiles {
    double median = 0.0, p95 = 0.0, p99 = 0.0;
};

struct QuantileInterval {
    double low = 0.0, high = 0.0;
};

struct PixelErrors {
    // Where the reference is at least relative_from; shares of the reference.
    std::size_t pixels = 0;
    ErrorQuantiles error;                        ///< of |tested - reference| / reference
    std::optional<QuantileInterval> p95_between; ///< with about 95 % confidence, where some tiles stand for all; nullopt: all, or too few
    ErrorQuantiles floor;                        ///< of sure * standard error / reference: errors below are the reference's own
    double mean = 0.0;                           ///< signed, over the pixels: above 0 the picture is too bright
    WorstPixel worst;                            ///< the largest error
    std::optional<double> area_m2;               ///< together; nullopt where the pixels came without areas
    std::array<double, 3> percent_beyond{}; ///< of that area, else of the pixels, beyond counted_errors by more than the noise; 0 of 0 m2
    // Where it is less; in the picture's unit.
    std::size_t dark_pixels = 0;
    ErrorQuantiles dark_error, dark_floor;
    WorstPixel dark_worst;

    bool below_floor() const { return error.p95 < floor.p95; }
};

/// Takes pixels one by one; eight bytes a pixel.
class PixelErrorFold {
  public:
    explicit PixelErrorFold(const ErrorRule& rule = {}) : rule_(rule) {}

    /// Either all pixels have an area or none has. Throws std::invalid_argument for a value that is not finite, an error or area below 0,
    /// and a pixel with an area among others without, naming the pixel.
    void add(const ComparedPixel& pixel);
    /// The pixels that follow are of a tile that was drawn at random from this row of tiles (sampling_order()).
    void begin_tile(int row) { tiles_.push_back({row, errors_.size()}); }
    /// nullopt where no pixel was compared. `tiles_of_row`: among how many the tiles of a row were drawn.
    std::optional<PixelErrors> finish(std::size_t tiles_of_row = 0) const;

  private:
    struct Tile {
        int row = 0;
        std::size_t first = 0; ///< of errors_
    };
    std::optional<QuantileInterval> p95_between(const std::vector<float>& ascending, std::size_t tiles_of_row) const;

    ErrorRule rule_;
    PixelErrors so_far_;
    double signed_sum_ = 0.0;
    std::size_t without_area_ = 0;   ///< of the pixels in errors_
    double sum_ = 0.0;               ///< m2 or pixels
    std::array<double, 3> beyond_{}; ///< of these
    std::vector<float> errors_, floors_, dark_errors_, dark_floors_;
    std::vector<Tile> tiles_;
};

} // namespace fernlicht
