#include "runner/files/clean_text.h"

#include "runner/files/csv_file.h"
#include "tests/trial.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(CleanText, LeavesGoodTextAlone) { EXPECT_EQ(clean_text("Straße nach Köln, 20 µm \U0001F697"), "Straße nach Köln, 20 µm \U0001F697"); }

TEST(CleanText, ReplacesBytesThatAreNoUtf8) {
    EXPECT_EQ(clean_text("a\xff"
                         "b"),
              "a\ufffdb");
    EXPECT_EQ(clean_text("caf\xe9"), "caf\ufffd");
    EXPECT_EQ(clean_text("\xc0\x80"), "\ufffd\ufffd") << "overlong NUL";
    EXPECT_EQ(clean_text("\xed\xa0\x80"), "\ufffd\ufffd\ufffd") << "surrogate";
    EXPECT_EQ(clean_text("\xf4\x90\x80\x80"), "\ufffd\ufffd\ufffd\ufffd") << "above U+10FFFF";
    EXPECT_EQ(clean_text("\xe2\x82"), "\ufffd\ufffd") << "cut off";
}

TEST(CleanText, ShowsControlCharacters) {
    EXPECT_EQ(clean_text(std::string_view("a\nb\0c\x1b[31m\x7f", 11)), "a\u240ab\u2400c\u241b[31m\u2421");
    EXPECT_EQ(clean_text("gpj.\u202exe"), "gpj.\ufffdxe") << "right-to-left override";
    EXPECT_EQ(clean_text("\uffff\u0085"), "\ufffd\ufffd") << "not allowed in XML";
}

TEST(ShortText, KeepsBothEnds) {
    EXPECT_EQ(short_text("beam.ies", 8), "beam.ies");
    EXPECT_EQ(short_text("0123456789abcdef", 8), "01\u2026bcdef");
    EXPECT_EQ(short_text("öööööööööö", 4), "ö\u2026öö");
}

TEST(XmlText, EscapesMarkup) { EXPECT_EQ(xml_text("<a b=\"c\">&'\n"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;\u240a"); }

TEST(CsvText, QuotesAndDisarmsFormulas) {
    EXPECT_EQ(csv_text("plain"), "plain");
    EXPECT_EQ(csv_text("own lane, \"centre\""), "\"own lane, \"\"centre\"\"\"");
    EXPECT_EQ(csv_text("=HYPERLINK(\"x\")"), "\"'=HYPERLINK(\"\"x\"\")\"");
    for (const char* const start : {"+1", "-1+x", "-x", "@x", "=x"})
        EXPECT_EQ(csv_text(start), std::string("'") + start);
    for (const char* const number : {"-1", "-0.3", "-1e-5"})
        EXPECT_EQ(csv_text(number), number);
}

TEST(CsvFile, ReadsWhatIsWrittenAndRefusesAnOpenQuote) {
    const std::string text = "name,note\na,\"two\nlines\"\nb," + csv_text("=x \"1\"") + '\n';
    const CsvFile csv = read_csv(tests::written("good.csv", text));
    EXPECT_EQ(csv.rows, (std::vector<std::vector<std::string>>{{"a", "two\nlines"}, {"b", "=x \"1\""}}));
    EXPECT_NE(tests::refusal_of([&] {
                  read_csv(tests::written("open.csv", text + "c,\"open\nd,e\n"));
              }).find("open.csv:5: found a quote that does not end, expected a quote at the end of the field"),
              std::string::npos);
}

TEST(RelativeLink, CannotLeaveOrNameAScheme) {
    EXPECT_EQ(relative_link("frames/a b.png"), "./frames/a%20b.png");
    EXPECT_EQ(relative_link("javascript:x(\"<\")"), "./javascript%3Ax%28%22%3C%22%29");
}

} // namespace
} // namespace fernlicht
