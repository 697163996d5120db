#include "renderer/technique.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <vector>

namespace fernlicht {
namespace {

constexpr const char* ours = "fernlicht";

constexpr std::array rows{
    Technique{
        "photometric", TechniqueKind::ours, 0, "", ours,
        "E = I cos / d^2 per fragment for each lamp, I from the candela table in float; a shadow map per lamp; diffuse and retroreflecting "
        "surfaces; compiled and drawn for what the moment needs",
        "light reflected twice; the extent of lamps", 1, true, true, true, ""},
    Technique{"photometric-unpruned", TechniqueKind::ours, 0, "", ours,
              "photometric with everything compiled in and nothing culled, to the same bytes", "as photometric", 1, true, true, true, ""},
    Technique{"photometric-naive", TechniqueKind::ours, 0, "", ours,
              "the equations of photometric as they stand, in a loop over the lamps, every look-up by hand, shadow maps of everything",
              "as photometric", 1, true, true, true, ""},
};

} // namespace

std::span<const Technique> techniques() { return rows; }

const Technique& technique_named(std::string_view name) {
    const auto found = std::ranges::find(rows, name, &Technique::name);
    if (found != rows.end())
        return *found;
    std::vector<std::string> names;
    for (const Technique& row : rows)
        names.emplace_back(row.name);
    const std::string wanted(name), nearest = nearest_name(wanted, names);
    throw InputError({{}, 0, 0, "technique"}, "found '" + printable(wanted) + "'",
                     nearest.empty() ? "a name that `fernlicht techniques` lists"
                                     : "'" + nearest + "', or another name that `fernlicht techniques` lists");
}

} // namespace fernlicht
