#include "metrics/statistics/statistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <stdexcept>

namespace fernlicht {
namespace {

using Order = std::vector<std::size_t>;

// By an implementation of mt19937-64 and of the shuffle in another language.
TEST(RandomOrder, IsTheSeedsOwnOnEveryMachine) {
    std::mt19937_64 generator(1);
    EXPECT_EQ(random_order(8, generator), (Order{4, 6, 3, 5, 1, 7, 2, 0}));
    EXPECT_EQ(random_order(8, generator), (Order{0, 5, 6, 3, 7, 4, 2, 1}));
    EXPECT_EQ(random_order(8, generator), (Order{7, 5, 2, 3, 0, 1, 6, 4}));
    generator.seed(2);
    EXPECT_EQ(random_order(8, generator), (Order{7, 5, 2, 0, 3, 1, 6, 4}));
}

TEST(RandomOrder, OfNothingAndOfOne) {
    std::mt19937_64 generator(1);
    EXPECT_EQ(random_order(0, generator), Order{});
    EXPECT_EQ(random_order(1, generator), Order{0});
}

// 6000 draws among 6 orders: each 1000 times, give or take 5 deviations of sqrt(6000 / 6 * 5 / 6) = 29.
TEST(RandomOrder, EveryOrderComesEquallyOften) {
    std::mt19937_64 generator(3);
    std::map<Order, int> seen;
    for (int i = 0; i < 6000; ++i)
        ++seen[random_order(3, generator)];
    EXPECT_EQ(seen.size(), 6U);
    for (const auto& [order, times] : seen)
        EXPECT_NEAR(times, 1000, 145) << order[0] << order[1] << order[2];
}

// Of 2^64 numbers the remainders of 3 * 2^62 would come twice as often below 2^62 as above, were none drawn again.
TEST(Below, FavoursNoNumber) {
    std::mt19937_64 generator(4);
    constexpr std::uint64_t third = std::uint64_t{1} << 62;
    int low = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::uint64_t drawn = below(3 * third, generator);
        ASSERT_LT(drawn, 3 * third);
        low += drawn < third ? 1 : 0;
    }
    EXPECT_NEAR(low, 1000, 130); // 5 deviations of sqrt(3000 / 3 * 2 / 3)
    EXPECT_THROW(below(0, generator), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
