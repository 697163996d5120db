#include "metrics/beam/lamp_difference.h"

#include "metrics/beam/beam_field.h"
#include "metrics/beam/beam_shift.h"
#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

constexpr double floor_share = 1e-4;    ///< of the peak; less is taken as this, for its logarithm
constexpr double compared_share = 1e-3; ///< of the peak: fainter light is not compared
constexpr double band_deg = 0.5;        ///< round the cut-off: what a raised cut-off moves
constexpr double body_deg = 1.5;        ///< below its level part begins the light that it does not move
constexpr std::size_t max_fitted = 3000;
/// A shift below this part of the tables' steps cannot be told from how intensity runs between the samples.
constexpr double min_step_share = 0.05;
/// An explanation counts when it at least halves the directions that would be claimed as zones: a zone's own border is uncertain by a
/// sample.
constexpr double must_leave = 0.5;

/// What the differences are put down to, before zones.
struct Explanation {
    BeamShift shift;
    double cut_off_up_deg = 0.0, log_level = 0.0;
};

struct Steps {
    double h_deg, v_deg;
};

Steps finest_steps(const SampledBeam& beam) {
    const double v = finest_step(beam.samples().v_deg);
    return {beam.measured && beam.measured->system.turns_about_beam ? v : finest_step(beam.samples().h_deg), v};
}

Steps coarser(const Steps& a, const Steps& b) { return {std::max(a.h_deg, b.h_deg), std::max(a.v_deg, b.v_deg)}; }

/// Which stored sample each one is: a symmetric file stores a half, a quarter or one plane of what it stands for. Its rest has the same
/// values to the last digit, and the same noise.
std::vector<std::size_t> sources_of(const CandelaTable& t) {
    const std::size_t columns = t.h_deg.size();
    std::vector<std::size_t> column_of(columns);
    for (std::size_t x = 0; x < columns; ++x)
        column_of[x] = x;
    const auto equal = [&](std::size_t a, std::size_t b) {
        for (std::size_t y = 0; y < t.v_deg.size(); ++y)
            if (t.at(y, a) != t.at(y, b))
                return false;
        return true;
    };
    for (std::size_t x = 1; x < columns; ++x)
        for (std::size_t other = 0; other < x; ++other)
            if (column_of[other] == other && equal(x, other)) {
                column_of[x] = other;
                break;
            }
    std::vector<std::size_t> source;
    for (std::size_t y = 0; y < t.v_deg.size(); ++y)
        for (std::size_t x = 0; x < columns; ++x)
            source.push_back(y * columns + column_of[x]);
    return source;
}

bool same_system(const SampledBeam& a, const SampledBeam& b) {
    return a.measured && b.measured ? a.measured->system.name == b.measured->system.name : !a.measured && !b.measured;
}

class Comparison {
  public:
    Comparison(const SampledBeam& tested, const SampledBeam& against, const LampDifferenceOptions& options)
        : tested_(tested.samples()), system_(tested.measured ? &tested.measured->system : nullptr),
          peak_cd_(std::max(peak_of(tested.samples()).cd, peak_of(against.samples()).cd)),
          against_(against.samples(), floor_share * peak_cd_, against.measured ? &against.measured->system : nullptr),
          line_(BeamField(*against.table, floor_share * peak_cd_), peak_cd_), options_(options), source_(sources_of(tested_)),
          source_against_(sources_of(against_.table())), steps_(coarser(finest_steps(tested), finest_steps(against))),
          is_same_system_(same_system(tested, against)) {
        collect();
        share_noise();
        set_noise({});
        z_limit_ = z_limit(options.false_claim_chance, 3 * samples_.size() + 6);
    }

    LampDifference find() {
        LampDifference result;
        result.directions = samples_.size();
        result.z_limit = z_limit_;
        result.floor_cd = compared_share * peak_cd_;
        Explanation best;
        best.shift.up_deg = options_.tested_up_deg;
        if (options_.tested_up_deg == 0.0 && !explain_by_cut_off(best, result))
            explain_by_aim(best, result);
        set_noise(best); // without what the shift made of it
        explain_by_level(best, result);
        result.noise_relative = noise_at_peak_;
        const ResidualGrid left = residuals(best);
        result.zones = find_zones(left, z_limit_);
        const BeamField tested(tested_, floor_share * peak_cd_, system_);
        name_zones(result.zones, left, tested, line_, options_.places);
        for (const BeamPlace& place : options_.places)
            result.places.push_back(change_at(place, {against_, source_against_}, {tested, source_}, place_limits()));
        if (!result.aim_up_deg && !result.cut_off_up_deg)
            result.undecided.clear();
        return result;
    }

  private:
    struct Level {
        double log = 0.0, error = 0.0, open = 0.0; ///< `open`: what interpolation leaves open, on the mean
    };

    TwoAngles un_of(std::size_t v, std::size_t h) const {
        return system_ ? system_->to_un(tested_.h_deg[h], tested_.v_deg[v]) : TwoAngles{tested_.h_deg[h], tested_.v_deg[v]};
    }

    void collect() {
        const double floor_cd = floor_share * peak_cd_, least = std::log(compared_share * peak_cd_);
        rounding_cd_ = std::hypot(rounding_of(tested_), rounding_of(against_.table())) / std::sqrt(12.0); // of a uniform error
        for (std::size_t v = 0; v < tested_.v_deg.size(); ++v)
            for (std::size_t h = 0; h < tested_.h_deg.size(); ++h) {
                if (!has_data(tested_, tested_.h_deg[h], tested_.v_deg[v]))
                    continue;
                const auto [h_deg, v_deg] = un_of(v, h);
                if (!against_.has(h_deg, v_deg))
                    continue;
                const double log_cd = std::log(std::max(tested_.at(v, h), floor_cd)), log_other = against_.at(h_deg, v_deg).log_cd;
                if (std::max(log_cd, log_other) < least)
                    continue;
                samples_.push_back({v, h, h_deg, v_deg, log_cd, 0.0});
                // The last term is what a double's last digits are worth in a logarithm: two equal tables still need a scale.
                rounding_.push_back(std::max(rounding_cd_ * std::exp(-std::min(log_cd, log_other)), 1e-9));
            }
    }

    PlaceLimits place_limits() const {
        const CandelaTable& other = against_.table();
        PlaceLimits limits{compared_share * peak_cd_, floor_share * peak_cd_, z_limit_};
        limits.is_same_grid = is_same_system_ && tested_.h_deg == other.h_deg && tested_.v_deg == other.v_deg;
        limits.noise_of = [this](double cd) {
            const double light = std::max(cd, floor_share * peak_cd_);
            return std::max({decade_noise_[decade_of(std::log(light))], rounding_cd_ / (std::numbers::sqrt2 * light), 1e-9});
        };
        return limits;
    }

    std::size_t decade_of(double log_cd) const {
        return static_cast<std::size_t>(std::clamp((std::log(peak_cd_) - log_cd) / std::log(10.0), 0.0, 2.0));
    }

    /// Noise may go with the level of light, so it is estimated by decades below the peak.
    void set_noise(const Explanation& explained) {
        Explanation plain = explained; // a range of shifts takes noise away with the rest
        plain.shift.up_deg += std::exchange(plain.cut_off_up_deg, 0.0);
        const ResidualGrid grid = residuals(plain);
        for (std::size_t decade = 0; decade < decade_noise_.size(); ++decade) {
            const auto is_in = [&](const BeamSample& sample) { return decade_of(sample.log_cd) == decade; };
            std::vector<bool> chosen(grid.r.size());
            for (const BeamSample& sample : samples_)
                chosen[sample.v * tested_.h_deg.size() + sample.h] = is_in(sample);
            const double noise = decade_noise_[decade] = std::max(neighbour_noise(grid, chosen), options_.noise_relative);
            if (decade == 0)
                noise_at_peak_ = noise * std::sqrt(2.0); // of a difference of two
            for (std::size_t i = 0; i < samples_.size(); ++i)
                if (is_in(samples_[i])) {
                    noise_[i] = std::max(noise, rounding_[i] / std::sqrt(2.0));
                    samples_[i].noise = noise_[i];
                    samples_[i].sigma = noise_[i] * spread_[i];
                }
        }
    }

    /// How much a residual counts for in a sum over many: sqrt(copies + share) times one sample's noise. A sample of the other file from
    /// which many were interpolated adds its noise to each.
    void share_noise() {
        std::vector<double> copies(tested_.cd.size()), taken(against_.table().cd.size());
        std::vector<std::vector<std::pair<std::size_t, double>>> weights;
        for (const BeamSample& sample : samples_) {
            copies[source_[sample.v * tested_.h_deg.size() + sample.h]] += 1.0;
            weights.push_back(against_.weights(sample.h_deg, sample.v_deg));
            for (const auto& [at, weight] : weights.back())
                taken[source_against_[at]] += std::abs(weight);
        }
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            double share = 0.0;
            for (const auto& [at, weight] : weights[i])
                share += std::abs(weight) * taken[source_against_[at]];
            spread_.push_back(std::sqrt(copies[source_[samples_[i].v * tested_.h_deg.size() + samples_[i].h]] + std::max(share, 1.0)));
        }
        noise_.assign(samples_.size(), 1.0);
    }

    /// How far a raised cut-off moves the light near and above it is not known: any shift up to its own explains.
    FieldValue unexplained(const BeamSample& sample, const Explanation& explained) const {
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

    ResidualGrid residuals(const Explanation& explained) const {
        const std::size_t columns = tested_.h_deg.size();
        ResidualGrid grid;
        grid.h_deg = tested_.h_deg;
        grid.v_deg = tested_.v_deg;
        grid.r.assign(tested_.cd.size(), std::numeric_limits<double>::quiet_NaN());
        grid.noise.assign(tested_.cd.size(), 1.0);
        grid.open.assign(tested_.cd.size(), 0.0);
        grid.source = source_;
        if (system_)
            grid.un.assign(tested_.cd.size(), {});
        std::size_t next = 0; // samples are in the grid's order
        for (std::size_t at = 0; at < grid.r.size(); ++at) {
            grid.first.push_back(grid.shared.size());
            if (next == samples_.size() || samples_[next].v * columns + samples_[next].h != at)
                continue;
            const BeamSample& sample = samples_[next];
            const FieldValue value = unexplained(sample, explained);
            grid.r[at] = value.log_cd;
            grid.open[at] = value.uncertainty;
            grid.noise[at] = noise_[next++];
            if (system_)
                grid.un[at] = {sample.h_deg, sample.v_deg};
            const auto [h, v] = before_shift(sample.h_deg, sample.v_deg, explained.shift);
            for (const auto& [other, weight] : against_.weights(h, v))
                grid.shared.emplace_back(source_against_[other], weight);
        }
        grid.first.push_back(grid.shared.size());
        return grid;
    }

    std::vector<BeamSample> where(const auto& belongs) const {
        std::vector<BeamSample> chosen, out;
        std::ranges::copy_if(samples_, std::back_inserter(chosen), belongs);
        const std::size_t stride = chosen.size() / max_fitted + 1;
        for (std::size_t i = 0; i < chosen.size(); i += stride)
            out.push_back(chosen[i]);
        return out;
    }

    bool is_shift(const ShiftFit& fit) const {
        const double min_h = min_step_share * steps_.h_deg, min_v = min_step_share * steps_.v_deg;
        return fit.found &&
               (is_beyond(fit.shift.up_deg, fit.up_error_deg, min_v) || is_beyond(fit.shift.right_deg, fit.right_error_deg, min_h));
    }

    std::size_t claimed(const Explanation& explained) const {
        std::size_t samples = 0;
        for (const BeamZone& zone : find_zones(residuals(explained), z_limit_))
            samples += zone.samples;
        return samples;
    }

    /// Whether with one of those tried few enough directions are claimed beside what is claimed without.
    bool explains(const Explanation& best, std::initializer_list<Explanation> tried) const {
        const std::size_t without = claimed(best);
        return without == 0 || std::ranges::any_of(tried, [&](const Explanation& one) {
                   return static_cast<double>(claimed(one)) <= must_leave * static_cast<double>(without);
               });
    }

    bool explain_by_cut_off(Explanation& best, LampDifference& result) const {
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
            result.undecided = "the light below the cut-off is too even to tell whether the whole beam moved or the cut-off alone";
            return false;
        }
        const double least = min_step_share * steps_.v_deg;
        if (!is_beyond(raise, error, least) || std::abs(body.shift.up_deg) > std::abs(raise) / 2.0)
            return false;
        Explanation tried = best;
        tried.cut_off_up_deg = raise;
        if (is_shift(body))
            tried.shift = body.shift;
        else
            tried.cut_off_up_deg = band.shift.up_deg;
        if (!explains(best, {tried}))
            return false;
        best = tried;
        result.cut_off_up_deg = {tried.cut_off_up_deg, error};
        if (is_shift(body)) {
            result.aim_up_deg = {body.shift.up_deg, body.up_error_deg};
            result.aim_right_deg = {body.shift.right_deg, body.right_error_deg};
        }
        return true;
    }

    void explain_by_aim(Explanation& best, LampDifference& result) const {
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
        if (!explains(best, {tried, with_level}))
            return;
        best = tried;
        result.aim_up_deg = {fit.shift.up_deg, fit.up_error_deg};
        result.aim_right_deg = {fit.shift.right_deg, fit.right_error_deg};
    }

    /// Location of what is left over by Tukey's biweight, from the median on; without the light that a cut-off moved by an unknown part.
    Level level_left(const Explanation& explained) const {
        ResidualGrid grid = residuals(explained);
        std::vector<double> sigma(grid.r.size(), 1.0);
        for (const BeamSample& sample : samples_)
            sigma[sample.v * tested_.h_deg.size() + sample.h] = sample.sigma;
        for (const BeamSample& sample : samples_)
            if (is_moved_by_cut_off(sample.v_deg, explained))
                grid.r[sample.v * tested_.h_deg.size() + sample.h] = std::numeric_limits<double>::quiet_NaN();
        std::vector<double> left;
        for (const double r : grid.r)
            if (!std::isnan(r))
                left.push_back(r);
        if (left.empty())
            return {};
        Level level{middle_of(left)};
        for (int iteration = 0; iteration < 20; ++iteration) {
            double weights = 0.0, sum = 0.0, open = 0.0;
            for (std::size_t at = 0; at < grid.r.size(); ++at) {
                const double u = (grid.r[at] - level.log) / (4.685 * sigma[at]);
                if (std::isnan(u) || std::abs(u) >= 1.0)
                    continue;
                const double weight = (1.0 - u * u) * (1.0 - u * u) / (sigma[at] * sigma[at]);
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

    void explain_by_level(Explanation& best, LampDifference& result) const {
        const Level level = level_left(best);
        if (!is_beyond(level.log, level.error, level.open))
            return;
        Explanation tried = best;
        tried.log_level = level.log;
        if (!explains(best, {tried}))
            return;
        best = tried;
        const double share = std::expm1(level.log);
        result.level = {share, (1.0 + share) * (level.error + level.open)};
    }

    bool is_moved_by_cut_off(double v_deg, const Explanation& explained) const {
        return explained.cut_off_up_deg != 0.0 && v_deg > line_.lowest_deg() - body_deg;
    }
    bool is_beyond(double value, double error, double least) const { return std::abs(value) > std::max(z_limit_ * error, least); }

    const CandelaTable& tested_; ///< over its own angles
    const AngleSystem* system_;  ///< of those; nullptr: H and V
    double peak_cd_;
    BeamField against_;
    CutOffLine line_;
    LampDifferenceOptions options_;
    std::vector<std::size_t> source_, source_against_; ///< by sample of the table
    Steps steps_;                                      ///< the finest of the coarser file
    std::vector<BeamSample> samples_;
    std::vector<double> rounding_;         ///< by sample
    std::vector<double> noise_;            ///< by sample: of one file's
    std::vector<double> spread_;           ///< by sample: see share_noise
    std::array<double, 3> decade_noise_{}; ///< by decades below the peak: of one sample of either file
    double noise_at_peak_ = 0.0, z_limit_ = 0.0, rounding_cd_ = 0.0;
    bool is_same_system_; ///< of angles: both files were measured alike
};

} // namespace

LampDifference compare_lamps(const SampledBeam& tested, const SampledBeam& against, const LampDifferenceOptions& options) {
    if (!(options.noise_relative >= 0.0) || !(options.noise_relative <= 1.0))
        throw std::invalid_argument("noise outside 0..1");
    if (!(options.false_claim_chance > 0.0) || !(options.false_claim_chance < 1.0))
        throw std::invalid_argument("chance of a false claim outside 0..1");
    if (!(peak_of(tested.samples()).cd > 0.0) || !(peak_of(against.samples()).cd > 0.0))
        throw std::invalid_argument("a lamp without light");
    return Comparison(tested, against, options).find();
}

bool LampDifference::any() const { return is_explained() || std::ranges::any_of(places, &PlaceChange::is_beyond_noise); }

} // namespace fernlicht
