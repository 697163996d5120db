// `fernlicht reference` as a user runs it.
#include "runner/experiments/reference/checkpoint.h"
#include "runner/files/picture_file.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;

json json_of(const std::filesystem::path& folder) { return json::parse(content_of(folder / "reference.json")); }

std::map<std::string, Image<float>> channels_of(const std::filesystem::path& folder) {
    std::map<std::string, Image<float>> channels;
    for (PictureChannel& channel : read_exr(folder / "reference.exr"))
        channels[channel.name] = std::move(channel.values);
    return channels;
}

TEST(ReferenceCommand, WritesMeanAndVarianceAndSaysHowNearItCame) {
    const TemporaryFolder folder;
    printed("reference " + library_file("drives/worked-example.yaml") +
            " --target-error 2% --max-samples 1100 --resolution 64x48 --quiet --out " + (folder / "out"));
    const json said = json_of(folder / "out");
    EXPECT_EQ(tests::complaints(said, "reference/reference"), std::vector<std::string>());
    EXPECT_EQ(said.at("settings").at("target_error"), 0.02);
    EXPECT_EQ(said.at("settings").at("integrator"), "direct");
    EXPECT_EQ(said.at("settings").at("max_samples"), 1024); // as used
    EXPECT_TRUE(said.at("complete"));
    EXPECT_GE(said.at("context").at("inputs").size(), 3U); // drive, road, lamp
    EXPECT_GT(said.at("rays").get<double>(), 64.0 * 48.0 * 32.0);
    auto channels = channels_of(folder / "out");
    const Image<float>&mean = channels.at("illuminance.lx"), &variance = channels.at("illuminance.variance_lx2");
    ASSERT_EQ(mean.width(), 64);
    EXPECT_GT(*std::ranges::max_element(mean.pixels()), 1.0F);
    // The share that reached the target, from the picture itself.
    std::size_t reached = 0, lit = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const bool is_lit = mean.pixels()[i] > 0.0F;
        lit += is_lit ? 1U : 0U;
        reached += is_lit && std::sqrt(static_cast<double>(variance.pixels()[i])) <=
                                 0.02 * std::max(static_cast<double>(mean.pixels()[i]), said.at("settings").at("floor_lx").get<double>()) *
                                     (1 + 1e-6)
                       ? 1U
                       : 0U;
    }
    EXPECT_GT(lit, 0U);
    EXPECT_LT(lit, mean.size()); // the sky
    EXPECT_EQ(said.at("relative_standard_error").at("illuminance").at("lit_pixels").get<std::size_t>(), lit);
    EXPECT_NEAR(said.at("relative_standard_error").at("illuminance").at("share_reached").get<double>(),
                static_cast<double>(reached) / static_cast<double>(lit), 1e-3);
    EXPECT_TRUE(channels.contains("luminance.cdm2") && channels.contains("luminance.variance_cd2m4") && channels.contains("samples"));
    for (const char* picture : {"reference.png", "illuminance.png", "error.png"})
        EXPECT_GT(std::filesystem::file_size(folder / (std::string("out/") + picture)), 100U) << picture;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE"));
    EXPECT_EQ(run_program("reference " + library_file("drives/worked-example.yaml") + " --out " + (folder / "out")).exit_code, 2);
}

TEST(ReferenceCommand, GoesOnAfterAnInterruptionAndEndsInTheSameBytes) {
    const TemporaryFolder folder;
    const std::string command =
        "reference " + library_file("drives/straight.yaml") + " --integrator path --target-error 1% --resolution 96x72 --moment 1";
    ASSERT_EQ(run_program(command + " --quiet --out " + (folder / "whole")).exit_code, 0);
    const Outcome stopped = run_interrupted(command + " --log-json --out " + (folder / "parts"), " pixels");
    ASSERT_EQ(stopped.exit_code, 1) << stopped.output;
    EXPECT_TRUE(std::filesystem::exists(folder / "parts/INCOMPLETE"));
    EXPECT_FALSE(json_of(folder / "parts").at("complete"));
    const auto undrawn = channels_of(folder / "parts").at("samples");
    EXPECT_GT(std::ranges::count(undrawn.pixels(), 0.0F), 0);
    EXPECT_LT(std::ranges::count(undrawn.pixels(), 0.0F), 96 * 72);

    const std::string other = printed(command + " --seed 2 --resume --out " + (folder / "parts"), 2);
    EXPECT_NE(other.find("another picture: --seed 1, now 2, expected"), std::string::npos) << other;
    const Outcome again = run_program(command + " --out " + (folder / "parts"));
    EXPECT_EQ(again.exit_code, 2); // not empty
    EXPECT_NE(again.output.find("--resume to go on"), std::string::npos) << again.output;
    EXPECT_EQ(run_program(command + " --resume").exit_code, 2); // go on with what?

    printed(command + " --resume --quiet --out " + (folder / "parts"));
    for (const char* file : {"reference.exr", "reference.png", "illuminance.png", "error.png"})
        EXPECT_EQ(content_of(folder / (std::string("whole/") + file)), content_of(folder / (std::string("parts/") + file))) << file;
    EXPECT_EQ(json_of(folder / "whole").at("rays"), json_of(folder / "parts").at("rays"));
    EXPECT_FALSE(std::filesystem::exists(folder / "parts/checkpoint.bin"));
    const std::string finished = printed(command + " --resume --out " + (folder / "parts"), 2);
    EXPECT_NE(finished.find("finished"), std::string::npos) << finished;
}

TEST(ReferenceCommand, BadInputIsOneSentenceAndExitCodeTwo) {
    const TemporaryFolder folder;
    const std::string drive = "reference " + library_file("drives/straight.yaml");
    for (const std::string& arguments : std::vector<std::string>{
             "reference", "reference /nonexistent.yaml", drive + " --moment 1e9", drive + " --view nowhere", drive + " --lamp-set candle",
             drive + " --target-error 0", drive + " --target-error 200%", drive + " --target-error 0.5x", drive + " --lamp-radius -1",
             drive + " --resolution 0x0",
             // what would have no effect
             drive + " --reach 30", drive + " --integrator path --patch 1", drive + " --integrator whitted --no-gather",
             drive + " --integrator radiosity --photons 100", drive + " --integrator photon-map --residual 0.1",
             drive + " --smooth-depth 3", drive + " --integrator radiosity --no-gather --max-samples 64", drive + " --view ''",
             drive + " --view map --resolution 64x48"}) {
        const std::string said = printed(arguments + " --out " + (folder / "out"), 2);
        EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
        EXPECT_LT(said.size(), 800U) << said;
    }
}

/// A small picture, as a checkpoint would hold it.
ReferenceImage small_picture() {
    ReferenceImage image;
    image.illuminance_lx = {Image<float>(3, 2, 1.5F), Image<float>(3, 2, 0.25F)};
    image.ids = Image<std::uint32_t>(3, 2, 7);
    image.samples = Image<std::uint32_t>(3, 2, 16);
    image.mixed = Image<std::uint8_t>(3, 2, 1);
    image.samples.at(2, 1) = 0;
    image.rays = 12345;
    image.seconds = 0.5;
    return image;
}

TEST(ReferenceCheckpoint, ComesBackAsItWasAndIsRefusedWhenItIsNot) {
    const TemporaryFolder folder;
    View view;
    view.width_px = 3;
    view.height_px = 2;
    constexpr FrameOutputs outputs{.illuminance = true};
    const std::string inputs = "version\t1\n--seed\t1\n", other = "version\t1\n--seed\t2\n";
    const ReferenceImage image = small_picture();
    EXPECT_THROW(read_checkpoint(inputs, view, outputs, folder.path()), InputError); // none there
    write_checkpoint(image, inputs, folder.path());
    const ReferenceImage back = read_checkpoint(inputs, view, outputs, folder.path());
    EXPECT_EQ(back.illuminance_lx.mean, image.illuminance_lx.mean);
    EXPECT_EQ(back.illuminance_lx.standard_error, image.illuminance_lx.standard_error);
    EXPECT_TRUE(back.luminance_cdm2.mean.empty());
    EXPECT_EQ(back.ids, image.ids);
    EXPECT_EQ(back.samples, image.samples);
    EXPECT_EQ(back.mixed, image.mixed);
    EXPECT_EQ(back.rays, image.rays);
    EXPECT_EQ(back.seconds, image.seconds);
    EXPECT_THROW(read_checkpoint(other, view, outputs, folder.path()), InputError);
    const std::string whole = content_of(checkpoint_file(folder.path()));
    std::vector<std::string> damaged{"", "x", whole.substr(0, whole.size() - 1), whole.substr(0, 40), whole + "x"};
    for (const std::size_t at : {std::size_t{0}, std::size_t{20}, std::size_t{70}, std::size_t{105}, whole.size() - 1}) {
        damaged.push_back(whole);
        damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 1);
    }
    for (const std::string& bytes : damaged) {
        std::ofstream(checkpoint_file(folder.path()), std::ios::binary) << bytes;
        EXPECT_THROW(read_checkpoint(inputs, view, outputs, folder.path()), InputError) << bytes.size();
    }
}

TEST(ReferenceCheckpoint, NamesWhatDiffers) {
    EXPECT_EQ(differing_inputs("--seed\t1\n--view\tmap\n", "--seed\t2\n--view\tmap\n"), "--seed 1, now 2");
    EXPECT_EQ(differing_inputs("content of a.ies\tf00\nb\t1\n", "content of a.ies\tba5\nc\t2\n"),
              "other content of a.ies; c unknown, now 2; b no more");
    EXPECT_EQ(differing_inputs("", "a\t1\nb\t1\nc\t1\nd\t1\ne\t1\n"), "a unknown, now 1; b unknown, now 1; c unknown, now 1; 2 more");
    EXPECT_EQ(differing_inputs("broken", "\n"), " unknown, now ");
}

TEST(ReferenceErrorReached, IsRelativeToTheMeanOrTheFloorOverLitPixelsDrawn) {
    Estimate estimate{Image<float>(6, 1), Image<float>(6, 1)};
    estimate.mean.pixels() = {10.0F, 0.01F, 1.0F, 5.0F, 0.0F, 0.0F};
    estimate.standard_error.pixels() = {0.05F, 0.0005F, 0.02F, 99.0F, 0.0F, 0.0F};
    Image<std::uint32_t> samples(6, 1, 16);
    samples.at(3, 0) = 0; // not drawn; the last two are not lit
    const auto reached = error_reached(estimate, samples, 0.011, 0.05);
    ASSERT_TRUE(reached);
    EXPECT_NEAR(reached->median, 0.01, 1e-6); // 0.005, 0.01 of the floor, 0.02
    EXPECT_NEAR(reached->worst, 0.02, 1e-6);
    EXPECT_DOUBLE_EQ(reached->share_reached, 2.0 / 3.0);
    EXPECT_EQ(reached->lit_pixels, 3U);
    const Estimate dark{Image<float>(6, 1), Image<float>(6, 1)};
    EXPECT_FALSE(error_reached(dark, samples, 0.011, 0.05));
    EXPECT_FALSE(error_reached({}, samples, 0.01, 0.05));
    EXPECT_FALSE(error_reached(estimate, Image<std::uint32_t>(6, 1), 0.01, 0.05));
}

TEST(ReferenceCommand, SolversRefuseDrivesWithFogInASentence) {
    const TemporaryFolder folder;
    for (const std::string integrator : {"radiosity", "photon-map"}) {
        const std::string said = printed("reference " + library_file("drives/fog.yaml") + " --integrator " + integrator +
                                             " --resolution 16x12 --quiet --out " + (folder / integrator),
                                         2);
        for (const char* part : {"fog.yaml", "--integrator", "fog, rain, snow or wet roads", "direct, whitted or path"})
            EXPECT_NE(said.find(part), std::string::npos) << said;
    }
}

} // namespace
} // namespace fernlicht
