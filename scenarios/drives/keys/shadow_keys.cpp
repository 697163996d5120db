#include "scenarios/drives/keys/shadow_keys.h"

#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/schema.h"
#include "scenarios/fields/write_fields.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <initializer_list>

namespace fernlicht {
namespace {

constexpr int min_texels = 16, max_texels = 8192;

std::vector<std::string_view> words_for_methods() {
    std::vector<std::string_view> names;
    for (const ShadowMethodName& row : shadow_method_names())
        names.push_back(row.name);
    names.push_back(name(ShadowMethod::automatic));
    return names;
}

bool is_one_of(ShadowMethod method, std::initializer_list<ShadowMethod> methods) {
    return std::ranges::find(methods, method) != methods.end();
}

ShadowMethod method_of(const void* shadows) { return static_cast<const ShadowSettings*>(shadows)->method; }
bool shadows_anything(const void* shadows) { return method_of(shadows) != ShadowMethod::none; }
bool draws_own_maps(const void* shadows) {
    return !is_one_of(method_of(shadows), {ShadowMethod::none, ShadowMethod::under_car, ShadowMethod::planar, ShadowMethod::volumes});
}
bool has_discs(const void* shadows) { return is_one_of(method_of(shadows), {ShadowMethod::soft_map, ShadowMethod::automatic}); }
bool is_to_be_chosen(const void* shadows) { return method_of(shadows) == ShadowMethod::automatic; }

void read_texels(const YamlEntry& entry, ShadowSettings& shadows) {
    const std::vector<YamlEntry> sides = entry.list(2, 2);
    shadows.width = sides[0].whole(min_texels, max_texels);
    shadows.height = sides[1].whole(min_texels, max_texels);
}

std::string texels_text(const ShadowSettings& shadows) { return fmt::format("[{}, {}]", shadows.width, shadows.height); }

} // namespace

/// The first two keys beside the method are those of the maps of others' lamps, whatever the method.
const Fields<ShadowSettings>& shadow_fields() {
    using Shadows = ShadowSettings;
    static const Fields<Shadows> fields{
        field("method", 1, &Shadows::method, words(words_for_methods()), "auto: the cheapest that errs by no more than error_bound")
            .required(),
        own("map_texels", 2, read_texels, texels_text, R"({"type": "array", "minItems": 2, "maxItems": 2,
            "items": {"type": "integer", "minimum": 16, "maximum": 8192}})",
            "width and height of a map")
            .heard_if(shadows_anything),
        field("tolerance_m", 3, &Shadows::tolerance_m, range(1.0e-4, 1.0), "shadows are looked up from so far above a surface")
            .heard_if(shadows_anything),
        field("redraw_texels", 4, &Shadows::redraw_texels, range(0.0, 16.0), "a map is kept while no edge has moved by more; 0: never")
            .heard_if(draws_own_maps),
        field("lamp_radius_m", 5, &Shadows::lamp_radius_m, range(0.001, 0.5), "of the discs that lamps are").heard_if(has_discs),
        field("lamp_places", 6, &Shadows::lamp_places, range(1.0, 64.0), "maps of each lamp").heard_if(has_discs),
        field("error_bound", 7, &Shadows::error_bound, below(0.0, 1.0, "a share from 0 to below 1 (0.01 is 1 %)"),
              "share of what is lit without shadows that may be rendered wrongly")
            .heard_if(is_to_be_chosen),
    };
    return fields;
}

void read_shadows(const YamlEntry& given, ShadowSettings& shadows) {
    if (given.is_scalar()) {
        if (given.value().text == "true" || given.value().text == "false") {
            shadows.objects_cast = given.flag();
            shadows.method = shadows.objects_cast ? ShadowMethod::map : ShadowMethod::none;
        } else
            shadows.method = static_cast<ShadowMethod>(given.choice(words_for_methods()));
        return;
    }
    if (given.value().kind != YamlValue::Kind::map)
        given.refuse(fmt::format("true, false, one of {}, or a map with keys such as method", fmt::join(words_for_methods(), ", ")));
    read_group(shadow_fields(), given, &shadows);
}

std::vector<std::pair<std::string_view, std::string>> used_shadow_keys(const ShadowSettings& shadows) {
    std::vector<std::pair<std::string_view, std::string>> used;
    for (const Field& field : shadow_fields().fields)
        if (field.heard && field.heard(&shadows))
            used.emplace_back(field.key, value_text(field, &shadows));
    return used;
}

std::string shadows_text(const ShadowSettings& shadows) {
    if (!shadows.any())
        return shadows.objects_cast ? "none" : "false";
    const std::string keys = flow_text(shadow_fields(), &shadows);
    const ShadowSettings usual;
    return keys == flow_text(shadow_fields(), &usual) ? "true" : "{" + keys + "}";
}

std::string shadows_schema() {
    ShadowSettings scratch;
    return fmt::format(R"({{"anyOf": [{{"type": "boolean"}}, {{"enum": ["{}"]}}, {}]}})", fmt::join(words_for_methods(), "\", \""),
                       schemas_by_word(shadow_fields(), &scratch));
}

} // namespace fernlicht
