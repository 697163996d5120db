// Clock, recording, pictures between threads, figures: the parts of a live drive that need no bus.
#include "runner/commands/run_files.h"
#include "runner/experiments/run/run_plots.h"
#include "runner/play/live/live_figures.h"
#include "runner/play/live/live_loop.h"
#include "runner/play/live/live_pictures.h"
#include "runner/play/live/log_writer.h"
#include "scenarios/can/candump_log.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "tests/runner/schema_check.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>
#include <tuple>

namespace fernlicht {
namespace {

using testing::HasSubstr;

TEST(TickClock, SleepsUntilThenAndNotBefore) {
    const TickClock clock(10'000'000);
    EXPECT_LT(clock.now_ns(), 0);
    for (const std::int64_t time_ns : {0LL, 3'000'000LL, 6'000'000LL}) {
        clock.sleep_until(time_ns);
        EXPECT_GE(clock.now_ns(), time_ns);
    }
    const std::int64_t before_ns = clock.now_ns();
    clock.sleep_until(before_ns - 1'000'000'000); // long over
    EXPECT_LT(clock.now_ns() - before_ns, 1'000'000'000);
}

TEST(TickClock, StartsAtAWholeMicrosecondAndBringsStampsOver) {
    TickClock clock(0);
    EXPECT_EQ(clock.start_realtime_ns() % 1000, 0);
    clock.look();
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    const std::int64_t stamped_ns = clock.of_stamp(std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec);
    EXPECT_LE(std::abs(stamped_ns - clock.now_ns()), 50'000'000) << "both clocks, but for the time in between";
}

TEST(LogWriter, WritesWhatCandumpWould) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "live-log-writer.log";
    CanFrame frame;
    frame.channel = "vcan0";
    frame.id = 0x123;
    frame.length = 2;
    frame.data = {0xAB, 0x01};
    {
        LogWriter writer(file, 1'436'509'052'000'000'000);
        for (int i = 0; i < 100'000; ++i) {
            frame.time_ns = std::int64_t{i} * 1000;
            writer.add(frame);
            if (i % 1000 == 0)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        writer.finish();
        EXPECT_EQ(writer.written() + writer.left_out(), 100'000U);
        EXPECT_EQ(writer.left_out(), 0U);
    }
    FilesRead opened;
    const std::vector<CanFrame> back = read_candump(file, opened);
    ASSERT_EQ(back.size(), 100'000U);
    frame.time_ns = 1'436'509'052'000'000'000 + 99'999'000;
    EXPECT_EQ(back.back(), frame);
    std::filesystem::remove(file);
}

TEST(LogWriter, ADiskThatIsFullIsSaid) {
    if (!std::filesystem::exists("/dev/full"))
        GTEST_SKIP() << "no /dev/full";
    LogWriter writer("/dev/full", 0);
    writer.add({});
    EXPECT_THROW(writer.finish(), DeviceError);
    EXPECT_THROW(LogWriter("/nowhere/at/all.log", 0), DeviceError);
}

LivePicture live_picture(int tick, bool captured) {
    LivePicture picture;
    picture.moment.tick = tick;
    picture.captured = captured;
    return picture;
}

/// Of all that is offered while nobody looks, what is to be stored comes first and whole; of the others the newest.
TEST(LivePictures, KeepsWhatIsToBeStoredAndTheNewestOfTheRest) {
    LivePictures pictures;
    for (int tick = 0; tick < 10; ++tick) {
        LivePicture offered = live_picture(tick, tick % 5 == 0);
        ASSERT_TRUE(pictures.offer(offered));
    }
    EXPECT_FALSE(pictures.wanted(false)) << "one waits already";
    EXPECT_TRUE(pictures.wanted(true));
    std::vector<int> taken;
    for (int i = 0; i < 3; ++i)
        taken.push_back(pictures.take()->moment.tick);
    EXPECT_EQ(taken, (std::vector{0, 5, 9}));
    pictures.end();
    EXPECT_FALSE(pictures.take());
}

TEST(LivePictures, TakingWaitsForTheOtherThread) {
    LivePictures pictures;
    std::vector<int> taken;
    std::thread drawing([&] {
        while (const auto next = pictures.take())
            taken.push_back(next->moment.tick);
    });
    for (int tick = 0; tick < 50; ++tick) {
        LivePicture offered = live_picture(tick, true);
        while (!pictures.wanted(true) || !pictures.offer(offered))
            std::this_thread::yield();
    }
    pictures.end();
    drawing.join();
    ASSERT_EQ(taken.size(), 50U);
    EXPECT_EQ(taken.back(), 49);
}

LiveFigures sample_figures() {
    LiveFigures live;
    live.interface = "vcan0";
    live.period_s = 0.01;
    live.start_ns = 1'436'509'052'249'713'000;
    live.ticks_planned = 101;
    for (int i = 0; i <= 100; ++i) {
        live.late_s.push_back(1e-5 * i);
        live.work_s.push_back(1e-4);
    }
    live.used = 200;
    live.late = 3;
    live.socket.received = 205;
    live.socket.dropped = 17;
    live.socket.outages = {{CanOutage::Kind::down, 300'000'000, 800'000'000}, {CanOutage::Kind::removed, 900'000'000, 0}};
    live.recording = "can-in.log";
    live.moments = 20;
    live.drawn = 12;
    return live;
}

TEST(LiveFigures, QuantilesAreThoseOfTheOrderedSamples) {
    EXPECT_DOUBLE_EQ(LiveFigures::quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
    EXPECT_DOUBLE_EQ(LiveFigures::quantile({1.0, 2.0}, 0.99), 1.99);
    EXPECT_DOUBLE_EQ(LiveFigures::quantile({}, 0.5), 0.0);
}

TEST(LiveFigures, JsonSaysWhatWasLost) {
    const nlohmann::ordered_json json = live_json(sample_figures());
    EXPECT_EQ(json["start_s"], "1436509052.249713");
    EXPECT_NEAR(json["lateness_s"]["p50"].get<double>(), 5e-4, 1e-12);
    EXPECT_NEAR(json["lateness_s"]["p99"].get<double>(), 9.9e-4, 1e-12);
    EXPECT_NEAR(json["lateness_s"]["max"].get<double>(), 1e-3, 1e-12);
    EXPECT_EQ(json["socket"]["dropped"], 17);
    EXPECT_EQ(json["socket"]["outages"][0]["kind"], "down");
    EXPECT_TRUE(json["socket"]["outages"][1]["until_s"].is_null());
    EXPECT_EQ(json["pictures"]["skipped"], 8);
    Report report;
    report.live = std::make_shared<const LiveFigures>(sample_figures());
    EXPECT_THAT(tests::complaints(nlohmann::json::parse(report_json(report)), "run/report"), testing::IsEmpty());
    EXPECT_THAT(report_html(report, {}),
                testing::AllOf(HasSubstr("Interface removed at 0.90 s, until the end"), HasSubstr("frames dropped by the socket")));
    EXPECT_THAT(live_text(sample_figures()), HasSubstr("17 dropped by the socket"));
    EXPECT_THAT(live_text(sample_figures()), HasSubstr("interface down at 0.30 s for 0.50 s, interface removed at 0.90 s to the end"));
}

TEST(LiveFigures, HistogramCountsEveryTick) {
    const std::vector<plots::Figure> figures = lateness_figures(sample_figures());
    ASSERT_EQ(figures.size(), 2U);
    EXPECT_EQ(figures.front().subtitle, "101 ticks every 10 ms");
    EXPECT_TRUE(lateness_figures({}).empty());
    LiveFigures punctual = sample_figures();
    punctual.late_s.assign(5, 0.0); // as without waiting
    EXPECT_EQ(lateness_figures(punctual).size(), 2U);
    punctual.waited = false;
    EXPECT_TRUE(lateness_figures(punctual).empty());
    EXPECT_TRUE(live_json(punctual)["lateness_s"].is_null());
    EXPECT_THAT(live_text(punctual), testing::Not(HasSubstr("late")));
}

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
