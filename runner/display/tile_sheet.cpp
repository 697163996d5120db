#include "runner/display/tile_sheet.h"

#include "runner/plots/canvas.h"

#include <algorithm>

namespace fernlicht {
namespace {

using plots::Canvas;

constexpr int tiles_across = 3;
constexpr plots::Colour sheet_ink{24, 24, 32}, sheet_faint{100, 100, 108};
constexpr double sheet_edge_px = 16.0, tile_gap_px = 12.0, under_tile_px = 44.0, over_tiles_px = 62.0;

double tile_height(const TileSection& section) { return section.tiles.empty() ? 0.0 : section.tiles.front().picture.height(); }

double section_height(const TileSection& section) {
    const auto rows = static_cast<double>((section.tiles.size() + tiles_across - 1) / tiles_across);
    return over_tiles_px + rows * (tile_height(section) + under_tile_px);
}

void draw_tiles(Canvas& canvas, const TileSection& section, double top) {
    const double height = tile_height(section);
    for (std::size_t i = 0; i < section.tiles.size(); ++i) {
        const PictureTile& tile = section.tiles[i];
        const double left = sheet_edge_px + static_cast<double>(i % tiles_across) * (tile_px + tile_gap_px),
                     at = top + static_cast<double>(i / tiles_across) * (height + under_tile_px);
        Image<plots::Colour> pixels(tile.picture.width(), tile.picture.height());
        std::ranges::transform(tile.picture.pixels(), pixels.data(), [](const Rgb8& p) { return plots::Colour{p.r, p.g, p.b}; });
        canvas.picture(left, at, tile_px, height, pixels);
        canvas.text(left, at + height + 15.0, tile.name, {.size_px = 13.0, .colour = sheet_ink, .bold = true});
        canvas.text(left, at + height + 30.0, tile.words, {.size_px = 12.0, .colour = sheet_faint});
    }
}

} // namespace

std::string tile_sheet_svg(const std::string& title, const std::vector<TileSection>& sections) {
    double height_px = 0.0;
    for (const TileSection& section : sections)
        height_px += section_height(section);
    const double width_px = 2.0 * sheet_edge_px + tiles_across * tile_px + (tiles_across - 1) * tile_gap_px;
    Canvas canvas(width_px, height_px, title);
    canvas.rectangle(0.0, 0.0, width_px, height_px, {.fill = "#ffffff"});
    double top = 0.0;
    for (const TileSection& section : sections) {
        canvas.text(sheet_edge_px, top + 26.0, section.title, {.size_px = 17.0, .colour = sheet_ink, .bold = true});
        canvas.text(sheet_edge_px, top + 46.0, section.words, {.size_px = 13.0, .colour = sheet_faint});
        draw_tiles(canvas, section, top + over_tiles_px);
        top += section_height(section);
    }
    return canvas.finish();
}

} // namespace fernlicht
