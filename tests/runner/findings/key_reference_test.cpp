#include "runner/findings/key_reference.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

std::vector<std::string> lines_of(const Section& section) {
    std::vector<std::string> lines;
    for (const DocumentPart& part : section.blocks)
        if (const auto* listing = std::get_if<Listing>(&part))
            for (const auto& item : listing->items)
                lines.push_back(item.text);
        else
            lines.push_back(std::get<std::string>(part));
    return lines;
}

KeyLine line(const std::string& name, const std::string& usual, const std::string& meaning) {
    return {{name}, "0..5 m", {}, "", usual, false, meaning};
}

TEST(KeyReference, SaysWhatIsAllowedAndTheDefault) {
    KeyLine required = line("b_deg", "", "turned");
    required.names.push_back("b_rad");
    required.is_required = true;
    const KeyLine choice{{"c"}, "", {"red", "green"}, "", "green", false, "colour"},
        within{{"d"}, "true, false", {}, "a.d", "", false, "more"};
    EXPECT_THAT(lines_of(key_sections({{"a", false, {line("a_m", "0.5", "long"), required, choice, within}}}).front()),
                testing::ElementsAre("`a_m` (0..5 m, **0.5**): long", "`b_deg`, `b_rad` (0..5 m, required): turned",
                                     "`c` (red, **green**): colour", "`d` (true, false, [keys](#ad)): more"));
}

TEST(KeyReference, ListsThatSayTheSameStandOnce) {
    const KeyLine to_first{{"x"}, "", {}, "a.NAME", "", false, ""}, to_second{{"y"}, "", {}, "named", "", false, ""};
    const std::vector<Section> sections = key_sections(
        {{"top", false, {to_first, to_second}}, {"a.NAME", false, {line("m", "1", "mass")}}, {"named", true, {line("m", "1", "mass")}}});
    ASSERT_EQ(sections.size(), 2U);
    EXPECT_EQ(sections[1].title, "named") << "the name stands for several";
    EXPECT_THAT(lines_of(sections[0]), testing::ElementsAre("`x` ([keys](#named))", "`y` ([keys](#named))"));
}

TEST(KeyReference, KeysInFullElsewhereAreNamed) {
    const std::string words = "a meaning of many words, all of which one would have to read again and again";
    const KeyLine p = line("p", "1", words), q = line("q", "2", words), own = line("own", "3", "short");
    KeyLine other_default = q;
    other_default.usual = "7";
    const std::vector<Section> sections =
        key_sections({{"front", false, {p, q}}, {"rear", false, {p, other_default, own}}, {"one", false, {own, line("x", "4", "other")}}});
    EXPECT_THAT(lines_of(sections[1]), testing::ElementsAre("All of [front](#front), but `q` (**7**).", "`own` (0..5 m, **3**): short"));
    EXPECT_THAT(lines_of(sections[2]), testing::ElementsAre("`own` (0..5 m, **3**): short", "`x` (0..5 m, **4**): other"))
        << "too little to be looked up elsewhere";
}

} // namespace
} // namespace fernlicht
