// Luminous intensity over the UN goniometer's angles: the one form in which every lamp file ends.
// Systems of angles other than the UN goniometer's, and a table as its file lists it.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// How intensity runs between the samples of a table.
enum class BetweenSamples { linear_cd, log_cd };

/// Intensity in candela over H (right positive) and V (up positive), degrees, UN goniometer: H = atan2(x, z), V = asin(y) with x right, y
/// up, z forward. Axes ascend strictly, at least two samples each, H within -180..180, V within -90..90. Outside the axes, and inside a
/// cell marked as a gap, there is no light: intensity 0, never an extrapolation. A table whose H axis runs from -180 to 180 wraps round.
struct CandelaTable {
    std::vector<double> h_deg;
    std::vector<double> v_deg;
    std::vector<double> cd;          ///< row-major: cd[v * h_deg.size() + h], each finite and >= 0
    std::vector<unsigned char> gaps; ///< empty, or (v_deg.size() - 1) * (h_deg.size() - 1) cells: 1 = no data between these four samples
    BetweenSamples rule = BetweenSamples::linear_cd;

    double at(std::size_t v, std::size_t h) const { return cd[v * h_deg.size() + h]; }
    double& at(std::size_t v, std::size_t h) { return cd[v * h_deg.size() + h]; }
    bool operator==(const CandelaTable&) const = default;
};

/// Intensity in cd by the table's rule at any direction; H is taken modulo 360, a NaN angle gives 0. log_cd falls back to linear in a cell
/// that holds a zero.
double intensity_cd(const CandelaTable& table, double h_deg, double v_deg);

/// How the intensity towards a direction answers to one sample of the table, `sample` an index into CandelaTable::cd.
struct SampleWeight {
    std::size_t sample = 0;
    double weight = 0.0; ///< d intensity / d sample
};
/// Of the four samples that intensity_cd() is taken from; nullopt where there is no data. By linear_cd the weights are bilinear and add up
/// to 1; by log_cd each is that weight times intensity over sample.
std::optional<std::array<SampleWeight, 4>> sample_weights(const CandelaTable& table, double h_deg, double v_deg);

/// intensity_cd() at all these H, where many V are asked for: places on the axis are looked up once.
class IntensityAcross {
  public:
    /// The table must outlive it.
    IntensityAcross(const CandelaTable& table, const std::vector<double>& h_deg);
    /// In the order of H; until the next call.
    const std::vector<double>& at(double v_deg);

  private:
    struct Column {
        std::size_t cell;
        double fraction;
        bool inside;
    };
    const CandelaTable& table_;
    std::vector<Column> columns_;
    std::vector<double> cd_;
};

/// Whether the direction lies on the axes and not inside a gap. A border belongs to the side that has data.
bool has_data(const CandelaTable& table, double h_deg, double v_deg);

struct Peak {
    double cd = 0.0, h_deg = 0.0, v_deg = 0.0;
};
Peak peak_of(const CandelaTable& table);

/// Luminous flux in lumen: the integral of I cos(V) dH dV over the table's cells, for the table's own rule.
double flux_lm(const CandelaTable& table);

/// Throws std::invalid_argument naming what is wrong when the invariants above do not hold.
void check_invariants(const CandelaTable& table);

CandelaTable scaled(CandelaTable table, double factor); ///< factor >= 0
CandelaTable mirrored(const CandelaTable& table);       ///< H -> -H: right-hand to left-hand traffic
CandelaTable sum(const CandelaTable& a,
                 const CandelaTable& b); ///< on the union of both axes: exact for linear_cd, for log_cd at its samples
/// a - b on the union of both axes; negative differences become 0 and are counted in `clamped`.
CandelaTable difference(const CandelaTable& a, const CandelaTable& b, std::size_t& clamped);

/// How wrong the rule is: every second row and column predicted from the others.
struct InterpolationError {
    std::size_t samples = 0;      ///< predicted samples; 0: table too small to tell
    double median_relative = 0.0; ///< of |predicted - given| / peak
    double p95_relative = 0.0;
    double worst_relative = 0.0;
    double worst_h_deg = 0.0, worst_v_deg = 0.0;
};
InterpolationError interpolation_error(const CandelaTable& table);

/// The smallest distance between neighbours on an axis that rises; infinite where there is one place alone.
double finest_step(const std::vector<double>& axis);

struct TwoAngles {
    double h_deg = 0.0, v_deg = 0.0;
};

/// Another system's two angles, its polar axis elsewhere. Each function is the inverse of the other where both are defined.
struct AngleSystem {
    std::string name;                                   ///< for notes: "type B"
    std::function<TwoAngles(double, double)> to_native; ///< from UN H, V to the system's own two angles
    std::function<TwoAngles(double, double)> to_un;
    bool turns_about_beam = false; ///< the first angle does: its steps say nothing of how far directions lie apart
};

/// What was measured, before it was brought onto H and V.
struct MeasuredTable {
    CandelaTable table; ///< over the system's two angles
    AngleSystem system;
};

MeasuredTable scaled(MeasuredTable measured, double factor); ///< factor >= 0
MeasuredTable mirrored(MeasuredTable measured);              ///< H and -H exchanged

} // namespace fernlicht
