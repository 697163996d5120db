#include "scenarios/drives/shadow_settings.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr ShadowMethodName names[] = {
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
     "ground that hides other ground by less than tolerance_m; the extent of lamps; what stands farther than 300 m from a lamp"},
    {ShadowMethod::map, "map", "Williams 1978; Reeves, Salesin, Cook 1987",
     "a depth map for each lamp, fitted to its beam; four texels compared and weighted, from a point raised by what a texel spans there",
     "bodies lower than 1.5 texels; the extent of lamps; what stands farther than 300 m from a lamp"},
};

} // namespace

std::span<const ShadowMethodName> shadow_method_names() { return names; }

std::string_view name(ShadowMethod method) { return std::ranges::find(names, method, &ShadowMethodName::method)->name; }

ShadowMethod shadow_method_named(const std::string& name, const std::filesystem::path& asked_in) {
    std::vector<std::string> known;
    for (const ShadowMethodName& row : names) {
        if (row.name == name)
            return row.method;
        known.emplace_back(row.name);
    }
    const std::string nearest = nearest_name(name, known);
    throw InputError({asked_in, 0, 0, "shadows"}, "found '" + printable(name) + "'",
                     fmt::format("one of {}{}", fmt::join(known, ", "), nearest.empty() ? "" : " (nearest: '" + nearest + "')"));
}

} // namespace fernlicht
