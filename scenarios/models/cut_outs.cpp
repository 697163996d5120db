#include "scenarios/models/cut_outs.h"

#include "scenarios/models/model.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

namespace fernlicht {
namespace {

constexpr std::size_t max_pieces = 500'000, max_tables = 512;
constexpr double finest_m = 0.02;
constexpr int finest_cut = 6;
constexpr double farthest_texel = 1e8;

/// A picture's opacity, summed from its corner: means over any box of a picture that repeats, in eight look-ups.
class Opacity {
  public:
    Opacity(const SurfaceTexture& texture, double cutoff)
        : width_(texture.width), height_(texture.height), all_(cells()), opaque_(cells()) {
        for (long y = 0; y < height_; ++y)
            for (long x = 0; x < width_; ++x) {
                const double a = texture.rgba[static_cast<std::size_t>(4 * (y * width_ + x) + 3)] / 255.0;
                put(all_, x, y, a);
                put(opaque_, x, y, a >= cutoff ? 1.0 : 0.0);
            }
    }

    /// Texture coordinates of its corners, in texels.
    glm::dvec2 texels(const glm::vec2& uv) const { return glm::dvec2(uv) * glm::dvec2(width_, height_); }

    double mean(const glm::dvec2& middle, double half) const { return share(all_, middle - half, middle + half); }
    double opaque_share(const glm::dvec2& low, const glm::dvec2& high) const { return share(opaque_, low, high); }

  private:
    using Sums = std::vector<double>; ///< of all texels left of and below a corner
    std::size_t cells() const { return static_cast<std::size_t>((width_ + 1) * (height_ + 1)); }
    double at(const Sums& sums, long x, long y) const { return sums[static_cast<std::size_t>(y * (width_ + 1) + x)]; }
    void put(Sums& sums, long x, long y, double value) const {
        sums[static_cast<std::size_t>((y + 1) * (width_ + 1) + x + 1)] = value + at(sums, x, y + 1) + at(sums, x + 1, y) - at(sums, x, y);
    }
    /// From the corner of the picture to a corner of any of its repetitions.
    double sum_to(const Sums& sums, long x, long y) const {
        const auto floor = [](long a, long b) { return a / b - (a % b < 0 ? 1 : 0); };
        const long across = floor(x, width_), up = floor(y, height_), rx = x - across * width_, ry = y - up * height_;
        const auto columns = static_cast<double>(across), rows = static_cast<double>(up);
        return columns * rows * at(sums, width_, height_) + columns * at(sums, width_, ry) + rows * at(sums, rx, height_) +
               at(sums, rx, ry);
    }
    /// Of all texels that the box touches.
    double share(const Sums& sums, const glm::dvec2& low, const glm::dvec2& high) const {
        const long x0 = std::lround(std::floor(low.x)), y0 = std::lround(std::floor(low.y));
        const long x1 = std::max(std::lround(std::ceil(high.x)), x0 + 1), y1 = std::max(std::lround(std::ceil(high.y)), y0 + 1);
        return (sum_to(sums, x1, y1) - sum_to(sums, x0, y1) - sum_to(sums, x1, y0) + sum_to(sums, x0, y0)) /
               (static_cast<double>(x1 - x0) * static_cast<double>(y1 - y0));
    }

    long width_, height_;
    Sums all_, opaque_;
};

using Corners = std::array<SoupVertex, 3>;

SoupVertex between(const SoupVertex& a, const SoupVertex& b, double t) {
    const auto part = static_cast<float>(t);
    return {glm::mix(a.position_m, b.position_m, t), glm::normalize(glm::mix(a.normal, b.normal, t)), glm::mix(a.uv, b.uv, part)};
}

/// One triangle on its way into what is left of it.
class Cutting {
  public:
    Cutting(const Opacity& opacity, double cutoff, std::vector<Corners>& kept) : opacity_(opacity), cutoff_(cutoff), kept_(kept) {}

    void cut(const Corners& corners, int depth) {
        std::array<glm::dvec2, 3> uv;
        std::ranges::transform(corners, uv.begin(), [&](const SoupVertex& v) { return opacity_.texels(v.uv); });
        const glm::dvec2 low = glm::min(uv[0], glm::min(uv[1], uv[2])), high = glm::max(uv[0], glm::max(uv[1], uv[2]));
        const bool near = std::max({-low.x, -low.y, high.x, high.y}) < farthest_texel;
        const double share = near ? opacity_.opaque_share(low, high) : 1.0;
        if (share > 1.0 - 1e-9)
            kept_.push_back(corners);
        if (share > 1.0 - 1e-9 || share < 1e-9)
            return;
        const double texels = longest(uv),
                     metres = longest(std::array{corners[0].position_m, corners[1].position_m, corners[2].position_m});
        if (depth == 0 || texels < 1.0 || metres < finest_m) {
            clip(corners, {value(uv[0], texels), value(uv[1], texels), value(uv[2], texels)});
            return;
        }
        const SoupVertex ab = between(corners[0], corners[1], 0.5), bc = between(corners[1], corners[2], 0.5),
                         ca = between(corners[2], corners[0], 0.5);
        for (const Corners& part :
             {Corners{corners[0], ab, ca}, Corners{ab, corners[1], bc}, Corners{ca, bc, corners[2]}, Corners{ab, bc, ca}})
            cut(part, depth - 1);
    }

  private:
    template <class Point> static double longest(const std::array<Point, 3>& p) {
        return std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    }
    /// Above the cut-off as a share of a step from clear to opaque; about a corner, as finely as the piece is.
    double value(const glm::dvec2& uv, double texels) const { return opacity_.mean(uv, std::max(0.25 * texels, 0.5)) - cutoff_; }

    /// The part where a value that is linear over the triangle is not negative.
    void clip(const Corners& corners, const std::array<double, 3>& values) {
        std::vector<SoupVertex> outline;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t next = (i + 1) % 3;
            if (values[i] >= 0.0)
                outline.push_back(corners[i]);
            if ((values[i] >= 0.0) != (values[next] >= 0.0))
                outline.push_back(between(corners[i], corners[next], values[i] / (values[i] - values[next])));
        }
        for (std::size_t i = 2; i < outline.size(); ++i)
            kept_.push_back({outline[0], outline[i - 1], outline[i]});
    }

    const Opacity& opacity_;
    double cutoff_;
    std::vector<Corners>& kept_;
};

/// So deep that all together stay below so many pieces, where each part becomes two.
int depth_of(std::size_t triangles, std::size_t pieces) {
    int depth = 0;
    for (std::size_t all = 8 * triangles; depth < finest_cut && all <= pieces; all *= 4)
        ++depth;
    return depth;
}

} // namespace

bool CutOuts::apply(TriangleSoup& soup, const std::vector<SurfaceTexture>& textures) {
    constexpr std::uint32_t gone = ~std::uint32_t{0};
    std::ranges::stable_sort(cuts_, {}, [](const Cut& cut) { return std::pair(cut.texture, cut.level); });
    std::unique_ptr<Opacity> opacity;
    std::pair<int, int> made{-1, 0};
    std::size_t tables = 0;
    const std::size_t room = max_model_triangles - std::min(max_model_triangles, soup.triangles.size());
    const int depth = depth_of(cuts_.size(), std::min(max_pieces, room));
    bool cut_away = false;
    for (const Cut& cut : cuts_) {
        const SoupTriangle whole = soup.triangles[cut.triangle];
        std::vector<Corners> kept;
        if (cut.level > 256) {
            cut_away = true;
            soup.triangles[cut.triangle].material = gone;
        }
        if (cut.texture < 0 || cut.level > 256)
            continue;
        if (made != std::pair(cut.texture, cut.level)) {
            if (++tables > max_tables)
                break; // the rest stays whole
            opacity = std::make_unique<Opacity>(textures[static_cast<std::size_t>(cut.texture)], cut.level / 256.0);
            made = {cut.texture, cut.level};
        }
        const Corners corners{soup.vertices[whole.corners[0]], soup.vertices[whole.corners[1]], soup.vertices[whole.corners[2]]};
        Cutting(*opacity, cut.level / 256.0, kept).cut(corners, depth);
        if (kept.size() == 1 && kept[0][0].position_m == corners[0].position_m && kept[0][1].position_m == corners[1].position_m &&
            kept[0][2].position_m == corners[2].position_m)
            continue; // all of it
        cut_away = true;
        soup.triangles[cut.triangle].material = gone;
        for (const Corners& piece : kept) {
            const auto first = static_cast<std::uint32_t>(soup.vertices.size());
            soup.vertices.insert(soup.vertices.end(), piece.begin(), piece.end());
            soup.triangles.push_back({{first, first + 1, first + 2}, whole.material, whole.tint});
        }
    }
    std::erase_if(soup.triangles, [](const SoupTriangle& triangle) { return triangle.material == gone; });
    return cut_away;
}

} // namespace fernlicht
