// The YAML tree and its typed reading: places, refusals, bounds.
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/yaml_entry.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

const std::filesystem::path file = "/tmp/some.yaml";

std::string refusal(const auto& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "not refused";
}

std::string parse_refusal(const std::string& content) {
    return refusal([&] { parse_yaml(content, file); });
}

TEST(YamlTree, KeepsKindsOrderAndPlaces) {
    const YamlValue root = parse_yaml("b: 1\na:\n  - x\n  - 'y'\nn: ~\n", file);
    ASSERT_EQ(root.kind, YamlValue::Kind::map);
    ASSERT_EQ(root.members.size(), 3U);
    EXPECT_EQ(root.members[0].key, "b");
    EXPECT_EQ(root.members[0].value.line, 1U);
    EXPECT_EQ(root.members[0].value.column, 4U);
    const YamlValue& list = root.members[1].value;
    ASSERT_EQ(list.items.size(), 2U);
    EXPECT_FALSE(list.items[0].quoted);
    EXPECT_TRUE(list.items[1].quoted);
    EXPECT_EQ(list.items[1].line, 4U);
    EXPECT_EQ(root.members[2].value.kind, YamlValue::Kind::null);
}

TEST(YamlTree, AliasesBecomeWhatTheyName) {
    const YamlValue root = parse_yaml("a: &lamp {file: x}\nb: *lamp\n", file);
    ASSERT_EQ(root.members[1].value.members.size(), 1U);
    EXPECT_EQ(root.members[1].value.members[0].value.text, "x");
}

TEST(YamlTree, RefusesWithLine) {
    EXPECT_THAT(parse_refusal("a: 1\na: 2\n"), HasSubstr("some.yaml:2:1: found the key 'a' a second time"));
    EXPECT_THAT(parse_refusal("a: [1, 2\nb: 3\n"), HasSubstr("some.yaml:2"));
    EXPECT_THAT(parse_refusal("a: 1\n---\nb: 2\n"), HasSubstr("second YAML document"));
    EXPECT_THAT(parse_refusal("? [1, 2]\n: 3\n"), HasSubstr("as a key"));
    EXPECT_THAT(parse_refusal("~: 3\n"), HasSubstr("key without text"));
    EXPECT_THAT(parse_refusal("a: &x [*x]\n"), HasSubstr("alias"));
    EXPECT_THAT(parse_refusal("a: *nowhere\n"), HasSubstr("some.yaml:1"));
    EXPECT_THAT(parse_refusal(std::string("a: \0 1", 6)), HasSubstr("zero byte"));
    EXPECT_THAT(parse_refusal("# nothing but a comment\n"), HasSubstr("no content"));
    for (const auto& [low, high] : {std::pair{1, 0}, std::pair{0, 1}}) // either order of bytes, with a mark and without
        for (const bool mark : {true, false}) {
            std::string wide = mark ? (low != 0 ? "\xff\xfe" : "\xfe\xff") : "";
            for (const char c : std::string("fernlicht: 1\nname: wide\n"))
                wide += high != 0 ? std::string{'\0', c} : std::string{c, '\0'};
            EXPECT_EQ(parse_refusal(wide), "/tmp/some.yaml: is encoded in UTF-16: save it as UTF-8");
            EXPECT_EQ(parse_refusal(to_utf8(wide)), "/tmp/some.yaml: is encoded in UTF-16: save it as UTF-8");
        }
}

TEST(YamlTree, IsBounded) {
    std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 20; ++i) {
        bomb += fmt::format("a{0}: &a{0} [", i);
        for (int k = 0; k < 10; ++k)
            bomb += fmt::format("*a{}{}", i - 1, k < 9 ? ", " : "]\n");
    }
    EXPECT_THAT(parse_refusal(bomb), HasSubstr("more than 100000 values"));
    EXPECT_THAT(parse_refusal("a: " + std::string(40, '[') + std::string(40, ']')), HasSubstr("levels of nesting"));
    EXPECT_NE(parse_refusal("a: " + std::string(100'000, '[')), "not refused");
    EXPECT_NE(parse_refusal(std::string(100'000, '{')), "not refused");
}

TEST(YamlTree, SurvivesEveryTruncationAndByteFlip) {
    const std::string good = "fernlicht: 1\nroute: {road: \"1\", via: [a, 'b']}\nspeed: &s\n  - {at_s: 0, kmh: 3}\nx: *s\nt: |\n  text\n";
    ASSERT_NO_THROW(parse_yaml(good, file));
    for (std::size_t length = 0; length < good.size(); ++length)
        parse_refusal(good.substr(0, length)); // must return: either a tree or one InputError
    for (std::size_t at = 0; at < good.size(); ++at)
        for (const char byte : {'\0', '\xff', '{', '[', '&', '*', '!', '"', '\n', '\t', '%', '@', ':', '-'}) {
            std::string changed = good;
            changed[at] = byte;
            parse_refusal(changed);
        }
}

class YamlEntryTest : public testing::Test {
  protected:
    /// `text` as the value of key `k`.
    YamlEntry entry(const std::string& text) {
        root = parse_yaml("k: " + text, file);
        return {root.members.at(0).value, file, "k"};
    }
    YamlValue root;
};

TEST_F(YamlEntryTest, NumbersAreFiniteInRangeAndUnquoted) {
    EXPECT_EQ(entry("0.1").number(0.0, 1.0), 0.1);
    EXPECT_EQ(entry("-1e-3").number(-1.0, 1.0), -1e-3);
    EXPECT_EQ(entry("+2").number(0.0, 3.0), 2.0);
    for (const char* bad : {"'1'", "1 km", "'0,5'", "0,5,5", "nan", ".nan", "inf", "-.inf", "1e999", "0x10", "1_000", "~", "[1]", "{a: 1}",
                            "1.5.2", "+-1", "4"})
        EXPECT_THAT(refusal([&] { entry(bad).number(0.0, 3.0); }), HasSubstr("some.yaml:1:4: k: found ")) << bad;
}

TEST_F(YamlEntryTest, DecimalCommasAreCalledThat) {
    EXPECT_EQ(refusal([&] { entry("64,4").number(0.0, 300.0); }), "/tmp/some.yaml:1:4: k: has a decimal comma: write 64.4");
    EXPECT_EQ(refusal([&] { entry("-0,5e1").number_above(0.0, 300.0); }), "/tmp/some.yaml:1:4: k: has a decimal comma: write -0.5e1");
}

TEST_F(YamlEntryTest, WholesFlagsNamesAndChoices) {
    EXPECT_EQ(entry("7").whole(0, 9), 7);
    EXPECT_EQ(entry("18446744073709551615").count(), 18446744073709551615U);
    EXPECT_TRUE(entry("true").flag());
    EXPECT_EQ(entry("rational").choice({"linear", "rational"}), 1U);
    EXPECT_EQ(entry("a-b_c.9").name(), "a-b_c.9");
    EXPECT_THAT(refusal([&] { entry("7.0").whole(0, 9); }), HasSubstr("whole number"));
    EXPECT_THAT(refusal([&] { entry("-1").count(); }), HasSubstr("whole number"));
    EXPECT_THAT(refusal([&] { entry("yes").flag(); }), HasSubstr("true or false"));
    EXPECT_THAT(refusal([&] { entry("ratinal").choice({"linear", "rational"}); }), HasSubstr("nearest: 'rational'"));
    for (const char* bad : {"../up", ".hidden", "a/b", "'a b'", "''", "ä", "a\"b"})
        EXPECT_NE(refusal([&] { entry(bad).name(); }), "not refused") << bad;
    EXPECT_NE(refusal([&] { entry(std::string(65, 'a')).name(); }), "not refused");
}

TEST_F(YamlEntryTest, PathsStartAtTheFilesFolder) {
    EXPECT_EQ(entry("../lamps/a.ies").path(), "/lamps/a.ies");
    EXPECT_EQ(entry("b.ies").path(), "/tmp/b.ies");
    EXPECT_EQ(entry("/abs/c.ies").path(), "/abs/c.ies");
}

TEST_F(YamlEntryTest, UnknownKeysNameTheNearest) {
    EXPECT_THAT(refusal([&] {
                    entry("{ahead: 3}").map({"ahead_m", "left_m"});
                }),
                HasSubstr("some.yaml:1:5: k.ahead: unknown key, expected 'ahead_m', the nearest known key"));
    EXPECT_THAT(refusal([&] { entry("{zzzzzzzzz: 3}").map({"ahead_m", "left_m"}); }), HasSubstr("one of ahead_m, left_m"));
    EXPECT_THAT(refusal([&] { entry("{left_m: 3}").map({"ahead_m", "left_m"}).require("ahead_m"); }), HasSubstr("k.ahead_m: missing"));
    EXPECT_THAT(refusal([&] { entry("3").map({"ahead_m"}); }), HasSubstr("found '3', expected a map"));
}

TEST_F(YamlEntryTest, AnglesInDegreesOrRadians) {
    const auto angle = [&](const char* text) { return entry(text).map({"yaw_deg", "yaw_rad"}).angle_rad("yaw", 90.0); };
    EXPECT_DOUBLE_EQ(*angle("{yaw_deg: 90}"), 1.5707963267948966);
    EXPECT_EQ(*angle("{yaw_rad: 0.25}"), 0.25);
    EXPECT_FALSE(angle("{}"));
    EXPECT_THAT(refusal([&] { angle("{yaw_deg: 1, yaw_rad: 1}"); }), HasSubstr("'yaw_rad' beside 'yaw_deg'"));
    EXPECT_THAT(refusal([&] { angle("{yaw_deg: 91}"); }), HasSubstr("from -90 to 90"));
}

} // namespace
} // namespace fernlicht
