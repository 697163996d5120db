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
