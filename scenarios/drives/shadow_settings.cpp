#include "scenarios/drives/shadow_settings.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr ShadowMethodName methods_by_name[] = {
    {ShadowMethod::none, "none", "", "nothing: light goes through everything", "all shadows"},
    {ShadowMethod::under_car, "under-car", "Knebel 2004, chapter on shadows",
     "a dark polygon under each body that moves: the ground within its outline from above gets no light of the own lamps",
     "every cast shadow: what stands before a lamp lets its light pass, and upright things are lit wherever they stand"},
    {ShadowMethod::planar, "planar", "Blinn 1988",
     "casters flattened onto the road's plane by a projection from each lamp, in a stencil buffer; drives whose ground is not one plane "
     "are "
     "refused",
     "shadows on upright things; the extent of lamps; what stands farther than 300 m from a lamp"},
    {ShadowMethod::volumes, "volumes", "Crow 1977; Everitt, Kilgard 2002; Aldridge, Woods 2004",
     "silhouettes extruded away from each lamp to infinity, counted in a stencil buffer behind each pixel's surface",
     "ground that hides other ground by less than 0.5 mm; the extent of lamps; what stands farther than 300 m from a lamp"},
    {ShadowMethod::map, "map", "Williams 1978; Reeves, Salesin, Cook 1987",
     "a depth map for each lamp, fitted to its beam; four texels compared and weighted, ground where it is, all else from a point raised "
     "by what a texel spans there",
     "what is smaller than half a texel, and on things that stand 1.5; the extent of lamps; what stands farther than 300 m from a lamp"},
    {ShadowMethod::one_map, "one-map", "Knebel 2004",
     "one depth map for all lamps, from midway between those that shine, over all their beams",
     "as map, and the lamps' distance from midway: edges shift by that times (distance over the caster's, less 1)"},
    {ShadowMethod::perspective_map, "perspective-map", "Stamminger, Drettakis 2002",
     "as map, warped by the view's perspective and fitted to what the view sees of the beam", "as map"},
    {ShadowMethod::light_space_map, "light-space-map", "Wimmer, Scherzer, Purgathofer 2004",
     "as map, warped by a perspective across the light and fitted to what the view sees of the beam", "as map"},
    {ShadowMethod::soft_map, "soft-map", "Brotman, Badler 1984; Herf, Heckbert 1996",
     "the mean over depth maps from places on the lamp's face, a disc: penumbrae", "as map, but for the extent of lamps"},
};

} // namespace

std::span<const ShadowMethodName> shadow_method_names() { return methods_by_name; }

std::string_view name(ShadowMethod method) {
    if (method == ShadowMethod::automatic)
        return "auto";
    return std::ranges::find(methods_by_name, method, &ShadowMethodName::method)->name;
}

void set_shadow_method(ShadowSettings& shadows, ShadowMethod method) {
    shadows.method = method;
    shadows.objects_cast |= method != ShadowMethod::none;
}

ShadowMethod shadow_method_named(const std::string& name, const std::filesystem::path& asked_in, const char* asked_by) {
    if (name == "auto")
        return ShadowMethod::automatic;
    std::vector<std::string> known{"auto"};
    for (const ShadowMethodName& row : methods_by_name) {
        if (row.name == name)
            return row.method;
        known.emplace_back(row.name);
    }
    const std::string nearest = nearest_name(name, known);
    throw InputError({asked_in, 0, 0, asked_by}, "found '" + printable(name) + "'",
                     fmt::format("one of {}{}", fmt::join(known, ", "), nearest.empty() ? "" : " (nearest: '" + nearest + "')"));
}

} // namespace fernlicht
