// Contact sheets: the layout of made-up tiles, and whole sheets through the program.
#include "runner/experiments/bench/contact_sheet.h"

#include "runner/write/document.h"
#include "scenarios/drives/play/camera.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Four by three pixels; every technique that has a lux image gives 5 lx.
ContactSheet sheet_of(std::span<const Technique> rows) {
    ContactSheet sheet;
    sheet.drive = "bend";
    sheet.title = "A <bend> & more";
    sheet.lamp_set = "xenon";
    sheet.moment.time_s = 1.5;
    sheet.moment.distance_m = 30.0;
    sheet.view.width_px = 4;
    sheet.view.height_px = 3;
    sheet.spot_px = glm::dvec2(2.0, 1.5);
    sheet.spot_ahead_m = 20.0;
    sheet.twin_lx = 4.0;
    for (const Technique& row : rows) {
        SheetTile tile{row, Image<Rgb8>(4, 3, {10, 20, 30}), {}, {}, {}};
        if (row.illuminance) {
            tile.illuminance_lx = Image<float>(4, 3, 5.0F);
            tile.spot_lx = 5.0;
        }
        sheet.tiles.push_back(tile);
    }
    return sheet;
}

std::string svg_of(const ContactSheet& sheet) { return plot_svg(contact_sheet(sheet)); }

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++n;
    return n;
}

TEST(ContactSheet, NamesEveryTechniqueTwiceAndSaysWhereNothingIsMeasured) {
    const std::string svg = svg_of(sheet_of(techniques()));
    const auto with_lux = static_cast<std::size_t>(std::ranges::count_if(techniques(), &Technique::illuminance));
    ASSERT_GT(with_lux, 0U);
    ASSERT_LT(with_lux, techniques().size());
    for (const Technique& row : techniques())
        EXPECT_EQ(count(svg, fmt::format(">{}</text>", row.name)), 2U) << row.name;
    EXPECT_EQ(count(svg, "<image "), techniques().size() + with_lux + 1) << "pictures, lux images and the bar";
    EXPECT_EQ(count(svg, ">not measured</text>"), techniques().size() - with_lux);
    EXPECT_EQ(count(svg, ">no lux image</text>"), techniques().size() - with_lux);
    EXPECT_EQ(count(svg, ">5.00 lx, x 1.25</text>"), with_lux); // 5 lx over the 4 lx calculated
    EXPECT_THAT(svg, HasSubstr("A &lt;bend&gt; &amp; more, xenon: after 1.50 s, 30.0 m along the route"));
    EXPECT_THAT(svg, HasSubstr("20 m ahead of the bumper, and its ratio to the 4.00 lx of the own lamps, as the twin computes there"));
    EXPECT_THAT(svg, HasSubstr(">as published, row 4 of Table 6.1</text>"));
    for (const char* tick : {">0.1</text>", ">1</text>", ">10</text>", ">100</text>"})
        EXPECT_THAT(svg, HasSubstr(tick));
    EXPECT_EQ(svg, svg_of(sheet_of(techniques())));
}

TEST(ContactSheet, ATechniqueThatCannotDrawTheMomentIsLeftOutWithItsReason) {
    ContactSheet sheet = sheet_of(techniques().first(2));
    const std::size_t drawn = count(svg_of(sheet), "<image ");
    sheet.tiles[0] = {techniques()[0], {}, {}, {}, "10 lamps are mounted"};
    const std::string svg = svg_of(sheet);
    EXPECT_EQ(count(svg, "<image "), drawn - (techniques()[0].illuminance ? 2 : 1));
    EXPECT_EQ(count(svg, ">10 lamps are mounted</text>"), 1U);
    EXPECT_EQ(count(svg, ">not rendered</text>"), 2U);
}

TEST(ContactSheet, LaysTilesFiveAcross) {
    const std::string svg = svg_of(sheet_of(techniques().first(6)));
    // 16 px edge, tiles of 4 with gaps of 12; rows of 3 below a head of 62 with captions of 44.
    EXPECT_THAT(svg, HasSubstr("width=\"100\" height=\"312\""));
    for (const char* place : {"translate(16 62)", "translate(32 62)", "translate(80 62)", "translate(16 109)"})
        EXPECT_THAT(svg, HasSubstr(place));
    EXPECT_THAT(svg, Not(HasSubstr("translate(96 62)")));
}

TEST(ContactSheet, MeasuresNothingInTheDarkAgainstNothing) {
    ContactSheet sheet = sheet_of(techniques().subspan(3, 1));
    sheet.twin_lx = 0.0;
    sheet.tiles[0].spot_lx = 0.0;
    EXPECT_THAT(svg_of(sheet), HasSubstr(">0.00 lx</text>"));
}

TEST(ContactSheet, ItsCrossStandsOnTheSpot) {
    const Stage stage(read_drive(library_file("drives/s-bend.yaml")));
    const Moment moment = moments_at({60}, stage, stage.drive.lamp_sets.front()).front();
    const ContactSheet sheet = new_sheet(stage, stage.drive.lamp_sets.front(), moment);
    ASSERT_TRUE(sheet.spot_px);
    EXPECT_EQ(sheet.view.width_px, 320);
    EXPECT_EQ(sheet.view.height_px, 240); // of 1024 x 768
    const Ray ray = pixel_ray(camera_of(moment, sheet.view), sheet.view, sheet.spot_px->x, sheet.spot_px->y);
    const glm::dvec3 spot = stage.route.pose(moment.distance_m + stage.drive.bumper_m + 20.0).position_m - moment.ego.position_m;
    const double along = glm::dot(spot - ray.origin_m, ray.direction);
    EXPECT_GT(along, 20.0);
    EXPECT_NEAR(glm::length(ray.origin_m + along * ray.direction - spot), 0.0, 1e-9);
}

TEST(ContactSheet, TwiceTheSameBytesInTheReportAndInTheBench) {
    const TemporaryFolder folder;
    for (const std::string& out : {folder / "a", folder / "b"}) {
        printed("run " + library_file("drives/worked-example.yaml") + " --quiet --contact-sheet --out " + out);
    }
    const auto report = nlohmann::json::parse(content_of(folder / "a/report.json"));
    const auto& sheet = report.at("drives").at(0).at("contact_sheet");
    const std::string name = sheet.at("png");
    EXPECT_EQ(content_of(folder / ("a/" + name)).substr(1, 3), "PNG");
    EXPECT_TRUE(content_of(folder / ("a/" + name)) == content_of(folder / ("b/" + name)));
    const std::string page = content_of(folder / "a/report.html");
    EXPECT_THAT(page, HasSubstr("One moment in every technique"));
    EXPECT_THAT(page, HasSubstr("href=\"./" + name));
    for (const auto& more : report.at("drives").at(0).at("more_sheets")) {
        const std::string file = more.at("png");
        EXPECT_TRUE(content_of(folder / ("a/" + file)) == content_of(folder / ("b/" + file)));
        EXPECT_THAT(page, HasSubstr("One moment " + more.at("what").get<std::string>() + "</h3>"));
        EXPECT_THAT(page, HasSubstr("href=\"./" + file));
    }
    EXPECT_EQ(report.at("drives").at(0).at("more_sheets").at(0).at("what"), "by every tone mapper and eye");
    EXPECT_EQ(report.at("drives").at(0).at("more_sheets").at(1).at("what"), "in every shadow method");
}

} // namespace
} // namespace fernlicht
