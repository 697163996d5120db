#include "runner/experiments/aliasing/motion.h"

#include "metrics/images/image_difference.h"
#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace fernlicht {
namespace {

/// One frame and whence it was seen.
struct Shot {
    const Moment& moment;
    const Frame& frame;
    Camera camera;
};

/// What pixel (x, y) shows, relative to the car of that moment; something is seen there.
glm::dvec3 point_at(const Shot& shot, const View& view, int x, int y) {
    return shown_at(shot.camera, view, x, y, shot.frame.depth_m.at(x, y));
}

/// Where a point of `from` with that id is seen in `to`, as seen_at() has it; nullopt where it is hidden or outside.
std::optional<glm::dvec3> found_in(const Shot& from, const Shot& to, const View& view, const glm::dvec3& point_m, std::uint32_t id) {
    const auto seen = seen_at(to.camera, view, point_m + from.moment.ego.position_m - to.moment.ego.position_m);
    if (!seen)
        return std::nullopt;
    const int x = static_cast<int>(seen->x), y = static_cast<int>(seen->y);
    const bool same = to.frame.ids.at(x, y) == id && std::abs(static_cast<double>(to.frame.depth_m.at(x, y)) - seen->z) <= 0.1 * seen->z;
    return same ? seen : std::nullopt;
}

bool too_few(const FlowPaths& followed) {
    return followed.paths.empty() || static_cast<double>(followed.paths.size()) < min_followed * static_cast<double>(followed.started);
}

void add_squares(AliasingPart& sum, const AliasingPart& part) {
    sum.rms += part.rms * part.rms;
    sum.contrast_percent += part.contrast_percent * part.contrast_percent;
    sum.visible += part.visible * part.visible;
}

void root(AliasingPart& sum, double count) {
    for (double* value : {&sum.rms, &sum.contrast_percent, &sum.visible})
        *value = std::sqrt(*value / count);
}

} // namespace

std::vector<PixelTrack> tracks_of(const std::vector<Moment>& moments, const View& view, const std::vector<Frame>& frames, std::size_t from,
                                  int stride) {
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < moments.size(); ++i)
        shots.push_back({moments[i], frames[i], camera_of(moments[i], view)});
    std::vector<PixelTrack> tracks;
    for (int y = stride / 2; y < view.height_px; y += stride)
        for (int x = stride / 2; x < view.width_px; x += stride) {
            const std::uint32_t id = frames[from].ids.at(x, y);
            if (id == 0)
                continue;
            const glm::dvec3 point_m = point_at(shots[from], view, x, y);
            PixelTrack track;
            for (const Shot& shot : shots) {
                const auto seen = found_in(shots[from], shot, view, point_m, id);
                if (!seen)
                    break;
                track.push_back(static_cast<int>(seen->y) * view.width_px + static_cast<int>(seen->x));
            }
            if (track.size() == moments.size())
                tracks.push_back(std::move(track));
        }
    return tracks;
}

KnownFlow known_flow(const std::vector<Moment>& moments, const View& view, const std::vector<Frame>& frames, std::size_t from,
                     std::size_t to) {
    const Shot first{moments[from], frames[from], camera_of(moments[from], view)},
        second{moments[to], frames[to], camera_of(moments[to], view)};
    const Image<float> none(view.width_px, view.height_px);
    KnownFlow found{{none, none}, Image<std::uint8_t>(view.width_px, view.height_px)};
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const std::uint32_t id = first.frame.ids.at(x, y);
            if (id == 0)
                continue;
            const auto seen = found_in(first, second, view, point_at(first, view, x, y), id);
            if (!seen)
                continue;
            found.known.at(x, y) = 1;
            found.flow.dx_px.at(x, y) = static_cast<float>(seen->x - (x + 0.5));
            found.flow.dy_px.at(x, y) = static_cast<float>(seen->y - (y + 0.5));
        }
    return found;
}

Image<Ground> ground_of(Device& device, const Scene& scene, const Moment& moment, const View& view) {
    Scene glowing = scene; // nothing returns light; what is looked for glows
    for (Material& material : glowing.materials) {
        const float glow = material.kind == SurfaceKind::road ? 1.0F : material.kind == SurfaceKind::marking ? 2.0F : 0.0F;
        material.albedo = glm::vec3(0.0F);
        material.retro_rl = 0.0F;
        material.texture = -1;
        material.emission_cdm2 = glm::vec3(glow);
    }
    Moment dark = moment;
    dark.lamps.clear();
    dark.daylight = {};
    Renderer renderer(device, glowing, {});
    const Frame frame = renderer.draw(dark, view, {.luminance = true});
    return mapped(frame.luminance_cdm2, [](float glow) { return glow > 1.5F ? Ground::mark : glow > 0.5F ? Ground::road : Ground::other; });
}

Image<float> floats_of(const Image<double>& picture) {
    return mapped(picture, [](double value) { return static_cast<float>(value); });
}

float displayed_cdm2(const Rgb8& pixel) {
    const auto linear = [](std::uint8_t value) { return srgb_decoded(value / 255.0); };
    return static_cast<float>(display_white_cdm2 * (0.2126 * linear(pixel.r) + 0.7152 * linear(pixel.g) + 0.0722 * linear(pixel.b)));
}

Image<float> display_step_cdm2(const Image<float>& displayed) {
    return mapped(displayed, [](float cdm2) {
        const std::array<float, 256>& decoded = srgb_table();
        const auto above = std::ranges::lower_bound(decoded, cdm2 / static_cast<float>(display_white_cdm2));
        const auto code = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - decoded.begin(), 0, 254));
        return static_cast<float>(display_white_cdm2) * (decoded[code + 1] - decoded[code]);
    });
}

std::string method_name(FlowMethod method) { return method == FlowMethod::dis ? "dense inverse search" : "Farneback"; }

std::optional<TemporalAliasing> aliasing_along(const FlowPaths& followed, const std::vector<Image<double>>& aliasing,
                                               const std::vector<Image<double>>& levels, double rate_hz, double pixels_per_degree) {
    if (too_few(followed))
        return std::nullopt;
    std::vector<PixelTrack> tracks;
    for (const Path& path : followed.paths)
        tracks.push_back(track_of(path, aliasing.front().width(), aliasing.front().height()));
    return measure_temporal_aliasing(aliasing, levels, tracks, rate_hz, pixels_per_degree);
}

std::optional<TemporalAliasing> flicker_along(const FlowPaths& followed, const std::vector<Image<float>>& pictures, double rate_hz,
                                              double pixels_per_degree) {
    if (too_few(followed))
        return std::nullopt;
    return measure_flicker(samples_along(followed.paths, pictures), rate_hz, pixels_per_degree);
}

SpatialAliasing over_moments(std::vector<SpatialAliasing>& found, std::size_t shown) {
    SpatialAliasing all = std::move(found[shown]);
    const auto each = [&](auto use) {
        use([](SpatialAliasing& a) -> AliasingPart& { return a.aliasing; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.folded; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.rest; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.lost; });
        for (std::size_t b = 0; b < all.bands.size(); ++b) {
            use([b](SpatialAliasing& a) -> AliasingPart& { return a.bands[b].aliasing; });
            use([b](SpatialAliasing& a) -> AliasingPart& { return a.bands[b].lost; });
        }
    };
    found[shown].bands = all.bands;
    each([&](auto part) {
        AliasingPart sum;
        for (SpatialAliasing& one : found)
            add_squares(sum, part(one));
        root(sum, static_cast<double>(found.size()));
        part(all) = sum;
    });
    return all;
}

} // namespace fernlicht
