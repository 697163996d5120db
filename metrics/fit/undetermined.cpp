#include "metrics/fit/undetermined.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Standard errors from which on a value is worth nothing, in the order of FitQuantity, and how they are told.
constexpr std::array<double, fit_quantities> useless_from{radians(1.0), radians(2.0), 0.5, 0.25};
constexpr std::array<const char*, fit_quantities> told_in{"°", "°", " %", " m"};
constexpr std::array<double, fit_quantities> unit_scale{degrees(1.0), degrees(1.0), 100.0, 1.0};
/// Of the least known combination: what has this share of its largest part takes part.
constexpr double takes_part = 0.3;

std::size_t quantity_of(const std::vector<Unknown>& group) { return group.front() % fit_quantities; }

/// The group whose standard error is the most of what is useless.
std::optional<Undetermined> useless(const std::vector<double>& standard_errors, const FreeGroups& free) {
    std::size_t worst = 0;
    const auto share = [&](std::size_t g) { return standard_errors[g] / useless_from[quantity_of(free[g])]; };
    for (std::size_t g = 1; g < free.size(); ++g)
        worst = share(g) > share(worst) ? g : worst;
    if (!(share(worst) > 1.0))
        return std::nullopt;
    const std::size_t quantity = quantity_of(free[worst]);
    return Undetermined{{worst},
                        false,
                        standard_errors[worst] == infinite ? "no point's light changes with it"
                                                           : fmt::format("the points tell it to ±{:.2g}{} only",
                                                                         standard_errors[worst] * unit_scale[quantity], told_in[quantity])};
}

} // namespace

int held_rank(Unknown unknown) { return std::array<int, fit_quantities>{1, 2, 0, 3}[unknown % fit_quantities]; }

std::optional<Undetermined> worst_known(const Matrix& jacobian, const FreeGroups& free, const std::vector<std::string>& names) {
    if (free.empty())
        return std::nullopt;
    std::vector<double> alone;
    for (std::size_t g = 0; g < free.size(); ++g) {
        double squares = 0.0;
        for (std::size_t i = 0; i < jacobian.rows; ++i)
            squares += jacobian.at(i, g) * jacobian.at(i, g);
        alone.push_back(squares > 0.0 ? 1.0 / std::sqrt(squares) : infinite);
    }
    if (std::optional<Undetermined> found = useless(alone, free))
        return found;
    const ScaledSvd svd(jacobian);
    if (svd.condition() > collinear_from) {
        const std::vector<double> weakest = svd.weakest();
        const double most = std::abs(*std::ranges::max_element(weakest, {}, [](double part) { return std::abs(part); }));
        std::vector<std::size_t> parts;
        for (std::size_t g = 0; g < free.size(); ++g)
            if (std::abs(weakest[g]) >= takes_part * most)
                parts.push_back(g);
        const auto same = [&](std::size_t g) { return quantity_of(free[g]) == quantity_of(free[parts[0]]); };
        const std::string condition = svd.condition() < 1e6 ? fmt::format("condition index {:.0f}", svd.condition())
                                                            : std::string("they cannot be told apart at all");
        if (parts.size() > 1 && std::ranges::all_of(parts, same))
            return Undetermined{parts, true, condition};
        const auto order = [&](std::size_t g) { return std::pair(held_rank(free[g].front()), std::abs(weakest[g])); };
        const std::size_t held = *std::ranges::max_element(parts, {}, order);
        std::string others;
        for (const std::size_t g : parts)
            if (g != held)
                others += (others.empty() ? "" : ", ") + names[free[g].front()];
        return Undetermined{
            {held}, false, fmt::format("the points cannot tell it from {} ({})", others.empty() ? "the others" : others, condition)};
    }
    const Matrix covariance = svd.covariance();
    std::vector<double> together;
    for (std::size_t g = 0; g < free.size(); ++g)
        together.push_back(std::sqrt(covariance.at(g, g)));
    return useless(together, free);
}

} // namespace fernlicht
