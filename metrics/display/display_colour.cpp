#include "metrics/display/display_colour.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>
#include <vector>

namespace fernlicht {
namespace {

/// What depends on the profile alone.
struct DisplayMatrices {
    explicit DisplayMatrices(const DisplayProfile& p)
        : white_xyz(p.xyz_from_rgb * glm::dvec3(1.0)), rgb_from_xyz(glm::inverse(p.xyz_from_rgb)),
          black_xyz(white_xyz * (p.black_cdm2 / white_xyz.y)), rgb_from_light(rgb_from_xyz * xyz_from_light()) {}
    glm::dvec3 white_xyz;
    glm::dmat3 rgb_from_xyz;
    glm::dvec3 black_xyz;
    glm::dmat3 rgb_from_light;
};

/// The share `grey` of white has the colour's luminance. The colour moves towards it as far as it must.
glm::dvec3 into_gamut(GamutRule rule, const glm::dvec3& rgb, double grey) {
    if (rule == GamutRule::clip)
        return glm::clamp(rgb, 0.0, 1.0);
    double keep = 1.0;
    for (int i = 0; i < 3; ++i) {
        if (rgb[i] > 1.0)
            keep = std::min(keep, (1.0 - grey) / (rgb[i] - grey));
        if (rgb[i] < 0.0)
            keep = std::min(keep, grey / (grey - rgb[i]));
    }
    return glm::clamp(glm::dvec3(grey) + keep * (rgb - grey), 0.0, 1.0);
}

glm::dvec3 shares_of_light(const DisplayProfile& profile, const DisplayMatrices& m, const ToneMapper& mapper, const glm::dvec3& light) {
    static const glm::dmat3 light_xyz = xyz_from_light();
    const double luminance = light_xyz[0].y * light.x + light_xyz[1].y * light.y + light_xyz[2].y * light.z;
    const double share = toned(mapper, luminance);
    if (share == 0.0)
        return glm::dvec3(0.0);
    return into_gamut(profile.gamut, m.rgb_from_light * (light * (share * m.white_xyz.y / luminance)), share);
}

} // namespace

glm::dvec3 shares_for(const DisplayProfile& profile, const glm::dvec3& xyz) {
    const DisplayMatrices m(profile);
    const glm::dvec3 light = xyz - m.black_xyz;
    if (!(light.y > 0.0))
        return glm::dvec3(0.0);
    const double grey = std::min(light.y / m.white_xyz.y, 1.0);
    return into_gamut(profile.gamut, m.rgb_from_xyz * (light * (grey * m.white_xyz.y / light.y)), grey);
}

glm::dvec3 shown_xyz(const DisplayProfile& profile, const glm::dvec3& code) {
    const DisplayMatrices m(profile);
    glm::dvec3 shares;
    for (int i = 0; i < 3; ++i)
        shares[i] = std::min(decoded(profile, std::clamp(code[i], 0.0, 1.0)), 1.0);
    return m.black_xyz + profile.xyz_from_rgb * shares;
}

glm::dvec3 display_code(const DisplayProfile& profile, const ToneMapper& mapper, const glm::dvec3& light) {
    const glm::dvec3 shares = shares_of_light(profile, DisplayMatrices(profile), mapper, light);
    return {encoded(profile, shares.x), encoded(profile, shares.y), encoded(profile, shares.z)};
}

Image<glm::u16vec3> display_picture(const DisplayProfile& profile, const ToneMapper& mapper, const Image<glm::vec3>& light) {
    const DisplayMatrices m(profile);
    const double most = profile.bits == 16 ? 65535.0 : 255.0;
    Image<glm::u16vec3> codes(light.width(), light.height());
    tbb::parallel_for(0, light.height(), [&](int y) {
        for (int x = 0; x < light.width(); ++x) {
            const glm::dvec3 shares = shares_of_light(profile, m, mapper, glm::dvec3(light.at(x, y)));
            for (int i = 0; i < 3; ++i)
                codes.at(x, y)[i] = static_cast<std::uint16_t>(std::lround(most * encoded(profile, shares[i])));
        }
    });
    return codes;
}

double mean_shown_cdm2(const DisplayProfile& profile, const Image<glm::u16vec3>& codes) {
    const std::size_t most = profile.bits == 16 ? 65535 : 255;
    std::vector<double> shares(most + 1);
    for (std::size_t code = 0; code <= most; ++code)
        shares[code] = std::min(decoded(profile, static_cast<double>(code) / static_cast<double>(most)), 1.0);
    glm::dvec3 sum(0.0);
    for (const glm::u16vec3& code : codes.pixels())
        sum += glm::dvec3(shares[code.r], shares[code.g], shares[code.b]);
    return profile.black_cdm2 + (profile.xyz_from_rgb * sum).y / static_cast<double>(codes.size());
}

} // namespace fernlicht
