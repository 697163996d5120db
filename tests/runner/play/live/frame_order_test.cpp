#include "runner/play/live/live_loop.h"

#include <gtest/gtest.h>
#include <tuple>

namespace fernlicht {
namespace {

CanFrame at(std::int64_t time_ns) { return {.time_ns = time_ns}; }

std::vector<std::int64_t> stamps(std::span<const CanFrame> frames) {
    std::vector<std::int64_t> stamps;
    for (const CanFrame& frame : frames)
        stamps.push_back(frame.time_ns);
    return stamps;
}

using Stamps = std::vector<std::int64_t>;

TEST(FrameOrder, HandsFramesToTheTickOfTheirStamp) {
    FrameOrder order;
    for (const std::int64_t time_ns : {-5'000'000LL, 0LL, 4'000'000LL, 10'000'000LL, 10'001'000LL})
        order.add(at(time_ns), 11'000'000);
    EXPECT_EQ(stamps(order.due(0)), (Stamps{-5'000'000, 0}));
    EXPECT_EQ(stamps(order.due(10'000'000)), (Stamps{4'000'000, 10'000'000})) << "a frame stamped at a tick's time counts for it";
    EXPECT_EQ(stamps(order.due(20'000'000)), (Stamps{10'001'000}));
    EXPECT_TRUE(order.due(30'000'000).empty());
    EXPECT_EQ(order.late(), 0U);
}

TEST(FrameOrder, StampsAreWholeMicrosecondsAlsoBeforeTheStart) {
    FrameOrder order;
    for (const std::int64_t time_ns : {-1'500LL, -1LL, 999LL, 1'001LL})
        order.add(at(time_ns), 5'000);
    EXPECT_EQ(stamps(order.due(5'000)), (Stamps{-2'000, -1'000, 0, 1'000}));
}

TEST(FrameOrder, ALateFrameCountsForTheNextTickAndIsStampedSo) {
    FrameOrder order;
    EXPECT_TRUE(order.due(10'000'000).empty());
    order.add(at(7'000'000), 12'000'000);
    order.add(at(9'999'500), 12'000'000);
    order.add(at(11'000'000), 12'000'000);
    EXPECT_EQ(stamps(order.due(20'000'000)), (Stamps{10'001'000, 10'001'000, 11'000'000}));
    EXPECT_EQ(std::tuple(order.late(), order.latest_ns()), std::tuple(2U, 3'000'000));
}

/// What was used, replayed: the same frames at the same ticks.
TEST(FrameOrder, ItsStampsComeBackTheSameWay) {
    FrameOrder live, again;
    std::vector<CanFrame> recorded;
    std::vector<std::size_t> counts;
    std::uint64_t seed = 1;
    for (std::int64_t tick = 0; tick < 200; ++tick) {
        for (int i = 0; i < 5; ++i) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
            const std::int64_t now_ns = tick * 10'000'000 + 2'000'000, age_ns = static_cast<std::int64_t>(seed >> 40);
            live.add(at(now_ns - age_ns), now_ns);
        }
        const auto used = live.due(tick * 10'000'000);
        counts.push_back(used.size());
        recorded.insert(recorded.end(), used.begin(), used.end());
    }
    EXPECT_GT(live.late(), 0U);
    for (const CanFrame& frame : recorded)
        again.add(frame, frame.time_ns);
    for (std::int64_t tick = 0; tick < 200; ++tick)
        EXPECT_EQ(again.due(tick * 10'000'000).size(), counts[static_cast<std::size_t>(tick)]) << tick;
    EXPECT_EQ(again.late(), 0U);
}

TEST(FrameOrder, AStampFromTheFutureIsTheTimeOfReading) {
    FrameOrder order;
    order.add(at(9'000'000), 5'000'000);
    EXPECT_EQ(stamps(order.due(5'000'000)), (Stamps{5'000'000}));
    EXPECT_EQ(order.from_future(), 1U);
}

TEST(FrameOrder, ReceptionDecidesTheOrder) {
    FrameOrder order;
    order.add(at(3'000), 10'000);
    order.add(at(2'000), 10'000);
    order.add(at(4'000), 10'000);
    EXPECT_EQ(order.waiting(), 3U);
    EXPECT_EQ(stamps(order.due(10'000)), (Stamps{3'000, 3'000, 4'000}));
    EXPECT_EQ(order.waiting(), 0U);
}

} // namespace
} // namespace fernlicht
