#include "runner/experiments/run/page_parts.h"
#include "runner/files/clean_text.h"
#include "runner/play/drawn_by.h"
#include "runner/play/shadows/choose_shadows.h"
#include "scenarios/drives/keys/shadow_keys.h"

#include <fmt/format.h>

namespace fernlicht {

kainjow::mustache::data shadows_part(const ComparedDrive& drive) {
    using kainjow::mustache::data;
    data part;
    const DrawnBy* const drawn = drive.variants.front()->drawn_by.get();
    part.set("was_drawn", drawn != nullptr);
    if (drawn) {
        std::string settings;
        for (const auto& [key, text] : used_shadow_keys(drawn->shadows))
            if (key != "redraw_texels" || drawn->shadows.redraw_texels > 0.0)
                settings += fmt::format("{}{} {}", settings.empty() ? "" : ", ", key, text);
        part.set("method", std::string(name(drawn->shadows.method)));
        part.set("settings", settings.empty() ? "" : " (" + settings + ")");
        part.set("casts_nothing", !drawn->shadows.things_cast);
        part.set("has_instead", !drawn->shadows_instead.empty());
        part.set("instead", drawn->shadows_instead);
        part.set("technique", clean_text(drive.variants.front()->technique));
    }
    const ShadowChoice* const choice = drive.variants.front()->shadows.get();
    part.set("was_chosen", choice != nullptr);
    if (choice == nullptr)
        return part;
    part.set("chosen", std::string(name(choice->chosen)));
    part.set("why", choice->why);
    part.set("moments", fmt::format("{}", choice->ticks));
    part.set("shadowed", fmt::format("{}", choice->ticks_shadowed));
    part.set("compared", fmt::format("{}", choice->compared));
    part.set("bound", figure(100.0 * choice->bound, 2));
    data rows{data::type::list};
    for (const TriedShadows& tried : choice->tried) {
        data row;
        row.set("method", std::string(name(tried.method)));
        row.set("drew", tried.error.has_value());
        row.set("error", figure(100.0 * tried.error.value_or(0.0), 2));
        row.set("time", figure(tried.worst_s, 2));
        row.set("lamp", short_text(tried.worst_set, 40));
        row.set("view", short_text(tried.worst_view, 40));
        row.set("pictures", fmt::format("{}", tried.pictures));
        row.set("refused", clean_text(tried.refused));
        rows.push_back(row);
    }
    part.set("tried", !choice->tried.empty());
    part.set("rows", rows);
    return part;
}

} // namespace fernlicht
