// Illuminance within bounds, in two thirds of the time of light.h, or a sixth where it is surely too little: for callers that ask at many
// points whether there is enough, and only at few of them how much.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <cstdint>
#include <limits>

namespace fernlicht {

/// The illuminance lies in low_lx..high_lx. An infinite high_lx, or a NaN, says that nothing is known.
struct LuxBounds {
    double low_lx = 0.0, high_lx = std::numeric_limits<double>::infinity();
};

/// The lamps of a moment. Refers to their files, which must outlive it. Nothing is known of a lamp whose table has gaps or runs in the
/// logarithm, and of directions more than 30 degrees up or down.
class LightBounds {
  public:
    explicit LightBounds(const Moment& moment);

    /// Bounds of surface_illuminance_lx. Where it is surely below `enough_lx`, they may be wide.
    LuxBounds surface_lx(const glm::dvec3& point_m, const glm::dvec3& normal, double enough_lx) const;
    /// Bounds of target_illuminance_lx.
    LuxBounds target_lx(const glm::dvec3& point_m) const;

  private:
    /// Cells of an axis, and for buckets of equal width the cell in which to begin looking.
    struct Axis {
        explicit Axis(const std::vector<double>& samples_deg);
        /// The cell of an angle on the axis and the share of it that lies below the angle.
        std::pair<std::size_t, double> place(double deg) const;

        struct Cell {
            double from_deg, to_deg, per_deg;
        };
        std::vector<Cell> cells;
        double buckets_per_deg = 0.0;
        std::vector<std::uint32_t> first_cell;
    };
    struct Table {
        explicit Table(const CandelaTable& table);
        double linear_cd(double h_deg, double v_deg) const;

        const CandelaTable* table;
        Axis h, v;
        double peak_cd = 0.0;
        double error_cd = 0.0; ///< of linear_cd at angles that are off by angle_error_deg; infinite where it cannot be told
    };
    struct Lamp {
        glm::dvec3 position_m, right, up, forward;
        double factor;
        std::size_t table;
    };
    struct Intensity {
        double cd = 0.0, error_cd = 0.0;
    };
    /// On a surface of this normal, or facing each lamp, beside `e` that is there without them.
    LuxBounds sum(const glm::dvec3& point_m, const glm::dvec3* normal, double e) const;
    Intensity towards(const Lamp& lamp, const glm::dvec3& from_lamp, double inverse_d) const;

    std::vector<Table> tables_; ///< one per lamp file
    std::vector<Lamp> lamps_;   ///< those that are on
    Daylight daylight_;
    Weather weather_;
};

} // namespace fernlicht
