// How the pictures of a drive are seen on the display that they were made for.
#pragma once

#include "metrics/display/seen_size.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

struct SeenView {
    std::string view;
    SeenSize size;
    int pictures = 0; ///< stored and shown by the profile
    /// Mean of their pixels' light on the display, black included, over all of these pictures; nullopt without any.
    std::optional<double> mean_cdm2;

    bool finer_by_day() const { return size.display_pixel_arcmin <= resolved_by_day_arcmin; }
    /// At the mean luminance.
    std::optional<double> resolved() const { return mean_cdm2 ? std::optional(resolved_arcmin(*mean_cdm2)) : std::nullopt; }
};

/// Of a profile that says both where it is looked at from and how large its pixels are; of all perspective views.
struct SeenDisplay {
    std::string profile;
    double viewing_distance_m = 0.0, pixel_pitch_mm = 0.0;
    std::vector<SeenView> views;
};

} // namespace fernlicht
