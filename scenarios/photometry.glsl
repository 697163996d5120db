// Every light equation of fernlicht, once. The GPU compiles this text as GLSL in float; C++ includes it in double (photometry.h),
// so the two cannot drift and their difference is the rounding error of the GPU path; and over packs of floats (packs/photometry.h).
//
// The common subset: `real`, never float or double; literals with a point and no suffix; no swizzles; no samplers (pass what was
// fetched); FN before a function, OUT(type) for results by reference; PRECISE before accumulators, so that leaving a feature out
// cannot change the rounding of what stays; SELECT(condition, a, b) where points differ in the condition, `?:` and `if` where all of a pack
// share it, as they share every bool and int. Angles in radians, lengths in metres, photometric units in the names.
//
// "Float: e of x, condition c.": evaluated in float, a value differs from the double one by at most e, measured by x; a relative change of an
// argument changes it by at most c times as much, by the same measure. Domains, derivations and the search for the worst arguments:
// runner/experiments/stability/equations.cpp; `fernlicht stability --equations` searches on any device.

const real photometry_pi = 3.14159265358979323846;
const real photometry_inverse_pi = 0.31830988618379067154;

// World direction -> lamp space (x right, y up, z forward) by the lamp's own axes, each of unit length.
// Float: 2e-07 of |v|, condition 1.
FN vec3 lamp_space(vec3 v, vec3 right, vec3 up, vec3 forward) {
    return vec3(dot(v, right), dot(v, up), dot(v, forward));
}

// Lamp space -> (H, V), UN goniometer with vertical polar axis: H right positive, V up positive.
// V = asin(y / |w|) in the text of the regulation; atan(y, length(x, z)) is the same angle without asin's error near the horizon.
// Float: 5e-06 rad, condition 0.6.
FN vec2 goniometer_angles(vec3 w) {
    return vec2(atan(w.x, w.z), atan(w.y, length(vec2(w.x, w.z))));
}

// atan(t) for 0 <= t <= 1 within 4e-8 rad: the minimax polynomial of degree 15, odd terms (Lawson's iteration, 8001 Chebyshev nodes).
// Float: 2e-07 relative, condition 1.
FN real quick_atan_unit(real t) {
    real s = t * t;
    return t * (0.999999336 + s * (-0.333298608 + s * (0.199465656 + s * (-0.139086292 + s * (0.096421961 + s * (-0.0559123078 +
           s * (0.0218629435 - s * 0.00405456293)))))));
}

// atan(y, x) within 1e-7 rad, for GPUs whose own atan is slower or coarser. (0, 0) gives 0.
// Float: 5e-07 relative, condition 1.
FN real quick_atan(real y, real x) {
    real ay = abs(y);
    real ax = abs(x);
    real a = quick_atan_unit(min(ay, ax) / max(max(ay, ax), 1e-30));
    a = SELECT(ay > ax, 0.5 * photometry_pi - a, a);
    a = SELECT(x < 0.0, photometry_pi - a, a);
    return SELECT(y < 0.0, -a, a);
}

// asin(s) for |s| <= 0.5 within 3e-8; beyond it stays monotone and above asin(0.5), so that a table ending below 30 degrees
// still has no light there. Odd minimax polynomial of degree 9.
// Float: 4e-07 relative, condition 2.
FN real quick_asin_half(real s) {
    real t = s * s;
    return s * (1.00000046 + t * (0.166631011 + t * (0.0757618196 + t * (0.0381369786 + t * 0.053321681))));
}

// goniometer_angles() for w.z > 0 within 1e-7 rad. inverse_d = 1 / |w|. `steep` 0.0: V is right up to 30 degrees only (asin is
// well-conditioned there, and 1 / |w| is known); beyond, it is above 30 degrees, which is all that a flat table asks.
// Float: 5e-07 rad, condition 0.6.
FN vec2 quick_goniometer_angles(vec3 w, real inverse_d, bool steep) {
    real v = steep ? quick_atan(w.y, length(vec2(w.x, w.z))) : quick_asin_half(w.y * inverse_d);
    return vec2(quick_atan(w.x, w.z), v);
}

// Where in a beam texture an angle falls. grid = (first H, first V, 1 / step H, 1 / step V); texel centres stand on the samples,
// so the result 0 is the first sample and count - 1 the last.
// Float: 2e-07 of angle plus first sample in steps, condition 1.
FN vec2 beam_position(vec2 angles, vec4 grid) {
    return vec2((angles.x - grid.x) * grid.z, (angles.y - grid.y) * grid.w);
}

// 1 where the texture knows the direction, else 0: no light is invented outside a table.
// Float: 0 of 1, condition unbounded.
FN real beam_known(vec2 position, vec2 count) {
    return SELECT(position.x >= 0.0 && position.y >= 0.0 && position.x <= count.x - 1.0 && position.y <= count.y - 1.0, 1.0, 0.0);
}

// Bilinear by hand: texture units weigh with 8 fractional bits, which shows at a cut-off.
// ab is the row below (a left, b right), cd the row above.
// Float: 3e-07 of the largest sample, condition 1.
FN real bilinear(real a, real b, real c, real d, vec2 f) {
    PRECISE real lower = a + (b - a) * f.x;
    PRECISE real upper = c + (d - c) * f.x;
    PRECISE real result = lower + (upper - lower) * f.y;
    return result;
}

// E = I / d^2 on a surface that faces the lamp. `to_lamp` from the point to the lamp, not normalised. Pole at d = 0.
// Float: 4.8e-07 relative, condition 2.
FN real facing_illuminance(real intensity_cd, vec3 to_lamp) {
    PRECISE real e = intensity_cd / dot(to_lamp, to_lamp);
    return e;
}

// The same with inverse_d = 1 / d known.
// Float: 1.3e-07 relative, condition 2.
FN real facing_illuminance_at(real intensity_cd, real inverse_d) {
    PRECISE real e = intensity_cd * inverse_d * inverse_d;
    return e;
}

// cos(alpha) between the unit normal and the direction to the lamp; 0 on the far side.
// Float: 6e-07 of 1, condition 1.
FN real incidence(vec3 normal, vec3 to_lamp) {
    PRECISE real c = dot(normal, to_lamp) * inversesqrt(dot(to_lamp, to_lamp));
    return max(c, 0.0);
}

// E of parallel light (sun, moon) on a surface: `perpendicular_lx` on a plane across it, `towards` the unit direction it comes from.
// Float: 4e-07 of perpendicular_lx, condition 1.
FN real directional_illuminance(real perpendicular_lx, vec3 normal, vec3 towards) {
    PRECISE real e = perpendicular_lx * max(dot(normal, towards), 0.0);
    return e;
}

// E of a uniform sky over black ground on a surface of this unit normal: (1 + cos(slope)) / 2 of the horizontal.
// Float: 3e-07 of horizontal_lx, condition 1.
FN real sky_illuminance(real horizontal_lx, vec3 normal) {
    PRECISE real e = horizontal_lx * 0.5 * (1.0 + normal.z);
    return e;
}

// Diffuse (Lambert): L = rho E / pi.
// Float: 2e-07 relative, condition 1.
FN real diffuse_luminance(real albedo, real illuminance_lx) {
    PRECISE real l = albedo * (illuminance_lx * photometry_inverse_pi);
    return l;
}

// Reflectance where a texel meets the material's own colour. mode: 0 modulate, 1 replace, 2 decal, 3 blend, as OpenGL 1.5 names its
// texture environments (table 3.22). All inputs 0..1, and so is the result.
// Float: 2e-07 of 1, condition 1.
FN vec3 combined_reflectance(int mode, vec3 own, vec4 texel, vec3 blend_colour) {
    vec3 colour = vec3(texel.x, texel.y, texel.z);
    if (mode == 1)
        return colour;
    if (mode == 2) {
        PRECISE vec3 decal = own * (1.0 - texel.w) + colour * texel.w;
        return decal;
    }
    if (mode == 3) {
        PRECISE vec3 blend = own * (1.0 - colour) + blend_colour * colour;
        return blend;
    }
    return own * colour;
}

// R_L of a textured surface: retroreflection goes with reflectance. The lighter grain returns more, paint that is worn off returns less,
// each by the ratio of luminances (Y of linear sRGB). A black own colour has no ratio; its R_L stays.
// Float: 9e-07 relative, condition 1.
FN real textured_rl(real rl, vec3 own, vec3 combined) {
    vec3 weights = vec3(0.2126, 0.7152, 0.0722);
    real own_y = dot(own, weights);
    PRECISE real textured = rl * dot(combined, weights) / own_y;
    return SELECT(own_y > 0.0, textured, rl);
}

// The same with rl / Y(own) known; 0 for a black own colour.
// Float: 3e-07 relative, condition 1.
FN real textured_rl_at(real rl_per_y, vec3 combined) {
    return rl_per_y * dot(combined, vec3(0.2126, 0.7152, 0.0722));
}

// Angle at the surface between light and eye; both vectors from the point, not normalised. Well-conditioned near 0, where
// retroreflection happens and acos is not.
// Float: 5e-06 rad, condition 0.6.
FN real observation_angle(vec3 to_lamp, vec3 to_eye) {
    return atan(length(cross(to_lamp, to_eye)), dot(to_lamp, to_eye));
}

// The same within 1e-7 rad.
// Float: 8e-07 rad, condition 0.6.
FN real quick_observation_angle(vec3 to_lamp, vec3 to_eye) {
    return quick_atan(length(cross(to_lamp, to_eye)), dot(to_lamp, to_eye));
}

// Retroreflection: L = R_L E_perp, R_L in cd/(m2 lx) at the reference observation angle, falling off exponentially with the angle.
// E_perp is on a plane perpendicular to the light (EN 1436). Nothing from behind (cosine 0).
// Float: 4e-05 relative while exp is above 1e-37, condition 111.
FN real retro_luminance(real rl, real e_perp_lx, real cosine, real angle, real reference, real inverse_falloff) {
    PRECISE real l = rl * e_perp_lx * exp((reference - angle) * inverse_falloff);
    return SELECT(cosine > 0.0, l, 0.0);
}

// How far `occluder` stands above the tangent plane of the point it might shade, in metres. Shadow maps compare this with a
// tolerance in metres of height: no bias that grows at grazing incidence, where headlamps live. Both relative to one origin.
// Float: 3e-07 of the two points' distance, condition unbounded.
FN real height_above_plane(vec3 occluder, vec3 point, vec3 normal) {
    return dot(normal, occluder - point);
}

// Share of light left after a way through a homogeneous medium (Bouguer). distance_m >= 0.
// Float: 3e-05 relative while exp is above 1e-35, condition 80.
FN real transmittance(real extinction_per_m, real distance_m) {
    PRECISE real t = exp(-extinction_per_m * distance_m);
    return t;
}

// Phase function of Henyey and Greenstein 1941, 1/sr: `cosine` of the angle by which light is turned, -1 < g < 1. The sum below cannot
// cancel. Integral over the sphere: 1.
// Float: 3e-06 relative, condition 271.
FN real henyey_greenstein(real cosine, real g) {
    real b = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cosine);
    PRECISE real p = 0.25 * photometry_inverse_pi * (1.0 - g * g) / (b * sqrt(b));
    return p;
}

// Integrand of single scattering along a ray past a lamp, over the angle at the lamp from its nearest point on the ray (equi-angular:
// Kulla and Fajardo 2012), where dt / r^2 = d angle / nearest_m: cd of the lamp times phase function times what both ways leave. `sine`
// and `cosine` of the angle, positive away from the eye; the nearest point lies `along_m` from the eye. The lamp's light there is turned by
// an angle of cosine -sine.
// Float: 2e-05 relative to optical depths of 10, condition 500.
FN real scattered_towards_eye(real cd, real sine, real cosine, real nearest_m, real along_m, real extinction_per_m, real g) {
    real from_lamp = nearest_m / cosine;
    PRECISE real way = from_lamp + max(along_m + from_lamp * sine, 0.0);
    return cd * henyey_greenstein(-sine, g) * transmittance(extinction_per_m, way);
}

// Refractive index of water and its film's reflectance for diffuse light from within (Fresnel, integrated).
const real water_index = 1.333;
const real water_inner_reflectance = 0.4745;

// Mean cosine between a direction and the facets of a rough surface that are seen from it; alpha is GGX's roughness.
// Float: 3e-07 of 1, condition 1.
FN real facet_cosine(real cosine, real alpha) {
    return sqrt(cosine * cosine + alpha * alpha * (1.0 - cosine * cosine));
}

// Refractive index of stone, bitumen and paint: of the facets of a dry road.
const real facet_index = 1.5;

// Fresnel's reflectance of a dielectric in air for unpolarised light, 0 <= cosine <= 1.
// Float: 3e-06 of 1, condition 2.
FN real dielectric_reflectance(real cosine, real index) {
    real g = sqrt(index * index - 1.0 + cosine * cosine);
    real across = (cosine - g) / (cosine + g);
    real along = (index * index * cosine - g) / (index * index * cosine + g);
    return 0.5 * (across * across + along * along);
}

// The same of water.
// Float: 3e-06 of 1, condition 2.
FN real water_reflectance(real cosine) {
    return dielectric_reflectance(cosine, water_index);
}

// Diffuse reflectance of a surface under a film of water towards one direction (Lekner and Dorf 1988, for given directions): light enters
// by 1 - F, is reflected to and fro under the film, and leaves by (1 - F) / n^2. Cosines as of facet_cosine.
// Float: 3e-05 relative, condition 4.
FN real wet_albedo(real albedo, real cosine_in, real cosine_out) {
    real through = (1.0 - water_reflectance(cosine_in)) * (1.0 - water_reflectance(cosine_out));
    return albedo * through / (water_index * water_index * (1.0 - water_inner_reflectance * albedo));
}

// Luminance by mirroring for each lux on a plane across the light, 1/sr: facets of GGX (Walter et al. 2007) with Smith's correlated
// shadowing and Fresnel's reflectance. Unit vectors. 0 where either direction lies below the surface. Over the cosine of the light it is the
// same with light and eye exchanged.
// Float: 0.0005 relative, condition 1000.
FN real facet_mirrored(vec3 normal, vec3 to_light, vec3 to_eye, real alpha, real index) {
    real c_in = dot(normal, to_light);
    real c_out = dot(normal, to_eye);
    vec3 h = to_light + to_eye;
    real length_h = length(h);
    h = h / max(length_h, 1e-20);
    vec3 across = cross(normal, h);
    real c_h = dot(normal, h);
    real a2 = alpha * alpha;
    real spread = a2 * c_h * c_h + dot(across, across);
    real density = a2 / (3.14159265358979323846 * spread * spread);
    real seen = 0.5 / (c_out * sqrt(a2 + (1.0 - a2) * c_in * c_in) + c_in * sqrt(a2 + (1.0 - a2) * c_out * c_out));
    real mirrored = c_in * density * seen * dielectric_reflectance(0.5 * length_h, index);
    return SELECT(c_in > 0.0 && c_out > 0.0, mirrored, 0.0);
}

// The same of a film of water.
// Float: 0.0005 relative, condition 1000.
FN real wet_mirrored(vec3 normal, vec3 to_light, vec3 to_eye, real alpha) {
    return facet_mirrored(normal, to_light, to_eye, alpha, water_index);
}

// Tone mappers: luminance -> 0..1, monotone, l_max -> 1. l >= 0, l_max > 0.
// Float: 3.1e-07 relative, condition 1.
FN real tone_linear(real l, real l_max) {
    return clamp(l / l_max, 0.0, 1.0);
}

// L' = s L / (s L - L + L_max), s >= 1; s = 1 is linear. Written with a sum that cannot cancel.
// Float: 6e-07 relative, condition 1.
FN real tone_rational(real l, real l_max, real s) {
    real x = min(l, l_max);
    return s * x / ((s - 1.0) * x + l_max);
}

// L' = ln(1 + s L / L_max) / ln(1 + s), s > 0.
// Float: 2e-06 of 1, condition 1.
FN real tone_logarithmic(real l, real l_max, real s) {
    real x = min(l, l_max) / l_max;
    return log(1.0 + s * x) / log(1.0 + s);
}

// Light as an eye sees it that is adapted to another white: rows of a matrix in linear sRGB (scenarios/display/white_adaptation.h).
// Float: 2e-07 of |light| and the longest row, condition 1.
FN vec3 white_adapted(vec3 light, vec3 r, vec3 g, vec3 b) {
    return vec3(dot(r, light), dot(g, light), dot(b, light));
}

// IEC 61966-2-1, linear 0..1 -> encoded 0..1.
// Float: 1e-06 of 1, condition 0.5.
FN real srgb_encoded(real c) {
    return SELECT(c <= 0.0031308, 12.92 * c, 1.055 * pow(c, 1.0 / 2.4) - 0.055);
}

// The same within 0.01 of an 8-bit step: minimax over 1, c, c^(1/2), c^(1/4), c^(3/4), two square roots in place of a power.
// Float: 1e-06 of 1, condition 0.5.
FN real quick_srgb_encoded(real c) {
    real s = sqrt(c);
    real q = sqrt(s);
    real curve = 1.12269338 * s + 0.19613123 * q - 0.335514046 * s * q + 0.0813347105 * c - 0.0646108987;
    return SELECT(c <= 0.0031308, 12.92 * c, curve);
}
