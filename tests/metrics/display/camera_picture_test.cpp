#include "metrics/display/camera_picture.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

constexpr double camera_fov_rad = 0.7;

/// Linear, without bloom: 78 / 800 lx s by 0.65 * 0.02 / 1.8^2 lx s a cd/m2.
CameraSettings plain_camera() {
    CameraSettings camera;
    camera.tone = TransferKind::linear;
    camera.bloom = 0.0;
    camera.saturation_e = 1000.0;
    camera.read_noise_e = 5.0;
    return camera;
}

TEST(CameraPicture, SaturatesByIso12232) {
    EXPECT_NEAR(plain_camera().saturation_cdm2(), 24.3, 1.0e-9);
    CameraSettings slower = plain_camera();
    slower.iso = 100.0;
    slower.f_number = 4.0;
    slower.exposure_s = 0.01;
    EXPECT_NEAR(slower.saturation_cdm2(), 78.0 / 100.0 * 16.0 / 0.0065, 1.0e-9);
    EXPECT_NEAR(camera_code(CameraSettings{}, 0.5), 0.7353570, 1.0e-6); // sRGB
    EXPECT_NEAR(camera_code(CameraSettings{}, 7.0), 1.0, 1.0e-12);
}

struct Codes {
    double mean = 0.0, variance = 0.0;
};
Codes codes_of(const CameraSettings& camera, double cdm2, std::uint64_t seed = 1) {
    const Image<glm::u16vec3> codes =
        camera_picture(camera, Image<glm::vec3>(200, 200, glm::vec3(static_cast<float>(cdm2))), camera_fov_rad, {}, seed);
    double sum = 0.0, squares = 0.0;
    for (const glm::u16vec3& code : codes.pixels())
        for (int i = 0; i < 3; ++i)
            sum += code[i], squares += static_cast<double>(code[i]) * code[i];
    const double n = 3.0 * static_cast<double>(codes.size()), mean = sum / n;
    return {mean, squares / n - mean * mean};
}

/// Of n electrons the variance is n + read^2; rounding to codes adds 1/12. 120 000 numbers tell a variance within 0.4 %.
TEST(CameraPicture, MeanIsTheExposureAndVarianceShotAndReadNoise) {
    const CameraSettings camera = plain_camera();
    for (const double share : {0.1, 0.25, 0.5, 0.8}) {
        const Codes codes = codes_of(camera, share * camera.saturation_cdm2());
        const double variance = (1000.0 * share + 25.0) / 1.0e6 * 255.0 * 255.0 + 1.0 / 12.0;
        EXPECT_NEAR(codes.mean, 255.0 * share, 5.0 * std::sqrt(variance / 120000.0)) << share;
        EXPECT_NEAR(codes.variance / variance, 1.0, 0.02) << share;
    }
    CameraSettings silent = camera;
    silent.saturation_e = 0.0;
    EXPECT_EQ(codes_of(silent, 0.25 * camera.saturation_cdm2()).variance, 0.0);
    EXPECT_EQ(codes_of(camera, 100.0 * camera.saturation_cdm2()).mean, 255.0);
}

TEST(CameraPicture, SeedsDecideTheNoiseAndTheLensSpreadsLight) {
    CameraSettings camera = plain_camera();
    const Image<glm::vec3> even(40, 30, glm::vec3(5.0F));
    EXPECT_EQ(camera_picture(camera, even, camera_fov_rad, {}, 7), camera_picture(camera, even, camera_fov_rad, {}, 7));
    EXPECT_NE(camera_picture(camera, even, camera_fov_rad, {}, 7), camera_picture(camera, even, camera_fov_rad, {}, 8));
    camera.saturation_e = 0.0;
    Image<glm::vec3> lamp(41, 31, glm::vec3(0.0F));
    lamp.at(20, 15) = glm::vec3(1.0e5F);
    EXPECT_EQ(camera_picture(camera, lamp, camera_fov_rad, {}, 0).at(24, 15), glm::u16vec3(0));
    camera.bloom = 0.03;
    EXPECT_GT(camera_picture(camera, lamp, camera_fov_rad, {}, 0).at(24, 15).x, 0);
}

} // namespace
} // namespace fernlicht
