#include "scenarios/openscenario/osc_path.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fernlicht::osc {
namespace {

constexpr double step_m = 0.2; ///< chord of a bend of 5 m radius: 1 mm off

double turned(double from, double to, double share) { return from + std::remainder(to - from, 2.0 * pi) * share; }

PathPoint between(const PathPoint& a, const PathPoint& b, double share, bool own_headings) {
    PathPoint out;
    out.s_m = std::lerp(a.s_m, b.s_m, share);
    out.x_m = std::lerp(a.x_m, b.x_m, share);
    out.y_m = std::lerp(a.y_m, b.y_m, share);
    out.z_m = std::lerp(a.z_m, b.z_m, share);
    // Along the chord of a polyline, from heading to heading on a curve.
    out.heading_rad = own_headings || !a.corner ? turned(a.heading_rad, b.heading_rad, share) : a.heading_rad;
    if (a.time_s && b.time_s)
        out.time_s = std::lerp(*a.time_s, *b.time_s, share);
    return out;
}

void measure(Path& path) {
    for (std::size_t i = 1; i < path.points.size(); ++i) {
        const PathPoint& before = path.points[i - 1];
        PathPoint& point = path.points[i];
        point.s_m = before.s_m + std::hypot(point.x_m - before.x_m, point.y_m - before.y_m);
    }
}

/// Equal points in a row count once; the first keeps its time only if the second has none.
void drop_repeated(Path& path) {
    std::vector<PathPoint> kept;
    for (const PathPoint& point : path.points)
        if (kept.empty() || point.s_m > kept.back().s_m || (point.time_s && kept.back().time_s && *point.time_s > *kept.back().time_s))
            kept.push_back(point);
    if (kept.size() == 1)
        kept.push_back(kept.front());
    path.points = std::move(kept);
}

bool gives_heading(const Position& position) {
    const auto* world = std::get_if<WorldPosition>(&position.place);
    return world && world->h_rad;
}

struct Builder {
    const World& world;
    const std::optional<Spot>& here;
    const Trajectory& trajectory;

    PathPoint point_of(const Position& position, Path& path) const {
        const Spot spot = world.spot(position);
        const auto* at = std::get_if<WorldPosition>(&position.place);
        path.has_z = path.has_z || (at && at->z_m);
        return {0.0, spot.pose.position_m.x, spot.pose.position_m.y, spot.pose.position_m.z, spot.heading_rad(), {}, false};
    }

    Path operator()(const Polyline& line) const {
        Path path;
        path.own_headings = std::ranges::all_of(line, [](const Vertex& vertex) { return gives_heading(vertex.position); });
        for (const Vertex& vertex : line) {
            path.points.push_back(point_of(vertex.position, path));
            path.points.back().time_s = vertex.time_s;
            path.points.back().corner = true;
        }
        if (trajectory.closed)
            path.points.push_back(path.points.front());
        measure(path);
        if (!path.own_headings)
            for (std::size_t i = 0; i < path.points.size(); ++i) {
                const PathPoint &a = path.points[std::min(i, path.points.size() - 2)],
                                &b = path.points[std::min(i, path.points.size() - 2) + 1];
                if (b.s_m > a.s_m)
                    path.points[i].heading_rad = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
            }
        return path;
    }

    /// Curvature runs linearly over each segment; heading and place are integrated by Simpson's rule.
    Path operator()(const ClothoidPath& clothoids) const {
        Path path;
        PathPoint at;
        if (here)
            at = {0.0, here->pose.position_m.x, here->pose.position_m.y, here->pose.position_m.z, here->heading_rad(), {}, false};
        for (const ClothoidSegment& segment : clothoids) {
            if (segment.start) {
                const PathPoint start = point_of(*segment.start, path);
                std::tie(at.x_m, at.y_m, at.z_m, at.heading_rad) = std::tie(start.x_m, start.y_m, start.z_m, start.heading_rad);
            }
            at.heading_rad += segment.h_offset_rad;
            const int steps = std::max(2, static_cast<int>(std::ceil(segment.length_m / step_m)));
            const double ds = segment.length_m / steps;
            const double dot = (segment.end_curvature_per_m - segment.curvature_per_m) / segment.length_m;
            const PathPoint start = at;
            const auto heading = [&](double s) { return start.heading_rad + s * (segment.curvature_per_m + 0.5 * dot * s); };
            if (path.points.empty()) {
                at.time_s = segment.time_start_s;
                path.points.push_back(at);
            } else if (segment.time_start_s) {
                path.points.back().time_s = segment.time_start_s;
            }
            if (segment.start && path.points.size() > 1)
                path.points.push_back(at);
            for (int i = 1; i <= steps; ++i) {
                const double s0 = (i - 1) * ds, s1 = i * ds, middle = 0.5 * (s0 + s1);
                at.x_m += ds / 6.0 * (std::cos(heading(s0)) + 4.0 * std::cos(heading(middle)) + std::cos(heading(s1)));
                at.y_m += ds / 6.0 * (std::sin(heading(s0)) + 4.0 * std::sin(heading(middle)) + std::sin(heading(s1)));
                at.heading_rad = heading(s1);
                at.time_s.reset();
                path.points.push_back(at);
            }
            path.points.back().time_s = segment.time_end_s;
        }
        measure(path);
        return path;
    }

    /// De Boor with weights (Piegl and Tiller, The NURBS Book, A3.1 and A4.1).
    Path operator()(const Nurbs& nurbs) const {
        Path path;
        std::vector<glm::dvec4> homogeneous;
        std::vector<double> times;
        for (const Vertex& control : nurbs.points) {
            const PathPoint p = point_of(control.position, path);
            homogeneous.emplace_back(glm::dvec4(p.x_m, p.y_m, p.z_m, 1.0) * control.weight);
            if (control.time_s)
                times.push_back(*control.time_s * control.weight);
        }
        const auto degree = static_cast<std::size_t>(nurbs.order - 1);
        const auto& knots = nurbs.knots;
        const double low = knots[degree], high = knots[homogeneous.size()];
        double rough = 0.0;
        for (std::size_t i = 1; i < homogeneous.size(); ++i)
            rough += std::hypot(homogeneous[i].x / homogeneous[i].w - homogeneous[i - 1].x / homogeneous[i - 1].w,
                                homogeneous[i].y / homogeneous[i].w - homogeneous[i - 1].y / homogeneous[i - 1].w);
        const int steps = std::clamp(static_cast<int>(std::ceil(rough / step_m)), 16, 200'000);
        for (int k = 0; k <= steps; ++k) {
            const double u = std::lerp(low, high, static_cast<double>(k) / steps);
            std::size_t span = degree;
            while (span + 1 < homogeneous.size() && u >= knots[span + 1])
                ++span;
            std::vector<glm::dvec4> d(homogeneous.begin() + static_cast<std::ptrdiff_t>(span - degree),
                                      homogeneous.begin() + static_cast<std::ptrdiff_t>(span) + 1);
            std::vector<double> t;
            if (times.size() == homogeneous.size())
                t.assign(times.begin() + static_cast<std::ptrdiff_t>(span - degree), times.begin() + static_cast<std::ptrdiff_t>(span) + 1);
            for (std::size_t r = 1; r <= degree; ++r)
                for (std::size_t j = degree; j >= r; --j) {
                    const double from = knots[span - degree + j], to = knots[span + 1 + j - r];
                    const double share = to > from ? (u - from) / (to - from) : 0.0;
                    d[j] = d[j - 1] * (1.0 - share) + d[j] * share;
                    if (!t.empty())
                        t[j] = t[j - 1] * (1.0 - share) + t[j] * share;
                }
            const glm::dvec4& p = d[degree];
            path.points.push_back({0.0, p.x / p.w, p.y / p.w, p.z / p.w, 0.0, {}, false});
            if (!t.empty())
                path.points.back().time_s = t[degree] / p.w;
        }
        measure(path);
        for (std::size_t i = 0; i < path.points.size(); ++i) {
            const PathPoint &a = path.points[i == 0 ? 0 : i - 1], &b = path.points[std::min(i + 1, path.points.size() - 1)];
            path.points[i].heading_rad = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
        }
        return path;
    }
};

/// Times between those given run with the distance.
void fill_times(Path& path) {
    if (!path.points.front().time_s || !path.points.back().time_s)
        return;
    std::size_t before = 0;
    for (std::size_t i = 1; i < path.points.size(); ++i) {
        if (!path.points[i].time_s)
            continue;
        const PathPoint a = path.points[before], b = path.points[i];
        for (std::size_t k = before + 1; k < i; ++k)
            path.points[k].time_s = std::lerp(*a.time_s, *b.time_s, b.s_m > a.s_m ? (path.points[k].s_m - a.s_m) / (b.s_m - a.s_m) : 0.0);
        before = i;
    }
    path.timed = true;
    for (std::size_t i = 1; i < path.points.size(); ++i)
        path.timed = path.timed && *path.points[i].time_s >= *path.points[i - 1].time_s;
}

/// Where the rising `of` a point is `wanted`; clamped.
template <class Of> PathPoint point_at(const Path& path, double wanted, const Of& of) {
    const auto next = std::ranges::upper_bound(path.points, wanted, {}, of);
    if (next == path.points.begin())
        return path.points.front();
    if (next == path.points.end())
        return path.points.back();
    const PathPoint &a = *(next - 1), &b = *next;
    return between(a, b, (wanted - of(a)) / (of(b) - of(a)), path.own_headings);
}

double steepest(Shape shape) { return shape == Shape::sinusoidal ? 0.5 * pi : shape == Shape::cubic ? 1.5 : 1.0; }

} // namespace

PathPoint Path::at(double s_m) const {
    const double s = closed && length_m() > 0.0 ? s_m - length_m() * std::floor(s_m / length_m()) : s_m;
    return point_at(*this, s, [](const PathPoint& point) { return point.s_m; });
}

PathPoint Path::at_time(double time_s) const {
    return point_at(*this, time_s, [](const PathPoint& point) { return *point.time_s; });
}

Path build_path(const Trajectory& trajectory, const World& world, const std::optional<Spot>& here) {
    Path path = std::visit(Builder{world, here, trajectory}, trajectory.shape);
    path.closed = trajectory.closed;
    drop_repeated(path);
    fill_times(path);
    return path;
}

Transition::Transition(const Dynamics& dynamics, double start, double target)
    : shape_(dynamics.shape), start_(start), target_(target), length_(dynamics.value) {
    if (dynamics.dimension == Dimension::rate)
        length_ = dynamics.value > 0.0 ? steepest(shape_) * std::abs(target - start) / dynamics.value : 0.0;
    if (shape_ == Shape::step)
        length_ = 0.0;
}

void Transition::limit_rate(double rate) {
    if (at_once() || !(rate > 0.0))
        return;
    stretch_ = std::max(1.0, steepest(shape_) * std::abs(target_ - start_) / length_ / rate);
}

void Transition::advance(double step) { at_ = std::clamp(at_ + step / stretch_, 0.0, length_); }

double Transition::value() const {
    if (at_once())
        return target_;
    const double x = at_ / length_, b = target_ - start_;
    if (shape_ == Shape::sinusoidal)
        return start_ + 0.5 * b * (1.0 - std::cos(pi * x));
    return shape_ == Shape::cubic ? start_ + b * x * x * (3.0 - 2.0 * x) : start_ + b * x;
}

double Transition::linear_value() const { return at_once() ? target_ : start_ + (target_ - start_) * at_ / length_; }

double Transition::slope() const {
    if (at_once())
        return 0.0;
    const double x = at_ / length_, b = (target_ - start_) / (length_ * stretch_);
    if (shape_ == Shape::sinusoidal)
        return 0.5 * pi * b * std::sin(pi * x);
    return shape_ == Shape::cubic ? 6.0 * b * x * (1.0 - x) : b;
}

bool Transition::over() const { return at_once() || at_ > length_ - 1e-6; }

} // namespace fernlicht::osc
