// A small experiment that nothing else knows: what it found, one function that tells it, and every output there is.
#include "runner/files/picture_file.h"
#include "runner/write/document.h"
#include "runner/write/formats.h"
#include "tests/runner/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <set>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct TossResult : Findings {
    int heads = 0, tosses = 0;
};

Document document(const TossResult& result) {
    const double share = static_cast<double>(result.heads) / result.tosses;
    WorkPrecision diagram{.name = "toss error",
                          .title = "Error over tosses",
                          .error_name = "error",
                          .error_unit = "%",
                          .time_name = "time",
                          .floor_name = "",
                          .notes = {"one coin"},
                          .rows = {}};
    diagram.rows.push_back({.label = "by hand",
                            .parameters = {},
                            .error = Interval{2.0, 1.0, 3.0},
                            .seconds = Interval{0.5, 0.4, 0.6},
                            .floor = 0.0,
                            .bytes = {},
                            .why_not = "",
                            .note = ""});
    diagram.rows.push_back(
        {.label = "by wind", .parameters = {}, .error = {}, .seconds = {}, .floor = 0.0, .bytes = {}, .why_not = "no wind", .note = ""});
    Section section = work_precision_section(diagram);
    section.blocks.insert(section.blocks.begin(), "A coin <thrown> often.");
    section.blocks.emplace_back(Table{
        "toss",
        "How `it` fell",
        {{.head = "side", .words = true}, {"share", "%", "of all"}, {"count", "", "of all"}},
        {{"heads | tails", Cell(fmt::format("{:.1f}", 100.0 * share), 100.0 * share), ""}, {"edge", "not measured, it never stood"}}});
    return {"Coins", {section}};
}

/// What a page sorts, slides and shows large.
Document full_document() {
    Table table{.name = "sides", .caption = "", .columns = {{"row"}, {.head = "side", .words = true}, {"share"}}, .rows = {}};
    table.rows = {{{"c0", 0.0}, Cell("50 % heads").hinted("the eagle"), {"37.5", 37.5}}, {{"c1", 1.0}, "tails", ""}};
    table.sortable = table.led_to = true;
    table.quiet = {1};
    const Card card{"share of heads", "+12.5", "%", "(more)", "by chance", Cell("a coin").linked("#c0")};
    return {"Coins & notes",
            {{"Unfair", {Listing{{Cell("all").linked("all tosses.csv")}, "Seen"}, Cards{card}, table, "Often."}, 2, false, "fail"}}};
}

class ToyExperiment : public testing::Test {
  protected:
    TossResult result = [] {
        TossResult found;
        found.heads = 3;
        found.tosses = 8;
        found.context.command = "toss --often";
        found.interrupted = "the coin is lost";
        found.missing = {"tosses 9 to 20"};
        return found;
    }();
};

TEST_F(ToyExperiment, BecomesAPage) {
    const std::string page = document_html(document(result), result);
    for (const char* part :
         {"<title>Coins", "<h2>Error over tosses</h2>", "A coin &lt;thrown&gt; often.", "<svg", "One coin.",
          "Not in the diagram: by wind, no wind.", "<summary>The same as a table</summary>", "colspan=\"2\" class=\"group\">Of all<",
          ">Share<br><small>%</small>", "<td class=\"n\">37.5</td>", "<td class=\"text\" colspan=\"2\">not measured, it never stood</td>",
          "<caption>How <code>it</code> fell</caption>", "Not all was measured: the coin is lost", "<li>tosses 9 to 20</li>",
          "toss --often"})
        EXPECT_THAT(page, HasSubstr(part));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
}

/// Every format there is says all, writes each table to a file, and as exactly as its row here demands; a new one needs a row.
TEST_F(ToyExperiment, BecomesEachFormat) {
    const std::map<std::string, std::pair<std::string, std::string>> exactly{
        {"html", {"", "<td class=\"text\" title=\"the eagle\">50 % heads</td><td class=\"n\" data-key=\"37.5\">37.5</td>"}},
        {"csv", {"side,\"of all share, %\",of all count\r\nheads | tails,37.5,\r\nedge,\"not measured, it never stood\",\r\n", ""}},
        {"markdown",
         {"| side | of all share, % | of all count |\n|---|--:|--:|\n| heads \\| tails | 37.5 | - |\n| edge | not measured, it never "
          "stood | |\n",
          "# Coins & notes\n\n## Unfair\n\nSeen:\n\n- all\n\n| row | side | share |\n|--:|---|--:|\n| c0 | 50 % heads | 37.5 |\n"}},
        {"tex",
         {"edge & \\multicolumn{2}{l}{not measured, it never stood} \\\\\n",
          "% Seen:\n% - all\n\\resizebox{\\linewidth}{!}{%\n% \n\\begin{tabular}{rlr}\n\\toprule\nrow & side & share \\\\\n\\midrule\n$c0$ "
          "& 50 \\% heads & $37.5$ \\\\\n$c1$ & tails & -- "}},
        {"text",
         {"How 'it' fell\n               of all  of all\nside            share   count\n                    %\n"
          "heads | tails    37.5       -\nedge: not measured, it never stood\n",
          "\nUnfair\nSeen\n  all\nshare of heads: +12.5 % (more); by chance; a coin\n"}}};
    const Document toy = document(result);
    const TemporaryFolder folder;
    std::set<std::string> extensions;
    for (const OutputFormat& format : output_formats()) {
        SCOPED_TRACE(format.name);
        EXPECT_TRUE(extensions.insert(format.extension).second && format.extension[0] == '.');
        ASSERT_TRUE(exactly.contains(format.name));
        const auto& [table, page] = exactly.at(format.name);
        const auto holds = [](const std::string& exact) {
            return AllOf(HasSubstr("37.5"), HasSubstr("heads"), HasSubstr("tails"), HasSubstr(exact));
        };
        ASSERT_TRUE(format.of_table || format.of_document);
        if (format.of_table) {
            EXPECT_THAT(format.of_table(std::get<Table>(toy.sections[0].blocks.back())), AllOf(holds(table), HasSubstr("it never stood")));
            write_tables(toy, folder.path(), format);
            for (const char* name : {"tables/toss", "tables/toss_error"})
                EXPECT_TRUE(std::filesystem::exists(folder / (std::string(name) + format.extension))) << name;
        }
        if (format.of_document) {
            EXPECT_THAT(format.of_document(toy), AllOf(HasSubstr("it never stood"), HasSubstr("often.")));
            EXPECT_THAT(format.of_document(full_document()), holds(page));
        }
    }
    write_document(toy, result, folder.path(), "coins");
    for (const char* name : {"coins.html", "toss_error.svg", "toss_error.png"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
}

TEST_F(ToyExperiment, SaysOnATerminalWhatItsPlotShows) {
    const std::string text = document_text(document(result));
    EXPECT_THAT(text, HasSubstr("\nError over tosses\nA coin <thrown> often.\n  on the front: by hand (2.0 %, 500 ms)\n  one coin\n"));
    EXPECT_THAT(text, Not(HasSubstr("The same as a table"))) << "what a plot shows is not printed again";
}

TEST_F(ToyExperiment, SortsAndLinksOnAPage) {
    const std::string page = document_html(full_document(), result);
    for (const char* part :
         {"<section class=\"verdict fail\">", "✗</span> Unfair</h2>", "<h3>Seen</h3>", "<li><a href=\"./all%20tosses.csv\">all</a></li>",
          "<span class=\"big\">+12.5<small> %</small></span> (more)</span>", "<a href=\"#c0\">a coin</a>", "<tr id=\"c0\">",
          "<td class=\"text\" title=\"the eagle\">50 % heads</td><td class=\"n\" data-key=\"37.5\">37.5</td>",
          "<tr id=\"c1\" class=\"quiet\">", "<td class=\"n\" data-key=\"\"></td>", "<script>"})
        EXPECT_THAT(page, HasSubstr(part));
}

TEST(DocumentMatrix, EveryFormatHasItsFigures) {
    PlaceMatrix matrix{.name = "m", .caption = "how far", .corner = "route", .unit = "m", .open_by = "aim"};
    matrix.columns = {Cell::of_series("old", 0), Cell::of_series("new", 1)};
    matrix.rows.emplace_back(Cell("hill"),
                             std::vector<MatrixEntry>{{{"40.1", 40.1}}, {{"50.2", 50.2}, "+10.1", "+25", "better", "2.0", 0.5}});
    const Document document{"Ways", {{"First", {matrix}}}};
    for (const OutputFormat& format : output_formats())
        for (const char* part : {"hill", "40.1", "50.2", "10.1", "better"})
            EXPECT_THAT(format.of_document ? format.of_document(document) : format.of_table(table_of(matrix)), HasSubstr(part))
                << format.name;
    EXPECT_EQ(table_csv(table_of(matrix)),
              "route,\"old, m\",\"new, m\",\"change, m\",\"change, %\",\"±, aim\",is\r\nhill,40.1,50.2,10.1,25,2.0,better\r\n");
}

TEST(DocumentPictures, StandInThePageAndLinkToFilesBelowIt) {
    const TemporaryFolder folder;
    write_png(Image<Rgb8>(2, 2), folder / "a.png");
    const Document document{"Seen", {{"Beside", {PictureStrip{"One moment", {{"a.png", "old"}, {folder / "a.png", "new"}}}}, 2, true}}};
    EXPECT_THAT(document_html(document, {}, folder.path()),
                AllOf(HasSubstr("<h3>One moment</h3>"), HasSubstr("<img alt=\"old\" src=\"data:image/jpeg;base64,"),
                      HasSubstr("<a href=\"./a.png\">old</a>"), HasSubstr("<figcaption>new</figcaption>")));
    EXPECT_EQ(document_text(document), "") << "on the page alone";
}

} // namespace
} // namespace fernlicht
