#include "scenarios/values/refusals.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

namespace fernlicht {
namespace {

const InputError first({"f", 1, 2, "a"}, "found 1", "2"), second({"f", 3, 0, "b"}, "missing", "it");

void read_both() {
    EachRead each;
    EXPECT_FALSE(each([] { throw first; }));
    EXPECT_TRUE(each([] {}));
    EXPECT_FALSE(each([] { throw second; }));
    EXPECT_FALSE(each([] { throw first; })) << "once more";
    EXPECT_TRUE(each.failed());
    each.end();
    FAIL() << "what was read by half";
}

TEST(Refusals, AreThrownAtOnceWhereNobodyListens) {
    EachRead each;
    EXPECT_THROW(each([] { throw first; }), InputError);
    EXPECT_NO_THROW(each.end());
    EXPECT_THROW(refuse_and_go_on(first), InputError);
    EXPECT_EQ(refusals_met(), 0U);
}

TEST(Refusals, AreAllThereEachOnce) {
    const auto all = all_refusals(read_both);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_STREQ(all[0].what(), first.what());
    EXPECT_STREQ(all[1].what(), second.what());
    EXPECT_EQ(refusals_met(), 0U);
}

TEST(Refusals, AMisspeltKeyIsNotMissing) {
    const auto all = all_refusals([] {
        refuse_and_go_on(first, "b");
        EXPECT_EQ(refusals_met(), 1U);
        throw second;
    });
    ASSERT_EQ(all.size(), 1U);
    EXPECT_STREQ(all[0].what(), first.what());
}

TEST(Refusals, OtherErrorsGoThrough) {
    EXPECT_THROW(all_refusals([] { throw std::logic_error("ours"); }), std::logic_error);
    EXPECT_EQ(all_refusals([] { EXPECT_TRUE(all_refusals([] { throw first; }).size() == 1); }).size(), 0U) << "one within another";
    EXPECT_THROW(refuse_and_go_on(first), InputError) << "nobody listens any more";
}

} // namespace
} // namespace fernlicht
