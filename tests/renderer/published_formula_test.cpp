// The published techniques against their own formulas in double, pixel by pixel: what they compute is wrong as light, but right as
// published.
#include "renderer/light_map.h"
#include "renderer/projected_beam.h"
#include "renderer/twin.h"
#include "scenarios/lamps/spots/spot_fit.h"
#include "tests/renderer/published_scene.h"

#include <functional>
#include <map>

namespace fernlicht {
namespace {

using namespace tests;

constexpr double sky_lx = 3.4;
constexpr FrameOutputs lux_and_ids{.illuminance = true, .ids = true};

/// A point on a triangle, in the car's frame.
struct Point {
    glm::dvec3 p, corners[3], normal;
    glm::dvec3 weights;
};

struct Value {
    double lx = 0.0, slack_lx = 0.0;
};

/// A texture look-up may err by 1/50 of a texel: weights of 8 bits (1/256), and coordinates of 24 bits at up to 100 m from the lamp.
Value looked_up(const ProjectedBeam& beam, double s, double t) {
    double least = 1e300, most = 0.0;
    for (const int i : {-1, 0, 1})
        for (const int k : {-1, 0, 1}) {
            const double lx = projected_lx(beam, s + 1.0 * i / beam.width, t + 1.0 * k / beam.height);
            least = std::min(least, lx);
            most = std::max(most, lx);
        }
    const auto near_border = [](double u, int n) { return std::min(std::abs(u), std::abs(1.0 - u)) * n < 2.0; };
    const bool framed = near_border(s, beam.width) || near_border(t, beam.height); // the outermost texels are black
    const double step_lx = beam.steps.empty() ? 0.0 : beam.scale_lx / 255.0;       // drivers filter 8-bit textures in 8 bits
    return {projected_lx(beam, s, t), framed ? most : 0.02 * (most - least) + step_lx};
}

struct Lamp {
    Pose pose; ///< in the car's frame
    double factor = 1.0;
    const ProjectedBeam* beam = nullptr;
    const CandelaTable* table = nullptr;
};

glm::dvec3 in_lamp(const Lamp& lamp, const glm::dvec3& p) {
    const glm::dvec3 w = to_local(lamp.pose, p);
    return {-w.y, w.z, w.x};
}

/// E_m in front of the lamp, or where `backwards`, also behind it, mirrored.
Value projected(const Lamp& lamp, const glm::dvec3& p, bool backwards, double q_offset) {
    const glm::dvec3 w = in_lamp(lamp, p);
    const TangentWindow& window = lamp.beam->window;
    const double q = w.z + q_offset;
    if (!backwards && q < 0.0)
        return {};
    // (2 x - (right + left) z) / (right - left) in -1..1 of q, then to 0..1: for q = z this is (x / z - left) / (right - left).
    const double s = 0.5 + 0.5 * (2.0 * w.x - (window.right + window.left) * w.z) / ((window.right - window.left) * q);
    const double t = 0.5 + 0.5 * (2.0 * w.y - (window.top + window.bottom) * w.z) / ((window.top - window.bottom) * q);
    return looked_up(*lamp.beam, s, t);
}

double interpolated(const Point& point, const std::function<double(const glm::dvec3&)>& of) {
    return point.weights.x * of(point.corners[0]) + point.weights.y * of(point.corners[1]) + point.weights.z * of(point.corners[2]);
}

/// Everything in the car's frame, lamps from left to right.
struct Car {
    explicit Car(const Moment& m, bool eight_bit = false) : moment(m) {
        moment.ego = {};
        for (LitLamp& lamp : moment.lamps)
            lamp.pose = {to_local(m.ego, lamp.pose.position_m), glm::transpose(m.ego.axes) * lamp.pose.axes};
        std::ranges::reverse(moment.lamps);
        for (const LitLamp& lamp : moment.lamps)
            beams.push_back(eight_bit ? make_projected_beam(lamp.file->table, {512, 128, 8})
                                      : make_projected_beam(lamp.file->table, {1024, 512, 32}));
        for (std::size_t i = 0; i < beams.size(); ++i)
            lamps.push_back({moment.lamps[i].pose, moment.lamps[i].intensity_factor, &beams[i], &moment.lamps[i].file->table});
    }
    Moment moment;
    std::vector<ProjectedBeam> beams;
    std::vector<Lamp> lamps;
};

using Formula = std::function<Value(const Car&, const Point&)>;

/// sum of 625 E_m f(lamp), plus sun.
Value summed(const Car& car, const Point& point, double sun_lx, double cd_per_lx, double q_offset,
             const std::function<bool(std::size_t)>& backwards, const std::function<double(std::size_t)>& fall_off) {
    Value sum{sun_lx, 0.0};
    for (std::size_t i = 0; i < car.lamps.size(); ++i) {
        const Value e_m = projected(car.lamps[i], point.p, backwards(i), q_offset);
        const double times = cd_per_lx * car.lamps[i].factor * fall_off(i);
        sum.lx += times * e_m.lx;
        sum.slack_lx += times * e_m.slack_lx;
    }
    return sum;
}

double distance_by_vertex(const Car& car, const Point& point, std::size_t lamp, double plus = 0.0) {
    return interpolated(point, [&](const glm::dvec3& c) {
        const glm::dvec3 d = c - car.lamps[lamp].pose.position_m;
        return std::sqrt(glm::dot(d, d) + plus);
    });
}

double square(double x) { return x * x; }

Formula full(double sun_lx, bool backwards_unless_first, std::function<double(const Car&, const Point&, std::size_t)> fall_off) {
    return [=](const Car& car, const Point& point) {
        return summed(
            car, point, sun_lx, 625.0, 0.0, [&](std::size_t i) { return backwards_unless_first && i > 0; },
            [&](std::size_t i) { return fall_off(car, point, i); });
    };
}

double published_fall_off(const Car& car, const Point& point, std::size_t i) {
    return 1.0 / (1.0 + square(distance_by_vertex(car, point, i)));
}

Value simplified(const Car& car, const Point& point) {
    Car lowered = car; // its lamps point into the beams of `car`
    for (Lamp& lamp : lowered.lamps)
        lamp.pose.axes = lamp.pose.axes * axes_from_angles(0.0, -radians(0.92), 0.0);
    if (in_lamp(lowered.lamps.back(), point.p).z <= 0.0)
        return {};
    return summed(
        lowered, point, 0.0, 1.0, 0.0, [](std::size_t) { return true; }, [](std::size_t) { return 1.0; });
}

Value as_printed(const Car& car, const Point& point) {
    const double fall_off = 1.0 / (1.0 + square(distance_by_vertex(car, point, 0, 1.0)));
    return summed(
        car, point, sky_lx, 625.0, 1.0, [](std::size_t) { return false; }, [&](std::size_t) { return fall_off; });
}

Value vertex_projective(const Car& car, const Point& point) {
    Value sum{sky_lx, 0.0};
    for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3& c = point.corners[corner];
        for (const Lamp& lamp : car.lamps) {
            const Value e_m = projected(lamp, c, false, 0.0);
            const glm::dvec3 d = c - lamp.pose.position_m;
            const double times = point.weights[corner] * 625.0 * lamp.factor / (1.0 + glm::dot(d, d));
            sum.lx += times * e_m.lx;
            sum.slack_lx += times * e_m.slack_lx;
        }
    }
    return sum;
}

Value vertex_spots(const Car& car, const Point& point) {
    static std::map<const CandelaTable*, std::vector<Spot>> fitted;
    const auto at_vertex = [&](const glm::dvec3& c) {
        double lx = 0.0;
        for (const Lamp& lamp : car.lamps) {
            if (!fitted.contains(lamp.table))
                fitted[lamp.table] = fit_spots(*lamp.table, 8).spots;
            const glm::dvec3 w = in_lamp(lamp, c);
            const double h = std::atan2(w.x, w.z), v = std::atan2(w.y, std::hypot(w.x, w.z)), d = glm::length(w);
            double cd = 0.0;
            for (const Spot& spot : fitted[lamp.table])
                cd += intensity_cd(spot, degrees(h), degrees(v));
            lx += lamp.factor * cd * std::max(glm::dot(point.normal, lamp.pose.position_m - c), 0.0) / (d * d * d);
        }
        return lx;
    };
    return {sky_lx + interpolated(point, at_vertex), 0.0};
}

Value merged(const Car& car, const Point& point) {
    static const ProjectedBeam beam = make_merged_beam(car.moment.lamps, {1024, 512, 32});
    const Lamp lamp{merged_pose(car.moment.lamps), 1.0, &beam, nullptr};
    const double d = interpolated(point, [&](const glm::dvec3& c) { return glm::distance(c, lamp.pose.position_m); });
    const Value e_m = projected(lamp, point.p, false, 0.0);
    return {sky_lx + 625.0 * e_m.lx / (1.0 + d * d), 625.0 * e_m.slack_lx / (1.0 + d * d)};
}

/// Light maps: 1/50 of a cell, and black cells along the borders.
template <class Map, class At> Value mapped(const Map& map, const glm::dvec3& p, At at) {
    const auto cell = [](const LightMapAxis& axis, double m) {
        const double u = std::clamp(texture_coordinate(axis, m), 0.0, 1.0);
        return std::pair(position_m(axis, std::min(u + 1.0 / axis.cells, 1.0)) - position_m(axis, u),
                         std::min(u, 1.0 - u) * axis.cells < 2.0);
    };
    const auto [x, x_border] = cell(map.ahead, p.x);
    const auto [y, y_border] = cell(map.left, p.y);
    double least = 1e300, most = 0.0;
    for (const int i : {-1, 0, 1})
        for (const int k : {-1, 0, 1}) {
            const double lx = at(glm::dvec3(p.x + i * x, p.y + k * y, p.z));
            least = std::min(least, lx);
            most = std::max(most, lx);
        }
    return {sky_lx + at(p), x_border || y_border ? most : 0.02 * (most - least)};
}

Value ground_map(const Car& car, const Point& point) {
    static const LightMap map = bake_ground(car.moment);
    return mapped(map, point.p, [&](const glm::dvec3& p) { return mapped_lx(map, {p.x, p.y, 0.0}); });
}

Value volume_map(const Car& car, const Point& point) {
    static const LightMap map = bake_volume(car.moment);
    return mapped(map, point.p, [&](const glm::dvec3& p) { return mapped_lx(map, p); });
}

const std::map<std::string, Formula>& formulas() {
    static const std::map<std::string, Formula> all{
        {"full", full(sky_lx, false, published_fall_off)},
        {"full-no-sun", full(0.0, true, published_fall_off)},
        {"full-clamped", full(sky_lx, false, published_fall_off)},
        {"full-unsquared",
         full(sky_lx, false, [](const Car& c, const Point& p, std::size_t i) { return 1.0 / (1.0 + distance_by_vertex(c, p, i)); })},
        {"full-one-distance", full(sky_lx, false, [](const Car& c, const Point& p, std::size_t) { return published_fall_off(c, p, 0); })},
        {"simplified", simplified},
        {"as-printed", as_printed},
        {"vertex-spots", vertex_spots},
        {"vertex-projective", vertex_projective},
        {"two-pass-projective", full(sky_lx, false, published_fall_off)},
        {"merged-beams", merged},
        {"light-map-2d", ground_map},
        {"light-map-3d", volume_map},
        {"axial-distance",
         full(sky_lx, false, [](const Car& c, const Point& p, std::size_t i) { return 1.0 / square(in_lamp(c.lamps[i], p.p).z); })},
    };
    return all;
}

/// What the pixel shows, nullopt for the sky and for pixels at the border between two triangles.
std::optional<Point> point_at(const Scene& scene, const Moment& moment, const View& view, int x, int y) {
    const TwinPixel pixel = Twin(scene, false).pixel(moment, view, x + 0.5, y + 0.5);
    if (pixel.id == 0)
        return std::nullopt;
    const Mesh& mesh = scene.meshes[pixel.id - 1];
    const auto in_car = [&](const glm::dvec3& v) { return v * moment.ego.axes; };
    Point point{in_car(pixel.point_m), {}, in_car(pixel.normal), {}};
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        for (std::size_t c = 0; c < 3; ++c)
            point.corners[c] = in_car(glm::dvec3(mesh.vertices[mesh.indices[k + c]].position_m));
        const glm::dvec3 a = point.corners[1] - point.corners[0], b = point.corners[2] - point.corners[0], p = point.p - point.corners[0];
        const glm::dvec3 n = glm::cross(a, b);
        const double u = glm::dot(glm::cross(p, b), n) / glm::dot(n, n), v = glm::dot(glm::cross(a, p), n) / glm::dot(n, n);
        point.weights = {1.0 - u - v, u, v};
        if (u > 1e-3 && v > 1e-3 && u + v < 1.0 - 1e-3)
            return point;
    }
    return std::nullopt;
}

struct Comparison {
    int compared = 0, lit = 0;
    double worst_ratio = 0.0; ///< of the tolerance
};

struct Pixel {
    int x = 0, y = 0;
    Point point;
};

/// Every third pixel each way.
std::vector<Pixel> pixels_of(const Scene& scene, const Moment& moment, const View& view) {
    std::vector<Pixel> pixels;
    for (const auto& [x, y] : each_pixel(view, 0, 3))
        if (const std::optional<Point> point = point_at(scene, moment, view, x, y))
            pixels.push_back({x, y, *point});
    return pixels;
}

Comparison compare(const Frame& frame, const Formula& formula, const std::vector<Pixel>& pixels, const Car& car) {
    Comparison result;
    for (const auto& [x, y, point] : pixels) {
        const Value expected = formula(car, point);
        // 1e-3: a pixel's place, found by perspective interpolation in float over triangles of up to 160 m, moves by 1e-4 of its distance
        // from the lamp, and light goes with its square and the angle.
        const double tolerance = expected.slack_lx + 1e-3 * expected.lx + 1e-4, found = static_cast<double>(frame.illuminance_lx.at(x, y));
        const double ratio = std::abs(found - expected.lx) / tolerance;
        if (ratio > 1.0 && result.worst_ratio <= 1.0)
            ADD_FAILURE() << "first at pixel " << x << ' ' << y << ", " << point.p.x << " m ahead, " << point.p.y << " m left, "
                          << point.p.z << " m up: found " << found << " lx, expected " << expected.lx << " within " << tolerance;
        result.worst_ratio = std::max(result.worst_ratio, ratio);
        ++result.compared;
        result.lit += std::abs(expected.lx - sky_lx) > 0.1 ? 1 : 0;
    }
    return result;
}

TEST_F(PublishedTest, EachFollowsItsOwnFormula) {
    const Moment moment = two_lamps(sky_lx);
    const Car car(moment);
    const std::vector<View> views{view_towards(0.0, -4.0), view_towards(170.0, -8.0), map_view(60.0, 10.0, 15.0, 48, 112)};
    for (const int cells : {40, 1}) {
        const Scene scene = ground_and_board(moment.ego, cells);
        std::vector<std::vector<Pixel>> pixels;
        for (const View& view : views)
            pixels.push_back(pixels_of(scene, moment, view));
        for (const auto& [technique, formula] : formulas()) {
            Renderer drawing = renderer(technique, scene);
            int lit = 0;
            for (std::size_t v = 0; v < views.size(); ++v) {
                SCOPED_TRACE(technique + ", " + std::to_string(cells) + " cells, view " + std::to_string(v));
                const Comparison c = compare(drawing.draw(moment, views[v], lux_and_ids), formula, pixels[v], car);
                EXPECT_GT(c.compared, 100);
                lit += c.lit;
            }
            const bool by_vertex = technique == "vertex-spots" || technique == "vertex-projective";
            EXPECT_GT(lit, by_vertex && cells == 1 ? -1 : 100) << technique << ", " << cells << " cells";
        }
    }
}

TEST_F(PublishedTest, EightBitBeamsAreTheThesiss) {
    const Moment moment = two_lamps(sky_lx);
    const Scene scene = ground_and_board(moment.ego, 40);
    Renderer coarse = renderer("full", scene, true), fine = renderer("full", scene);
    const View view = view_towards(0.0, -4.0);
    const Frame frame = coarse.draw(moment, view, lux_and_ids);
    EXPECT_GT(compare(frame, formulas().at("full"), pixels_of(scene, moment, view), Car(moment, true)).compared, 100);
    EXPECT_NE(frame.illuminance_lx, fine.draw(moment, view, lux_and_ids).illuminance_lx);
    EXPECT_EQ(coarse.count(moment, view, lux_and_ids).texture_bytes, 2U * 512 * 128);
    EXPECT_EQ(fine.count(moment, view, lux_and_ids).texture_bytes, 2U * 1024 * 512 * 4);
    EXPECT_GT(coarse.beam_error(*moment.lamps[0].file).value(), fine.beam_error(*moment.lamps[0].file).value());
    EXPECT_FALSE(renderer("plain", scene).beam_error(*moment.lamps[0].file));
}

// d interpolated from vertices depends on the tessellation, although the thesis claims independence of it: its error, wanted here.
TEST_F(PublishedTest, TheDistanceDependsOnTheTessellation) {
    const Moment moment = two_lamps(0.0);
    const Scene fine = ground_and_board(moment.ego, 320), coarse = ground_and_board(moment.ego, 1);
    const View view = view_towards(0.0, -4.0);
    for (const auto& [technique, differs] : {std::pair("full", true), std::pair("axial-distance", false)}) {
        const Frame a = drawn(technique, fine, moment, view), b = drawn(technique, coarse, moment, view);
        double worst = 1.0;
        for (int x = 0; x < view.width_px; ++x)
            for (int y = 40; y < view.height_px; ++y)
                if (a.ids.at(x, y) == 1 && a.illuminance_lx.at(x, y) > 1.0F && b.ids.at(x, y) == 1)
                    worst = std::max(worst, static_cast<double>(a.illuminance_lx.at(x, y) / b.illuminance_lx.at(x, y)));
        EXPECT_EQ(worst > 5.0, differs) << technique << ": " << worst; // 10 m ahead the corners 60 and 100 m away decide
        if (!differs) {
            EXPECT_LT(worst, 1.05); // 1 - r/q cancels all but 0.1 m / z of the float's digits
        }
    }
}

} // namespace
} // namespace fernlicht
