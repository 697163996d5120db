// How the luminances of a night become shares of what a display can show.
// Tone mappers as functions of one luminance, their inverses and the contrast they keep. Equations of the pointwise ones:
// scenarios/photometry.glsl.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace fernlicht {

enum class ToneMapperKind {
    linear,
    rational,
    logarithmic,
    histogram ///< after the luminances of the whole drive (Larson, Rushmeier, Piatko 1997)
};

/// What becomes white.
enum class WhitePoint {
    given,   ///< l_max_cdm2 as it stands
    all,     ///< the brightest luminance of the drive, light sources included
    surfaces ///< the brightest of what does not shine itself: light sources are clipped
};

/// A point of a tone curve: natural logarithms of the luminance in cd/m2 and of the share shown.
struct ToneKnot {
    double ln_luminance = 0.0, ln_share = 0.0;
    bool operator==(const ToneKnot&) const = default;
};

struct ToneMapper {
    ToneMapperKind kind = ToneMapperKind::rational;
    double s = 20.0;                      ///< rational (>= 1, 1 is linear) and logarithmic (> 0)
    double l_max_cdm2 = 100.0;            ///< luminance that becomes white
    WhitePoint white = WhitePoint::given; ///< else l_max_cdm2 is found from the drive's own pictures before the first is shown,
    bool fitted_s = false;                ///< and so is s, rational only, such that the log-mean luminance is shown in middle grey
    /// histogram only: both rise, the last is (ln l_max, 0). Empty until it is found from the drive's pictures.
    std::vector<ToneKnot> curve = {};

    bool is_open() const { return white != WhitePoint::given || fitted_s || (kind == ToneMapperKind::histogram && curve.empty()); }

    bool operator==(const ToneMapper&) const = default;
};

/// "rational", as drives name it.
std::string_view name(ToneMapperKind kind);

/// Share of what the display can show, 0..1: 0 for 0 and below, 1 from l_max on; rises with the luminance. A luminance that is not a number
/// is shown as 0.
///
/// A histogram curve that is not found yet (ToneMapper::is_open) is linear.
/// Below a histogram curve's first knot the share falls in proportion to the luminance, so that 0 stays 0.
double toned(const ToneMapper& mapper, double luminance_cdm2);

/// The luminance that is shown with this share: toned(untoned(d)) = d. nullopt outside 0..1. 1 gives l_max, the least that is shown so.
std::optional<double> untoned(const ToneMapper& mapper, double share);

/// d ln(share) / d ln(luminance): 1 keeps a small contrast as it was, 0 loses it; above 1 raises it. From l_max on 0. luminance > 0.
double contrast_kept(const ToneMapper& mapper, double luminance_cdm2);

/// The same on a display whose black is not dark: what of the contrast is left when `black_share` = black / white is added to all.
double contrast_kept(const ToneMapper& mapper, double luminance_cdm2, double black_share);

} // namespace fernlicht
