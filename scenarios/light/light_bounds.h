// Illuminance within bounds, at many points at once and in a fraction of the time of light.h: for callers that ask at many points whether
// there is enough, and only at few of them how much.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/light/light_bounds_packs.h"

#include <limits>
#include <span>

namespace fernlicht {

/// The illuminance lies in low_lx..high_lx. An infinite high_lx, or a NaN, says that nothing is known.
struct LuxBounds {
    double low_lx = 0.0, high_lx = std::numeric_limits<double>::infinity();
};

/// Places and normals of a surface, as packs of numbers read them: many times a second for one road.
struct SurfacePlaces {
    SurfacePlaces() = default;
    explicit SurfacePlaces(std::span<const Pose> surface) : SurfacePlaces(surface.size()) { put(0, surface); }
    explicit SurfacePlaces(std::size_t count);
    void put(std::size_t first, std::span<const Pose> surface);

    std::vector<double> x_m, y_m, z_m;
    std::vector<float> normal_x, normal_y, normal_z;
};

/// The lamps of a moment, in packs of floats; the bounds hold their rounding. Nothing is known of a lamp whose table has gaps or runs in
/// the logarithm, and of directions more than 30 degrees up or down. The same bytes on every processor.
class LightBounds {
  public:
    explicit LightBounds(const Moment& moment, packs::Level level = packs::widest_level());
    LightBounds(const LightBounds&) = delete;

    /// Bounds of surface_illuminance_lx at places from `first` on. Where it is surely below `enough_lx`, they may be wide.
    void surface_lx(const SurfacePlaces& places, std::size_t first, double enough_lx, std::span<LuxBounds> bounds) const;
    /// Bounds of target_illuminance_lx so high above them.
    void target_lx(const SurfacePlaces& places, std::size_t first, double height_m, std::span<LuxBounds> bounds) const;

  private:
    struct Axis {
        explicit Axis(const std::vector<double>& samples_deg);

        double error_rad = 0.0;                  ///< of an angle, beside the axis's ends
        double blur_rad = 0.0, blur_cells = 0.0; ///< of the place between samples where its light is taken from
        std::vector<float> start_and_per_rad;    ///< by bucket
        packs::BeamAxis in_packs{};              ///< but for where the buckets lie
    };
    struct Table {
        explicit Table(const CandelaTable& table);

        Axis h, v;
        std::vector<float> cd;
        double peak_cd = 0.0, error_cd = 0.0; ///< infinite where it cannot be told
    };

    template <class Bound>
    void bound(const SurfacePlaces& places, std::size_t first, double raised_m, std::span<LuxBounds> bounds, Bound bound_places) const;

    packs::Level level_;
    std::vector<Table> tables_;             ///< one per lamp file
    std::vector<packs::BoundedLamp> lamps_; ///< those that are on
    packs::BoundedLight light_{};
};

} // namespace fernlicht
