#include "scenarios/display/display_profile.h"
#include "scenarios/values/errors.h"
#include "tests/trial.h"

#include <gmock/gmock.h>
#include <stdexcept>

namespace fernlicht {
namespace {

DisplayProfile profile_of(const std::string& text) {
    FilesRead opened;
    return read_display_profile(tests::written("profile.yaml", text), opened);
}

// A device whose row Y is (0.09, 0.18, 0.033) in W/(sr m2): L = 683 (0.09 r + 0.18 g + 0.033 b), so white is 683 * 0.303 = 206.9 cd/m2 and
// grey for 50 cd/m2 has c = 50 / 206.9 = 0.2416.
constexpr const char* example = "fernlicht_display: 1\n"
                                "rgb_to_xyz:\n"
                                "  - [0.170, 0.090, 0.043]\n"
                                "  - [0.090, 0.180, 0.033]\n"
                                "  - [0.008, 0.030, 0.240]\n"
                                "unit: W/(sr m2)\n"
                                "transfer: linear\n";

TEST(DisplayProfile, ExampleOfADeviceInWatts) {
    const DisplayProfile profile = profile_of(example);
    EXPECT_NEAR(profile.white_cdm2(), 207.0, 0.1);
    EXPECT_NEAR(50.0 / profile.white_cdm2(), 0.242, 5.0e-4);
    EXPECT_EQ(profile.peak_cdm2(), profile.white_cdm2());
    EXPECT_EQ(profile.title, "profile"); // the file's name
}

TEST(DisplayProfile, ShippedOnesReadAndComeBack) {
    for (const auto& entry : std::filesystem::directory_iterator(FERNLICHT_SOURCE_DIR "/scenarios/library/displays")) {
        FilesRead opened;
        DisplayProfile profile = read_display_profile(entry.path(), opened);
        ASSERT_EQ(opened.size(), 1U);
        DisplayProfile again = profile_of(write_display_profile(profile));
        again.name = profile.name;
        EXPECT_EQ(again, profile) << entry.path();
    }
}

TEST(DisplayProfile, ShippedFiguresAreTheirs) {
    FilesRead opened;
    const std::filesystem::path folder = FERNLICHT_SOURCE_DIR "/scenarios/library/displays";
    const DisplayProfile srgb = read_display_profile(folder / "srgb.yaml", opened);
    DisplayProfile built_in = srgb_display();
    built_in.title = srgb.title;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(srgb.xyz_from_rgb[i][k], built_in.xyz_from_rgb[i][k], 1.0e-12);
    EXPECT_NEAR(srgb.pixel_deg().value(), 0.0258, 1.0e-4); // 0.27 mm from 0.6 m: atan(0.00045) = 1.55'
    const DisplayProfile projector = read_display_profile(folder / "projector.yaml", opened);
    EXPECT_NEAR(projector.peak_cdm2(), 120.0, 1.0e-9);
    EXPECT_NEAR(projector.white_cdm2(), 119.88, 1.0e-9);
    // BT.709's luminances are 0.2126, 0.7152, 0.0722 to four digits.
    EXPECT_NEAR(projector.xyz_from_rgb[1].y / projector.white_cdm2(), 0.7152, 5.0e-5);
    const DisplayProfile hdr = read_display_profile(folder / "hdr-monitor.yaml", opened);
    EXPECT_EQ(hdr.bits, 16);
    // BT.2020: 0.2627, 0.6780, 0.0593.
    EXPECT_NEAR(hdr.xyz_from_rgb[0].y / hdr.white_cdm2(), 0.2627, 5.0e-5);
    EXPECT_NEAR(hdr.xyz_from_rgb[2].y / hdr.white_cdm2(), 0.0593, 5.0e-5);
}

TEST(DisplayProfile, TransferCurvesAreThePublishedOnes) {
    DisplayProfile profile = srgb_display();
    EXPECT_NEAR(decoded(profile, 0.5), 0.214041, 1.0e-6); // IEC 61966-2-1: ((0.5 + 0.055) / 1.055)^2.4
    EXPECT_NEAR(encoded(profile, 0.0031308), 0.0404499, 1.0e-7);
    profile.transfer = TransferKind::gamma;
    profile.gamma = 2.0;
    EXPECT_DOUBLE_EQ(decoded(profile, 0.5), 0.25);
    // ST 2084: 100 cd/m2 has code 0.508078, 1000 cd/m2 0.751827, 10 000 cd/m2 1.
    profile.transfer = TransferKind::pq;
    profile.xyz_from_rgb = 1000.0 / 80.0 * profile.xyz_from_rgb;
    EXPECT_NEAR(encoded(profile, 0.1), 0.508078, 1.0e-6);
    EXPECT_NEAR(encoded(profile, 1.0), 0.751827, 1.0e-6);
    EXPECT_NEAR(decoded(profile, 1.0), 10.0, 1.0e-9);
}

TEST(DisplayProfile, TransferCurvesRiseAndComeBack) {
    for (const TransferKind kind : {TransferKind::linear, TransferKind::gamma, TransferKind::srgb, TransferKind::pq}) {
        DisplayProfile profile = srgb_display();
        profile.transfer = kind;
        double last = -1.0;
        for (int i = 0; i <= 1000; ++i) {
            const double share = i / 1000.0, code = encoded(profile, share);
            EXPECT_GT(code, last);
            EXPECT_NEAR(decoded(profile, code), share, 1.0e-12);
            last = code;
        }
    }
}

TEST(DisplayProfile, PrimariesOfSrgbGiveItsMatrixAndPqEndsWhereItsStandardDoes) {
    const glm::dmat3 matrix = xyz_from_primaries({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}, 1.0),
                     rounded = xyz_from_light();
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            EXPECT_NEAR(matrix[column][row], rounded[column][row], 1.0e-4);
    EXPECT_THROW(xyz_from_primaries({0.64, 0.33}, {0.30, 0.60}, {0.47, 0.465}, {0.31, 0.33}, 1.0), std::invalid_argument);
    EXPECT_THROW(xyz_from_primaries({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.7, 0.2}, 1.0), std::invalid_argument);
    EXPECT_THROW(xyz_from_primaries({0.64, 0.0}, {0.30, 0.60}, {0.15, 0.06}, {0.31, 0.33}, 1.0), std::invalid_argument);
    const std::string lines = "fernlicht_display: 1\nprimaries: {red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, "
                              "0.329]}\nblack_cdm2: 0.7\ntransfer: pq\npeak_cdm2: ";
    EXPECT_NEAR(profile_of(lines + "10000\n").peak_cdm2(), 10000.0, 1.0e-8);
    EXPECT_THROW(profile_of(lines + "10000.1\n"), InputError);
}

TEST(DisplayProfile, WhereItIsSeenFromMayBeUnknown) {
    const std::string lines = "fernlicht_display: 1\nrgb_to_xyz: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\ntransfer: srgb\n";
    const DisplayProfile unknown = profile_of(lines), half = profile_of(lines + "pixel_pitch_mm: 0.3\n");
    EXPECT_FALSE(unknown.pixel_deg());
    EXPECT_FALSE(half.pixel_deg());
    EXPECT_EQ(profile_of(write_display_profile(half)), half);
    EXPECT_NEAR(profile_of(lines + "pixel_pitch_mm: 0.3\nviewing_distance_m: 1\n").pixel_deg().value(), 0.0171887, 1.0e-6);
}

TEST(DisplayProfile, RefusalsNameTheirPlace) {
    const auto primaries = [](const std::string& red, const std::string& blue, const std::string& white, const std::string& rest = {}) {
        return "fernlicht_display: 1\nprimaries: {red: " + red + ", green: [0.3, 0.6], blue: " + blue + ", white: " + white + "}\n" +
               (rest.empty() ? "transfer: srgb\npeak_cdm2: 80\n" : rest);
    };
    const auto srgb = [&](const std::string& rest) { return primaries("[0.64, 0.33]", "[0.15, 0.06]", "[0.3127, 0.329]", rest); };
    const auto matrix = [](const std::string& rows, const std::string& transfer = "srgb") {
        return "fernlicht_display: 1\nrgb_to_xyz: " + rows + "\ntransfer: " + transfer + "\n";
    };
    const std::string one = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
    const std::pair<std::string, const char*> cases[]{
        {"fernlicht_display: 2\n", "fernlicht_display"},
        {"fernlicht_display: 1\ntransfer: srgb\n", "rgb_to_xyz"},
        {srgb("transfer: srgb\n"), "peak_cdm2"},
        {srgb("transfer: srgb\npeak_cdm2: 80\nbits: 10\n"), "8 or 16"},
        {srgb("transfer: srgb\npeak_cdm2: 1\nblack_cdm2: 2\n"), "peak_cdm2"},
        {srgb("transfer: srgb\npeak_cdm2: 80\nblak_cdm2: 2\n"), "black_cdm2"},
        {srgb("transfer: srgb\npeak_cdm2: 80\nunit: W/(sr m2)\n"), "profile.yaml:5:7: unit: a unit beside primaries"},
        {srgb("peak_cdm2: 20000\ntransfer: pq\n"), "profile.yaml:3:12: peak_cdm2: a peak of 20000 cd/m2 with transfer: pq"},
        {"fernlicht_display: 1\ntransfer: pq\nrgb_to_xyz: [[1, 0, 0], [0, 10001, 0], [0, 0, 1]]\n",
         "profile.yaml:3:13: rgb_to_xyz: a peak of 10001 cd/m2"},
        {primaries("[0.8, 0.8]", "[0.15, 0.06]", "[0.3127, 0.329]"),
         "profile.yaml:2:18: primaries.red: found [0.8, 0.8], a chromaticity that no light has, expected x, y with x at least 0, y above 0 "
         "and x + y at most 1"},
        {primaries("[0.64, 0.33]", "[-0.1, 0.06]", "[0.3127, 0.329]"),
         "primaries.blue: found [-0.1, 0.06], a chromaticity that no light has"},
        {primaries("[0.64, 0.33]", "[0.15, 0.06]", "[0.3127, 0]"), "primaries.white: found [0.3127, 0], a chromaticity that no light has"},
        {matrix("[[1, 2, 3], [2, 4, 6], [1, 1, 1]]"), "inverse"},
        {matrix("[[0.4, 0.36, 0.18], [0.21, 0.72, 0.07], [0.02, -0.2, 0.95]]"),
         "profile.yaml:2:13: rgb_to_xyz: found a green channel with Z = -0.2, which no light has"},
        {matrix("[[1, 2, 3], [2, 4, 6]]"), "rgb_to_xyz"},
        {matrix(one, "{gamma: 0}"), "gamma"},
        {matrix(one, "rec709"), "linear"}};
    for (const auto& [text, says] : cases)
        EXPECT_THAT(tests::refusal_of([&profile = text] { profile_of(profile); }),
                    testing::AllOf(testing::HasSubstr(says), testing::HasSubstr("profile.yaml:")));
}

} // namespace
} // namespace fernlicht
