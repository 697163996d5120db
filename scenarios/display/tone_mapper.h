// How the luminances of a night become shares of what a display can show.
#pragma once

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

} // namespace fernlicht
