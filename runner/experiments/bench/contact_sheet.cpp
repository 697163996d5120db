#include "runner/experiments/bench/contact_sheet.h"

#include "runner/play/extent_fold.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr int tile_width_px = 320;
constexpr double ahead_m = 20.0;

View small(View view) {
    view.height_px = std::max(1, static_cast<int>(std::lround(double{tile_width_px} * view.height_px / view.width_px)));
    view.width_px = tile_width_px;
    return view;
}

std::optional<glm::dvec2> pixel_of(const glm::dvec3& point_m, const Moment& moment, const View& view) {
    const Camera camera = camera_of(moment, view);
    const glm::dvec3 p = point_m - moment.ego.position_m - camera.eye_m;
    const double ahead = glm::dot(p, camera.axis);
    const glm::dvec2 at((1.0 + glm::dot(p, camera.right) / ahead / camera.half_extent.x) * 0.5 * view.width_px,
                        (1.0 - glm::dot(p, camera.up) / ahead / camera.half_extent.y) * 0.5 * view.height_px);
    const bool seen = ahead > 0.0 && at.x >= 0.0 && at.x < view.width_px && at.y >= 0.0 && at.y < view.height_px;
    return seen ? std::optional(at) : std::nullopt;
}

} // namespace

ContactSheet new_sheet(const Stage& stage, const Variant& variant, const Moment& moment) {
    ContactSheet sheet;
    sheet.drive = stage.drive.name;
    sheet.title = stage.drive.title;
    sheet.variant = variant.name;
    sheet.moment = moment;
    sheet.view = small(*driver_view(stage.drive));
    sheet.spot_ahead_m = ahead_m;
    const Pose surface = stage.route.pose(moment.distance_m + stage.drive.bumper_m + ahead_m);
    sheet.spot = map_around(surface.position_m, moment);
    sheet.spot_px = pixel_of(surface.position_m, moment, sheet.view);
    sheet.twin_lx = surface_illuminance_lx(moment, surface.position_m, surface.up());
    return sheet;
}

void add_tile(ContactSheet& sheet, Renderer& renderer) {
    SheetTile tile{renderer.technique(), {}, {}, {}, {}};
    try {
        Frame frame = renderer.draw(sheet.moment, sheet.view, {.colour = true, .illuminance = true});
        if (tile.row.illuminance)
            tile.spot_lx = renderer.draw(sheet.moment, sheet.spot, {.illuminance = true}).illuminance_lx.at(1, 1);
        tile.colour = std::move(frame.colour);
        tile.illuminance_lx = std::move(frame.illuminance_lx);
    } catch (const InputError& error) {
        tile.not_drawn = error.what();
    }
    sheet.tiles.push_back(std::move(tile));
}

void add_all_techniques(std::vector<ContactSheet>& sheets, const Stage& stage, Device& device, RendererSettings settings) {
    for (const Technique& row : techniques()) {
        settings.technique = row.name;
        Renderer renderer(device, stage.scene, settings);
        for (ContactSheet& sheet : sheets)
            add_tile(sheet, renderer);
    }
}

} // namespace fernlicht
