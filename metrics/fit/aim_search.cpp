#include "metrics/fit/aim_search.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double most_log_error = 2.0, least_floor_lx = 0.003;

class AimSearch {
  public:
    AimSearch(const FitModel& model, const FreeGroups& free) : model_(model), free_(fit_quantities * model.lamps(), false) {
        for (const auto& group : free)
            for (const Unknown unknown : group)
                free_[unknown] = true;
    }

    Shifts all_alike(Shifts from) const {
        return over_grids(std::move(from), [&](Shifts& shifts, double pitch_rad, double yaw_rad) {
            for (std::size_t lamp = 0; lamp < shifts.size(); ++lamp)
                turn_lamp(shifts, lamp, pitch_rad, yaw_rad);
            const std::vector<double> lux = model_.lux(shifts);
            const double ln_flux = typical_ln([&](std::size_t i) { return lux[i]; }, [](std::size_t) { return 0.0; });
            for (std::size_t lamp = 0; lamp < shifts.size(); ++lamp)
                if (free_[fit_quantities * lamp + 2])
                    shifts[lamp][2] = ln_flux;
            return cost(model_.lux(shifts));
        });
    }

    Shifts lamp_alone(Shifts from, std::size_t lamp) const {
        std::vector<double> others(model_.points().size(), 0.0);
        for (std::size_t other = 0; other < from.size(); ++other)
            if (other != lamp)
                model_.add_light(other, from[other], others);
        return over_grids(std::move(from), [&](Shifts& shifts, double pitch_rad, double yaw_rad) {
            turn_lamp(shifts, lamp, pitch_rad, yaw_rad);
            shifts[lamp][2] = 0.0;
            std::vector<double> own(others.size(), 0.0);
            model_.add_light(lamp, shifts[lamp], own);
            if (free_[fit_quantities * lamp + 2])
                shifts[lamp][2] = typical_ln([&](std::size_t i) { return own[i]; }, [&](std::size_t i) { return others[i]; });
            std::vector<double> lux = others;
            for (std::size_t i = 0; i < lux.size(); ++i)
                lux[i] += own[i] * std::exp(shifts[lamp][2]);
            return cost(lux);
        });
    }

  private:
    double floor_lx(std::size_t i) const { return std::max(model_.points()[i].absolute_lx, least_floor_lx); }

    double cost(const std::vector<double>& lux) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < lux.size(); ++i)
            sum += std::min(std::abs(std::log((lux[i] + floor_lx(i)) / (model_.points()[i].lux + floor_lx(i)))), most_log_error);
        return sum;
    }

    /// Median of the logarithm by which `own` light has to grow, over the points of which it makes most.
    template <class Own, class Others> double typical_ln(Own own, Others others) const {
        std::vector<double> logs;
        for (std::size_t i = 0; i < model_.points().size(); ++i)
            if (const double rest = model_.points()[i].lux - others(i); rest > 0.0 && own(i) > std::max(others(i), floor_lx(i)))
                logs.push_back(std::log(rest / own(i)));
        return std::clamp(middle_of(std::move(logs)), -2.0, 2.0);
    }

    void turn_lamp(Shifts& shifts, std::size_t lamp, double pitch_rad, double yaw_rad) const {
        shifts[lamp][0] += free_[fit_quantities * lamp] ? pitch_rad : 0.0;
        shifts[lamp][1] += free_[fit_quantities * lamp + 1] ? yaw_rad : 0.0;
        shifts[lamp][2] = free_[fit_quantities * lamp + 2] ? 0.0 : shifts[lamp][2];
    }

    /// `tried` changes shifts by these angles and tells its cost. Of equal ones the nearest to `from` wins.
    template <class Tried> Shifts over_grids(Shifts from, Tried tried) const {
        struct Grid {
            double pitch_deg, yaw_deg, pitch_step_deg, yaw_step_deg;
        };
        for (const Grid& grid : {Grid{search_pitch_deg, search_yaw_deg, 0.25, 0.5}, Grid{0.25, 0.5, 0.05, 0.1}}) {
            Shifts best = from;
            double least = tried(best, 0.0, 0.0), away = 0.0;
            const int pitches = static_cast<int>(std::lround(grid.pitch_deg / grid.pitch_step_deg));
            const int yaws = static_cast<int>(std::lround(grid.yaw_deg / grid.yaw_step_deg));
            for (int p = -pitches; p <= pitches; ++p)
                for (int y = -yaws; y <= yaws; ++y) {
                    Shifts shifts = from;
                    const double found = tried(shifts, radians(p * grid.pitch_step_deg), radians(y * grid.yaw_step_deg));
                    const double far = std::hypot(p, y);
                    if (found < least - 1e-9 || (found < least + 1e-9 && far < away)) {
                        least = found;
                        away = far;
                        best = std::move(shifts);
                    }
                }
            from = std::move(best);
        }
        return from;
    }

    const FitModel& model_;
    std::vector<bool> free_; ///< by unknown
};

} // namespace

std::vector<Shifts> starts_of(const FitModel& model, const FreeGroups& free) {
    const AimSearch search(model, free);
    std::vector<Shifts> starts{Shifts(model.lamps(), LampShift{})};
    starts.push_back(search.all_alike(starts.back()));
    if (model.lamps() == 1)
        return starts;
    Shifts each = starts.back();
    for (int round = 0; round < 2; ++round)
        for (std::size_t lamp = 0; lamp < model.lamps(); ++lamp)
            if (!model.points_of(lamp).empty())
                each = search.lamp_alone(std::move(each), lamp);
    starts.push_back(std::move(each));
    return starts;
}

} // namespace fernlicht
