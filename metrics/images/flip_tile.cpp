#include "metrics/images/flip_tile.h"

#include "metrics/images/quick_powers.h"
#include "scenarios/packs/level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace fernlicht::flip {
namespace {

// Colours here are tristimulus values over those of white (D65), so that grey is x = y = z. The paper's opponent space is Y = 116 y - 16,
// Cx = 500 (x - y), Cz = 200 (y - z); its filters are linear and sum to 1, so factors and offsets can stay out.

/// Row by row.
using ColourMatrix = std::array<float, 9>;

constexpr float share(double part, double whole) { return static_cast<float>(part / whole); }

/// The matrix of BT.709's primaries and D65 as fractions, each row over its own sum.
constexpr ColourMatrix white_of_rgb{share(10135552, 23359437), share(8788810, 23359437), share(4435075, 23359437), //
                                    share(2613072, 12288897),  share(8788810, 12288897), share(887015, 12288897),  //
                                    share(1425312, 80288307),  share(8788810, 80288307), share(70074185, 80288307)};
/// Its inverse.
constexpr ColourMatrix rgb_of_white{3.0803419882804608F,   -1.5373989694887855F,  -0.54294301879167506F,
                                    -0.92117839616512365F, 1.8759299836951759F,   0.045248412469947583F,
                                    0.052881292875543252F, -0.20401120612390997F, 1.1511299132483668F};

/// L* 0..100, and a* and b* times 0.01 L*, since colours look the paler the darker they are (Hunt; section 4.1.2).
struct HuntLab {
    float l, a, b;
};

inline float unit(float v) { return v < 0.0F ? 0.0F : v > 1.0F ? 1.0F : v; }

/// CIE 15's f(t): cube root above (6/29)^3, a line below.
inline float lab_root(float t) {
    constexpr float end = 216.0F / 24389.0F;
    return t > end ? quick_cube_root(t > end ? t : 1.0F) : t * (841.0F / 108.0F) + 4.0F / 29.0F;
}

/// What is seen of a filtered colour, clamped to what a display can show.
inline HuntLab hunt_lab(float y, float x_less_y, float y_less_z) {
    const float x = y + x_less_y, z = y - y_less_z;
    const ColourMatrix &to = rgb_of_white, &from = white_of_rgb;
    const float r = unit(to[0] * x + to[1] * y + to[2] * z), g = unit(to[3] * x + to[4] * y + to[5] * z),
                b = unit(to[6] * x + to[7] * y + to[8] * z);
    const float fx = lab_root(from[0] * r + from[1] * g + from[2] * b), fy = lab_root(from[3] * r + from[4] * g + from[5] * b),
                fz = lab_root(from[6] * r + from[7] * g + from[8] * b);
    const float l = 116.0F * fy - 16.0F;
    return {l, 500.0F * (fx - fy) * 0.01F * l, 200.0F * (fy - fz) * 0.01F * l};
}

/// Section 4.1.3 and 4.1.4: distances to the power of 0.7; up to 0.4 of the largest they take 0.95 of the scale, evenly.
struct ErrorScale {
    float knee;         ///< 0.4 of the largest
    float below, above; ///< slopes
};

/// From the largest distance of two colours of a display, that of its green and its blue.
ErrorScale error_scale() {
    const ColourMatrix& m = white_of_rgb;
    const HuntLab green = hunt_lab(m[4], m[1] - m[4], m[4] - m[7]), blue = hunt_lab(m[5], m[2] - m[5], m[5] - m[8]);
    const double da = static_cast<double>(green.a - blue.a), db = static_cast<double>(green.b - blue.b);
    const double largest = std::pow(std::abs(static_cast<double>(green.l - blue.l)) + std::hypot(da, db), 0.7);
    const double knee = 0.4 * largest;
    return {static_cast<float>(knee), static_cast<float>(0.95 / knee), static_cast<float>(0.05 / (largest - knee))};
}

/// HyAB of two colours (section 4.1.3), about 0 to 203.
float distance_of(const HuntLab& a, const HuntLab& b) {
    const float da = a.a - b.a, db = a.b - b.b;
    return std::abs(a.l - b.l) + std::sqrt(da * da + db * db);
}

/// The error of colour, for a distance of at least 1e-30.
float colour_error(float distance, const ErrorScale& scale) {
    const float power = quick_exp2(0.7F * quick_log2(distance));
    return power < scale.knee ? scale.below * power : 0.95F + (power - scale.knee) * scale.above;
}

/// Section 4.3: the error of colour, raised where edges or points differ (`feature`, at most sqrt 2). colour above 1e-30.
float colour_and_features(float colour, float feature) {
    const float left = 1.0F - std::sqrt(unit(feature * 0.70710678F));
    return unit(quick_exp2(left * quick_log2(colour)));
}

typedef float Lanes __attribute__((vector_size(64)));
constexpr int lanes = 16;

/// Sixteen floats that lie anywhere in memory.
[[gnu::always_inline]] inline Lanes load(const float* at) {
    Lanes value;
    std::memcpy(&value, at, sizeof value);
    return value;
}
[[gnu::always_inline]] inline void store(float* at, const Lanes& value) { std::memcpy(at, &value, sizeof value); }

/// A tile with its surroundings: where its rows lie in the buffers.
struct Ground {
    int halo, stride, rows; ///< stride of rows that are wider by the halo on both sides; rows with it
};

/// sum[x] = weights[0] in[x] + sum over i of weights[i] (in[x - i step] + in[x + i step]), sixteen pixels at once.
[[gnu::always_inline]] inline void even(const float* in, std::ptrdiff_t step, const HalfFilter& filter, Lanes& sum) {
    const float* w = filter.weights.data();
    sum = w[0] * load(in);
    for (int i = 1; i <= filter.radius(); ++i)
        sum += w[i] * (load(in - i * step) + load(in + i * step));
}

/// The same with the other side's weights negative.
[[gnu::always_inline]] inline void odd(const float* in, std::ptrdiff_t step, const HalfFilter& filter, Lanes& sum) {
    const float* w = filter.weights.data();
    sum = w[0] * load(in);
    for (int i = 1; i <= filter.radius(); ++i)
        sum += w[i] * (load(in + i * step) - load(in - i * step));
}

/// As even(), for weights that sum to 0, by the differences from the middle: exactly 0 where the picture is even. The square root that
/// features go through would make 1e-4 out of the 1e-8 that sums leave otherwise.
[[gnu::always_inline]] inline void even_of_differences(const float* in, std::ptrdiff_t step, const HalfFilter& filter, Lanes& sum) {
    const float* w = filter.weights.data();
    const Lanes middle = load(in);
    sum = 0.0F * middle;
    for (int i = 1; i <= filter.radius(); ++i)
        sum += w[i] * ((load(in - i * step) - middle) + (load(in + i * step) - middle));
}

/// Rows of linear RGB, then of Y, Cx, Cz over it; beyond the picture its edge goes on.
void fetch(const Tile& tile, const Ground& g, int width, int height, const Rows& rows, TileMemory& memory) {
    const std::size_t plane = static_cast<std::size_t>(g.stride) * static_cast<std::size_t>(g.rows);
    memory.linear.resize(3 * plane);
    const int from = std::max(0, tile.x - g.halo), to = std::min(width, tile.x + tile_px + g.halo), left = from - (tile.x - g.halo);
    for (int row = 0; row < g.rows; ++row) {
        const int y = std::clamp(tile.y - g.halo + row, 0, height - 1);
        float* line = memory.linear.data() + static_cast<std::ptrdiff_t>(row) * g.stride;
        rows(y, from, to - from, line + left, line + plane + left, line + 2 * plane + left);
        for (std::size_t c = 0; c < 3; ++c) {
            float* channel = line + c * plane;
            std::fill(channel, channel + left, channel[left]);
            std::fill(channel + left + to - from, channel + g.stride, channel[left + to - from - 1]);
        }
    }
}

FERNLICHT_WIDEST void to_opponent(const float* linear, std::size_t plane, float* opponent) {
    const float *r = linear, *g = linear + plane, *b = linear + 2 * plane;
    float *y = opponent, *cx = opponent + plane, *cz = opponent + 2 * plane;
    const ColourMatrix& m = white_of_rgb;
    for (std::size_t i = 0; i < plane; ++i) {
        const float xn = m[0] * r[i] + m[1] * g[i] + m[2] * b[i], yn = m[3] * r[i] + m[4] * g[i] + m[5] * b[i],
                    zn = m[6] * r[i] + m[7] * g[i] + m[8] * b[i];
        y[i] = yn;
        cx[i] = xn - yn;
        cz[i] = yn - zn;
    }
}

/// Planes of `across`, each rows of tile_px.
enum Across { a_y, a_cx, a_wide, a_narrow, a_gaussian, a_edge, a_point, across_planes };
/// Planes of a picture's results.
enum Seen { lightness, red_green, blue_yellow, edge, point, seen_planes };

FERNLICHT_WIDEST void filter_across(const Ground& g, const Filters& f, bool grey, const float* opponent, float* across) {
    const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(g.stride) * g.rows, out_plane = static_cast<std::ptrdiff_t>(tile_px) * g.rows;
    for (int row = 0; row < g.rows; ++row)
        for (int x = 0; x < tile_px; x += lanes) {
            const float* y = opponent + static_cast<std::ptrdiff_t>(row) * g.stride + g.halo + x;
            float* out = across + static_cast<std::ptrdiff_t>(row) * tile_px + x;
            Lanes sum;
            even(y, 1, f.y, sum);
            store(out + a_y * out_plane, sum);
            if (!grey) {
                even(y + plane, 1, f.cx, sum);
                store(out + a_cx * out_plane, sum);
                even(y + 2 * plane, 1, f.cz_wide_across, sum);
                store(out + a_wide * out_plane, sum);
                even(y + 2 * plane, 1, f.cz_narrow_across, sum);
                store(out + a_narrow * out_plane, sum);
            }
            even(y, 1, f.gaussian, sum);
            store(out + a_gaussian * out_plane, sum);
            odd(y, 1, f.edge, sum);
            store(out + a_edge * out_plane, sum);
            even_of_differences(y, 1, f.point, sum);
            store(out + a_point * out_plane, sum);
        }
}

/// Down, and to what is compared: colours in L*a*b* with Hunt's adjustment, sizes of edges and points.
FERNLICHT_WIDEST void filter_down(const Ground& g, const Tile& tile, const Filters& f, bool grey, const float* across, float* seen) {
    const std::ptrdiff_t in_plane = static_cast<std::ptrdiff_t>(tile_px) * g.rows, out_plane = std::ptrdiff_t{tile_px} * tile_px;
    for (int row = 0; row < tile.height; ++row) {
        float* out = seen + static_cast<std::ptrdiff_t>(row) * tile_px;
        alignas(64) float squares[2][tile_px];
        for (int x = 0; x < tile_px; x += lanes) {
            const float* in = across + static_cast<std::ptrdiff_t>(row + g.halo) * tile_px + x;
            Lanes sum, other;
            even(in + a_y * in_plane, tile_px, f.y, sum);
            store(out + lightness * out_plane + x, sum);
            if (!grey) {
                even(in + a_cx * in_plane, tile_px, f.cx, sum);
                store(out + red_green * out_plane + x, sum);
                even(in + a_wide * in_plane, tile_px, f.cz_wide_down, sum);
                even(in + a_narrow * in_plane, tile_px, f.cz_narrow_down, other);
                store(out + blue_yellow * out_plane + x, sum + other);
            }
            even(in + a_edge * in_plane, tile_px, f.gaussian, sum);
            odd(in + a_gaussian * in_plane, tile_px, f.edge, other);
            store(squares[0] + x, sum * sum + other * other);
            even(in + a_point * in_plane, tile_px, f.gaussian, sum);
            even_of_differences(in + a_gaussian * in_plane, tile_px, f.point, other);
            store(squares[1] + x, sum * sum + other * other);
        }
        for (int x = 0; x < tile_px; ++x) {
            out[edge * out_plane + x] = std::sqrt(squares[0][x]);
            out[point * out_plane + x] = std::sqrt(squares[1][x]);
        }
        if (grey) {
            for (int x = 0; x < tile_px; ++x)
                out[lightness * out_plane + x] = 116.0F * lab_root(unit(out[lightness * out_plane + x])) - 16.0F;
            continue;
        }
        for (int x = 0; x < tile_px; ++x) {
            const HuntLab seen_as = hunt_lab(out[x], out[red_green * out_plane + x], out[blue_yellow * out_plane + x]);
            out[lightness * out_plane + x] = seen_as.l;
            out[red_green * out_plane + x] = seen_as.a;
            out[blue_yellow * out_plane + x] = seen_as.b;
        }
    }
}

FERNLICHT_WIDEST void compare(const Tile& tile, bool grey, const float* t, const float* r, float* errors) {
    constexpr std::ptrdiff_t plane = std::ptrdiff_t{tile_px} * tile_px;
    const ErrorScale scale = error_scale();
    for (int row = 0; row < tile.height; ++row, t += tile_px, r += tile_px, errors += tile_px) {
        float distance[tile_px], feature[tile_px]; // loops of one choice each: two would become jumps, which are no SIMD
        if (grey)
            for (int x = 0; x < tile_px; ++x)
                distance[x] = std::abs(t[x] - r[x]);
        else
            for (int x = 0; x < tile_px; ++x)
                distance[x] = distance_of({t[x], t[red_green * plane + x], t[blue_yellow * plane + x]},
                                          {r[x], r[red_green * plane + x], r[blue_yellow * plane + x]});
        for (int x = 0; x < tile_px; ++x) {
            const float edges = std::abs(t[edge * plane + x] - r[edge * plane + x]),
                        points = std::abs(t[point * plane + x] - r[point * plane + x]);
            feature[x] = edges > points ? edges : points;
        }
        for (int x = 0; x < tile_px; ++x)
            errors[x] = colour_error(distance[x] > 1e-30F ? distance[x] : 1e-30F, scale);
        for (int x = 0; x < tile_px; ++x)
            errors[x] = colour_and_features(errors[x], feature[x]);
        for (int x = 0; x < tile_px; ++x)
            errors[x] = distance[x] > 0.0F ? errors[x] : 0.0F; // without an error of colour there is none
    }
}

void see(const Tile& tile, const Ground& g, int width, int height, const Rows& rows, const Filters& f, bool grey, TileMemory& memory,
         std::vector<float>& seen) {
    const std::size_t plane = static_cast<std::size_t>(g.stride) * static_cast<std::size_t>(g.rows);
    fetch(tile, g, width, height, rows, memory);
    memory.across.resize(static_cast<std::size_t>(across_planes) * tile_px * static_cast<std::size_t>(g.rows));
    seen.resize(static_cast<std::size_t>(seen_planes) * tile_px * tile_px);
    const float* opponent = memory.linear.data(); // of a grey, y is any of its channels
    if (!grey) {
        memory.opponent.resize(3 * plane);
        to_opponent(memory.linear.data(), plane, memory.opponent.data());
        opponent = memory.opponent.data();
    }
    filter_across(g, f, grey, opponent, memory.across.data());
    filter_down(g, tile, f, grey, memory.across.data(), seen.data());
}

} // namespace

void flip_of_tile(const Tile& tile, int picture_width, int picture_height, const Rows& tested, const Rows& reference,
                  const Filters& filters, Colours colours, TileMemory& memory, float* errors) {
    const Ground ground{filters.radius, tile_px + 2 * filters.radius, tile.height + 2 * filters.radius};
    const bool grey = colours == Colours::grey;
    see(tile, ground, picture_width, picture_height, reference, filters, grey, memory, memory.reference);
    see(tile, ground, picture_width, picture_height, tested, filters, grey, memory, memory.tested);
    compare(tile, grey, memory.tested.data(), memory.reference.data(), errors);
}

} // namespace fernlicht::flip
