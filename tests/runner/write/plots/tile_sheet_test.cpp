// Captions of contact sheets: all of their words, and none beyond the picture's edge or its neighbour.
#include "runner/write/plots/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>

namespace fernlicht {
namespace {

struct Line {
    double x, y, size_px;
    std::string text;
};

std::vector<Line> lines_of(const std::string& svg) {
    static const std::regex text("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*font-size=\"([0-9.]+)\"[^>]*>([^<]*)</text>");
    std::vector<Line> lines;
    for (std::sregex_iterator at(svg.begin(), svg.end(), text), end; at != end; ++at)
        lines.push_back({std::stod((*at)[1]), std::stod((*at)[2]), std::stod((*at)[3]), (*at)[4]});
    return lines;
}

double number_after(const std::string& svg, const std::string& what) { return std::stod(svg.substr(svg.find(what) + what.size())); }

TileSection section(const std::string& words, const std::string& name, const std::string& caption) {
    TileSection made{"A title", words, {}};
    for (int i = 0; i < 4; ++i)
        made.tiles.push_back({i == 1 ? name : "short", i == 1 ? caption : "words", Image<Rgb8>(tile_px, 200)});
    return made;
}

TEST(TileSheet, LongCaptionsAreWrappedWhole) {
    std::string words, caption;
    for (int i = 0; i < 60; ++i)
        words += (i ? " word" : "word") + std::to_string(i);
    for (int i = 0; i < 20; ++i)
        caption += (i ? " caption" : "caption") + std::to_string(i);
    const std::string name(70, 'W'), svg = plots::svg_of(TileSheet{"sheet", {section(words, name, caption), section("last", "a", "b")}});
    const double width = number_after(svg, "width=\""), height = number_after(svg, "height=\"");
    std::string all, unbroken;
    double last_y = 0.0;
    for (const Line& line : lines_of(svg)) {
        EXPECT_LE(line.x + plots::text_width(line.text, line.size_px), width) << line.text;
        const bool under_tile = line.text.starts_with("caption") || line.text.starts_with("WW");
        EXPECT_LE(plots::text_width(line.text, line.size_px), under_tile ? tile_px : width) << line.text;
        EXPECT_LT(line.y, height) << line.text;
        all += line.text + ' ';
        unbroken += line.text;
        last_y = std::max(last_y, line.y);
    }
    EXPECT_THAT(all, testing::HasSubstr(words + ' '));
    EXPECT_THAT(all, testing::HasSubstr(caption + ' '));
    EXPECT_THAT(unbroken, testing::HasSubstr(name));
    EXPECT_GT(last_y, 700.0); // two rows of each section
}

/// A longer heading moves what is below it down by a line each, and nothing else.
TEST(TileSheet, WhatIsShortTakesTwoLinesAsBefore) {
    const std::string one = plots::svg_of(TileSheet{"sheet", {section("words", "a", "b")}});
    const std::string more = plots::svg_of(TileSheet{"sheet", {section(std::string(150, 'w'), "a", "b")}});
    EXPECT_DOUBLE_EQ(number_after(more, "height=\"") - number_after(one, "height=\""), 17.0);
    EXPECT_DOUBLE_EQ(number_after(one, "height=\""), 62.0 + 2.0 * (200.0 + 44.0));
}

} // namespace
} // namespace fernlicht
