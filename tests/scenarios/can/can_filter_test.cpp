// candump's filters with the kernel's meaning; the examples are those of candump's own help.
#include "scenarios/can/can_filter.h"
#include "scenarios/can/candump_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

bool passes(const std::string& filters, const std::string& frame) {
    return parse_can_filters(filters, "--filter").passes(parse_candump_line("(1.000000) can0 " + frame, {}).frame);
}

TEST(CanFilter, LooksAtTheBitsOfTheMask) {
    EXPECT_TRUE(passes("123:7FF", "123#11"));
    EXPECT_FALSE(passes("123:7FF", "124#11"));
    EXPECT_TRUE(passes("123:7FF", "123##111"));
    EXPECT_TRUE(passes("400:700", "4FF#11"));
    EXPECT_FALSE(passes("400:700", "500#11"));
    EXPECT_FALSE(passes("400~7F0", "40F#11"));
    EXPECT_TRUE(passes("400~7F0", "410#11"));
    EXPECT_TRUE(passes("0x123:0x7ff", "123#11"));
}

TEST(CanFilter, MatchesExtendedAndRemoteUnlessTheMaskTells) {
    EXPECT_TRUE(passes("123:7FF", "00000123#11")); // "including EFF and RTR frames"
    EXPECT_TRUE(passes("123:7FF", "123#R"));
    EXPECT_TRUE(passes("123:7FF", "12345123#11"));
    EXPECT_TRUE(passes("123:C00007FF", "123#11")); // "only SFF and non-RTR frames"
    EXPECT_FALSE(passes("123:C00007FF", "00000123#11"));
    EXPECT_FALSE(passes("123:C00007FF", "123#R"));
    EXPECT_TRUE(passes("12345678:DFFFFFFF", "12345678#11")); // "only for extended CAN ID 12345678"
    EXPECT_FALSE(passes("12345678:DFFFFFFF", "678#11"));
    EXPECT_FALSE(passes("12345678:DFFFFFFF", "12345678#R"));
    EXPECT_TRUE(passes("00000123:DFFFFFFF", "00000123#"));
    EXPECT_FALSE(passes("00000123:DFFFFFFF", "123#"));
    EXPECT_TRUE(passes("123:9FFFFFFF", "123#")); // the extended flag in the mask: 11 bits are looked at
    EXPECT_FALSE(passes("123:9FFFFFFF", "00000123#"));
}

TEST(CanFilter, LetsErrorFramesPassByTheirOwnMaskAlone) {
    EXPECT_FALSE(passes("0:0", "20000004#0000000000000000"));
    EXPECT_TRUE(passes("0:0,#FFFFFFFF", "20000004#0000000000000000"));
    EXPECT_TRUE(passes("0:0,#FFFFFFFF", "123#"));
    EXPECT_TRUE(passes("0~0,#FFFFFFFF", "20000004#0000000000000000")); // "only error frames"
    EXPECT_FALSE(passes("0~0,#FFFFFFFF", "123#"));
    EXPECT_FALSE(passes("#00000003", "20000004#0000000000000000"));
    EXPECT_TRUE(passes("#00000003", "123#")); // without a filter for data frames all of them
}

TEST(CanFilter, PassesByAnyOrJoinedByAll) {
    EXPECT_TRUE(passes("100:700,200:700", "2AA#"));
    EXPECT_FALSE(passes("100:700,200:700", "3AA#"));
    EXPECT_TRUE(passes("100~7FF,200~7FF", "100#"));
    EXPECT_FALSE(passes("100~7FF,200~7FF,j", "100#"));
    EXPECT_TRUE(passes("100~7FF,200~7FF,J", "300#"));
}

TEST(CanFilter, BelongsToAChannel) {
    const CanFrame frame = parse_candump_line("(1.000000) can0 123#", {}).frame;
    CanFrame error = parse_candump_line("(1.000000) can0 20000001#", {}).frame;
    EXPECT_TRUE(parse_channel_filter("can0", "--channel").passes(frame));
    EXPECT_TRUE(parse_channel_filter("can0", "--channel").passes(error));
    EXPECT_FALSE(parse_channel_filter("can0,0:0", "--channel").passes(error));
    EXPECT_FALSE(parse_channel_filter("can1", "--channel").passes(frame));
    EXPECT_TRUE(parse_channel_filter("any", "--channel").passes(frame));
    EXPECT_TRUE(parse_channel_filter("any,123:7FF", "--channel").passes(frame));
    EXPECT_FALSE(parse_channel_filter("can0,124:7FF,#FF", "--channel").passes(frame));
}

TEST(CanFilter, SaysWhatIsNoFilter) {
    for (const char* bad : {"", "123", "123:", ":7FF", "123:7FG", "123:7FF,", "#", "#X", "123456789:7FF", "jj", "123:7FF:1", "-1:7FF"})
        EXPECT_THROW(parse_can_filters(bad, "--filter"), InputError) << bad;
    for (const char* bad : {"", ",123:7FF", "sixteen_letters__", "can0,"})
        EXPECT_THROW(parse_channel_filter(bad, "--channel"), InputError) << bad;
    try {
        parse_can_filters("123:7FF,nonsense", "--filter");
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("--filter: found 'nonsense', expected filters as candump has them"));
    }
}

} // namespace
} // namespace fernlicht
