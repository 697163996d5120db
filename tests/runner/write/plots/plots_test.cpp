#include "runner/findings/plots/drawing.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <limits>

namespace fernlicht::plots {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> labels_of(const Axis& axis, int most) {
    std::vector<std::string> labels;
    for (const Tick& t : ticks_of(axis, most))
        if (!t.label.empty())
            labels.push_back(t.label);
    return labels;
}

TEST(Axes, LinearTicksAreRoundAndCoverTheAxis) {
    EXPECT_EQ(labels_of({"", "", 0.0, 100.0, Scale::linear, {}}, 6), (std::vector<std::string>{"0", "20", "40", "60", "80", "100"}));
    EXPECT_EQ(labels_of({"", "", -0.3, 0.3, Scale::linear, {}}, 7),
              (std::vector<std::string>{"-0.3", "-0.2", "-0.1", "0", "0.1", "0.2", "0.3"}));
    EXPECT_EQ(labels_of({"", "", 10.0, -10.0, Scale::linear, {}}, 3), (std::vector<std::string>{"-10", "0", "10"}));
}

TEST(Axes, LogarithmicTicksAreDecadesWithTwoAndFiveWhereThereIsRoom) {
    EXPECT_EQ(labels_of({"", "", 0.1, 100.0, Scale::logarithmic, {}}, 5), (std::vector<std::string>{"0.1", "1", "10", "100"}));
    EXPECT_EQ(labels_of({"", "", 1.0, 50.0, Scale::logarithmic, {}}, 8), (std::vector<std::string>{"1", "2", "5", "10", "20", "50"}));
    EXPECT_EQ(labels_of({"", "", 1e-6, 1e6, Scale::logarithmic, {}}, 6),
              (std::vector<std::string>{"1e-6", "0.0001", "0.01", "1", "100", "10000", "1e6"}));
}

TEST(Axes, PositionIsAffineInTheValueOrInItsLogarithm) {
    EXPECT_DOUBLE_EQ(position({"", "", 10.0, 20.0, Scale::linear, {}}, 12.5), 0.25);
    EXPECT_DOUBLE_EQ(position({"", "", 20.0, 10.0, Scale::linear, {}}, 12.5), 0.75);
    EXPECT_NEAR(position({"", "", 0.1, 1000.0, Scale::logarithmic, {}}, 1.0), 0.25, 1e-15);
    EXPECT_TRUE(std::isnan(position({"", "", 0.1, 1000.0, Scale::logarithmic, {}}, 0.0)));
}

// Three decades to either side: 1000 at the end, 100 a third of the half nearer to the middle, 1 and less in it.
TEST(Axes, SignedLogarithmsStandAlikeToBothSidesOfNothing) {
    const Axis axis{.label = "d", .unit = "cd", .from = -1000.0, .to = 1000.0, .scale = Scale::signed_logarithmic};
    EXPECT_DOUBLE_EQ(position(axis, 1000.0), 1.0);
    EXPECT_NEAR(position(axis, 100.0), 0.5 + 0.5 * 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(position(axis, 1.0), 0.5, 1e-12);
    EXPECT_DOUBLE_EQ(position(axis, 0.3), 0.5);
    EXPECT_DOUBLE_EQ(position(axis, 0.0), 0.5);
    for (const double value : {0.5, 2.0, 30.0, 700.0, 5000.0})
        EXPECT_NEAR(position(axis, -value), 1.0 - position(axis, value), 1e-12);
    const std::vector<Tick> ticks = ticks_of(axis, 4);
    ASSERT_EQ(ticks.size(), 7U);
    EXPECT_EQ(ticks.front().label, "-1000");
    EXPECT_EQ(ticks.back().label, "+1000");
    EXPECT_EQ(ticks[3].label, "0 \u00b1 1");
}

TEST(Axes, AxisAroundHoldsItsValues) {
    const Axis axis = axis_around("reach", "m", {61.3, std::nan(""), 94.0});
    EXPECT_EQ(axis.from, 60.0);
    EXPECT_EQ(axis.to, 95.0);
    const Axis from_zero = axis_around("reach", "m", {40.0, 100.0}, Scale::linear, true);
    EXPECT_EQ(from_zero.from, 0.0);
    EXPECT_GE(from_zero.to, 105.0) << "a line on the frame cannot be seen";
    const Axis log = axis_around("E", "lx", {0.0, 0.3, 42.0}, Scale::logarithmic);
    EXPECT_NEAR(log.from, 0.1, 1e-15);
    EXPECT_NEAR(log.to, 100.0, 1e-12);
    const Axis nothing = axis_around("reach", "m", {});
    EXPECT_LT(nothing.from, nothing.to);
    const Axis one = axis_around("reach", "m", {7.0});
    EXPECT_LT(one.from, one.to);
}

TEST(Axes, NumbersAreShort) {
    EXPECT_EQ(number(0.1 + 0.2), "0.3");
    EXPECT_EQ(number(2.5e6), "2.5e6");
    EXPECT_EQ(number(1e-5), "1e-5");
    EXPECT_EQ(number(-150.0), "-150");
}

/// x2 + y2 on a fine grid: the isoline of 1 is the unit circle.
Grid bowl(std::size_t n) {
    Grid g;
    for (std::size_t i = 0; i <= n; ++i)
        g.x.push_back(-1.5 + 3.0 * static_cast<double>(i) / static_cast<double>(n));
    g.y = g.x;
    for (const double y : g.y)
        for (const double x : g.x)
            g.values.push_back(x * x + y * y);
    return g;
}

TEST(Isolines, CircleIsOneClosedLineOfTheRightLength) {
    const auto lines = isolines(bowl(101), 1.0);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].front(), lines[0].back());
    double length = 0.0;
    for (std::size_t i = 1; i < lines[0].size(); ++i) {
        const Point &a = lines[0][i - 1], &b = lines[0][i];
        length += std::hypot(b.x - a.x, b.y - a.y);
        EXPECT_NEAR(std::hypot(b.x, b.y), 1.0, 2.3e-4); // chord of a parabola over a cell of 0.03: h2 / 8 / slope, and less
    }
    EXPECT_NEAR(length, 2.0 * 3.14159265, 2e-3);
}

TEST(Isolines, OpenAtTheEdgeOfTheGridAndAtMissingData) {
    Grid g{{0.0, 1.0, 2.0}, {0.0, 1.0, 2.0}, {0, 0, 0, 1, 1, 1, 2, 2, 2}};
    auto lines = isolines(g, 0.5);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].size(), 3u);
    for (const Point& p : lines[0])
        EXPECT_DOUBLE_EQ(p.y, 0.5);
    g.values[0] = std::nan("");
    lines = isolines(g, 0.5);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].size(), 2u);
    EXPECT_TRUE(isolines(g, 5.0).empty());
}

TEST(Isolines, SaddleIsJoinedByItsMiddle) {
    const Grid low{{0.0, 1.0}, {0.0, 1.0}, {2.0, 0.0, 0.0, 1.2}};  // mean 0.8: the high corners stand alone
    const Grid high{{0.0, 1.0}, {0.0, 1.0}, {3.0, 0.0, 0.0, 1.8}}; // mean 1.2: the high corners are joined
    for (const Polyline& line : isolines(low, 1.0))
        for (const Point& p : line) // each line cuts off a high corner: both its ends on one side of the other diagonal
            EXPECT_EQ(p.x + p.y < 1.0, line[0].x + line[0].y < 1.0);
    for (const Polyline& line : isolines(high, 1.0))
        for (const Point& p : line)
            EXPECT_EQ(p.x < p.y, line[0].x < line[0].y);
    EXPECT_EQ(isolines(low, 1.0).size(), 2u);
    EXPECT_EQ(isolines(high, 1.0).size(), 2u);
}

TEST(Colours, SequentialMapGetsLighterAllTheWay) {
    double last = -1.0;
    for (int i = 0; i <= 64; ++i) {
        const double now = luminance(sequential(i / 64.0));
        EXPECT_GT(now, last) << i;
        last = now;
    }
    EXPECT_LT(luminance(sequential(0.0)), 0.02);
    EXPECT_GT(luminance(sequential(1.0)), 0.75);
    EXPECT_EQ(sequential(2.0), sequential(1.0));
}

TEST(Png, BytesAreAPngOfTheGivenPixelsAndAlwaysTheSame) {
    Image<Colour> pixels(3, 2);
    pixels.at(2, 1) = {255, 128, 0};
    const std::string png = png_of_pixels(pixels);
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\3\0\0\0\2", 8)); // IHDR: 3 x 2
    EXPECT_EQ(png, png_of_pixels(pixels));
    EXPECT_THROW(png_of_pixels({}), std::runtime_error);
}

TEST(Png, Base64AsInRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

Figure small_figure() {
    Figure f;
    f.title = "Reach <b> & \"more\"";
    f.x = {"time", "s", 0.0, 10.0, Scale::linear, {}};
    f.y = {"reach", "m", 0.0, 100.0, Scale::linear, {}};
    f.series.push_back({"halo'gen",
                        {{0.0, 50.0}, {5.0, 60.0}, {6.0, std::numeric_limits<double>::quiet_NaN()}, {8.0, 40.0}, {10.0, 45.0}},
                        series_colour(0)});
    return f;
}

TEST(Svg, TextIsEscapedAndBytesRepeat) {
    const std::string svg = svg_of(small_figure());
    EXPECT_THAT(svg, HasSubstr("Reach &lt;b&gt; &amp; &quot;more&quot;"));
    EXPECT_THAT(svg, HasSubstr("halo&#39;gen"));
    EXPECT_THAT(svg, Not(HasSubstr("<b>")));
    EXPECT_THAT(svg, HasSubstr("reach [m]"));
    EXPECT_EQ(svg, svg_of(small_figure()));
}

TEST(Svg, ALongSubtitleGoesOnInTheNextLine) {
    Figure f = small_figure();
    f.subtitle = "a few words";
    EXPECT_THAT(svg_of(f), HasSubstr(">a few words<"));
    for (int i = 0; i < 40; ++i)
        f.subtitle += fmt::format(" word-{}", i);
    const std::string svg = svg_of(f);
    EXPECT_THAT(svg, AllOf(HasSubstr(">a few words word-0 "), HasSubstr(" word-39<")));
    std::size_t lines = 0;
    for (std::size_t at = svg.find("word-"); at != std::string::npos; at = svg.find("word-", svg.find('<', at)))
        ++lines;
    EXPECT_EQ(lines, 3U);
}

TEST(Svg, ALongTitleIsSmallerInsteadOfCutOff) {
    Figure figure = small_figure();
    const auto size_of = [&](const std::string& title) {
        figure.title = title;
        const std::string svg = svg_of(figure);
        const std::size_t text = svg.rfind("<text", svg.rfind(">" + title + "<")), at = svg.find("font-size=\"", text) + 11;
        return std::stod(svg.substr(at));
    };
    EXPECT_EQ(size_of("Light"), 16.0);
    const std::string longest(120, 'm');
    const double size_px = size_of(longest);
    EXPECT_LT(size_px, 16.0);
    EXPECT_LE(text_width(longest, size_px), figure.width_px);
}

TEST(Svg, WhatWasNotMeasuredInterruptsTheLine) {
    const std::string svg = svg_of(small_figure());
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    const std::string stroke = "stroke=\"" + css(series_colour(0)) + "\"";
    std::size_t count = 0;
    for (std::size_t at = svg.find(stroke); at != std::string::npos; at = svg.find(stroke, at + 1))
        ++count;
    EXPECT_EQ(count, 3u); // two parts of the curve and its sample in the legend
}

TEST(Svg, PointsOnTheWayBetweenOthersAreLeftOut) {
    Figure figure;
    figure.title = "bent";
    figure.x = {"x", "", 0.0, 200.0};
    figure.y = {"y", "", 0.0, 100.0};
    Series line{"way"};
    for (int i = 0; i <= 200; ++i)
        line.points.push_back({static_cast<double>(i), i < 100 ? 0.0 : static_cast<double>(i - 100)});
    figure.series = {line};
    const std::string svg = svg_of(figure);
    const std::size_t at = svg.find("data-of=\"way\""), from = svg.rfind("d=\"", at);
    const std::string path = svg.substr(from, svg.find('"', from + 3) - from);
    EXPECT_LT(std::ranges::count(path, ','), 12) << path;
    EXPECT_GE(std::ranges::count(path, ','), 3) << path;
    EXPECT_THAT(svg, testing::HasSubstr("data-course=\"")) << "by which a page moves a line across it";
}

TEST(Svg, BecomesAPngOfItsSize) {
    Figure f = small_figure();
    Image<float> lux(4, 3, 1.0f);
    lux.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    f.colour_bar = ColourBar{{"E", "lx", 0.1, 100.0, Scale::logarithmic, {}}};
    f.rasters.push_back({heat_map(lux, f.colour_bar->axis), 0.0, 10.0, 100.0, 0.0});
    f.isolines.push_back({"1 lx", {{{2.0, 20.0}, {5.0, 50.0}, {8.0, 20.0}}}});
    f.bands.push_back({"spread", {0.0, 10.0}, {40.0, 40.0}, {60.0, 70.0}, series_colour(1)});
    f.marks.push_back({Mark::Across::at_y, 30.0, "limit"});
    const std::string png = png_of_svg(svg_of(f), 2.0);
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\x06\xb8\0\0\x03\xc0", 8)); // 1720 x 960
    EXPECT_THROW(png_of_svg("<svg"), std::invalid_argument);
}

TEST(Svg, AnAxisThatCannotBeDrawnIsNamed) {
    Figure f = small_figure();
    f.y = {"reach", "m", 0.0, 100.0, Scale::logarithmic, {}};
    EXPECT_THROW(svg_of(f), std::invalid_argument);
    f.y = {"reach", "m", 5.0, 5.0, Scale::linear, {}};
    EXPECT_THROW(svg_of(f), std::invalid_argument);
}

TEST(Svg, HeatMapShowsMissingValuesAsMissing) {
    Image<float> lux(3, 1);
    lux.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    lux.at(1, 0) = 0.0f;
    lux.at(2, 0) = 100.0f;
    const Image<Colour> map = heat_map(lux, {"E", "lx", 0.1, 100.0, Scale::logarithmic, {}}, {1, 2, 3});
    EXPECT_EQ(map.at(0, 0), (Colour{1, 2, 3}));
    EXPECT_EQ(map.at(1, 0), sequential(0.0));
    EXPECT_EQ(map.at(2, 0), sequential(1.0));
}

} // namespace
} // namespace fernlicht::plots
