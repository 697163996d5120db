#include "runner/files/icc_profile.h"

#include <algorithm>
#include <array>
#include <lcms2.h>
#include <memory>
#include <stdexcept>
#include <vector>

namespace fernlicht {
namespace {

constexpr std::size_t curve_points = 4096, date_at = 24, date_bytes = 12;
constexpr std::array<unsigned char, date_bytes> no_date{7, 208, 0, 1, 0, 1,
                                                        0, 0,   0, 0, 0, 0}; // 2000-01-01: bytes must not depend on the clock

cmsCIExyY chromaticity(const glm::dvec3& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    return {xyz.x / sum, xyz.y / sum, 1.0};
}

cmsToneCurve* curve_of(const DisplayProfile& display) {
    constexpr double srgb[] = {2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045};
    switch (display.transfer) {
    case TransferKind::linear:
        return cmsBuildGamma(nullptr, 1.0);
    case TransferKind::gamma:
        return cmsBuildGamma(nullptr, display.gamma);
    case TransferKind::srgb:
        return cmsBuildParametricToneCurve(nullptr, 4, srgb);
    case TransferKind::pq:
        break;
    }
    std::vector<cmsUInt16Number> table(curve_points);
    for (std::size_t i = 0; i < curve_points; ++i) {
        const double share = decoded(display, static_cast<double>(i) / (curve_points - 1));
        table[i] = static_cast<cmsUInt16Number>(65535.0 * std::clamp(share, 0.0, 1.0) + 0.5);
    }
    return cmsBuildTabulatedToneCurve16(nullptr, curve_points, table.data());
}

} // namespace

std::string icc_profile(const DisplayProfile& display) {
    const cmsCIExyY white = chromaticity(display.xyz_from_rgb * glm::dvec3(1.0));
    const cmsCIExyYTRIPLE primaries{chromaticity(display.xyz_from_rgb[0]), chromaticity(display.xyz_from_rgb[1]),
                                    chromaticity(display.xyz_from_rgb[2])};
    const std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)> curve(curve_of(display), cmsFreeToneCurve);
    if (!curve)
        throw std::runtime_error("Little CMS cannot make a transfer curve");
    cmsToneCurve* const curves[3] = {curve.get(), curve.get(), curve.get()};
    const std::unique_ptr<void, int (*)(void*)> profile(cmsCreateRGBProfile(&white, &primaries, curves), cmsCloseProfile);
    if (!profile)
        throw std::runtime_error("Little CMS cannot make a profile of these primaries");
    const cmsCIEXYZ luminance{0.0, display.peak_cdm2(), 0.0};
    const std::unique_ptr<cmsMLU, void (*)(cmsMLU*)> title(cmsMLUalloc(nullptr, 1), cmsMLUfree);
    cmsMLUsetASCII(title.get(), "en", "US", display.title.c_str());
    cmsWriteTag(profile.get(), cmsSigLuminanceTag, &luminance);
    cmsWriteTag(profile.get(), cmsSigProfileDescriptionTag, title.get());
    cmsUInt32Number bytes = 0;
    std::string icc;
    if (cmsSaveProfileToMem(profile.get(), nullptr, &bytes) != 0) {
        icc.resize(bytes);
        if (cmsSaveProfileToMem(profile.get(), icc.data(), &bytes) == 0)
            bytes = 0;
    }
    if (bytes < date_at + date_bytes)
        throw std::runtime_error("Little CMS cannot write a profile");
    std::copy(no_date.begin(), no_date.end(), icc.begin() + date_at);
    return icc;
}

} // namespace fernlicht
