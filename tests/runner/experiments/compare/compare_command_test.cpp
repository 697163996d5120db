#include "runner/experiments/compare/picture_comparison.h"
#include "runner/files/picture_file.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CompareCommand : public testing::Test {
  protected:
    void SetUp() override {
        Image<Rgb8> scene(64, 48, {0, 0, 0});
        for (int y = 20; y < 48; ++y)
            for (int x = 0; x < 64; ++x)
                scene.at(x, y) = {static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(4 * y), 90};
        write_png(scene, path("a.png"));
        scene.at(33, 30) = {66, 120, 100}; // blue 90 -> 100
        write_png(scene, path("b.png"));
        write_png(Image<Rgb8>(64, 47), path("small.png"));
        std::ofstream(path("text.png")) << "this is no picture";
        std::ofstream(path("half.png"), std::ios::binary) << content_of(path("a.png")).substr(0, 90);
        write_light("a.exr", "illuminance.lx", "luminance.cdm2", 1.0F);
        write_light("b.exr", "illuminance.lx", "luminance.cdm2", 1.05F);
        write_light("target.exr", "target.lx", "luminance.cdm2", 1.0F);
        write_light("nan.exr", "illuminance.lx", "luminance.cdm2", std::numeric_limits<float>::quiet_NaN());
    }
    void write_light(const std::string& name, const std::string& first, const std::string& second, float factor) {
        View view;
        view.width_px = 48;
        view.height_px = 32;
        Image<float> lux(48, 32, 0.0F), luminance(48, 32, 0.0F);
        for (int y = 12; y < 32; ++y)
            for (int x = 0; x < 48; ++x) {
                lux.at(x, y) = factor * static_cast<float>(2 * (32 - y));
                luminance.at(x, y) = 0.03F * lux.at(x, y);
            }
        write_channels({{first, lux}, {second, luminance}}, Moment{}, view, {}, path(name));
    }
    std::string path(const std::string& name) const { return folder_ / name; }
    Outcome compare(const std::string& a, const std::string& b, const std::string& more = "") const {
        return run_program("compare '" + path(a) + "' '" + path(b) + "' " + more);
    }
    static std::optional<double> value(const json& layer, const std::string& name) {
        const json& found = tests::entry(layer.at("values"), "name", name).at("value");
        return found.is_null() ? std::nullopt : std::optional<double>(found);
    }
    void write_class(const std::string& text) const { std::ofstream(path("class.yaml")) << text; }
    TemporaryFolder folder_;
};

// One pixel of 3072 differs by 10 levels of blue: rmse sqrt(100 / 9216).
TEST_F(CompareCommand, TellsOneDifferentPixel) {
    const Outcome outcome = compare("a.png", "b.png", "--json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const json layer = json::parse(outcome.output).at("layers").at(0);
    EXPECT_EQ(value(layer, "max_error"), 10.0);
    EXPECT_EQ(layer.at("values").at(0).at("x"), 33);
    EXPECT_EQ(layer.at("values").at(0).at("y"), 30);
    EXPECT_NEAR(*value(layer, "rmse"), std::sqrt(100.0 / 9216.0), 1e-12);
    EXPECT_NEAR(*value(layer, "percent_different"), 100.0 / 3072.0, 1e-12);
    EXPECT_FALSE(value(layer, "ms_ssim")); // 48 rows are too few
    EXPECT_GT(*value(layer, "flip_max"), 0.0);
    EXPECT_EQ(layer.at("histogram").at("equal"), 3071);
}

TEST_F(CompareCommand, TheSamePictureIsIdentical) {
    const Outcome outcome = compare("a.png", "a.png", "--strictness identical");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.output, AllOf(HasSubstr("strictness identical: pass"), HasSubstr("the pictures do not differ")));
}

TEST_F(CompareCommand, AClassThatIsNotKeptGivesOne) {
    const Outcome strict = compare("a.png", "b.png", "--strictness same-driver");
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_THAT(strict.output, HasSubstr("FAIL at most 0.01 % of the pixels differ by more than 1 levels"));
    EXPECT_EQ(compare("a.exr", "b.exr", "--strictness same-light").exit_code, 1); // 5 % more light
    EXPECT_EQ(compare("a.exr", "b.exr", "--strictness same-picture").exit_code, 0);
}

// 5 % more: largest difference 0.05 * 40 lx, mean by hand 0.05 * 2 * (20 + ... + 1) / 32 lx; FLIP of luminance alone.
TEST_F(CompareCommand, ComparesLinearChannels) {
    const Outcome outcome = compare("a.exr", "b.exr", "--json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const json found = json::parse(outcome.output);
    ASSERT_EQ(found.at("layers").size(), 2U);
    const json& lux = found.at("layers").at(0);
    EXPECT_EQ(lux.at("name"), "illuminance.lx");
    EXPECT_NEAR(*value(lux, "max_error"), 2.0, 1e-5); // floats of 40 and 42
    EXPECT_NEAR(*value(lux, "mean_difference"), 0.05 * 2.0 * 210.0 / 32.0, 1e-5);
    EXPECT_NEAR(*value(lux, "psnr_peak"), 40.0, 1e-12);
    EXPECT_THAT(outcome.output, HasSubstr("flip_start_exposure"));
    EXPECT_GT(*value(found.at("layers").at(1), "flip_mean"), 0.0);
}

TEST_F(CompareCommand, JsonFitsItsSchemaAndIsTheSameTwice) {
    const Outcome outcome = compare("a.exr", "b.exr", "--json --strictness same-light");
    tests::checked(outcome.output, pictures_members);
    EXPECT_EQ(compare("a.exr", "b.exr", "--json --strictness same-light").output, outcome.output);
}

TEST_F(CompareCommand, DrawsIntoANewFolderOnly) {
    ASSERT_EQ(compare("a.exr", "b.exr", "--out '" + path("out") + "'").exit_code, 0);
    const json found = json::parse(content_of(path("out/compare.json")));
    EXPECT_THAT(found.at("pictures").get<std::vector<std::string>>(),
                ElementsAre("illuminance-side-by-side.png", "illuminance-split.png", "illuminance-difference.png", "illuminance-isolux.png",
                            "illuminance-isolux.svg", "illuminance-histogram.png", "illuminance-histogram.svg",
                            "luminance-side-by-side.png", "luminance-split.png", "luminance-difference.png", "luminance-flip.png",
                            "luminance-histogram.png", "luminance-histogram.svg"));
    for (const json& name : found.at("pictures")) {
        const std::string file = path("out/" + name.get<std::string>());
        if (file.ends_with(".svg"))
            EXPECT_THAT(content_of(file), HasSubstr("</svg>"));
        else
            EXPECT_GT(read_png(file).size(), 10'000U);
    }
    EXPECT_FALSE(std::filesystem::exists(path("out/INCOMPLETE")));
    // 5 % more light is orange, the dark keeps the colour of 0: 48 x 32 pixels, shown seven times as large from 16, 54 on.
    const Image<Rgb8> picture = read_png(path("out/illuminance-difference.png"));
    const Rgb8 dark = picture.at(30, 70), lit = picture.at(100, 180);
    EXPECT_GT(dark.r, 230);
    EXPECT_GT(dark.b, 230);
    EXPECT_GT(int{lit.r}, int{lit.b} + 60);
    const Outcome again = compare("a.exr", "b.exr", "--out '" + path("out") + "'");
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_THAT(again.output, HasSubstr("is not empty"));
    ASSERT_EQ(compare("a.png", "b.png", "--strictness same-light --out '" + path("shown") + "'").exit_code, 0);
    EXPECT_THAT(
        json::parse(content_of(path("shown/compare.json"))).at("pictures").get<std::vector<std::string>>(),
        ElementsAre("side-by-side.png", "split.png", "difference.png", "flip.png", "ciede2000.png", "histogram.png", "histogram.svg"));
}

TEST_F(CompareCommand, PixelsPerDegree) {
    EXPECT_THAT(compare("a.png", "b.png").output, HasSubstr("67.0206 pixels per degree"));
    // 24 pixels are tan 10 degrees: 24 / tan(10 degrees) * pi / 180 = 2.3756.
    EXPECT_THAT(compare("a.png", "b.png", "--vertical-fov 20").output, HasSubstr("2.3756 pixels per degree"));
}

TEST_F(CompareCommand, WrongInputIsOneSentenceAndTwo) {
    const auto refused = [&](const std::string& a, const std::string& b, const std::string& more, const std::string& words) {
        const Outcome outcome = compare(a, b, more);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr(words));
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    };
    refused("a.png", "small.png", "", "64 x 47 pixels, expected 64 x 48");
    refused("a.png", "b.png", "--ppd 0", "1 to 1000");
    refused("a.png", "b.png", "--vertical-fov 180", "below 180");
}

template <class Read> std::string refusal(const Read& read) {
    try {
        read();
    } catch (const InputError& error) {
        return error.what();
    }
    return "not refused";
}

TEST_F(CompareCommand, PicturesThatDoNotFitAreRefused) {
    const auto found = [&](const std::string& a, const std::string& b) { return refusal([&] { read_picture_pair(path(a), path(b)); }); };
    EXPECT_THAT(found("a.png", "none.png"), HasSubstr("none.png: does not exist"));
    EXPECT_THAT(found("a.png", "."), HasSubstr("is no file that can be read"));
    EXPECT_THAT(found("a.png", "text.png"), HasSubstr("neither a PNG nor an EXR"));
    EXPECT_THAT(found("half.png", "a.png"), AllOf(HasSubstr("half.png"), HasSubstr("cannot be read")));
    EXPECT_THAT(found("a.png", "a.exr"), HasSubstr("is an EXR picture or another one of numbers, expected a PNG"));
    EXPECT_THAT(found("a.exr", "target.exr"), HasSubstr("expected illuminance.lx, luminance.cdm2"));
    EXPECT_THAT(found("a.exr", "nan.exr"), HasSubstr("is nan"));
}

TEST_F(CompareCommand, ClassesFromAFile) {
    write_class("name: mine\n"
                "display:\n"
                "  all:\n"
                "    - hard_limit: {absolute: 12}\n"
                "    - any:\n"
                "        - every: {absolute: 1}\n"
                "        - percentage: {percent: 0.1, absolute: 1, one_pixel_shift: true}\n");
    const Outcome kept = compare("a.png", "b.png", "--strictness '" + path("class.yaml") + "'");
    EXPECT_EQ(kept.exit_code, 0) << kept.output;
    EXPECT_THAT(kept.output,
                AllOf(HasSubstr("strictness mine: pass"), HasSubstr("10 of 12 levels, 16.7 % to spare"), HasSubstr("FAIL no pixel")));
    EXPECT_EQ(compare("a.exr", "b.exr", "--strictness '" + path("class.yaml") + "'").exit_code,
              1); // what it says nothing of must be the same
}

// The leaves say what the figures say: just kept at the figure itself, not at a thousandth less.
TEST_F(CompareCommand, FlipAndSsimAsLeavesOfAClass) {
    const json found = json::parse(compare("a.exr", "b.exr", "--json").output);
    const json &lux = found.at("layers").at(0), &luminance = found.at("layers").at(1);
    const double flip = *value(luminance, "flip_mean"), ssim = std::min(*value(lux, "ssim"), *value(luminance, "ssim"));
    const auto judged = [&](double max_flip, double min_ssim) {
        write_class(fmt::format("name: seen\nlinear:\n  all:\n    - mean_flip: {{at_most: {}}}\n    - ssim: {{at_least: {}}}\n", max_flip,
                                min_ssim));
        return compare("a.exr", "b.exr", "--strictness '" + path("class.yaml") + "'");
    };
    ASSERT_GT(flip, 0.002);
    ASSERT_LT(ssim, 1.0);
    EXPECT_EQ(judged(flip * 1.001, ssim - 1e-6).exit_code, 0);
    const Outcome seen = judged(flip * 0.999, ssim - 1e-6);
    EXPECT_EQ(seen.exit_code, 1);
    EXPECT_THAT(seen.output, AllOf(HasSubstr("FAIL mean FLIP at most"), HasSubstr("pass mean FLIP"), HasSubstr("pass SSIM at least")))
        << "lux has no FLIP, luminance has";
    EXPECT_THAT(judged(1.0, ssim + 1e-6).output, HasSubstr("FAIL SSIM at least"));
    write_class("name: seen\ndisplay:\n  mean_flip: {at_most: 0.5}\n");
    EXPECT_EQ(compare("a.png", "b.png", "--strictness '" + path("class.yaml") + "'").exit_code, 0);
    write_class("name: seen\ndisplay:\n  mean_flip: {at_least: 0.5}\n");
    EXPECT_EQ(compare("a.png", "b.png", "--strictness '" + path("class.yaml") + "'").exit_code, 2);
}

TEST_F(CompareCommand, MasksOfAFile) {
    Image<Rgb8> mask(64, 48, {255, 255, 255});
    mask.at(33, 30) = {0, 0, 0};
    write_png(mask, path("mask.png"));
    write_class("name: masked\ndisplay:\n  every: {absolute: 0, mask: mask.png}\n");
    EXPECT_EQ(compare("a.png", "b.png", "--strictness '" + path("class.yaml") + "'").exit_code, 0);
    write_png(Image<Rgb8>(4, 4, {255, 255, 255}), path("mask.png"));
    const Outcome other = compare("a.png", "b.png", "--strictness '" + path("class.yaml") + "'");
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.output, HasSubstr("mask.png of 4x4 does not fit"));
}

TEST_F(CompareCommand, WrongClassesNameFileAndLine) {
    const auto refused = [&](const std::string& text, const std::string& words) {
        write_class(text);
        EXPECT_THAT(refusal([&] { read_strictness(path("class.yaml")); }), AllOf(HasSubstr("class.yaml:"), HasSubstr(words)));
    };
    refused("name: x\ndisplay:\n  evry: {absolute: 1}\n", "class.yaml:3");
    refused("name: x\ndisplay:\n  every: {absolute: -1}\n", "'-1'");
    refused("name: x\ndisplay:\n  every: {}\n", "absolute");
    refused("name: x\ndisplay:\n  percentage: {absolute: 1}\n", "percent");
    refused("name: x\ndisplay:\n  percentage: {absolute: 1, percent: 101}\n", "'101'");
    refused("name: x\ndisplay:\n  all: []\n", "all");
    refused("name: x\ndisplay:\n  hard_limit: {absolute: 1, mask: m.png}\n", "mask");
    refused("name: x\n", "display");
    refused("display:\n  every: {absolute: 1}\n", "name");
    EXPECT_THAT(refusal([] { read_strictness("same-lihgt"); }), HasSubstr("same-light"));
    EXPECT_THAT(refusal([] { read_strictness("nonsense"); }), HasSubstr("one of identical, same-driver"));
}

} // namespace
} // namespace fernlicht
