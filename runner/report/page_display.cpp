#include "runner/display/seen_display.h"
#include "runner/report/clean_text.h"
#include "runner/report/page_parts.h"

#include <fmt/format.h>

namespace fernlicht {

kainjow::mustache::data display_part(const ComparedDrive& drive) {
    using kainjow::mustache::data;
    data part, rows{data::type::list};
    const SeenDisplay* const first = drive.variants.front()->display.get();
    part.set("was_seen", first != nullptr);
    if (first == nullptr)
        return part;
    part.set("profile", short_text(first->profile, 60));
    part.set("distance", fmt::format("{:g}", first->viewing_distance_m));
    part.set("pitch", fmt::format("{:g}", first->pixel_pitch_mm));
    const auto finer = [](bool is) { return is ? "yes" : "no"; };
    for (std::size_t i = 0; i < drive.variants.size(); ++i)
        if (const SeenDisplay* const seen = drive.variants[i]->display.get())
            for (const SeenView& view : seen->views) {
                data row;
                row.set("lamp", short_text(drive.variants[i]->variant, 40));
                row.set("colour", variant_colour(i));
                row.set("view", clean_text(view.view));
                row.set("scene", figure(view.size.scene_pixel_arcmin, 2));
                row.set("display", figure(view.size.display_pixel_arcmin, 2));
                row.set("magnification", figure(view.size.magnification(), 3));
                row.set("life_size", figure(view.size.life_size_m, 2));
                row.set("finer_by_day", finer(view.finer_by_day()));
                row.set("shown", view.mean_cdm2.has_value());
                if (view.mean_cdm2) {
                    row.set("mean", fmt::format("{:.3g}", *view.mean_cdm2));
                    row.set("resolved", figure(*view.resolved(), 2));
                    row.set("finer", finer(view.size.display_pixel_arcmin <= *view.resolved()));
                }
                rows.push_back(row);
            }
    part.set("rows", rows);
    return part;
}

} // namespace fernlicht
