// Error frames in words: data after include/uapi/linux/can/error.h, words as candump -e prints them.
#include "scenarios/can/can_frame.h"
#include "scenarios/can/candump_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using testing::ElementsAre;

std::vector<std::string> words(const std::string& frame) { return error_words(parse_candump_line("(1.000000) can0 " + frame, {}).frame); }

TEST(ErrorWords, NameClassesAndWhatTheirDataSay) {
    EXPECT_THAT(words("20000001#0000000000000000"), ElementsAre("tx-timeout"));
    EXPECT_THAT(words("20000002#0B00000000000000"), ElementsAre("lost-arbitration{at bit 11}"));
    EXPECT_THAT(words("20000004#0004000000000000"), ElementsAre("controller-problem{rx-error-warning}"));
    EXPECT_THAT(words("20000004#0030000000000000"), ElementsAre("controller-problem{rx-error-passive,tx-error-passive}"));
    EXPECT_THAT(words("20000008#0000041900000000"), ElementsAre("protocol-violation{{bit-stuffing-error}{acknowledge-slot}}"));
    EXPECT_THAT(words("20000040#0000000000000000"), ElementsAre("bus-off"));
    EXPECT_THAT(words("20000204#0008000000008060"), ElementsAre("controller-problem{tx-error-warning}", "error-counter-tx-rx{{128}{96}}"));
    EXPECT_THAT(words("20000080#0000000000000102"), ElementsAre("bus-error", "error-counter-tx-rx{{1}{2}}"));
    EXPECT_THAT(words("200000A8#000000FF00000000"), ElementsAre("protocol-violation{{}{}}", "no-acknowledgement-on-tx", "bus-error"));
    EXPECT_TRUE(words("20001000#0000000000000000").empty());
    EXPECT_TRUE(words("123#11").empty());
}

} // namespace
} // namespace fernlicht
