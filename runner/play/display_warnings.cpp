#include "runner/play/display_warnings.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double least_display_contrast = 3.0;

/// By how much luminance rises from the code that shows it to the next.
double code_step(const DisplayProfile& profile, double luminance_cdm2) {
    const double codes = profile.bits == 16 ? 65535.0 : 255.0, share = luminance_cdm2 / profile.white_cdm2();
    return decoded(profile, encoded(profile, share) + 1.0 / codes) / share - 1.0;
}

} // namespace

std::vector<std::string> display_warnings(const DisplayProfile& profile) {
    std::vector<std::string> warnings;
    if (const double contrast = profile.peak_cdm2() / profile.black_cdm2; contrast < least_display_contrast)
        warnings.push_back(fmt::format("display '{}' has a contrast of {:.4g} : 1 (peak {:.4g} cd/m2, black {:.4g} cd/m2), less than the "
                                       "{:g} : 1 that ISO 9241-3 recommends for text: its pictures hide what was drawn",
                                       profile.name, contrast, profile.peak_cdm2(), profile.black_cdm2, least_display_contrast));
    if (profile.transfer == TransferKind::pq && profile.bits == 8)
        warnings.push_back(
            fmt::format("display '{}' has transfer: pq in 8 bits, where ITU-R BT.2100 has 10 or 12: its codes are {:.1f} % of "
                        "luminance apart at 1 cd/m2, and dark pictures show bands; bits: 16 has none",
                        profile.name, 100.0 * code_step(profile, 1.0)));
    return warnings;
}

} // namespace fernlicht
