#include "runner/experiments/study/study_maps.h"

#include "runner/experiments/compare/runs/lux_ratio.h"
#include "runner/play/lux_map.h"
#include "runner/play/stage.h"

#include <algorithm>

namespace fernlicht {
namespace {

const View* view_of(const CellResult& cell, const StoredFrame& frame) {
    const auto found = std::ranges::find(cell.maps, frame.view, &View::name);
    return found == cell.maps.end() ? nullptr : &*found;
}

/// The middle one of those from above; nullptr where there is none.
const StoredFrame* map_frame(const CellResult& cell) {
    std::vector<const StoredFrame*> maps;
    for (const StoredFrame& frame : cell.frames)
        if (!frame.exr.empty() && view_of(cell, frame))
            maps.push_back(&frame);
    return maps.empty() ? nullptr : maps[maps.size() / 2];
}

} // namespace

std::optional<LuxMap> map_of(const CellResult& cell, const std::filesystem::path& folder) {
    const StoredFrame* frame = map_frame(cell);
    if (!frame)
        return std::nullopt;
    std::optional<LuxMap> map = stored_lux_map(folder / frame->exr, *frame, *view_of(cell, *frame));
    if (map)
        map->edges = cell.map_edges;
    return map;
}

void add_map_edges(const Drive& drive, std::vector<CellResult*> cells) {
    std::erase_if(cells, [](const CellResult* cell) { return map_frame(*cell) == nullptr; });
    if (cells.empty())
        return;
    const Stage stage(drive);
    for (CellResult* cell : cells) {
        const StoredFrame& frame = *map_frame(*cell);
        const std::vector<Moment> moments = moments_at({frame.tick}, stage, stage.drive.variants.front());
        cell->map_edges = edges_on_map(moments.front(), *view_of(*cell, frame), stage.route);
        cell->map_edges.push_back(car_outline(stage.drive.bumper_m));
    }
}

} // namespace fernlicht
