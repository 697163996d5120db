#include "scenarios/lamps/spectrum.h"

#include "scenarios/lamps/spectral_tables.h"
#include "scenarios/values/errors.h"
#include "tests/trial.h"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <tuple>

namespace fernlicht {
namespace {

double luminance_of(const glm::dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

/// Chromaticity from the integrals.
std::pair<double, double> xy(const VisualIntegrals& i) { return {i.x / (i.x + i.y + i.z), i.y / (i.x + i.y + i.z)}; }

TEST(SpectralTables, SumsAreThePublishedOnes) {
    double x = 0.0, y = 0.0, z = 0.0, scotopic = 0.0;
    for (const SpectralWeights& w : spectral_table) {
        x += w.x;
        y += w.y;
        z += w.z;
        scotopic += w.scotopic;
    }
    EXPECT_NEAR(x, 21.371524, 1e-9); // CIE 15:2004, foot of table T.4
    EXPECT_NEAR(y, 21.371327, 1e-9);
    EXPECT_NEAR(z, 21.371540, 1e-9);
    EXPECT_NEAR(scotopic * 5.0, 97.07, 0.01);
    EXPECT_EQ(spectral_table.size(), 81u);
}

TEST(Spectrum, IlluminantAHasItsPublishedChromaticityAndScotopicRatio) {
    const Spectrum a = planck_spectrum(2855.542); // 2848 K with c2 = 1.435e-2 m K, today 1.438776877e-2
    const auto [x, y] = xy(visual_integrals(a));
    EXPECT_NEAR(x, 0.44757, 2e-4); // the tables are taken linearly between 5 nm here
    EXPECT_NEAR(y, 0.40745, 2e-4);
    const LampColour colour = colour_of_spectrum(a);
    EXPECT_NEAR(colour.sp_ratio, 1.41, 0.005);
    EXPECT_NEAR(colour.cct_k, 2855.5, 0.5);
}

TEST(Spectrum, EqualEnergyHasItsPublishedScotopicRatioAndIsWhite) {
    const Spectrum e{{380.0, 780.0}, {1.0, 1.0}};
    const auto [x, y] = xy(visual_integrals(e));
    EXPECT_NEAR(x, 1.0 / 3.0, 1e-4);
    EXPECT_NEAR(y, 1.0 / 3.0, 1e-4);
    EXPECT_NEAR(colour_of_spectrum(e).sp_ratio, 2.26, 0.01);
    EXPECT_NEAR(colour_of_spectrum(e).cct_k, 5455.0, 15.0);
}

TEST(Spectrum, PlanckLocusPointsAsPublished) {
    // CIE 1931 x, y of the black body (Wyszecki and Stiles, Color Science, table 1(3.11)).
    for (const auto& [kelvin, x, y] :
         {std::tuple{2000.0, 0.5267, 0.4133}, {4000.0, 0.3805, 0.3768}, {6500.0, 0.3135, 0.3237}, {10000.0, 0.2807, 0.2884}}) {
        const auto [found_x, found_y] = xy(visual_integrals(planck_spectrum(kelvin)));
        EXPECT_NEAR(found_x, x, 4e-4) << kelvin;
        EXPECT_NEAR(found_y, y, 4e-4) << kelvin;
    }
}

TEST(LampColour, HalogenAndXenonAreApart) {
    const LampColour halogen = colour_of_temperature(3200.0), xenon = colour_of_temperature(4300.0);
    EXPECT_NEAR(halogen.sp_ratio, 1.5672, 1e-3); // summed in steps of 5 nm
    EXPECT_NEAR(xenon.sp_ratio, 1.9602, 1e-3);
    EXPECT_GT(xenon.sp_ratio, halogen.sp_ratio);
    EXPECT_EQ(halogen.cct_k, 3200.0);
    EXPECT_GT(halogen.linear_srgb.x, halogen.linear_srgb.z); // redder
    EXPECT_LT(halogen.linear_srgb.z, xenon.linear_srgb.z);
}

TEST(LampColour, LuminanceIsOneAndOtherTemperaturesAreRefused) {
    for (const double kelvin : {1000.0, 1500.0, 1900.0, 3200.0, 4300.0, 6504.0, 25000.0}) {
        const glm::dvec3 rgb = colour_of_temperature(kelvin).linear_srgb;
        EXPECT_NEAR(luminance_of(rgb), 1.0, 1e-12) << kelvin;
        EXPECT_GE(std::min({rgb.x, rgb.y, rgb.z}), 0.0) << kelvin;
    }
    const glm::dvec3 white = colour_of_temperature(6504.0).linear_srgb; // beside D65, on Planck's locus a little more magenta
    EXPECT_NEAR(white.x, 1.0, 0.06);
    EXPECT_NEAR(white.z, 1.0, 0.06);
    for (const double kelvin : {0.0, 999.0, 25001.0, std::nan("")})
        EXPECT_THROW(colour_of_temperature(kelvin), std::invalid_argument) << kelvin;
    const Spectrum green{{500.0, 520.0, 530.0, 550.0}, {0.0, 1.0, 1.0, 0.0}};
    EXPECT_EQ(colour_of_spectrum(green).cct_k, 0.0);
    EXPECT_THROW(colour_of_spectrum({{900.0, 1000.0}, {1.0, 1.0}}), std::invalid_argument);
}

class SpectrumFile : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& content) { return tests::written("s.csv", content, folder_); }
    std::string refusal(const std::string& content) {
        FilesRead opened;
        return tests::refusal_of([&] { read_spectrum(file(content), opened); });
    }
    const std::filesystem::path folder_ = tests::new_folder();
};

std::string flat(const std::string& separator, const std::string& line_end = "\n") {
    std::string text;
    for (int nm = 380; nm <= 780; nm += 10)
        text += std::to_string(nm) + separator + "2.5" + line_end;
    return text;
}

TEST_F(SpectrumFile, EverySeparatorGivesTheSameSpectrum) {
    const double expected = colour_of_spectrum({{380.0, 780.0}, {1.0, 1.0}}).sp_ratio;
    for (const std::string separator : {",", ";", "\t", " ", " , "}) {
        FilesRead opened;
        EXPECT_NEAR(read_spectrum(file("# measured\nwavelength nm" + separator + "power\n" + flat(separator)), opened).sp_ratio, expected,
                    1e-12);
        ASSERT_EQ(opened.size(), 1u);
        EXPECT_EQ(opened[0].xxh128.size(), 32u);
    }
    FilesRead opened;
    EXPECT_NEAR(read_spectrum(file("\xef\xbb\xbf" + flat(",", "\r\n")), opened).sp_ratio, expected, 1e-12);
}

TEST_F(SpectrumFile, PlanckThroughAFileIsPlanck) {
    std::string text;
    const Spectrum s = planck_spectrum(3200.0);
    for (std::size_t i = 0; i < s.power.size(); i += 5)
        text += std::to_string(s.wavelength_nm[i]) + "," + std::to_string(s.power[i]) + "\n";
    FilesRead opened;
    const LampColour colour = read_spectrum(file(text), opened);
    EXPECT_NEAR(colour.cct_k, 3200.0, 1.0);
    EXPECT_NEAR(colour.sp_ratio, colour_of_temperature(3200.0).sp_ratio, 1e-3);
}

TEST_F(SpectrumFile, BadFilesAreRefusedWithTheirLine) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal(""), HasSubstr("empty"));
    EXPECT_THAT(refusal("a,b\nc,d\n"), HasSubstr("s.csv:2"));
    EXPECT_THAT(refusal("380,1\n390,nan\n"), HasSubstr("s.csv:2"));
    EXPECT_THAT(refusal("380,1\n390,-1\n"), HasSubstr("power -1"));
    EXPECT_THAT(refusal("380,1\n380,1\n"), HasSubstr("ascend"));
    EXPECT_THAT(refusal("380,1,7\n"), HasSubstr("s.csv:1"));
    EXPECT_THAT(refusal("nm;power\n380,0;0,5\n"), HasSubstr("s.csv:2:1: has decimal commas, expected points: write 380.0 for 380,0"));
    EXPECT_THAT(refusal("\xff\xfe" + std::string("3\0008\0", 4)), HasSubstr("is encoded in UTF-16"));
    EXPECT_THAT(refusal("500,1\n600,1\n"), HasSubstr("400 to 700 nm"));
    EXPECT_THAT(refusal("380,1\n500,1\n780,1\n"), HasSubstr("20 nm"));
    EXPECT_THAT(refusal(std::string("\177ELF\0\1\2", 7)), HasSubstr("s.csv"));
    std::string dark = flat(",");
    for (std::size_t at = 0; (at = dark.find("2.5", at)) != std::string::npos;)
        dark.replace(at, 3, "0.0");
    EXPECT_THAT(refusal(dark), HasSubstr("power of 0"));
    FilesRead opened;
    EXPECT_THROW(read_spectrum(folder_ / "missing.csv", opened), InputError);
}

TEST(MountedLamp, VoltageScalesFilamentsOnly) {
    MountedLamp lamp;
    EXPECT_EQ(lamp.intensity_factor(), 1.0);
    lamp.voltage_v = 12.0;
    EXPECT_NEAR(lamp.intensity_factor(), 0.72321, 5e-6); // (12 / 13.2)^3.4
    lamp.voltage_v = 13.8;
    EXPECT_NEAR(lamp.intensity_factor(), 1.1632, 5e-5);
    lamp.level = 0.5;
    EXPECT_NEAR(lamp.intensity_factor(), 0.5816, 5e-5);
    lamp.source = SourceKind::arc;
    EXPECT_EQ(lamp.intensity_factor(), 0.5);
    lamp.source = SourceKind::led;
    EXPECT_EQ(lamp.intensity_factor(), 0.5);
    lamp.flux_factor = 1.2; // a bright one of its kind, dimmed
    EXPECT_DOUBLE_EQ(lamp.intensity_factor(), 0.6);
    lamp.source = SourceKind::filament;
    EXPECT_NEAR(lamp.intensity_factor(), 1.2 * 0.5816, 6e-5);
    lamp.level = 0.0;
    EXPECT_EQ(lamp.intensity_factor(), 0.0);
}

} // namespace
} // namespace fernlicht
