#include "runner/write/plots/svg.h"

#include <algorithm>

namespace fernlicht {
namespace {

using plots::Drawing;

constexpr int tiles_across = 3;
constexpr plots::Colour tile_ink{24, 24, 32}, tile_faint{100, 100, 108};
constexpr double sheet_edge_px = 16.0, tile_gap_px = 12.0, section_title_px = 17.0, words_px = 13.0, tile_name_px = 13.0,
                 tile_words_px = 12.0;
constexpr double words_line_px = 17.0, tile_line_px = 15.0;
constexpr double inner_px = tiles_across * tile_px + (tiles_across - 1) * tile_gap_px;

/// Broken between words, so that no line is wider than `max_px`; a word that is wider by itself is broken, too.
std::vector<std::string> sheet_lines(const std::string& text, double size_px, double max_px) {
    const auto fits = [&](const std::string& line) { return plots::text_width(line, size_px) <= max_px; };
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        at = end + 1;
        if (const std::string longer = line.empty() ? word : line + ' ' + word; fits(longer)) {
            line = longer;
            continue;
        }
        if (!line.empty())
            lines.push_back(line);
        line.clear();
        for (std::size_t i = 0; i < word.size();) {
            std::size_t letter = 1;
            while (i + letter < word.size() && (static_cast<unsigned char>(word[i + letter]) & 0xc0U) == 0x80U)
                ++letter;
            if (!line.empty() && !fits(line + word.substr(i, letter))) {
                lines.push_back(line);
                line.clear();
            }
            line += word.substr(i, letter);
            i += letter;
        }
    }
    if (!line.empty())
        lines.push_back(line);
    return lines;
}

/// Returns where the next line goes.
double draw_lines(Drawing& canvas, double left, double baseline, double pitch_px, const std::vector<std::string>& lines,
                  const plots::Lettering& lettering) {
    for (const std::string& line : lines) {
        canvas.text(left, baseline, line, lettering);
        baseline += pitch_px;
    }
    return baseline;
}

std::vector<std::string> name_lines(const PictureTile& tile) { return sheet_lines(tile.name, 1.1 * tile_name_px, tile_px); } // bold
std::vector<std::string> caption_lines(const PictureTile& tile) { return sheet_lines(tile.words, tile_words_px, tile_px); }

double tile_height(const TileSection& section) { return section.tiles.empty() ? 0.0 : section.tiles.front().picture.height(); }

/// Room for the longest caption, one height for all tiles of the section.
double under_tiles(const TileSection& section) {
    std::size_t most = 2;
    for (const PictureTile& tile : section.tiles)
        most = std::max(most, name_lines(tile).size() + caption_lines(tile).size());
    return 14.0 + static_cast<double>(most) * tile_line_px;
}

double over_tiles(const TileSection& section) {
    const std::size_t lines = std::max<std::size_t>(1, sheet_lines(section.words, words_px, inner_px).size());
    return 45.0 + static_cast<double>(lines) * words_line_px;
}

double section_height(const TileSection& section) {
    const std::size_t rows = (section.tiles.size() + tiles_across - 1) / tiles_across;
    return over_tiles(section) + static_cast<double>(rows) * (tile_height(section) + under_tiles(section));
}

void draw_tiles(Drawing& canvas, const TileSection& section, double top) {
    const double height = tile_height(section), pitch = height + under_tiles(section);
    for (std::size_t i = 0; i < section.tiles.size(); ++i) {
        const PictureTile& tile = section.tiles[i];
        const std::size_t column = i % tiles_across, row = i / tiles_across;
        const double left = sheet_edge_px + static_cast<double>(column) * (tile_px + tile_gap_px),
                     at = top + static_cast<double>(row) * pitch;
        canvas.picture(left, at, tile_px, height, pixels_of(tile.picture));
        const double next = draw_lines(canvas, left, at + height + 15.0, tile_line_px, name_lines(tile),
                                       {.size_px = tile_name_px, .colour = tile_ink, .bold = true});
        draw_lines(canvas, left, next, tile_line_px, caption_lines(tile), {.size_px = tile_words_px, .colour = tile_faint});
    }
}

} // namespace

std::string plots::svg_of(const TileSheet& sheet, int zlib) {
    double height_px = 0.0;
    for (const TileSection& section : sheet.sections)
        height_px += section_height(section);
    const double width_px = 2.0 * sheet_edge_px + inner_px;
    Drawing canvas{width_px, height_px, sheet.title};
    canvas.rectangle(0.0, 0.0, width_px, height_px, {.fill = "#ffffff"});
    double top = 0.0;
    for (const TileSection& section : sheet.sections) {
        canvas.text(sheet_edge_px, top + 26.0, section.title, {.size_px = section_title_px, .colour = tile_ink, .bold = true});
        draw_lines(canvas, sheet_edge_px, top + 46.0, words_line_px, sheet_lines(section.words, words_px, inner_px),
                   {.size_px = words_px, .colour = tile_faint});
        draw_tiles(canvas, section, top + over_tiles(section));
        top += section_height(section);
    }
    return svg_of(canvas, zlib);
}

} // namespace fernlicht
