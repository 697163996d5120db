#include "metrics/fit/lamp_fit.h"

#include "metrics/fit/aim_search.h"
#include "metrics/fit/undetermined.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int most_rounds = 20;        // of leaving out and taking back
constexpr double decides_alone = 1e-9; // of 1 - leverage
constexpr std::array<double, fit_quantities> told_unit{degrees(1.0), degrees(1.0), 1.0, 1.0};

class LampFitting {
  public:
    LampFitting(const std::vector<CarAtReading>& cars, const std::vector<LuxPoint>& points, const FitOptions& options)
        : cars_(cars), model_(cars, points), options_(options), used_(points.size(), true), held_(fit_quantities * model_.lamps()),
          with_(held_.size()) {
        for (std::size_t lamp = 0; lamp < model_.lamps(); ++lamp)
            for (std::size_t k = 0; k < fit_quantities; ++k) {
                names_.push_back(fmt::format("{} of {}", name_of(static_cast<FitQuantity>(k)), cars[0].lamps[lamp].name));
                for (const auto& [name, quantity] : options.hold)
                    if (static_cast<std::size_t>(quantity) == k && (name.empty() || name == cars[0].lamps[lamp].name))
                        held_[names_.size() - 1] = "as asked";
                if (held_[names_.size() - 1].empty() && !model_.points_of(lamp).empty())
                    free_.push_back({names_.size() - 1});
            }
    }

    LampFit fit() {
        hold_beyond_count();
        starts_ = starts_of(model_, free_);
        for (bool held = true; held;) {
            used_.assign(used_.size(), true);
            best_of_starts();
            if (std::ranges::all_of(at_.lux, [](double lux) { return lux == 0.0; })) {
                fit_.failed = fmt::format("no lamp lights any point, at any aim within {:g}° of pitch and {:g}° of yaw", search_pitch_deg,
                                          search_yaw_deg);
                hold_all(fit_.failed);
                break;
            }
            held = hold_worst();
            if (!held) {
                leave_out();
                held = hold_worst();
            }
        }
        return result();
    }

  private:
    const std::vector<LuxPoint>& points() const { return model_.points(); }

    /// Fewer points than values go through any point: what is left over keeps the drive's value before anything is looked for.
    void hold_beyond_count() {
        while (free_.size() > points().size()) {
            const auto first = std::ranges::max_element(free_, {}, [](const auto& group) { return held_rank(group.front()); });
            if (held_rank(first->front()) == 0) { // flux alone is left: that of all lamps alike
                std::vector<Unknown> all;
                for (const auto& group : free_)
                    all.insert(all.end(), group.begin(), group.end());
                free_ = {all};
                return;
            }
            held_[first->front()] = "there are fewer points than values";
            free_.erase(first);
        }
    }

    void hold_all(const std::string& why) {
        for (const auto& group : free_)
            for (const Unknown unknown : group)
                held_[unknown] = why;
        free_.clear();
        at_ = descend(model_, free_, Shifts(model_.lamps(), LampShift{}), used_, false);
    }

    /// True where something was held that was not.
    bool hold_worst() {
        const std::optional<Undetermined> found = worst_known(weighted_jacobian(model_, free_, at_, used_), free_, names_);
        if (!found)
            return false;
        if (found->alike) {
            std::vector<Unknown> together;
            for (const std::size_t g : found->groups)
                together.insert(together.end(), free_[g].begin(), free_[g].end());
            free_[found->groups.front()] = together;
            for (std::size_t i = found->groups.size(); i-- > 1;)
                free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(found->groups[i]));
        } else {
            const std::size_t g = found->groups.front();
            for (const Unknown unknown : free_[g])
                held_[unknown] = found->why;
            free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(g));
        }
        return true;
    }

    /// What is held at 0, what changes alike at its mean.
    Shifts allowed(const Shifts& start) const {
        Shifts shifts(start.size(), LampShift{});
        Shifts given = start;
        for (const auto& group : free_) {
            double mean = 0.0;
            for (const Unknown unknown : group)
                mean += of_unknown(given, unknown) / static_cast<double>(group.size());
            for (const Unknown unknown : group)
                of_unknown(shifts, unknown) = mean;
        }
        return shifts;
    }

    void best_of_starts() {
        std::optional<Descent> best;
        for (const Shifts& start : starts_) {
            Descent found = descend(model_, free_, allowed(start), used_, true);
            fit_.iterations += found.iterations;
            if (!best || found.misfit < best->misfit)
                best = std::move(found);
        }
        at_ = std::move(*best);
    }

    /// Residuals in multiples of their own deviation; of points left out of that of the prediction.
    std::vector<std::optional<double>> studentised() const {
        const std::vector<double> z = normalised_residuals(points(), at_);
        std::vector<std::optional<double>> out(z.size());
        const std::vector<bool> all(z.size(), true);
        const Matrix covariance = free_.empty() ? Matrix() : ScaledSvd(weighted_jacobian(model_, free_, at_, used_)).covariance();
        const Matrix rows = free_.empty() ? Matrix(z.size(), 0) : weighted_jacobian(model_, free_, at_, all);
        for (std::size_t i = 0; i < z.size(); ++i) {
            double leverage = 0.0;
            for (std::size_t a = 0; a < rows.columns; ++a)
                for (std::size_t b = 0; b < rows.columns; ++b)
                    leverage += rows.at(i, a) * covariance.at(a, b) * rows.at(i, b);
            const double variance = used_[i] ? 1.0 - leverage : 1.0 + leverage;
            if (std::isfinite(variance) && variance > decides_alone)
                out[i] = -z[i] / std::sqrt(variance);
        }
        return out;
    }

    /// Least squares of what is left when readings beyond the threshold are out.
    void leave_out() {
        const double bound = normal_bound(options_.false_outlier, points().size());
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<std::optional<double>> z = studentised();
            fit_.outlier_from = bound * residual_scale(normalised_residuals(points(), at_), used_);
            std::vector<bool> used;
            for (const auto& one : z)
                used.push_back(!one || std::abs(*one) <= fit_.outlier_from);
            const bool settled = used == used_ && round > 0;
            used_ = std::move(used);
            if (settled)
                break;
            at_ = descend(model_, free_, at_.shifts, used_, false);
            fit_.iterations += at_.iterations;
        }
    }

    void judge() {
        fit_.unknowns = free_.size();
        fit_.used = static_cast<std::size_t>(std::ranges::count(used_, true));
        const std::vector<double> z = normalised_residuals(points(), at_);
        for (std::size_t i = 0; i < z.size(); ++i)
            fit_.chi_squared += used_[i] ? z[i] * z[i] : 0.0;
        if (fit_.freedom() > 0) {
            fit_.chi_squared_limit = chi_squared_bound(fit_.freedom(), options_.false_alarm);
            if (fit_.chi_squared > fit_.chi_squared_limit)
                fit_.error_scale = std::sqrt(fit_.chi_squared / fit_.freedom());
        } else
            fit_.chi_squared = 0.0;
        if (!fit_.failed.empty())
            return;
        const FitBounds bounds;
        for (const auto& group : free_)
            for (const Unknown unknown : group)
                if (std::abs(of_unknown(at_.shifts, unknown)) >= bounds.of(unknown))
                    fit_.failed = names_[unknown] + " runs to the edge of what is looked at";
        if (fit_.failed.empty() && !at_.converged)
            fit_.failed = "the fit does not settle";
    }

    void take_values() {
        const std::size_t unknowns = held_.size();
        Matrix covariance(unknowns, unknowns);
        if (!free_.empty()) {
            const ScaledSvd svd(weighted_jacobian(model_, free_, at_, used_));
            fit_.condition = svd.condition();
            const Matrix of_groups = svd.covariance();
            for (std::size_t a = 0; a < free_.size(); ++a)
                for (std::size_t b = 0; b < free_.size(); ++b)
                    for (const Unknown row : free_[a])
                        for (const Unknown column : free_[b])
                            covariance.at(row, column) = of_groups.at(a, b) * told_unit[row % fit_quantities] *
                                                         told_unit[column % fit_quantities] * fit_.error_scale * fit_.error_scale;
        }
        for (const auto& group : free_)
            for (const Unknown unknown : group)
                with_[unknown] = group.size() < 2 ? "" : cars_[0].lamps[(group[0] == unknown ? group[1] : group[0]) / fit_quantities].name;
        std::vector<Unknown> told;
        for (Unknown unknown = 0; unknown < unknowns; ++unknown) {
            const std::size_t lamp = unknown / fit_quantities, k = unknown % fit_quantities;
            if (model_.points_of(lamp).empty())
                continue;
            told.push_back(unknown);
            FittedValue value{cars_[0].lamps[lamp].name,
                              static_cast<FitQuantity>(k),
                              at_.shifts[lamp][k] * told_unit[k],
                              {},
                              held_[unknown],
                              with_[unknown]};
            const double error = std::sqrt(covariance.at(unknown, unknown));
            if (value.quantity == FitQuantity::flux)
                value.change = std::exp(value.change);
            if (value.held.empty())
                value.standard_error = value.quantity == FitQuantity::flux ? error * value.change : error;
            fit_.values.push_back(std::move(value));
        }
        fit_.covariance = Matrix(told.size(), told.size());
        for (std::size_t a = 0; a < told.size(); ++a)
            for (std::size_t b = 0; b < told.size(); ++b)
                fit_.covariance.at(a, b) = covariance.at(told[a], told[b]);
    }

    void take_points() {
        std::vector<std::vector<double>> light(model_.lamps(), std::vector<double>(points().size(), 0.0));
        for (std::size_t lamp = 0; lamp < model_.lamps(); ++lamp)
            model_.add_light(lamp, at_.shifts[lamp], light[lamp]);
        const std::vector<double> z = normalised_residuals(points(), at_);
        const std::vector<std::optional<double>> own = studentised();
        for (std::size_t i = 0; i < points().size(); ++i) {
            FittedPoint point{at_.lux[i], at_.sigma_lx[i], -z[i], own[i], !used_[i]};
            const std::vector<std::size_t>& shone = points()[i].lamps;
            point.lamp = shone.empty() ? 0 : *std::ranges::max_element(shone, {}, [&](std::size_t lamp) { return light[lamp][i]; });
            const CarAtReading& car = cars_[points()[i].car];
            const Pose pose = compose(car.ego, shifted(car.lamps[point.lamp], at_.shifts[point.lamp]).pose());
            const glm::dvec2 angles = photometry::goniometer_angles(
                photometry::lamp_space(points()[i].place_m - pose.position_m, -pose.left(), pose.up(), pose.forward()));
            point.h_deg = degrees(angles.x);
            point.v_deg = degrees(angles.y);
            fit_.points.push_back(point);
        }
    }

    LampFit result() {
        judge();
        take_values();
        take_points();
        fit_.shifts = at_.shifts;
        return std::move(fit_);
    }

    const std::vector<CarAtReading>& cars_;
    FitModel model_;
    FitOptions options_;
    FreeGroups free_;
    std::vector<bool> used_;
    std::vector<std::string> held_, with_, names_; ///< by unknown
    std::vector<Shifts> starts_;
    Descent at_;
    LampFit fit_;
};

} // namespace

std::optional<bool> LampFit::consistent() const {
    if (freedom() <= 0)
        return std::nullopt;
    const double out = static_cast<double>(points.size() - used);
    return chi_squared <= chi_squared_limit && out <= most_outliers * static_cast<double>(points.size());
}

LampFit fit_lamps(const std::vector<CarAtReading>& cars, const std::vector<LuxPoint>& points, const FitOptions& options) {
    return LampFitting(cars, points, options).fit();
}

const char* name_of(FitQuantity quantity) { return std::array{"pitch", "yaw", "flux", "height"}[static_cast<std::size_t>(quantity)]; }

} // namespace fernlicht
