#include "runner/play/display_pipeline.h"

#include "metrics/display/camera_picture.h"
#include "metrics/display/display_colour.h"
#include "metrics/display/night_vision.h"
#include "metrics/display/scatter.h"
#include "metrics/display/sky_picture.h"
#include "renderer/technique.h"
#include "scenarios/drives/drive.h"
#include "scenarios/values/files.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace fernlicht {
namespace {

/// Of a pixel in the middle of the picture.
double scene_pixel_deg(double vertical_fov_rad, int height) {
    return std::atan(2.0 * std::tan(0.5 * vertical_fov_rad) / height) * 180.0 / std::numbers::pi;
}

Image<glm::vec3> behind_windscreen(const Image<glm::vec3>& light, double vertical_fov_rad, const Windscreen& screen) {
    Image<glm::vec3> seen = scattered(light, vertical_fov_rad, windscreen_scatter(screen.haze));
    for (glm::vec3& pixel : seen.pixels())
        pixel *= static_cast<float>(screen.transmittance);
    return seen;
}

/// The light that an eye with this adaptation calls grey, of luminance 1: what rods see has no colour.
glm::dvec3 seen_as_grey(const WhiteAdaptation& white) {
    const glm::dvec3 light = glm::inverse(light_adaptation(white).value_or(glm::dmat3(1.0))) * glm::dvec3(1.0);
    return light / glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), light);
}

} // namespace

ShownPicture show(const Image<glm::vec3>& light, double vertical_fov_rad, const DisplaySettings& display, const ToneMapper& mapper,
                  std::uint64_t seed) {
    using Clock = std::chrono::steady_clock;
    ShownPicture shown;
    Image<glm::vec3> seen = light;
    const auto stage = [&](const char* name, auto make) {
        const Clock::time_point began = Clock::now();
        make();
        shown.stage_s.emplace_back(name, std::chrono::duration<double>(Clock::now() - began).count());
    };
    const double pixel_deg = scene_pixel_deg(vertical_fov_rad, std::max(light.height(), 1));
    if (display.windscreen)
        stage("windscreen", [&] { seen = behind_windscreen(seen, vertical_fov_rad, *display.windscreen); });
    if (display.camera) {
        stage("camera",
              [&] { shown.codes = camera_picture(*display.camera, seen, vertical_fov_rad, light_adaptation(display.white), seed); });
        return shown;
    }
    if (display.veil)
        stage("veil in the eye", [&] {
            seen = scattered(seen, vertical_fov_rad, eye_scatter({display.veil->age_years, display.veil->pigmentation}));
        });
    if (display.night_colours)
        stage("colours at night", [&] { seen = colours_at_night(seen, pixel_deg, seen_as_grey(display.white)); });
    if (display.night_sharpness)
        stage("sharpness at night", [&] { seen = sharpness_at_night(seen, pixel_deg); });
    const DisplayProfile profile = display.profile.value_or(srgb_display());
    shown.bits = profile.bits;
    stage("tone mapper and display", [&] { shown.codes = display_picture(profile, mapper, seen, light_adaptation(display.white)); });
    return shown;
}

namespace {

/// By lamp set, view and moment, which the picture's file is named by.
std::uint64_t noise_seed(std::uint64_t drive, const std::filesystem::path& picture) {
    const std::string name = picture.parent_path().filename().string() + "/" + picture.filename().string();
    return drive ^ std::stoull(content_hash(name.data(), name.size()).substr(0, 16), nullptr, 16);
}

} // namespace

ShownPicture show_frame(const Frame& frame, const std::optional<Moment>& moment, const View& view, const DisplaySettings& display,
                        const ToneMapper& mapper, std::uint64_t drive_seed, const std::filesystem::path& picture) {
    const std::uint64_t seed = noise_seed(drive_seed, picture);
    if (display.sky && moment)
        return show(with_night_sky(frame, *moment, view, *display.sky), view.vertical_fov_rad, display, mapper, seed);
    return show(frame.light, view.vertical_fov_rad, display, mapper, seed);
}

bool is_shown_after_drawing(const DisplaySettings& display, const ToneMapper& mapper) {
    return display.after_drawing() || mapper.kind == ToneMapperKind::histogram;
}

namespace {

std::string sky_text(const NightSky& sky) {
    std::string all = fmt::format("{} {}", sky.zenith_cdm2, sky.extinction_mag);
    for (const Town& town : sky.towns)
        all += fmt::format(" {} {} {}", town.azimuth_rad, town.distance_km, town.inhabitants);
    return fmt::format("night sky {:.4g} cd/m2 ({})", sky.zenith_cdm2, content_hash(all.data(), all.size()).substr(0, 8));
}

std::string camera_text(const CameraSettings& camera) {
    static constexpr const char* tones[] = {"linear", "gamma", "srgb"};
    return fmt::format("camera {:.6g} s f/{:.4g} ISO {:.6g}, {:.6g} e- at saturation, read noise {:.4g} e-, bloom {:.4g}, tone {}{}",
                       camera.exposure_s, camera.f_number, camera.iso, camera.saturation_e, camera.read_noise_e, camera.bloom,
                       tones[static_cast<std::size_t>(camera.tone)],
                       camera.tone == TransferKind::gamma ? fmt::format(" {:.4g}", camera.gamma) : "");
}

} // namespace

std::string shown_by(const DisplaySettings& display, const ToneMapper& mapper) {
    if (display.camera) {
        const std::string windscreen =
            display.windscreen ? fmt::format("windscreen {:g} haze {:g}; ", display.windscreen->transmittance, display.windscreen->haze)
                               : "";
        return (display.sky ? sky_text(*display.sky) + "; " : "") + windscreen + camera_text(*display.camera) +
               (display.white.adapts() ? "; " + adaptation_text(display.white) : "");
    }
    std::string text = std::string(name(mapper.kind));
    if (mapper.kind == ToneMapperKind::rational || mapper.kind == ToneMapperKind::logarithmic)
        text += fmt::format(" s={:.6g}", mapper.s);
    if (mapper.kind == ToneMapperKind::histogram)
        text += fmt::format(" curve={}", content_hash(mapper.curve.data(), mapper.curve.size() * sizeof(ToneKnot)).substr(0, 8));
    text += fmt::format(" white={:.6g} cd/m2; display {}", mapper.l_max_cdm2, display.profile ? display.profile->name : "srgb");
    if (!display.profile && is_shown_after_drawing(display, mapper))
        text += ", luminance kept";
    if (display.profile) {
        const std::string profile = write_display_profile(*display.profile);
        text += fmt::format(" ({})", content_hash(profile.data(), profile.size()).substr(0, 8));
    }
    if (display.sky)
        text += "; " + sky_text(*display.sky);
    if (display.windscreen)
        text += fmt::format("; windscreen {:g} haze {:g}", display.windscreen->transmittance, display.windscreen->haze);
    if (display.veil)
        text += fmt::format("; eye of {:g} years, pigmentation {:g}", display.veil->age_years, display.veil->pigmentation);
    if (display.night_colours)
        text += "; colours at night";
    if (display.night_sharpness)
        text += "; sharpness at night";
    if (display.white.adapts())
        text += "; " + adaptation_text(display.white);
    if (display.adaptation)
        text += "; adapting";
    return text;
}

namespace {

constexpr double min_display_contrast = 3.0;

/// By how much luminance rises from the code that shows it to the next.
double code_step(const DisplayProfile& profile, double luminance_cdm2) {
    const double codes = profile.bits == 16 ? 65535.0 : 255.0, share = luminance_cdm2 / profile.white_cdm2();
    return decoded(profile, encoded(profile, share) + 1.0 / codes) / share - 1.0;
}

} // namespace

std::vector<std::string> display_warnings(const DisplayProfile& profile) {
    std::vector<std::string> warnings;
    if (const double contrast = profile.peak_cdm2() / profile.black_cdm2; contrast < min_display_contrast)
        warnings.push_back(fmt::format("display '{}' has a contrast of {:.4g} : 1 (peak {:.4g} cd/m2, black {:.4g} cd/m2), less than the "
                                       "{:g} : 1 that ISO 9241-3 recommends for text: its pictures hide what was rendered",
                                       profile.name, contrast, profile.peak_cdm2(), profile.black_cdm2, min_display_contrast));
    if (profile.transfer == TransferKind::pq && profile.bits == 8)
        warnings.push_back(
            fmt::format("display '{}' has transfer: pq in 8 bits, where ITU-R BT.2100 has 10 or 12: its codes are {:.1f} % of "
                        "luminance apart at 1 cd/m2, and dark pictures show bands; bits: 16 has none",
                        profile.name, 100.0 * code_step(profile, 1.0)));
    return warnings;
}

std::string substitute_shadows(const Drive& drive) {
    const Technique& technique = technique_named(drive.technique, drive.file);
    const ShadowMethod method = drive.shadows.method;
    const bool ours = technique.kind == TechniqueKind::ours;
    if (method == ShadowMethod::none || (ours && (technique.name != "photometric-naive" || method == ShadowMethod::map)))
        return "";
    return ours ? "its shadows are those of a map for each lamp" : "it renders no shadows of lamps";
}

RenderingSettings rendering_settings(const Drive& drive) {
    return {drive.shadows, substitute_shadows(drive), drive.tone_mapper, drive.display};
}

DisplayProfile display_of(const RenderingSettings& drawn) {
    if (drawn.display.profile)
        return *drawn.display.profile;
    DisplayProfile srgb = srgb_display();
    srgb.name = "srgb";
    srgb.gamut = is_shown_after_drawing(drawn.display, drawn.tone_mapper) ? GamutRule::keep_luminance : GamutRule::clip;
    return srgb;
}

double shown_cdm2(const RenderingSettings& drawn, double seen_cdm2) {
    const DisplayProfile display = display_of(drawn);
    if (const auto& camera = drawn.display.camera)
        return display.black_cdm2 + decoded(display, camera_code(*camera, seen_cdm2 / camera->saturation_cdm2())) * display.white_cdm2();
    return display.black_cdm2 + toned(drawn.tone_mapper, seen_cdm2) * display.white_cdm2();
}

std::vector<std::string> display_stages(const RenderingSettings& drawn) {
    const DisplaySettings& display = drawn.display;
    std::vector<std::string> stages;
    if (display.sky)
        stages.push_back(fmt::format("night sky of {:.4g} cd/m² at the zenith and the glow of {} towns, in pictures alone",
                                     display.sky->zenith_cdm2, display.sky->towns.size()));
    if (display.windscreen)
        stages.push_back(
            fmt::format("windscreen, transmittance {:g}, haze {:g}", display.windscreen->transmittance, display.windscreen->haze));
    if (display.veil)
        stages.push_back(
            fmt::format("veil in an eye of {:g} years, pigmentation {:g}", display.veil->age_years, display.veil->pigmentation));
    if (display.night_colours)
        stages.emplace_back("colours at night");
    if (display.night_sharpness)
        stages.emplace_back("sharpness at night");
    if (display.camera)
        stages.push_back(fmt::format("{}: saturated by {:.4g} cd/m2", camera_text(*display.camera), display.camera->saturation_cdm2()));
    if (display.white.adapts())
        stages.push_back(fmt::format("white of an eye adapted to light of x = {:.4f}, y = {:.4f} by {:.4g} (CAT16)",
                                     display.white.chromaticity->x, display.white.chromaticity->y, *display.white.degree));
    if (display.adaptation)
        stages.push_back(
            fmt::format("adaptation: white follows the driver's picture, in {:g} s towards brighter and {:g} s towards darker light",
                        display.adaptation->brighter_s, display.adaptation->darker_s));
    return stages;
}

} // namespace fernlicht
