#include "scenarios/packs/photometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace fernlicht::packs::plain {
namespace {

/// The worst over a sweep, by the measure of the truth.
double worst_of(const std::function<Floats(Floats)>& function, const std::function<double(double)>& truth, double from, double to,
                double least_scale) {
    double worst = 0.0;
    constexpr std::size_t steps = 400'000;
    std::array<float, lanes> x{}, y{};
    for (std::size_t i = 0; i < steps; i += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane)
            x[lane] = static_cast<float>(std::lerp(from, to, static_cast<double>(i + lane) / static_cast<double>(steps)));
        store(function(load(x.data())), y.data());
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double right = truth(static_cast<double>(x[lane]));
            worst = std::max(worst, std::abs(static_cast<double>(y[lane]) - right) / std::max(std::abs(right), least_scale));
        }
    }
    return worst;
}

/// The same function of one number in every lane.
float of(Floats value) {
    std::array<float, lanes> out{};
    store(value, out.data());
    return out[lanes - 1];
}

TEST(Packs, FunctionsAreAsExactAsTheySay) {
    const auto exp_of = [](Floats x) { return photometry::exp(x); };
    const auto log_of = [](Floats x) { return photometry::log(x); };
    EXPECT_LT(worst_of(
                  exp_of, [](double x) { return std::exp(x); }, -87.0, 88.7, 0.0),
              1.2e-7);
    EXPECT_LT(worst_of(
                  exp_of, [](double x) { return std::exp(x); }, -104.0, -87.0, 1.2e-38),
              1.2e-7);
    EXPECT_LT(worst_of(
                  log_of, [](double x) { return std::log(x); }, 0.5, 2.0, 0.0),
              1e-7);
    EXPECT_LT(worst_of(
                  log_of, [](double x) { return std::log(x); }, 1.2e-38, 1e-30, 0.0),
              1e-7);
    EXPECT_LT(worst_of(
                  log_of, [](double x) { return std::log(x); }, 2.0, 1e38, 0.0),
              1e-7);
    EXPECT_LT(worst_of([](Floats a) { return photometry::atan(a, Floats(-3.0)); }, [](double a) { return std::atan2(a, -3.0); }, -100.0,
                       100.0, 1.0),
              1.6e-7 + 1e-7);
    EXPECT_EQ(of(photometry::exp(0.0)), 1.0F);
    EXPECT_EQ(of(photometry::log(1.0)), 0.0F);
    EXPECT_EQ(of(photometry::exp(-1e30)), 0.0F);
    EXPECT_EQ(of(photometry::exp(1e30)), std::numeric_limits<float>::infinity());
    EXPECT_EQ(of(inversesqrt(Floats(0.25))), 2.0F);
}

TEST(Packs, LanesAreTakenAndFoundBySelf) {
    std::array<float, 64> table{};
    std::array<std::int32_t, lanes> index{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = static_cast<float>(i * i);
    for (std::size_t lane = 0; lane < lanes; ++lane)
        index[lane] = static_cast<std::int32_t>(63 - 5 * lane);
    std::array<float, lanes> found{};
    const Ints at = load(index.data());
    store(gather(table.data(), at), found.data());
    for (std::size_t lane = 0; lane < lanes; ++lane)
        EXPECT_EQ(found[lane], table[63 - 5 * lane]);
    store(select(at < Ints(60), to_floats(at), -1.0), found.data());
    EXPECT_EQ(found[0], -1.0F);
    EXPECT_EQ(found[1], 58.0F);
    EXPECT_TRUE(any(at == Ints(63)) && !any(at == Ints(62)) && any(!(at == Ints(63))));
    EXPECT_EQ(of(to_floats(to_ints(Floats(-2.75)))), -2.0F);
    // As GLSL's: what is not a number does not come in by the second argument.
    EXPECT_EQ(of(max(0.0, std::numeric_limits<double>::quiet_NaN())), 0.0F);
    EXPECT_EQ(of(min(1.0, std::numeric_limits<double>::quiet_NaN())), 1.0F);
}

} // namespace
} // namespace fernlicht::packs::plain
