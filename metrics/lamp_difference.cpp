#include "metrics/lamp_difference.h"

#include "metrics/cut_off_line.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

constexpr double floor_share = 1e-4;    ///< of the peak; less is taken as this, for its logarithm
constexpr double compared_share = 1e-3; ///< of the peak: fainter light is not compared
constexpr double band_deg = 0.5;        ///< round the cut-off: what a raised cut-off moves
constexpr double body_deg = 1.5;        ///< below its level part begins the light that it does not move
constexpr std::size_t most_fitted = 3000;
/// A shift below this part of the tables' steps cannot be told from how intensity runs between the samples.
constexpr double least_step_share = 0.05;
/// An explanation counts when it at least halves the directions that would be claimed as zones: a zone's own border is uncertain by a
/// sample.
constexpr double must_leave = 0.5;

/// What the differences are put down to, before zones.
struct Explanation {
    BeamShift shift;
    double cut_off_up_deg = 0.0, log_level = 0.0;
};

class Comparison {
  public:
    Comparison(const CandelaTable& tested, const CandelaTable& against, const LampDifferenceOptions& options)
        : tested_(tested), peak_cd_(std::max(peak_of(tested).cd, peak_of(against).cd)), against_(against, floor_share * peak_cd_),
          line_(against_, peak_cd_), options_(options) {
        collect();
        set_noise({});
        z_limit_ = z_limit(options.false_claim_chance, 3 * samples_.size() + 6);
    }

    LampDifference find();

  private:
    void collect();
    void set_noise(const Explanation& explained);
    ResidualGrid residuals(const Explanation& explained) const;
    bool is_moved_by_cut_off(double v_deg, const Explanation& explained) const {
        return explained.cut_off_up_deg != 0.0 && v_deg > line_.lowest_deg() - body_deg;
    }
    FieldValue unexplained(const BeamSample& sample, const Explanation& explained) const;
    std::vector<BeamSample> where(const auto& belongs) const;
    bool is_beyond(double value, double error, double least) const { return std::abs(value) > std::max(z_limit_ * error, least); }
    bool is_shift(const ShiftFit& fit) const;
    std::size_t claimed(const Explanation& explained) const;
    struct Level {
        double log = 0.0, error = 0.0, open = 0.0; ///< `open`: what interpolation leaves open, on the mean
    };
    Level level_left(const Explanation& explained) const;
    bool explain_by_cut_off(Explanation& best, LampDifference& result) const;
    void explain_by_aim(Explanation& best, LampDifference& result) const;
    void explain_by_level(Explanation& best, LampDifference& result) const;

    const CandelaTable& tested_;
    double peak_cd_;
    BeamField against_;
    CutOffLine line_;
    LampDifferenceOptions options_;
    std::vector<BeamSample> samples_;
    std::vector<double> rounding_; ///< by sample
    double noise_at_peak_ = 0.0, z_limit_ = 0.0;
};

/// Within the compared part, the finest step of the coarser table.
double finest_step(const std::vector<double>& axis) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < axis.size(); ++i)
        least = std::min(least, axis[i] - axis[i - 1]);
    return least;
}

void Comparison::collect() {
    const double floor_cd = floor_share * peak_cd_, least = std::log(compared_share * peak_cd_);
    const double rounding_cd = std::hypot(rounding_of(tested_), rounding_of(against_.table())) / std::sqrt(12.0); // of a uniform error
    for (std::size_t v = 0; v < tested_.v_deg.size(); ++v)
        for (std::size_t h = 0; h < tested_.h_deg.size(); ++h) {
            const double h_deg = tested_.h_deg[h], v_deg = tested_.v_deg[v];
            if (!has_data(tested_, h_deg, v_deg) || !against_.has(h_deg, v_deg))
                continue;
            const double log_cd = std::log(std::max(tested_.at(v, h), floor_cd)), log_other = against_.at(h_deg, v_deg).log_cd;
            if (std::max(log_cd, log_other) < least)
                continue;
            samples_.push_back({v, h, h_deg, v_deg, log_cd, 0.0});
            // The last term is what a double's last digits are worth in a logarithm: two equal tables still need a scale.
            rounding_.push_back(std::max(rounding_cd * std::exp(-std::min(log_cd, log_other)), 1e-9));
        }
}

/// Noise may go with the level of light, so it is estimated by decades below the peak.
void Comparison::set_noise(const Explanation& explained) {
    Explanation plain = explained; // a range of shifts takes noise away with the rest
    plain.shift.up_deg += std::exchange(plain.cut_off_up_deg, 0.0);
    const ResidualGrid grid = residuals(plain);
    const double log_peak = std::log(peak_cd_);
    for (int decade = 0; decade < 3; ++decade) {
        const auto is_in = [&](const BeamSample& sample) {
            return std::clamp(static_cast<int>((log_peak - sample.log_cd) / std::log(10.0)), 0, 2) == decade;
        };
        std::vector<bool> chosen(grid.r.size());
        for (const BeamSample& sample : samples_)
            chosen[sample.v * tested_.h_deg.size() + sample.h] = is_in(sample);
        const double noise = std::max(neighbour_noise(grid, chosen), options_.noise_relative * std::sqrt(2.0)); // of a difference of two
        if (decade == 0)
            noise_at_peak_ = noise;
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (is_in(samples_[i]))
                samples_[i].sigma = std::max(noise, rounding_[i]);
    }
}

/// How far a raised cut-off moves the light near and above it is not known: any shift up to its own explains.
FieldValue Comparison::unexplained(const BeamSample& sample, const Explanation& explained) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const bool is_near = is_moved_by_cut_off(sample.v_deg, explained);
    double low = std::numeric_limits<double>::infinity(), high = -low, open = 0.0;
    const int steps = is_near ? 8 : 0;
    for (int i = 0; i <= steps; ++i) {
        BeamShift shift = explained.shift;
        shift.up_deg += is_near ? explained.cut_off_up_deg * i / steps : 0.0;
        const auto r = residual(against_, sample, shift);
        if (!r)
            return {nan, 0.0};
        low = std::min(low, r->log_cd - explained.log_level);
        high = std::max(high, r->log_cd - explained.log_level);
        open = std::max(open, r->uncertainty);
    }
    return {low > 0.0 ? low : std::min(high, 0.0), open};
}

ResidualGrid Comparison::residuals(const Explanation& explained) const {
    ResidualGrid grid{tested_.h_deg, tested_.v_deg, {}, {}, {}};
    grid.r.assign(tested_.cd.size(), std::numeric_limits<double>::quiet_NaN());
    grid.sigma.assign(tested_.cd.size(), 1.0);
    grid.open.assign(tested_.cd.size(), 0.0);
    for (const BeamSample& sample : samples_) {
        const std::size_t at = sample.v * tested_.h_deg.size() + sample.h;
        const FieldValue value = unexplained(sample, explained);
        grid.r[at] = value.log_cd;
        grid.open[at] = value.uncertainty;
        grid.sigma[at] = sample.sigma;
    }
    return grid;
}

std::vector<BeamSample> Comparison::where(const auto& belongs) const {
    std::vector<BeamSample> chosen, out;
    std::ranges::copy_if(samples_, std::back_inserter(chosen), belongs);
    const std::size_t stride = chosen.size() / most_fitted + 1;
    for (std::size_t i = 0; i < chosen.size(); i += stride)
        out.push_back(chosen[i]);
    return out;
}

bool Comparison::is_shift(const ShiftFit& fit) const {
    const CandelaTable& other = against_.table();
    const double least_h = least_step_share * std::max(finest_step(tested_.h_deg), finest_step(other.h_deg));
    const double least_v = least_step_share * std::max(finest_step(tested_.v_deg), finest_step(other.v_deg));
    return fit.found &&
           (is_beyond(fit.shift.up_deg, fit.up_error_deg, least_v) || is_beyond(fit.shift.right_deg, fit.right_error_deg, least_h));
}

std::size_t Comparison::claimed(const Explanation& explained) const {
    std::size_t samples = 0;
    for (const BeamZone& zone : find_zones(residuals(explained), z_limit_))
        samples += zone.samples;
    return samples;
}

bool Comparison::explain_by_cut_off(Explanation& best, LampDifference& result) const {
    if (!line_.exists())
        return false;
    const auto offset = [&](const BeamSample& sample) {
        const auto line = line_.at(sample.h_deg);
        return line ? sample.v_deg - *line : std::numeric_limits<double>::quiet_NaN();
    };
    const ShiftFit band = fit_shift(against_, where([&](const BeamSample& s) { return std::abs(offset(s)) <= band_deg; }), {});
    if (!is_shift(band))
        return false;
    const ShiftFit body = fit_shift(against_, where([&](const BeamSample& s) { return s.v_deg < line_.lowest_deg() - body_deg; }), {});
    const double raise = band.shift.up_deg - body.shift.up_deg, error = std::hypot(band.up_error_deg, body.up_error_deg);
    if (!body.found || body.up_error_deg > std::abs(band.shift.up_deg) / 4.0) {
        result.not_told = "the light below the cut-off is too even to tell whether the whole beam moved or the cut-off alone";
        return false;
    }
    const double least = least_step_share * std::max(finest_step(tested_.v_deg), finest_step(against_.table().v_deg));
    if (!is_beyond(raise, error, least) || std::abs(body.shift.up_deg) > std::abs(raise) / 2.0)
        return false;
    Explanation tried = best;
    tried.cut_off_up_deg = raise;
    if (is_shift(body))
        tried.shift = body.shift;
    else
        tried.cut_off_up_deg = band.shift.up_deg;
    if (const std::size_t without = claimed(best);
        without > 0 && static_cast<double>(claimed(tried)) > must_leave * static_cast<double>(without))
        return false;
    best = tried;
    result.cut_off_up_deg = {tried.cut_off_up_deg, error};
    if (is_shift(body)) {
        result.aim_up_deg = {body.shift.up_deg, body.up_error_deg};
        result.aim_right_deg = {body.shift.right_deg, body.right_error_deg};
    }
    return true;
}

void Comparison::explain_by_aim(Explanation& best, LampDifference& result) const {
    const std::vector<BeamSample> all = where([](const BeamSample&) { return true; });
    ShiftFit fit = fit_shift(against_, all, BeamTurn::angles_shifted);
    if (!is_shift(fit))
        return;
    if (const ShiftFit rotated = fit_shift(against_, all, BeamTurn::lamp_rotated); rotated.found && rotated.scale < fit.scale)
        fit = rotated;
    Explanation tried = best;
    tried.shift = fit.shift;
    Explanation with_level = tried;
    with_level.log_level = fit.log_level;
    const std::size_t without = claimed(best);
    if (without > 0 && static_cast<double>(std::min(claimed(tried), claimed(with_level))) > must_leave * static_cast<double>(without))
        return;
    best = tried;
    result.aim_up_deg = {fit.shift.up_deg, fit.up_error_deg};
    result.aim_right_deg = {fit.shift.right_deg, fit.right_error_deg};
}

/// Location of what is left over by Tukey's biweight, from the median on; without the light that a cut-off moved by an unknown part.
Comparison::Level Comparison::level_left(const Explanation& explained) const {
    ResidualGrid grid = residuals(explained);
    for (const BeamSample& sample : samples_)
        if (is_moved_by_cut_off(sample.v_deg, explained))
            grid.r[sample.v * tested_.h_deg.size() + sample.h] = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> left;
    for (const double r : grid.r)
        if (!std::isnan(r))
            left.push_back(r);
    if (left.empty())
        return {};
    std::ranges::nth_element(left, left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2));
    Level level{left[left.size() / 2]};
    for (int iteration = 0; iteration < 20; ++iteration) {
        double weights = 0.0, sum = 0.0, open = 0.0;
        for (std::size_t at = 0; at < grid.r.size(); ++at) {
            const double u = (grid.r[at] - level.log) / (4.685 * grid.sigma[at]);
            if (std::isnan(u) || std::abs(u) >= 1.0)
                continue;
            const double weight = (1.0 - u * u) * (1.0 - u * u) / (grid.sigma[at] * grid.sigma[at]);
            weights += weight;
            sum += weight * grid.r[at];
            open += weight * grid.open[at];
        }
        if (weights == 0.0)
            return {};
        level = {sum / weights, 1.0 / std::sqrt(weights), open / weights};
    }
    return level;
}

void Comparison::explain_by_level(Explanation& best, LampDifference& result) const {
    const Level level = level_left(best);
    if (!is_beyond(level.log, level.error, level.open))
        return;
    Explanation tried = best;
    tried.log_level = level.log;
    if (const std::size_t without = claimed(best);
        without > 0 && static_cast<double>(claimed(tried)) > must_leave * static_cast<double>(without))
        return;
    best = tried;
    const double share = std::expm1(level.log);
    result.level = {share, (1.0 + share) * (level.error + level.open)};
}

LampDifference Comparison::find() {
    LampDifference result;
    result.directions = samples_.size();
    result.z_limit = z_limit_;
    result.floor_cd = compared_share * peak_cd_;
    Explanation best;
    if (!explain_by_cut_off(best, result))
        explain_by_aim(best, result);
    set_noise(best); // without what the shift made of it
    explain_by_level(best, result);
    result.noise_relative = noise_at_peak_;
    result.zones = find_zones(residuals(best), z_limit_);
    if (!result.aim_up_deg && !result.cut_off_up_deg)
        result.not_told.clear();
    return result;
}

} // namespace

LampDifference compare_lamps(const CandelaTable& tested, const CandelaTable& against, const LampDifferenceOptions& options) {
    if (!(options.noise_relative >= 0.0) || !(options.noise_relative <= 1.0))
        throw std::invalid_argument("noise outside 0..1");
    if (!(options.false_claim_chance > 0.0) || !(options.false_claim_chance < 1.0))
        throw std::invalid_argument("chance of a false claim outside 0..1");
    if (!(peak_of(tested).cd > 0.0) || !(peak_of(against).cd > 0.0))
        throw std::invalid_argument("a lamp without light");
    return Comparison(tested, against, options).find();
}

std::vector<std::string> sentences_of(const LampDifference& difference) {
    std::vector<std::string> out;
    const auto turned = [](double deg, const char* more, const char* less) {
        return fmt::format("{:.3f} degrees {}", std::abs(deg), deg < 0.0 ? less : more);
    };
    if (difference.aim_up_deg)
        out.push_back(fmt::format("aimed {} and {}: the whole beam (±{:.3f} and ±{:.3f})",
                                  turned(difference.aim_up_deg->value, "higher", "lower"),
                                  turned(difference.aim_right_deg->value, "to the right", "to the left"),
                                  difference.aim_up_deg->uncertainty, difference.aim_right_deg->uncertainty));
    if (difference.cut_off_up_deg)
        out.push_back(fmt::format("cut-off {} (±{:.3f}), over the light below it",
                                  turned(difference.cut_off_up_deg->value, "higher", "lower"), difference.cut_off_up_deg->uncertainty));
    const auto changed = [](double share) {
        return fmt::format("{:.2f} % {}", 100.0 * std::abs(share), share < 0.0 ? "dimmer" : "brighter");
    };
    if (difference.level)
        out.push_back(fmt::format("{} all over (±{:.3f} %)", changed(difference.level->value), 100.0 * difference.level->uncertainty));
    for (const BeamZone& zone : difference.zones)
        out.push_back(fmt::format("{} within H {:.2f}..{:.2f}, V {:.2f}..{:.2f} degrees (±{:.2f} %, {} directions)", changed(zone.share),
                                  zone.h_from_deg, zone.h_to_deg, zone.v_from_deg, zone.v_to_deg, 100.0 * zone.uncertainty, zone.samples));
    if (out.empty())
        out.push_back("no difference beyond noise");
    if (!difference.not_told.empty())
        out.push_back(difference.not_told);
    return out;
}

} // namespace fernlicht
