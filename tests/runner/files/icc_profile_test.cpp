// The profile as Little CMS reads it back: the same colours as ours.
#include "runner/files/picture_file.h"

#include "scenarios/values/files.h"

#include <gtest/gtest.h>
#include <lcms2.h>
#include <memory>
#include <random>

namespace fernlicht {
namespace {

/// XYZ against white, both as measured on the display, from codes, by Little CMS.
class ByLittleCms {
  public:
    explicit ByLittleCms(const std::string& icc)
        : whole_(cmsSetAdaptationState(0.0)), // an eye that is not adapted to the paper's D50
          profile_(cmsOpenProfileFromMem(icc.data(), static_cast<cmsUInt32Number>(icc.size()))), xyz_(cmsCreateXYZProfile()),
          transform_(cmsCreateTransform(profile_, TYPE_RGB_DBL, xyz_, TYPE_XYZ_DBL, INTENT_ABSOLUTE_COLORIMETRIC,
                                        cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE)) {}
    ~ByLittleCms() {
        cmsDeleteTransform(transform_);
        cmsCloseProfile(xyz_);
        cmsCloseProfile(profile_);
    }
    ByLittleCms(const ByLittleCms&) = delete;
    ByLittleCms& operator=(const ByLittleCms&) = delete;
    glm::dvec3 operator()(const glm::dvec3& code) const {
        const double rgb[3] = {code.x, code.y, code.z};
        cmsCIEXYZ xyz;
        cmsDoTransform(transform_, rgb, &xyz, 1);
        return {xyz.X, xyz.Y, xyz.Z};
    }

  private:
    double whole_;
    cmsHPROFILE profile_, xyz_;
    cmsHTRANSFORM transform_;
};

class IccProfiles : public testing::TestWithParam<const char*> {};

TEST_P(IccProfiles, HaveTheDisplaysColours) {
    FilesRead opened;
    const DisplayProfile display =
        read_display_profile(std::filesystem::path(FERNLICHT_SOURCE_DIR "/scenarios/library/displays") / GetParam(), opened);
    const ByLittleCms read(icc_profile(display));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0.0, 0.75); // of PQ up to the display's own peak
    for (int n = 0; n < 200; ++n) {
        const glm::dvec3 code(any(random), any(random), any(random));
        const glm::dvec3 ours = display.xyz_from_rgb *
                                glm::dvec3(decoded(display, code.x), decoded(display, code.y), decoded(display, code.z)) /
                                display.white_cdm2();
        const glm::dvec3 theirs = read(code);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(theirs[i], ours[i], 2.0e-3) << n; // 15 bits of s15Fixed16 and the adaptation to D50 and back
    }
}

TEST_P(IccProfiles, SameProfileSameBytes) {
    FilesRead opened;
    const DisplayProfile display =
        read_display_profile(std::filesystem::path(FERNLICHT_SOURCE_DIR "/scenarios/library/displays") / GetParam(), opened);
    const std::string icc = icc_profile(display);
    EXPECT_EQ(icc, icc_profile(display));
    EXPECT_EQ(icc.substr(36, 4), "acsp");
    EXPECT_NE(icc.find("lumi"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, IccProfiles, testing::Values("srgb.yaml", "projector.yaml", "hdr-monitor.yaml"),
                         [](const auto& test) { return std::string(test.param).substr(0, std::string(test.param).find_first_of(".-")); });

} // namespace
} // namespace fernlicht
