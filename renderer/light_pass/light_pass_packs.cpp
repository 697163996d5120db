#include "renderer/light_pass/light_pass_packs.h"

#include "scenarios/packs/photometry.h"

namespace fernlicht::packs::FERNLICHT_LEVEL {
namespace {

using photometry::dot, photometry::vec2, photometry::vec3, photometry::vec4;

constexpr std::int32_t pack_width = static_cast<std::int32_t>(lanes);

vec3 in_all(const float* three) { return {three[0], three[1], three[2]}; }
vec3 select(Mask mask, const vec3& a, const vec3& b) {
    return {packs::FERNLICHT_LEVEL::select(mask, a.x, b.x), packs::FERNLICHT_LEVEL::select(mask, a.y, b.y),
            packs::FERNLICHT_LEVEL::select(mask, a.z, b.z)};
}
Floats in_row(const float* row, const vec3& p) { return row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]; }

/// What the pixels of a pack show.
struct Shown {
    Mask seen, curved, ground;              ///< curved: with a normal that is not yet of unit length
    std::int32_t all_of = 0;                ///< id that every pixel has; 0: none
    const PassMaterial* material = nullptr; ///< of that
    vec3 nearness, normal_x, normal_y, normal_z, albedo, emission, tint;
    Floats nearest, farthest, rl, retro_reference, retro_inverse_falloff, gloss, roughness;
    Ints mesh;
    bool lit, shadowed, retroreflecting, emissive, glossy, any_curved;
};

void show_material(Shown& s, Mask here, const PassMaterial& m, Ints texels) {
    vec3 albedo = in_all(m.albedo);
    Floats rl = m.rl;
    if (m.texture_mode >= 0) {
        const auto channel = [texels](int shift) { return to_floats((texels >> shift) & Ints(255)) * (1.0 / 255.0); };
        albedo = photometry::combined_reflectance(m.texture_mode, albedo, vec4(channel(0), channel(8), channel(16), channel(24)),
                                                  in_all(m.blend));
        rl = photometry::textured_rl_at(m.rl_per_y, albedo);
    }
    s.albedo = select(here, albedo, s.albedo);
    if (m.retroreflecting)
        s.rl = select(here, rl, s.rl);
}

void show(Shown& s, Mask here, const PassTriangle& t, Ints texels) {
    const PassMaterial& m = *t.material;
    const auto put = [here](Floats& to, float value) { to = select(here, value, to); };
    const auto put_three = [here](vec3& to, const float* values) { to = select(here, in_all(values), to); };
    put_three(s.nearness, t.nearness);
    put_three(s.normal_x, t.normal);
    put_three(s.normal_y, t.normal + 3);
    put_three(s.normal_z, t.normal + 6);
    put(s.nearest, t.nearest);
    put(s.farthest, t.farthest);
    s.mesh = select(here, Ints(t.mesh), s.mesh);
    if (!t.flat) {
        s.curved = s.curved || here;
        s.any_curved = true;
    }
    show_material(s, here, m, texels);
    if (t.ground)
        s.ground = s.ground || here;
    s.lit = s.lit || t.lit;
    s.shadowed = s.shadowed || t.shadowed;
    if (m.retroreflecting) {
        put(s.retro_reference, m.retro_reference);
        put(s.retro_inverse_falloff, m.retro_inverse_falloff);
        put_three(s.tint, m.tint);
        s.retroreflecting = true;
    }
    if (m.glossy) {
        put(s.gloss, m.gloss);
        put(s.roughness, m.roughness);
        s.glossy = true;
    }
    if (m.emissive) {
        put_three(s.emission, m.emission);
        s.emissive = true;
    }
}

/// Candela towards w (lamp space, 1 / |w| known); 0 behind the lamp and outside its table.
Floats intensity_towards(const PassLamp& lamp, const vec3& w, Floats inverse_d) {
    const vec2 at = photometry::beam_position(photometry::quick_goniometer_angles(w, inverse_d, lamp.steep),
                                              vec4(lamp.grid[0], lamp.grid[1], lamp.grid[2], lamp.grid[3]));
    const Floats none = 0.0, columns = lamp.count[0], rows = lamp.count[1];
    const Mask known = w.z > none && photometry::beam_known(at, vec2(columns, rows)) > none;
    if (!any(known))
        return none;
    const Ints column = to_ints(min(columns - 1.0, max(none, at.x))), row = to_ints(min(rows - 1.0, max(none, at.y)));
    const std::int32_t stride = static_cast<std::int32_t>(lamp.count[0]) + 1;
    const Ints first = row * Ints(stride) + column;
    // The next row of pixels looks further down, while these come from far.
    for (const std::size_t lane : {std::size_t{0}, lanes - 1})
        if (const std::int32_t below = first.v[lane] - stride; below > 0)
            __builtin_prefetch(lamp.cd + below);
    const Pair lower = gather_pair(lamp.cd, first), upper = gather_pair(lamp.cd + stride, first);
    const Floats cd = lamp.factor * photometry::bilinear(lower.first, lower.second, upper.first, upper.second,
                                                         vec2(at.x - to_floats(column), at.y - to_floats(row)));
    return select(known, cd, none);
}

/// Share of the lamp that is seen from p, weighted over four texels. What lies outside the maps, or behind what they can show, is lit.
Floats visibility(const PassShadow& shadow, const float* depths, const vec3& p, Mask asked) {
    const Floats w = in_row(shadow.rows + 8, p), inverse = 1.0 / w, none = 0.0, all = 1.0;
    const Floats qx = in_row(shadow.rows, p), qy = in_row(shadow.rows + 4, p), depth = shadow.near * inverse;
    const Floats across = static_cast<float>(shadow.width), up = static_cast<float>(shadow.height);
    Floats seen = none;
    for (std::int32_t layer = 0; layer < shadow.layers; ++layer) {
        const Floats x = (qx - shadow.shifts[2 * layer]) * inverse * across - 0.5,
                     y = (qy - shadow.shifts[2 * layer + 1]) * inverse * up - 0.5;
        if (!any(asked && x > shadow.box[0] && x < shadow.box[1] && y > shadow.box[2] && y < shadow.box[3])) {
            seen += all;
            continue;
        }
        const Floats inside_x = min(across - 1.0, max(none, x)), inside_y = min(up - 1.0, max(none, y));
        const Ints column = min(to_ints(inside_x), Ints(shadow.width - 2)), row = min(to_ints(inside_y), Ints(shadow.height - 2));
        const Ints first = row * Ints(shadow.width) + column;
        const float* map =
            depths + static_cast<std::size_t>(layer) * static_cast<std::size_t>(shadow.width) * static_cast<std::size_t>(shadow.height);
        const Pair lower = gather_pair(map, first), upper = gather_pair(map + shadow.width, first);
        const auto passed = [&](Floats texel) { return select(depth >= texel, all, none); };
        seen += photometry::bilinear(passed(lower.first), passed(lower.second), passed(upper.first), passed(upper.second),
                                     vec2(inside_x - to_floats(column), inside_y - to_floats(row)));
    }
    if (shadow.layers > 1)
        seen = seen * (1.0F / static_cast<float>(shadow.layers));
    return select(w > none, seen, all);
}

/// What lamps bring: lux, and what retroreflection and gloss make of it; in colour where they differ in it.
struct Light {
    Floats illuminance = 0.0, target = 0.0, returned = 0.0, mirrored = 0.0;
    vec3 coloured{0.0, 0.0, 0.0}, returned_coloured{0.0, 0.0, 0.0}, mirrored_coloured{0.0, 0.0, 0.0};
};

/// Of unit length.
vec3 towards_eye(const PassPicture& picture, const vec3& p) {
    const Floats none = 0.0;
    return picture.is_map ? vec3(none, none, -1.0) : vec3(none, none, none) - p * inversesqrt(dot(p, p));
}

void add_lamp(Light& sum, const PassPicture& picture, const PassLamp& lamp, const Shown& s, const vec3& p, const vec3& n, Floats lift,
              bool seen) {
    const Floats none = 0.0;
    const vec3 v = p - in_all(lamp.position), w = photometry::lamp_space(v, in_all(lamp.right), in_all(lamp.up), in_all(lamp.forward));
    const Floats inverse_d = inversesqrt(dot(w, w)), cosine = max(-dot(n, v) * inverse_d, 0.0);
    if (any(s.seen && cosine > none && w.z > none)) {
        Floats e_perp = photometry::facing_illuminance_at(intensity_towards(lamp, w, inverse_d), inverse_d);
        const Mask lit = s.seen && cosine > none && e_perp > none;
        if (any(lit)) {
            if (s.shadowed && lamp.shadow != nullptr)
                e_perp = e_perp * visibility(*lamp.shadow, lamp.shadow->depth,
                                             p + n * (lift * max(lamp.shadow->tolerance, in_row(lamp.shadow->rows + 12, p))), lit);
            e_perp = select(lit, e_perp, none);
            const Floats e = select(lit, e_perp * cosine, none);
            sum.illuminance += e;
            const vec3 colour = in_all(lamp.colour);
            if (seen && picture.colour_of_all == nullptr)
                sum.coloured = sum.coloured + colour * e;
            if (seen && s.retroreflecting) {
                const vec3 to_eye = picture.is_map ? vec3(none, none, -1.0) : vec3(none - p.x, none - p.y, none - p.z);
                const Floats angle = photometry::quick_observation_angle(vec3(none - v.x, none - v.y, none - v.z), to_eye);
                const Floats l = photometry::retro_luminance(s.rl, e_perp, cosine, angle, s.retro_reference, s.retro_inverse_falloff);
                if (picture.colour_of_all == nullptr)
                    sum.returned_coloured = sum.returned_coloured + colour * l;
                else
                    sum.returned += l;
            }
            if (seen && s.glossy) {
                const vec3 to_lamp = vec3(none, none, none) - v * inverse_d;
                const Floats mirrored =
                    photometry::facet_mirrored(n, to_lamp, towards_eye(picture, p), s.roughness, photometry::facet_index);
                const Floats l = select(lit && s.gloss > none, e_perp * s.gloss * mirrored, none);
                if (picture.colour_of_all == nullptr)
                    sum.mirrored_coloured = sum.mirrored_coloured + colour * l;
                else
                    sum.mirrored += l;
            }
        }
    }
    if (picture.target == nullptr)
        return;
    const vec3 above = w + in_all(lamp.raise);
    const Floats inverse_above = inversesqrt(dot(above, above));
    Floats e = photometry::facing_illuminance_at(intensity_towards(lamp, above, inverse_above), inverse_above);
    const Mask lit = s.seen && e > none;
    if (s.shadowed && lamp.shadow != nullptr && any(lit))
        e = e * visibility(*lamp.shadow, lamp.shadow->target_depth, p + in_all(lamp.raise_in_camera), lit);
    sum.target += select(lit, e, none);
}

Floats toned(const PassPicture& picture, Floats l) {
    const Floats l_max = picture.tone_l_max, s = picture.tone_s;
    if (picture.tone_kind == 0)
        return photometry::tone_linear(l, l_max);
    return picture.tone_kind == 1 ? photometry::tone_rational(l, l_max, s) : photometry::tone_logarithmic(l, l_max, s);
}

/// 8 bits; of what is no number 0.
Ints encoded(Floats share) { return to_ints(photometry::quick_srgb_encoded(min(1.0, max(0.0, share))) * 255.0 + 0.5); }

/// `count` of the pack's numbers; a whole pack at once.
template <class Pack, class Number> void put(Pack pack, Number* to, std::int32_t count) {
    if (count == pack_width) {
        store(pack, to);
        return;
    }
    Number all[lanes];
    store(pack, all);
    __builtin_memcpy(to, all, static_cast<std::size_t>(count) * sizeof(Number));
}

struct Place {
    std::size_t first; ///< pixel
    std::int32_t count;
};

void put_colour(const PassPicture& picture, Place at, Ints rgb) {
    std::int32_t all[lanes];
    store(rgb, all);
    unsigned char* to = picture.colour + 3 * at.first;
    for (std::int32_t i = 0; i + 1 < at.count; ++i, to += 3) // the fourth byte is the next pixel's
        __builtin_memcpy(to, all + i, 4);
    __builtin_memcpy(to, all + at.count - 1, 3);
}

void put_light(const PassPicture& picture, Place at, const vec3& light) {
    float r[lanes], g[lanes], b[lanes];
    store(light.x, r);
    store(light.y, g);
    store(light.z, b);
    float* to = picture.light + 3 * at.first;
    for (std::int32_t i = 0; i < at.count; ++i) {
        *to++ = r[i];
        *to++ = g[i];
        *to++ = b[i];
    }
}

Ints background(const PassPicture& picture) {
    return Ints(picture.background[0] | picture.background[1] << 8 | picture.background[2] << 16);
}

void put_nothing(const PassPicture& picture, Place at) {
    const Floats none = 0.0, sky = picture.sky_luminance;
    if (picture.colour != nullptr)
        put_colour(picture, at, background(picture));
    if (picture.light != nullptr)
        put_light(picture, at, {sky, sky, sky});
    if (picture.luminance != nullptr)
        put(sky, picture.luminance + at.first, at.count);
    for (float* const of : {picture.illuminance, picture.target, picture.depth})
        if (of != nullptr)
            put(none, of + at.first, at.count);
    if (picture.ids != nullptr)
        put(Ints(0), picture.ids + at.first, at.count);
}

/// `s`: of the pack before.
void show_pack(Shown& s, const PassPicture& picture, void* triangles, Ints ids, Ints texels) {
    std::int32_t all[lanes];
    store(ids, all);
    const Mask as_first = ids == Ints(all[0]);
    const bool alike = !any(!as_first);
    if (alike && s.material != nullptr && all[0] != 0 && all[0] == s.all_of) {
        if (s.material->texture_mode >= 0)
            show_material(s, as_first, *s.material, texels);
        return;
    }
    s = Shown{};
    s.seen = !(ids == Ints(0));
    for (Mask left = s.seen; any(left);) {
        const std::int32_t id = all[first_lane(left)];
        const Mask here = ids == Ints(id);
        const PassTriangle& triangle = picture.triangle(triangles, id);
        show(s, here, triangle, texels);
        s.material = triangle.material;
        left = left && !here;
    }
    s.all_of = alike ? all[0] : 0;
}

void light_pack(const PassPicture& picture, const Shown& s, Place at, Floats x, Floats y) {
    const Floats none = 0.0, one = 1.0;
    const Floats near = s.nearness.x * x + s.nearness.y * y + s.nearness.z;
    const Floats depth = min(s.farthest, max(s.nearest, picture.is_map ? near : one / near));
    const vec3 p = picture.is_map ? vec3(x, y, depth) : vec3(x * depth, y * depth, depth);
    vec3 n(s.normal_x.z, s.normal_y.z, s.normal_z.z);
    if (s.any_curved) {
        const auto of_place = [&](const vec3& row) { return row.x * x + row.y * y + row.z; };
        const vec3 normal(of_place(s.normal_x), of_place(s.normal_y), of_place(s.normal_z));
        n = select(s.curved, normal * inversesqrt(dot(normal, normal)), n);
    }
    const bool seen = picture.colour != nullptr || picture.luminance != nullptr || picture.light != nullptr;
    Light sum;
    const Floats lift = s.shadowed ? select(s.ground, one - dot(n, in_all(picture.upwards)), one) : one;
    if (s.lit)
        for (std::int32_t i = 0; i < picture.lamp_count; ++i)
            add_lamp(sum, picture, picture.lamps[i], s, p, n, lift, seen);
    const auto diffuse = [&](const vec3& lux) {
        return vec3(photometry::diffuse_luminance(s.albedo.x, lux.x), photometry::diffuse_luminance(s.albedo.y, lux.y),
                    photometry::diffuse_luminance(s.albedo.z, lux.z));
    };
    vec3 light(none, none, none);
    if (s.lit && seen) {
        if (picture.colour_of_all != nullptr) {
            const vec3 colour = in_all(picture.colour_of_all);
            sum.coloured = colour * sum.illuminance;
            sum.returned_coloured = colour * sum.returned;
            sum.mirrored_coloured = colour * sum.mirrored;
        }
        light = diffuse(sum.coloured);
        if (s.retroreflecting)
            light = light + s.tint * sum.returned_coloured;
        if (s.glossy)
            light = light + sum.mirrored_coloured;
    }
    if (picture.sky_lx > 0.0F) {
        const Floats e = photometry::sky_illuminance(picture.sky_lx, {none, none, dot(n, in_all(picture.upwards))});
        sum.illuminance += e;
        light = light + diffuse({e, e, e});
        if (s.glossy && seen) {
            const Floats cosine = photometry::facet_cosine(max(dot(n, towards_eye(picture, p)), none), s.roughness);
            const Floats l = s.gloss * picture.sky_luminance * photometry::dielectric_reflectance(cosine, photometry::facet_index);
            light = light + vec3(l, l, l);
        }
    }
    if (s.emissive)
        light = light + s.emission;
    if (picture.illuminance != nullptr)
        put(select(s.seen, sum.illuminance, none), picture.illuminance + at.first, at.count);
    if (picture.target != nullptr)
        put(sum.target, picture.target + at.first, at.count);
    if (picture.depth != nullptr)
        put(select(s.seen, depth, none), picture.depth + at.first, at.count);
    if (picture.ids != nullptr)
        put(select(s.seen, s.mesh, Ints(0)), picture.ids + at.first, at.count);
    if (!seen)
        return;
    const Floats luminance = 0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z, sky = picture.sky_luminance;
    if (picture.luminance != nullptr)
        put(select(s.seen, luminance, sky), picture.luminance + at.first, at.count);
    if (picture.light != nullptr)
        put_light(picture, at, select(s.seen, light, vec3(sky, sky, sky)));
    if (picture.colour != nullptr) {
        const Mask bright = s.seen && luminance > none;
        vec3 adapted = light;
        Floats weighed = luminance;
        if (const float* rows = picture.white_rows) {
            adapted = photometry::white_adapted(light, in_all(rows), in_all(rows + 3), in_all(rows + 6));
            weighed = 0.2126 * adapted.x + 0.7152 * adapted.y + 0.0722 * adapted.z;
        }
        const vec3 shown = select(bright, adapted * (toned(picture, luminance) / weighed), vec3(none, none, none));
        const Ints rgb = encoded(shown.x) | encoded(shown.y) << 8 | encoded(shown.z) << 16;
        put_colour(picture, at, select(s.seen, rgb, background(picture)));
    }
}

} // namespace

void light_rows(const PassPicture& picture, void* triangles, std::int32_t first_row, std::int32_t end_row) {
    float lane_numbers[lanes];
    for (std::size_t i = 0; i < lanes; ++i)
        lane_numbers[i] = static_cast<float>(i);
    Shown shown{};
    const Floats lane = load(lane_numbers), x_first = picture.x_first, x_step = picture.x_step;
    for (std::int32_t row = first_row; row < end_row; ++row) {
        const Floats y = picture.y_first + picture.y_step * row;
        const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width);
        for (std::int32_t column = 0; column < picture.width; column += pack_width) {
            const Place at{begin + static_cast<std::size_t>(column),
                           picture.width - column < pack_width ? picture.width - column : pack_width};
            const std::int32_t* visible = picture.visible + 2 * at.first;
            std::int32_t last[2 * lanes] = {};
            if (at.count < pack_width) {
                __builtin_memcpy(last, visible, static_cast<std::size_t>(2 * at.count) * sizeof *visible);
                visible = last;
            }
            const IntPair pixels = load_pairs(visible);
            if (!any(!(pixels.first == Ints(0)))) {
                put_nothing(picture, at);
                continue;
            }
            show_pack(shown, picture, triangles, pixels.first, pixels.second);
            light_pack(picture, shown, at, x_first + x_step * (static_cast<float>(column) + lane), y);
        }
    }
}

} // namespace fernlicht::packs::FERNLICHT_LEVEL
