#include "runner/experiments/film/film_layout.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double film_heights_per_letter = 36.0, panel_widths_per_letter = 32.0, smallest_letter_px = 8.0;
constexpr double line_letters = 1.7, second_line_letters = 1.3, scale_letters = 2.5, map_share = 0.24;
constexpr int panel_gap_px = 2, least_picture_px = 16;

/// `count` parts of a length with gaps between them: where one begins and how long it is.
std::pair<int, int> part(int length_px, int count, int index) {
    const int size = (length_px - (count - 1) * panel_gap_px) / count;
    return {index * (size + panel_gap_px), size};
}

FilmPanelBoxes boxes_in(const PixelBox& cell, int title_px, bool map) {
    const int map_px = map ? static_cast<int>(std::lround(map_share * (cell.height - title_px))) : 0;
    FilmPanelBoxes boxes;
    boxes.title = {cell.x, cell.y, cell.width, title_px};
    boxes.map = {cell.x, cell.y + cell.height - map_px, cell.width, map_px};
    boxes.picture = {cell.x, cell.y + title_px, cell.width, cell.height - title_px - map_px - (map ? panel_gap_px : 0)};
    boxes.shown = boxes.picture;
    return boxes;
}

} // namespace

FilmLayout film_layout(FilmArrangement arrangement, int panels, int width_px, int height_px, FilmBands bands) {
    const auto refuse = [](const char* flag, const std::string& found, const std::string& expected) {
        throw InputError({{}, 0, 0, flag}, found, expected);
    };
    const std::string found = fmt::format("found {} panel{}, one for each lamp set of each drive", panels, panels == 1 ? "" : "s");
    const bool two = arrangement == FilmArrangement::side_by_side || arrangement == FilmArrangement::wipe;
    if (two && panels != 2)
        refuse(arrangement == FilmArrangement::wipe ? "--wipe" : "--side-by-side", found, "two; --lamp-sets chooses");
    if (panels > most_film_panels)
        refuse("--lamp-sets", found, fmt::format("at most {}", most_film_panels));
    FilmLayout layout{.width_px = width_px, .height_px = height_px, .wipe = arrangement == FilmArrangement::wipe};
    const int columns = layout.wipe                                    ? 1
                        : arrangement == FilmArrangement::side_by_side ? 2
                                                                       : static_cast<int>(std::ceil(std::sqrt(panels) - 1e-9));
    const int rows = layout.wipe ? 1 : (panels + columns - 1) / columns;
    layout.letter_px =
        std::max(smallest_letter_px, std::min(height_px / film_heights_per_letter,
                                              part(width_px, layout.wipe ? 2 : columns, 0).second / panel_widths_per_letter));
    const auto px = [&](double letters) { return static_cast<int>(std::lround(letters * layout.letter_px)); };
    const int footer_px = px(bands.maps ? scale_letters : line_letters);
    const int title_px = px(line_letters + (bands.readings ? second_line_letters : 0.0));
    layout.footer = {0, height_px - footer_px, width_px, footer_px};
    for (int i = 0; i < panels; ++i) {
        const auto [x, width] = part(width_px, columns, layout.wipe ? 0 : i % columns);
        const auto [y, height] = part(height_px - footer_px, rows, layout.wipe ? 0 : i / columns);
        FilmPanelBoxes boxes = boxes_in({x, y, width, height}, title_px, bands.maps);
        if (layout.wipe) {
            const auto [left, half] = part(width_px, 2, i);
            for (PixelBox* box : {&boxes.title, &boxes.map}) {
                box->x = left;
                box->width = half;
            }
            const int middle = width_px / 2;
            boxes.shown.x = i == 0 ? 0 : middle;
            boxes.shown.width = i == 0 ? middle : width_px - middle;
        }
        if (boxes.picture.height < least_picture_px || boxes.picture.width < least_picture_px)
            refuse("--resolution", fmt::format("found {} x {}", width_px, height_px),
                   fmt::format("more: a picture of {} would have {} x {} pixels", panels, boxes.picture.width, boxes.picture.height));
        layout.panels.push_back(boxes);
    }
    return layout;
}

} // namespace fernlicht
