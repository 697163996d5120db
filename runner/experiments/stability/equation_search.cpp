// The search for the arguments at which an equation's float is farthest from its double.
#include "runner/experiments/stability/equations.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace fernlicht {
/// photometry.glsl and the calls of it, compiled as C++ in double.
namespace photometry {

#define FN inline
#include "renderer/shaders/equation_calls.glsl"
#undef FN

} // namespace photometry

namespace packs {
AT_EACH_LEVEL(void equation_values(int equation, const float* arguments, float* values, std::size_t points);)
} // namespace packs

namespace {

using Kind = EquationInput::Kind;

EquationDoubles in_double(const EquationArguments& x) {
    EquationDoubles out{};
    std::ranges::copy(x, out.begin());
    return out;
}

class Search {
  public:
    Search(const Equation& equation, std::uint64_t seed) : equation_(equation), random_(seed) {}

    /// A point of the domain.
    EquationArguments anywhere() {
        for (int tries = 0; tries < 1000; ++tries) {
            EquationArguments x{};
            for (const EquationInput& input : equation_.inputs)
                fill(input, x);
            if (holds(x))
                return x;
        }
        return {};
    }
    /// A point near another: one argument changed by a part of itself from 1 down to a unit in the last place.
    EquationArguments near(const EquationArguments& from) {
        EquationArguments x = from;
        const EquationInput& input = equation_.inputs[random_() % equation_.inputs.size()];
        const std::size_t slot = input.slot + (input.kind == Kind::direction ? random_() % 3 : 0);
        if (share(random_) < 0.1)
            fill(input, x);
        else if (share(random_) < 0.3)
            x[slot] =
                std::nextafter(x[slot], share(random_) < 0.5 ? -std::numeric_limits<float>::max() : std::numeric_limits<float>::max());
        else
            x[slot] *= static_cast<float>(1.0 + (2.0 * share(random_) - 1.0) * std::pow(10.0, -7.0 * share(random_)));
        settle(input, x);
        return holds(x) ? x : from;
    }
    bool holds(const EquationArguments& x) const {
        const EquationDoubles d = in_double(x);
        return equation_.holds(d, equation_in_double(equation_.number, d));
    }
    double error(const EquationArguments& x, const EquationValue& value) const {
        const EquationDoubles d = in_double(x);
        const std::array<double, 4> truth = equation_in_double(equation_.number, d);
        double worst = 0.0;
        for (std::size_t i = 0; i < equation_.outputs; ++i) {
            const double off = std::abs(static_cast<double>(value[i]) - truth[i]), scale = equation_.scale(d, truth[i]);
            const double error = off == 0.0 ? 0.0 : off / scale;
            worst = error <= worst ? worst : error; // a NaN is worse than all
        }
        return worst;
    }
    /// Change of the value by the equation's measure per relative change of one argument.
    double condition(const EquationArguments& x) const {
        constexpr double change = 1e-6;
        const EquationDoubles d = in_double(x);
        const std::array<double, 4> here = equation_in_double(equation_.number, d);
        double worst = 0.0;
        for (const EquationInput& input : equation_.inputs)
            for (std::size_t slot = input.slot; slot < input.slot + (input.kind == Kind::direction ? 3 : 1); ++slot) {
                EquationDoubles less = d, more = d;
                less[slot] *= 1.0 - change;
                more[slot] *= 1.0 + change;
                const auto low = equation_in_double(equation_.number, less), high = equation_in_double(equation_.number, more);
                for (std::size_t i = 0; i < equation_.outputs; ++i)
                    if (const double scale = equation_.scale(d, here[i]); scale > 0.0)
                        worst = std::max(worst, std::abs(high[i] - low[i]) / (2.0 * change * scale));
            }
        return worst;
    }

  private:
    void fill(const EquationInput& input, EquationArguments& x) {
        const auto put = [&](std::size_t slot, double value) { x[slot] = static_cast<float>(value); };
        const double u = share(random_);
        switch (input.kind) {
        case Kind::linear: // often at an end, or on a whole number
            put(input.slot, u < 0.05  ? input.low
                            : u < 0.1 ? input.high
                            : u < 0.2 ? std::round(std::lerp(input.low, input.high, share(random_)))
                                      : std::lerp(input.low, input.high, share(random_)));
            break;
        case Kind::logarithmic:
        case Kind::signed_logarithmic: {
            const double size = u < 0.03 ? input.low : u < 0.06 ? input.high : input.low * std::pow(input.high / input.low, share(random_));
            put(input.slot, input.kind == Kind::signed_logarithmic && share(random_) < 0.5 ? -size : size);
            break;
        }
        case Kind::direction: // components of very different sizes, too
            for (std::size_t i = 0; i < 3; ++i)
                put(input.slot + i, (2.0 * share(random_) - 1.0) * (u < 0.5 ? 1.0 : std::pow(10.0, -6.0 * share(random_))));
            break;
        }
        settle(input, x);
    }
    /// Back into the input's range.
    static void settle(const EquationInput& input, EquationArguments& x) {
        float& value = x[input.slot];
        const auto low = static_cast<float>(input.low), high = static_cast<float>(input.high);
        if (input.kind == Kind::direction) {
            const double length = std::hypot(static_cast<double>(x[input.slot]), static_cast<double>(x[input.slot + 1]),
                                             static_cast<double>(x[input.slot + 2]));
            for (std::size_t i = 0; i < 3; ++i)
                x[input.slot + i] =
                    length > 0.0 ? static_cast<float>(static_cast<double>(x[input.slot + i]) / length) : (i == 0 ? 1.0F : 0.0F);
        } else if (input.kind == Kind::signed_logarithmic) {
            value = std::copysign(std::clamp(std::abs(value), low, high), value);
        } else {
            value = std::clamp(value, low, high);
        }
    }

    const Equation& equation_;
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> share{0.0, 1.0};
};

void take(EquationError& worst, double error, const EquationArguments& x) {
    if (std::isnan(worst.error) || error <= worst.error)
        return;
    worst = {error, x};
}

using Ranked = std::vector<std::pair<double, EquationArguments>>;

/// The `count` largest come first.
void keep_worst(Ranked& points, std::size_t count) {
    count = std::min(count, points.size());
    std::ranges::partial_sort(points, points.begin() + static_cast<std::ptrdiff_t>(count),
                              [](const auto& a, const auto& b) { return a.first > b.first; });
    points.resize(count);
}

} // namespace

std::array<double, 4> equation_in_double(int equation, const EquationDoubles& x) {
    const auto four = [&](std::size_t i) { return glm::dvec4(x[i], x[i + 1], x[i + 2], x[i + 3]); };
    const glm::dvec4 value = photometry::equation_value(equation, four(0), four(4), four(8), four(12));
    return {value.x, value.y, value.z, value.w};
}

std::vector<EquationValue> equation_in_packs(packs::Level level, int equation, const std::vector<EquationArguments>& points) {
    const std::size_t padded = (points.size() + packs::most_lanes - 1) / packs::most_lanes * packs::most_lanes;
    std::vector<float> arguments(16 * padded), values(4 * padded);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t slot = 0; slot < 16; ++slot)
            arguments[slot * padded + i] = points[i][slot];
    AT_LEVEL(level, equation_values)(equation, arguments.data(), values.data(), padded);
    std::vector<EquationValue> result;
    for (std::size_t i = 0; i < points.size(); ++i)
        result.push_back({values[i], values[padded + i], values[2 * padded + i], values[3 * padded + i]});
    return result;
}

Examination examine(const Equation& equation, Device& device, double effort, std::uint64_t seed) {
    const auto many = [&](double points) { return static_cast<std::size_t>(points * effort); };
    Search search(equation, seed + static_cast<std::uint64_t>(equation.number));
    Examination found;
    std::vector<EquationArguments> points;
    for (std::size_t i = 0; i < many(60'000); ++i)
        points.push_back(search.anywhere());
    Ranked in_float, conditions;
    for (const EquationArguments& x : points)
        in_float.emplace_back(search.error(x, equation_in_float(equation.number, x)), x);
    for (std::size_t i = 0; i < points.size(); i += 4)
        conditions.emplace_back(search.condition(points[i]), points[i]);
    keep_worst(in_float, 32);
    for (auto& [error, x] : in_float)
        for (std::size_t i = 0; i < many(1500); ++i) {
            const EquationArguments next = search.near(x);
            if (const double better = search.error(next, equation_in_float(equation.number, next)); better > error)
                error = better, x = next;
        }
    keep_worst(conditions, 8);
    for (auto& [condition, x] : conditions)
        for (std::size_t i = 0; i < many(300); ++i) {
            const EquationArguments next = search.near(x);
            if (const double better = search.condition(next); better > condition)
                condition = better, x = next;
        }
    // The GPU and packs take them by the ten thousand: the random ones, the worst of the CPU, then generations round the worst.
    for (const auto& [error, x] : in_float)
        points.push_back(x);
    const auto climb = [&](const auto& values_at, EquationError& worst) {
        Ranked ranked;
        std::vector<EquationArguments> next = points;
        for (int generation = 0; generation < 5; ++generation) {
            const std::vector<EquationValue> values = values_at(next);
            for (std::size_t i = 0; i < next.size(); ++i)
                ranked.emplace_back(search.error(next[i], values[i]), next[i]);
            found.points += next.size();
            keep_worst(ranked, 64);
            next.clear();
            for (const auto& [error, x] : ranked)
                for (std::size_t i = 0; i < many(400); ++i)
                    next.push_back(search.near(x));
        }
        for (const auto& [error, x] : ranked)
            take(worst, error, x);
    };
    EquationProbe probe(device, equation.number);
    climb([&](const auto& at) { return probe.at(at); }, found.on_gpu);
    climb([&](const auto& at) { return equation_in_packs(packs::widest_level(), equation.number, at); }, found.in_packs);
    for (const auto& [error, x] : in_float)
        take(found.in_float, error, x);
    for (const auto& [condition, x] : conditions)
        if (condition > found.condition)
            found.condition = condition, found.condition_at = x;
    return found;
}

} // namespace fernlicht
