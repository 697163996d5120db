#include "runner/experiments/bench/contact_sheet.h"

#include "runner/files/clean_text.h"
#include "runner/findings/lists.h"
#include "runner/findings/plots/axes.h"
#include "runner/play/extent_fold.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
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

using plots::Drawing;

constexpr int across = 5;
constexpr plots::Colour sheet_ink{24, 24, 32}, sheet_faint{100, 100, 108}, empty{232, 233, 236}, cross{255, 255, 255};
constexpr double edge_px = 16.0, between_px = 12.0, caption_px = 44.0, head_px = 62.0, scale_px = 300.0;

plots::Axis lux_axis() { return {.label = "illuminance", .unit = "lx", .from = 0.1, .to = 100.0, .scale = plots::Scale::logarithmic}; }

/// Where tiles of one part of the sheet lie.
struct SheetGround {
    double tile_width = 0.0, tile_height = 0.0, top = 0.0;
    double left_of(std::size_t tile) const { return edge_px + static_cast<double>(tile % across) * (tile_width + between_px); }
    double top_of(std::size_t tile) const {
        const std::size_t row = tile / across;
        return top + static_cast<double>(row) * (tile_height + caption_px);
    }
};

/// "as published, row 4"
std::string kind_text(const Technique& row) {
    return std::string(kind_name(row.kind)) + (row.thesis_row > 0 ? fmt::format(", row {} of Table 6.1", row.thesis_row) : "");
}

std::string lux_text(double lux) { return fmt::format("{:.{}f} lx", lux, lux < 9.995 ? 2 : 1); }

/// "12.3 lx, x 1.02"
std::string spot_text(const ContactSheet& sheet, const SheetTile& tile) {
    if (!tile.spot_lx)
        return tile.not_drawn.empty() ? "no lux image" : "not rendered";
    return lux_text(*tile.spot_lx) + (sheet.twin_lx > 0.0 ? fmt::format(", x {:.2f}", *tile.spot_lx / sheet.twin_lx) : "");
}

void draw_caption(Drawing& canvas, const SheetGround& ground, std::size_t i, const SheetTile& tile, const std::string& words) {
    const double left = ground.left_of(i), below = ground.top_of(i) + ground.tile_height;
    canvas.text(left, below + 15.0, std::string(tile.row.name), {.size_px = 13.0, .colour = sheet_ink, .bold = true});
    canvas.text(left, below + 30.0, words, {.size_px = 12.0, .colour = sheet_faint});
}

void draw_empty(Drawing& canvas, const SheetGround& ground, std::size_t i, const char* words) {
    const double left = ground.left_of(i), top = ground.top_of(i);
    canvas.rectangle(left, top, ground.tile_width, ground.tile_height, {.fill = css(empty)});
    canvas.text(left + 0.5 * ground.tile_width, top + 0.5 * ground.tile_height, words,
                {.size_px = 13.0, .colour = sheet_faint, .anchor = "middle"});
}

void draw_pictures(Drawing& canvas, const ContactSheet& sheet, const SheetGround& ground) {
    for (std::size_t i = 0; i < sheet.tiles.size(); ++i) {
        const SheetTile& tile = sheet.tiles[i];
        if (tile.not_drawn.empty())
            canvas.picture(ground.left_of(i), ground.top_of(i), ground.tile_width, ground.tile_height, pixels_of(tile.colour));
        else
            draw_empty(canvas, ground, i, "not rendered");
        draw_caption(canvas, ground, i, tile, tile.not_drawn.empty() ? kind_text(tile.row) : short_text(tile.not_drawn, 50));
    }
}

void draw_cross(Drawing& canvas, double x, double y) {
    for (const auto& [colour, width] : {std::pair(sheet_ink, 3.0), std::pair(cross, 1.2)}) {
        canvas.line({{x - 5.0, y}, {x + 5.0, y}}, {.colour = colour, .width_px = width});
        canvas.line({{x, y - 5.0}, {x, y + 5.0}}, {.colour = colour, .width_px = width});
    }
}

void draw_lux(Drawing& canvas, const ContactSheet& sheet, const SheetGround& ground) {
    for (std::size_t i = 0; i < sheet.tiles.size(); ++i) {
        const SheetTile& tile = sheet.tiles[i];
        const double left = ground.left_of(i), top = ground.top_of(i);
        if (tile.illuminance_lx.empty()) {
            draw_empty(canvas, ground, i, "not measured");
        } else {
            canvas.picture(left, top, ground.tile_width, ground.tile_height, plots::heat_map(tile.illuminance_lx, lux_axis()));
            if (sheet.spot_px)
                draw_cross(canvas, left + sheet.spot_px->x, top + sheet.spot_px->y);
        }
        draw_caption(canvas, ground, i, tile, spot_text(sheet, tile));
    }
}

void draw_bar(Drawing& canvas, double right, double top) {
    const plots::Axis axis = lux_axis();
    Image<plots::Colour> colours(static_cast<int>(scale_px), 1);
    for (int x = 0; x < colours.width(); ++x)
        colours.at(x, 0) = plots::sequential((x + 0.5) / colours.width());
    canvas.picture(right - scale_px, top, scale_px, 14.0, colours);
    for (const plots::Tick& tick : plots::ticks_of(axis, 10)) {
        const double x = right - scale_px + scale_px * plots::position(axis, tick.value);
        canvas.line({{x, top + 14.0}, {x, top + 19.0}}, {.colour = sheet_ink});
        canvas.text(x, top + 31.0, tick.label, {.size_px = 12.0, .colour = sheet_ink, .anchor = "middle"});
    }
    canvas.text(right - scale_px - 12.0, top + 12.0, "lx, logarithmic", {.size_px = 12.0, .colour = sheet_ink, .anchor = "end"});
}

} // namespace

ContactSheet new_sheet(const Stage& stage, const LampSet& lamp_set, const Moment& moment) {
    ContactSheet sheet;
    sheet.drive = stage.drive.name;
    sheet.title = stage.drive.title;
    sheet.lamp_set = lamp_set.name;
    sheet.moment = moment;
    sheet.view = small(*driver_view(stage.drive));
    sheet.spot_ahead_m = ahead_m;
    const Pose surface = stage.route.pose(moment.distance_m + stage.drive.bumper_m + ahead_m);
    sheet.spot = map_around(surface.position_m, moment);
    if (const auto seen = seen_at(camera_of(moment, sheet.view), sheet.view, surface.position_m - moment.ego.position_m))
        sheet.spot_px = glm::dvec2(*seen);
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

Plot contact_sheet(const ContactSheet& sheet) {
    const std::size_t rows = (sheet.tiles.size() + across - 1) / across;
    SheetGround ground{static_cast<double>(sheet.view.width_px), static_cast<double>(sheet.view.height_px), head_px};
    const double part_px = head_px + static_cast<double>(rows) * (ground.tile_height + caption_px);
    const double width_px = 2.0 * edge_px + across * ground.tile_width + (across - 1) * between_px, height_px = 2.0 * part_px;
    Drawing canvas{width_px, height_px, "Contact sheet of the techniques"};
    canvas.rectangle(0.0, 0.0, width_px, height_px, {.fill = "#ffffff"});
    const auto head = [&](double top, const std::string& title, const std::string& words) {
        canvas.text(edge_px, top + 26.0, title, {.size_px = 17.0, .colour = sheet_ink, .bold = true});
        canvas.text(edge_px, top + 46.0, words, {.size_px = 13.0, .colour = sheet_faint});
    };
    head(0.0, "One moment in every technique",
         fmt::format("{}, {}: after {:.2f} s, {:.1f} m along the route; the same exposure for all",
                     short_text(sheet.title.empty() ? sheet.drive : sheet.title, 80), short_text(sheet.lamp_set, 40), sheet.moment.time_s,
                     sheet.moment.distance_m));
    draw_pictures(canvas, sheet, ground);
    head(part_px, "Illuminance on the surfaces seen",
         fmt::format(
             "below each: at the cross, on the road in the own lane {:.0f} m ahead of the bumper, and its ratio to the {} of the own "
             "lamps, as the twin computes there",
             sheet.spot_ahead_m, lux_text(sheet.twin_lx)));
    draw_bar(canvas, width_px - edge_px - 14.0, part_px + 16.0);
    ground.top = part_px + head_px;
    draw_lux(canvas, sheet, ground);
    return {.name = "contact-sheet", .figure = std::move(canvas), .png_alone = true};
}

} // namespace fernlicht
