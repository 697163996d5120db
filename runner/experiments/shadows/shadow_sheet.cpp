#include "runner/experiments/shadows/shadow_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/findings/plots/colour.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

Rgb8 grey_pixel(double share) {
    const auto code = static_cast<std::uint8_t>(std::lround(255.0 * photometry::srgb_encoded(std::clamp(share, 0.0, 1.0))));
    return {code, code, code};
}

/// Compressed so that the dark shows what is in it: L / (L + 0.3 white), white as white.
Image<Rgb8> seen_picture(const Image<float>& luminance, double white_cdm2) {
    return mapped(luminance, [&](float cdm2) {
        const double share = static_cast<double>(cdm2) / white_cdm2;
        return grey_pixel(1.3 * share / (share + 0.3));
    });
}

Image<Rgb8> degree_picture(const Image<float>& degree) {
    return mapped(degree, [](float value) {
        return value < 0.0F ? Rgb8{120, 130, 150} : grey_pixel(0.9 * (1.0 - static_cast<double>(value)) + 0.02);
    });
}

/// Orange: wrongly lit; blue: wrongly dark; white: right.
Image<Rgb8> wrong_picture(const Image<float>& wrong, const Image<float>& degree) {
    Image<Rgb8> out(wrong.width(), wrong.height());
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        const plots::Colour colour = plots::diverging(static_cast<double>(wrong.pixels()[i]));
        out.pixels()[i] = degree.pixels()[i] < 0.0F ? Rgb8{120, 130, 150} : Rgb8{colour.r, colour.g, colour.b};
    }
    return out;
}

std::string share_words(const ShadowArea& area) {
    return fmt::format("{} % wrongly lit, {} % wrongly dark", shadow_percent(area.wrongly_lit_share()),
                       shadow_percent(area.wrongly_dark_share()));
}

std::string cost_words(const ShadowRow& row) {
    std::string words;
    if (const auto time = frame_time(row))
        words = time_text(time->value) + " a frame";
    if (row.texture_bytes)
        words += fmt::format("{}{:.1f} MiB for shadows", words.empty() ? "" : ", ", static_cast<double>(*row.texture_bytes) / (1 << 20));
    return words;
}

} // namespace

TileSheet shadow_sheet(const ShadowSceneResult& scene) {
    const double white = scene.white_cdm2;
    TileSection seen{
        short_text(scene.title, 90),
        fmt::format(
            "{}: luminance, white is {} cd/m2, which one in a hundred of the ground's pixels exceeds without shadows; reference: as "
            "rendered without shadows, times the reference's share of the light",
            scene.whole_view ? "the whole view" : "a quarter of the view, about its shadows", shadow_figure(white, 1e-4)),
        {{"reference", "what methods are held against", seen_picture(scene.luminance_cdm2, white)}}};
    TileSection wrong{
        "Where shadows are wrong",
        "orange: wrongly lit; blue: wrongly dark, against the reference at pixels' centres; grey: below the floor without shadows, "
        "or nothing; shares are of the whole view",
        {{"reference shadow", "dark: no light of any lamp, points", degree_picture(scene.degree)}}};
    for (const ShadowRow& row : scene.rows)
        if (!measured(row)) {
            seen.words += fmt::format("; {} refuses the scene", name(row.method));
        } else {
            const std::string method(name(row.method));
            seen.tiles.push_back({method, cost_words(row), seen_picture(row.luminance_cdm2, white)});
            wrong.tiles.push_back({method, share_words(row.view_px), wrong_picture(row.wrong, scene.degree)});
        }
    return {"Shadow methods: " + scene.title, {seen, wrong}};
}

} // namespace fernlicht
