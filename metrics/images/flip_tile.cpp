#include "metrics/images/flip_tile.h"

#include "metrics/images/flip_colour.h"
#include "metrics/images/quick_powers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

// The function is compiled for several widths of vectors, and the right one chosen when the program starts; sanitizers cannot instrument
// that. No width changes a bit: nothing is summed across a vector, nothing is contracted.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define FERNLICHT_WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FERNLICHT_WIDEST
#endif

namespace fernlicht::flip {
namespace {

/// Sixteen floats that lie anywhere in memory.
typedef float Lanes __attribute__((vector_size(64), aligned(4), may_alias));
constexpr int lanes = 16;

[[gnu::always_inline]] inline const Lanes& load(const float* at) { return *reinterpret_cast<const Lanes*>(at); }
[[gnu::always_inline]] inline void store(float* at, const Lanes& value) { *reinterpret_cast<Lanes*>(at) = value; }

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
