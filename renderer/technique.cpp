#include "renderer/technique.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <vector>

namespace fernlicht {
namespace {

constexpr const char* ours = "fernlicht";

// Where a row of the thesis leaves a choice open, the constants are in light_map.h.
constexpr const char* thesis_table = "Knebel 2004, Table 6.1";
constexpr const char* thesis_text = "Knebel 2004, other ways it describes";
constexpr const char* no_shadows = "incidence angle, shadows, the lamps' colour";

constexpr std::array rows{
    Technique{
        "plain", TechniqueKind::as_published, 1, ">= 60", thesis_table,
        "surface's colour or texture times the fixed pipeline's ambient light, 0.2 at night up to 1 by day; no illuminance anywhere in it",
        "headlamps, incidence angle, shadows", 1, false, false, false, "TONE=SHARE AMBIENT=1"},
    Technique{"scene-graph-projective", TechniqueKind::as_published, 2, ">= 60", thesis_table,
              "surface's colour or texture times the sum of ambient light and the beam textures in shares of their peak, clamped: what "
              "fixed-function projective texturing gives, and no illuminance, since a peak is white at any distance",
              "incidence angle, distance, which side of the lamp a point is on, shadows, the lamps' colour", 1, false, false, false,
              "LIGHT=PROJECTED TONE=SHARE AMBIENT=1"},
    Technique{"texturing-only", TechniqueKind::as_published, 3, ">= 60", thesis_table,
              "transform, texture coordinates and the surface's colour or texture as it is, in shaders; nothing is lit", "all light", 1,
              false, false, false, ""},
    Technique{"full", TechniqueKind::as_published, 4, "~22", thesis_table,
              "E = sum of I / (1 + d^2) + sun per fragment, I from projected beam textures, d per lamp, computed per vertex and "
              "interpolated; rational tone mapper; sheeting of signs glows instead of reflecting and fades to 0 at 500 m; their sum times "
              "the surface's colour or texture",
              no_shadows, 1, true, false, false, "LIGHT=PROJECTED DISTANCE=SQUARED BEHIND=EACH TONE=RATIONAL SUN=1 EMISSIVE=FADING"},
    Technique{"full-vertex-only", TechniqueKind::as_published, 5, ">= 60", thesis_table,
              "the vertex work of full; per fragment only its textures: the surface's times the sum of the beams' in shares of their peak; "
              "distances are passed on and not used, so there is no illuminance",
              "incidence angle, distance, sky, which side of the lamp a point is on, shadows, the lamps' colour", 1, false, false, false,
              "LIGHT=PROJECTED DISTANCE=SQUARED TONE=SHARE EMISSIVE=FADING FRAGMENT_TEXTURES_ONLY=1"},
    Technique{"full-fragment-only", TechniqueKind::as_published, 6, "~22", thesis_table,
              "the fragment work of full on constants from the vertex stage: every point lies on each lamp's axis 25 m away, which is work "
              "to be timed and no illuminance",
              "where a point is; as full", 1, false, false, false,
              "LIGHT=PROJECTED DISTANCE=SQUARED BEHIND=EACH TONE=RATIONAL SUN=1 EMISSIVE=FADING CONSTANTS=1"},
    Technique{
        "full-no-sun", TechniqueKind::as_published, 7, "~26", thesis_table,
        "full without sun, neither as light nor in the tone mapper's range; only the lamp farthest left is kept from shining backwards",
        "sky; as full", 1, true, false, false, "LIGHT=PROJECTED DISTANCE=SQUARED BEHIND=FIRST TONE=RATIONAL EMISSIVE=FADING"},
    Technique{"full-clamped", TechniqueKind::as_published, 8, "~30", thesis_table,
              "full, shown by clamping its lux at 100 in place of the tone mapper (the lux image is not clamped)", no_shadows, 1, true,
              false, false, "LIGHT=PROJECTED DISTANCE=SQUARED BEHIND=EACH TONE=CLAMPED SUN=1 EMISSIVE=FADING"},
    Technique{"full-unsquared", TechniqueKind::as_published, 9, "~25", thesis_table, "full with I / (1 + d), which it takes for lux",
              no_shadows, 1, true, false, false, "LIGHT=PROJECTED DISTANCE=UNSQUARED BEHIND=EACH TONE=RATIONAL SUN=1 EMISSIVE=FADING"},
    Technique{"full-one-distance", TechniqueKind::as_published, 10, "~30", thesis_table,
              "full with the distance to the lamp farthest left for all lamps", no_shadows, 1, true, false, false,
              "LIGHT=PROJECTED DISTANCE=SQUARED ONE_DISTANCE=1 BEHIND=EACH TONE=RATIONAL SUN=1 EMISSIVE=FADING"},
    Technique{"simplified", TechniqueKind::as_published, 11, "~56", thesis_table,
              "E = sum of the lux that the beams have at 25 m, at any distance; lamps aimed 0.92 degrees further down, so that a cut-off "
              "1 % down meets the road where these lux hold; in front of the lamp farthest right counts for all; clamped at 100 lx; "
              "sheeting of signs glows at any distance",
              "distance, sky; as full", 1, true, false, false, "LIGHT=PROJECTED BEHIND=LAST TONE=CLAMPED EMISSIVE=SCALAR LOWERED=1"},
    Technique{
        "as-printed", TechniqueKind::as_printed, 0, "", "Knebel 2004, the formulas as they stand in print",
        "full with the projection's q = 1 + z, so that the beam is twice as wide 1 m ahead and points up to 1 m behind the lamp are lit; "
        "the test q >= 0; the length of a 4-vector for d, so that E = I / (2 + d^2); both d from the lamp farthest left",
        no_shadows, 1, true, false, false,
        "LIGHT=PROJECTED DISTANCE=PRINTED ONE_DISTANCE=1 BEHIND=EACH_PRINTED MATRIX=PRINTED TONE=RATIONAL SUN=1 EMISSIVE=FADING"},
    Technique{
        "vertex-spots", TechniqueKind::known, 0, "", thesis_text,
        "E = sum of I cos / d^2 per vertex and interpolated, I from 8 spot lights of OpenGL 1.x fitted to each beam; clamped at 100 lx "
        "per vertex",
        "all of a beam that lies between two vertices or is narrower than a spot light; shadows, the lamps' colour", 1, true, false, false,
        "LIGHT=SPOTS TONE=CLAMPED SUN=1 EMISSIVE=SCALAR"},
    Technique{"vertex-projective", TechniqueKind::known, 0, "", thesis_text,
              "full's lux and tone mapper per vertex, beam textures too, and interpolated",
              "all of a beam that lies between two vertices; as full", 1, true, false, false,
              "LIGHT=VERTEX_PROJECTED DISTANCE=SQUARED BEHIND=EACH TONE=RATIONAL SUN=1 EMISSIVE=SCALAR"},
    Technique{"two-pass-projective", TechniqueKind::known, 0, "", thesis_text,
              "first pass: the sky's light and signs that glow; second pass: full's lux of all lamps; each clamped at 100 lx times the "
              "surface's colour or texture, added by blending",
              no_shadows, 2, true, false, false, "LIGHT=PROJECTED DISTANCE=SQUARED BEHIND=EACH TONE=CLAMPED SUN=1 EMISSIVE=SCALAR"},
    Technique{"merged-beams", TechniqueKind::known, 0, "", thesis_text,
              "full with one projection, one texture and one distance for all lamps, from midway between them, right 25 m ahead; made anew "
              "when a lamp moves or changes its level",
              "that the lamps stand apart; as full", 1, true, false, false,
              "LIGHT=PROJECTED DISTANCE=SQUARED BEHIND=EACH TONE=RATIONAL SUN=1 EMISSIVE=FADING MERGED=1"},
    Technique{"light-map-2d", TechniqueKind::known, 0, "", thesis_text,
              "E = I cos / d^2 of the plane that the car stands on, baked into a map of 100 by 50 m, on whatever stands above or below it, "
              "plus sun; baked anew when a lamp moves or changes its level",
              "that the road bends and that things stand up; light beyond the map, shadows, the lamps' colour", 1, true, false, false,
              "LIGHT=GROUND_MAP TONE=RATIONAL SUN=1 EMISSIVE=FADING"},
    Technique{
        "light-map-3d", TechniqueKind::known, 0, "", thesis_text,
        "E = I / d^2, baked into a volume of 100 by 50 by 8 m around the car, plus sun; baked anew when a lamp moves or changes its level",
        "what is finer than a cell, light beyond the volume; as full", 1, true, false, false,
        "LIGHT=VOLUME_MAP TONE=RATIONAL SUN=1 EMISSIVE=FADING"},
    Technique{"axial-distance", TechniqueKind::known, 0, "", thesis_text,
              "full with the depth along the lamp's axis in place of the distance, per fragment from the projection itself: E = I / z^2, "
              "1 / z = (1 - r/q) / near",
              no_shadows, 1, true, false, false, "LIGHT=PROJECTED DISTANCE=AXIAL BEHIND=EACH TONE=RATIONAL SUN=1 EMISSIVE=FADING"},
    Technique{
        "photometric", TechniqueKind::ours, 0, "", ours,
        "E = I cos / d^2 per fragment for each lamp, I from the candela table in float; a shadow map per lamp; diffuse and retroreflecting "
        "surfaces; pruned to what the moment needs",
        "light reflected twice; the extent of lamps; shadows of what stands farther than 300 m from an own lamp; in the light of "
        "other vehicles' and street lamps: shadows in fog, of faint light and of more than 16 lamps",
        1, true, true, true, ""},
    Technique{"photometric-unpruned", TechniqueKind::ours, 0, "", ours,
              "photometric with everything compiled in and nothing culled, to the same bytes", "as photometric", 1, true, true, true, ""},
    Technique{"photometric-naive", TechniqueKind::ours, 0, "", ours,
              "the equations of photometric as they stand, in a loop over the lamps, every look-up by hand, shadow maps of everything",
              "light of other vehicles' and street lamps; as photometric", 1, true, true, true, ""},
};

} // namespace

std::span<const Technique> techniques() { return rows; }

const Technique& technique_named(std::string_view name, const std::filesystem::path& asked_in, const std::string& key) {
    const auto found = std::ranges::find(rows, name, &Technique::name);
    if (found != rows.end())
        return *found;
    std::vector<std::string> names;
    for (const Technique& row : rows)
        names.emplace_back(row.name);
    const std::string wanted(name), nearest = nearest_name(wanted, names);
    throw InputError({asked_in, 0, 0, key}, "found '" + printable(wanted) + "'",
                     nearest.empty() ? "a name that `fernlicht techniques` lists"
                                     : "'" + nearest + "', or another name that `fernlicht techniques` lists");
}

} // namespace fernlicht
