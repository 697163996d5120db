#include "renderer/reference/tile.h"

#include "renderer/reference/pixel_estimate.h"

#include <algorithm>
#include <bit>

namespace fernlicht::reference {
namespace {

static_assert(tile_px == packet_size, "a row of a tile is a packet of rays through pixels' centres");

/// What every pixel has, its samples' number last: a pixel counts as drawn by it.
void store(ReferenceImage& image, int x, int y, const std::array<MeanAndError, 3>& result, std::uint8_t mixed, int samples) {
    const std::array<Estimate*, 3> estimates{&image.illuminance_lx, &image.target_lx, &image.luminance_cdm2};
    for (std::size_t r = 0; r < 3; ++r)
        if (!estimates[r]->mean.empty()) {
            estimates[r]->mean.at(x, y) = static_cast<float>(result[r].mean);
            estimates[r]->standard_error.at(x, y) = static_cast<float>(result[r].standard_error);
        }
    image.mixed.at(x, y) = mixed;
    image.samples.at(x, y) = static_cast<std::uint32_t>(samples);
}

/// Rays through the centres of a row of pixels.
struct CentreRow {
    std::array<Ray, packet_size> rays;
    LaneMask lanes = 0;
};
CentreRow centre_row(const Shot& shot, int x0, int y, int width) {
    CentreRow row;
    for (int i = 0; i < width; ++i) {
        row.rays[static_cast<std::size_t>(i)] = shot.ray_through(x0 + i + 0.5, y + 0.5);
        row.lanes |= 1U << i;
    }
    return row;
}

/// Nothing is left to chance: one ray a pixel, no noise.
bool is_certain(const ReferenceSettings& settings) {
    return settings.footprint == Footprint::centre && is_direct(settings) && settings.lamp_radius_m <= 0.0;
}

std::uint64_t draw_certain_row(const Shot& shot, const CentreRow& row, int x0, int y, ReferenceImage& image) {
    Drawing drawing(shot);
    PacketLight light;
    add_packet(shot, {}, row.rays, row.lanes, light, drawing);
    for (std::size_t i = 0; i < packet_size && in_mask(row.lanes, i); ++i) {
        const int x = x0 + static_cast<int>(i);
        store(image, x, y, {{{drawing.sums[0][i], 0.0}, {drawing.sums[1][i], 0.0}, {drawing.sums[2][i], 0.0}}}, 0, 1);
        image.ids.at(x, y) = in_mask(light.hit, i) ? light.hits[i].mesh + 1 : 0;
    }
    return drawing.rays;
}

std::uint64_t draw_ids(const Shot& shot, const CentreRow& row, int x0, int y, ReferenceImage& image) {
    std::array<SurfaceHit, packet_size> hits;
    const LaneMask hit = shot.embree.cast(row.rays, row.lanes, shot.camera.is_map, hits);
    for (std::size_t i = 0; i < packet_size && in_mask(row.lanes, i); ++i)
        image.ids.at(x0 + static_cast<int>(i), y) = in_mask(hit, i) ? hits[i].mesh + 1 : 0;
    return static_cast<std::uint64_t>(std::popcount(row.lanes));
}

/// The pilots of a tile and of the pixels around it, as far as the picture goes.
class Pilots {
  public:
    Pilots(const Shot& shot, int x0, int y0)
        : left_(std::max(0, x0 - 1)), top_(std::max(0, y0 - 1)), width_(std::min(shot.view.width_px, x0 + tile_px + 1) - left_),
          height_(std::min(shot.view.height_px, y0 + tile_px + 1) - top_) {
        for (int y = top_; y < top_ + height_; ++y)
            for (int x = left_; x < left_ + width_; ++x) {
                pilots_.push_back(pilot_of(shot, x, y));
                rays_ += pilots_.back().rays;
            }
    }
    const Drawing& at(int x, int y) const { return pilots_[static_cast<std::size_t>((y - top_) * width_ + x - left_)]; }
    bool at_edge(int x, int y) const {
        bool edge = false;
        for (int j = std::max(top_, y - 1); j <= std::min(top_ + height_ - 1, y + 1); ++j)
            for (int i = std::max(left_, x - 1); i <= std::min(left_ + width_ - 1, x + 1); ++i)
                edge |= at(i, j).mixed() != 0 || differ(at(i, j), at(x, y));
        return edge;
    }
    std::uint64_t rays() const { return rays_; }

  private:
    int left_, top_, width_, height_;
    std::vector<Drawing> pilots_;
    std::uint64_t rays_ = 0;
};

std::uint64_t draw_pixels(const Shot& shot, int x0, int y0, ReferenceImage& image) {
    std::uint64_t rays = 0;
    const int width = std::min(tile_px, image.samples.width() - x0), bottom = std::min(y0 + tile_px, image.samples.height());
    if (is_certain(shot.settings)) {
        for (int y = y0; y < bottom; ++y)
            rays += draw_certain_row(shot, centre_row(shot, x0, y, width), x0, y, image);
        return rays;
    }
    const Pilots pilots(shot, x0, y0);
    rays += pilots.rays();
    for (int y = y0; y < bottom; ++y) {
        rays += draw_ids(shot, centre_row(shot, x0, y, width), x0, y, image);
        for (int x = x0; x < x0 + width; ++x) {
            const PixelEstimate estimate = estimate_pixel(shot, x, y, pilots.at(x, y), pilots.at_edge(x, y));
            store(image, x, y, estimate.result, estimate.mixed, estimate.each * static_cast<int>(replicate_count));
            rays += estimate.rays;
        }
    }
    return rays;
}

} // namespace

std::uint64_t draw_tile(const Shot& shot, int x0, int y0, ReferenceImage& image) {
    try {
        return draw_pixels(shot, x0, y0, image);
    } catch (const Stopped&) {
        for (int y = y0; y < std::min(y0 + tile_px, image.samples.height()); ++y)
            for (int x = x0; x < std::min(x0 + tile_px, image.samples.width()); ++x) {
                store(image, x, y, {}, 0, 0);
                image.ids.at(x, y) = 0;
            }
        return 0;
    }
}

} // namespace fernlicht::reference
