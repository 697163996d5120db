// The file of a pixel lamp, and its keys.
#pragma once

#include "scenarios/lamps/lamp_file.h"

namespace fernlicht {

struct LitBoxKeys {
    std::vector<double> h_deg, v_deg; ///< lower and upper edge
};
struct PixelSegmentKeys {
    std::filesystem::path file;
    std::optional<LitBoxKeys> lights;
    bool dead = false;
};
struct PixelRasterKeys {
    std::vector<double> pixels, h_deg, v_deg, spread_deg; ///< two each
    std::optional<double> cd;
    std::filesystem::path profile;
    double crosstalk = 0.0;
    std::vector<std::pair<int, int>> dead; ///< column, row
};
struct PixelLampKeys {
    int version = 1;
    std::string name;
    std::filesystem::path base;
    std::optional<PixelRasterKeys> raster;
    std::vector<PixelSegmentKeys> segments;
    int steps = 0;
    double exponent = 1.0, latency_s = 0.0;
    std::optional<double> slew_per_s;
};

template <class Struct> struct Fields;
const Fields<PixelLampKeys>& pixel_lamp_fields();

/// YAML whose first key is fernlicht_pixel_lamp.
bool looks_like_pixel_lamp(std::string_view text);
/// Version 1 (scenarios/pixel-lamp.example.yaml explains every key). The table is that of all pixels at full level. Throws InputError with
/// file, line, column, key.
LampFile read_pixel_lamp(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened);

} // namespace fernlicht
