// How shadows of lamps are drawn (docs/shadows.md).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace fernlicht {

/// automatic: to be chosen among the others for the drive (no row of the table). none: light goes through everything. under_car: the ground
/// under bodies is dark. planar: shadows flattened onto the road's plane. volumes: the space behind silhouettes, by stencil. map: a depth
/// map for each lamp. one_map: one for all, from midway between those that shine. perspective_map, light_space_map: warped towards what the
/// view sees. soft_map: several for each lamp, which is a disc.
enum class ShadowMethod { none, under_car, planar, volumes, map, one_map, perspective_map, light_space_map, soft_map, automatic };

/// A row of the table of shadow methods.
struct ShadowMethodName {
    ShadowMethod method;
    std::string_view name; ///< as in files and on the command line
    std::string_view origin, computes, ignores;
};
/// All of them, in the order of the table of techniques.
std::span<const ShadowMethodName> shadow_method_names();
std::string_view name(ShadowMethod method); ///< "auto" for automatic
/// "auto" too. Throws InputError, asked in that file by that key or flag, naming the nearest.
ShadowMethod shadow_method_named(const std::string& name, const std::filesystem::path& asked_in = {}, const char* asked_by = "shadows");

struct ShadowSettings {
    ShadowMethod method = ShadowMethod::map;
    int width = 1024, height = 512; ///< texels of a map; 16..8192
    double tolerance_m = 0.03; ///< maps, those of others' lamps too: shadows are looked up from points at least this far above a surface;
                               ///< planar: ground lies so near to one plane; > 0

    double redraw_texels = 0.0;  ///< maps: one is kept while no shadow's edge has moved by more than this; 0..16; 0: never
    double lamp_radius_m = 0.06; ///< soft_map: of the discs that lamps are; 0.001..0.5
    int lamp_places = 16;        ///< soft_map: maps of each lamp; 1..64
    bool objects_cast = true;    ///< false: nothing throws a shadow, for rays either; only with none (`shadows: false`)
    double error_bound = 0.01;   ///< automatic: largest share of what is lit without shadows that may be drawn wrongly; 0..<1

    bool operator==(const ShadowSettings&) const = default;
    bool any() const { return method != ShadowMethod::none; }
};
/// `shadows: false` stays so with none alone: any other method is for things that cast.
void set_shadow_method(ShadowSettings& shadows, ShadowMethod method);

} // namespace fernlicht
