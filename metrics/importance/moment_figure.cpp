#include "metrics/importance/moment_figure.h"

#include "metrics/folds/glare_followed.h"
#include "metrics/folds/place_fold.h"
#include "metrics/road/lit_road.h"
#include "metrics/seeing/homogeneity.h"
#include "metrics/seeing/visibility.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/roads/mesh/mesh_materials.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace fernlicht {
namespace {

class SteepestGradient final : public MomentFigure {
  public:
    SteepestGradient(const ReadingKey& key, double min_lx, LanePlaces places)
        : along_(key.place == ReadingPlace::along), per_m_(key.quantity == Quantity::gradient_per_m), min_lx_(min_lx),
          places_(std::move(places)) {}

    Value value(const Moment& moment) const override {
        const Gradient found = steepest(lit(moment));
        return per_m_ ? found.per_m : found.per_degree;
    }

    void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const override {
        const LaneLight light = lit(moment);
        const Gradient found = steepest(light);
        const auto [a, b] = per_m_ ? found.per_m_between : found.per_degree_between;
        const double figure = per_m_ ? found.per_m : found.per_degree, ln = std::log(light.lx[b] / light.lx[a]); // figure ~ |ln|
        if (figure == 0.0)
            return;
        for (const auto& [at, sign] : {std::pair(a, -1.0), std::pair(b, 1.0)}) {
            const Pose& pose = places_.surface[at];
            fernlicht::add_gradient(gradient, moment, {pose.position_m, Facing::surface, pose.up()},
                                    weight * sign * figure / (ln * light.lx[at]));
        }
    }

  private:
    LaneLight lit(const Moment& moment) const {
        LaneLight light = places_.light;
        for (const Pose& pose : places_.surface)
            light.lx.push_back(surface_illuminance_lx(moment, pose.position_m, pose.up()));
        return light;
    }
    Gradient steepest(const LaneLight& light) const {
        const Gradients found = largest_gradients(light, min_lx_);
        return along_ ? found.along : found.across;
    }

    bool along_, per_m_;
    double min_lx_;
    LanePlaces places_;
};

class Foreground final : public MomentFigure {
  public:
    Foreground(bool ratio, LanePlaces places) : ratio_(ratio), places_(std::move(places)) {
        // Rows without a share in either stay dark.
        places_.light.lx.assign(places_.surface.size(), 1.0);
        if ((ratio ? foreground_ratio(places_.light) : foreground_lx(places_.light)).measured()) {
            const std::vector<double> shares = shares_in(places_.light);
            for (std::size_t i = 0; i < shares.size(); ++i)
                if (shares[i] != 0.0)
                    used_.push_back(i);
        }
        places_.light.lx.assign(places_.surface.size(), 0.0);
    }

    Value value(const Moment& moment) const override {
        const LaneLight light = lit(moment);
        return ratio_ ? foreground_ratio(light) : foreground_lx(light);
    }

    void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const override {
        const std::vector<double> shares = shares_in(lit(moment));
        for (const std::size_t i : used_)
            fernlicht::add_gradient(gradient, moment, {places_.surface[i].position_m, Facing::surface, places_.surface[i].up()},
                                    weight * shares[i]);
    }

  private:
    LaneLight lit(const Moment& moment) const {
        LaneLight light = places_.light;
        for (const std::size_t i : used_)
            light.lx[i] = surface_illuminance_lx(moment, places_.surface[i].position_m, places_.surface[i].up());
        return light;
    }
    std::vector<double> shares_in(const LaneLight& light) const {
        return ratio_ ? foreground_ratio_shares(light) : foreground_shares(light);
    }

    bool ratio_;
    LanePlaces places_;
    std::vector<std::size_t> used_;
};

class Uniformity final : public MomentFigure {
  public:
    explicit Uniformity(std::vector<glm::dvec3> targets) : targets_(std::move(targets)) {}

    Value value(const Moment& moment) const override { return uniformity(lit(moment)); }

    void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const override {
        const std::vector<double> shares = uniformity_shares(lit(moment));
        for (std::size_t i = 0; i < targets_.size(); ++i)
            fernlicht::add_gradient(gradient, moment, {targets_[i]}, weight * shares[i]);
    }

  private:
    std::vector<double> lit(const Moment& moment) const {
        std::vector<double> lx;
        for (const glm::dvec3& target : targets_)
            lx.push_back(target_illuminance_lx(moment, target));
        return lx;
    }
    std::vector<glm::dvec3> targets_;
};

class LaneArea final : public MomentFigure {
  public:
    LaneArea(const ReadingKey& key, double last_row_m, ExtentGrid grid)
        : surface_(key.surface == ReadingSurface::road ? Surface::road : Surface::target), threshold_lx_(key.threshold.value),
          last_row_m_(last_row_m), grid_(std::move(grid)) {}

    /// As runner/findings/summary.cpp takes it.
    Value value(const Moment& moment) const override {
        const std::vector<double> lx = twin_lux_near_thresholds(grid_, moment, surface_, {threshold_lx_});
        const LaneExtent extent = measure_extent(grid_, lx, surface_, {threshold_lx_}, {}).front();
        const auto ends_early = [&](bool cut_off, double reach_m) { return cut_off && reach_m < last_row_m_; };
        if (ends_early(extent.reach_is_cut_off, extent.reach_centre_m) ||
            ends_early(extent.left_edge_is_cut_off, extent.reach_left_edge_m) ||
            ends_early(extent.right_edge_is_cut_off, extent.reach_right_edge_m))
            return Value::not_measured("cut off by the end of the road or lane");
        return extent.area_is_cut_off() ? Value::at_least(extent.area_m2) : Value(extent.area_m2);
    }

    void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const override {
        const std::vector<double> lx = twin_illuminance_lx(grid_, moment, surface_);
        const LitRoad road(grid_, lx);
        const std::vector<double> shares = LitArea(road, threshold_lx_).lane_shares(grid_.strips.front().spans);
        for (std::size_t i = 0; i < shares.size(); ++i)
            if (shares[i] != 0.0)
                fernlicht::add_gradient(gradient, moment, surface_place(grid_, i, surface_), weight * shares[i]);
    }

  private:
    Surface surface_;
    double threshold_lx_, last_row_m_;
    ExtentGrid grid_; ///< of the lane alone
};

class Glare final : public MomentFigure {
  public:
    Glare(Quantity quantity, LightPlace eye, const GlareParameters& parameters, Value adaptation_cdm2)
        : quantity_(quantity), eye_(std::move(eye)), parameters_(parameters), adaptation_cdm2_(std::move(adaptation_cdm2)) {}

    Value value(const Moment& moment) const override {
        std::vector<GlareSource> sources;
        const std::vector<SeenLamp> lamps = seen_lamps(moment, eye_.point_m);
        for (std::size_t i = 0; i < lamps.size(); ++i) {
            sources.push_back(glare_source(lamps[i], eye_.point_m, eye_.normal));
            if (eye_.hidden[i])
                sources.back().eye_lx = 0.0;
        }
        return of(sources);
    }

    void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const override {
        const double now = *value(moment).number();
        std::vector<double> per_cd;
        for (std::size_t i = 0; i < moment.lamps.size(); ++i) {
            const glm::dvec3& lamp_m = moment.lamps[i].pose.position_m;
            const double distance_m = glm::distance(lamp_m, eye_.point_m),
                         lx_per_cd = air_transmittance(moment.weather, distance_m) / (distance_m * distance_m);
            const std::optional<double> alone = of({glare_source({"", lamp_m, lx_per_cd}, eye_.point_m, eye_.normal)}).number();
            // W = 5 - 2 lg G, and G is the sum of each lamp's
            const double by_lamp = !alone                                 ? 0.0
                                   : quantity_ != Quantity::glare_de_boer ? *alone
                                                                          : -2.0 / std::log(10.0) * std::pow(10.0, 0.5 * (now - *alone));
            per_cd.push_back(eye_.hidden[i] ? 0.0 : weight * by_lamp);
        }
        fernlicht::add_gradient(gradient, moment, eye_.point_m, per_cd);
    }

  private:
    Value of(const std::vector<GlareSource>& sources) const {
        const GlareFigures figures = glare_figures(sources, 0.0, adaptation_cdm2_, parameters_);
        if (quantity_ == Quantity::glare_veiling || !figures.veiling_cdm2.measured())
            return figures.veiling_cdm2;
        if (!adaptation_cdm2_.measured() || (quantity_ == Quantity::glare_de_boer && *figures.eye_lx.number() == 0.0))
            return {};
        return quantity_ == Quantity::glare_de_boer ? figures.de_boer : figures.increment_percent;
    }

    Quantity quantity_;
    LightPlace eye_;
    const GlareParameters parameters_;
    Value adaptation_cdm2_;
};

class Margin final : public MomentFigure {
  public:
    Margin(LightPlace place, double limit_lx) : place_(std::move(place)), limit_lx_(limit_lx) {}
    Value value(const Moment& moment) const override { return 100.0 * (1.0 - light_lx(moment, place_) / limit_lx_); }
    void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const override {
        fernlicht::add_gradient(gradient, moment, place_, -100.0 / limit_lx_ * weight);
    }

  private:
    LightPlace place_;
    double limit_lx_;
};

/// The columns that the lane lies between, and the lane alone.
ExtentGrid grid_of_lane(const ExtentGrid& grid, const LaneStrip& strip) {
    double left_m = grid.offset_m.front(), right_m = grid.offset_m.back();
    for (const std::optional<LaneSpan>& span : strip.spans)
        if (span) {
            left_m = std::max(left_m, span->left_m);
            right_m = std::min(right_m, span->right_m);
        }
    const std::size_t first = column_left_of(grid.offset_m, right_m) - 1, end = column_left_of(grid.offset_m, left_m) + 1;
    const std::size_t columns = grid.offset_m.size();
    ExtentGrid part;
    part.ahead_m = grid.ahead_m;
    part.offset_m.assign(grid.offset_m.begin() + static_cast<std::ptrdiff_t>(first),
                         grid.offset_m.begin() + static_cast<std::ptrdiff_t>(end));
    part.sections.resize(grid.ahead_m.size()); // whose lanes are known
    part.target_height_m = grid.target_height_m;
    for (std::size_t row = 0; row < grid.ahead_m.size(); ++row) {
        const auto take = [&](const auto& from, std::size_t stride, std::size_t count, auto& to) {
            const auto begin = from.begin() + static_cast<std::ptrdiff_t>(row * stride + first);
            to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
        };
        take(grid.surface, columns, end - first, part.surface);
        if (row + 1 < grid.ahead_m.size())
            take(grid.cell_m2, columns - 1, end - first - 1, part.cell_m2);
    }
    part.places = SurfacePlaces(part.surface);
    part.strips = {strip};
    return part;
}

/// Across the step d in either direction where the function is measured there: of a step h the error is h^2 f''' / 6 by truncation and
/// f eps / h by rounding, which are alike where h is the cube root of eps, 6e-6 of the scale.
template <class Function> double slope_at(const Function& function, double x, double scale) {
    const double step = std::cbrt(std::numeric_limits<double>::epsilon()) * scale;
    const Value low = function(x - step), high = function(x + step);
    const double from = low.number() ? x - step : x, to = high.number() ? x + step : x;
    return (*(high.number() ? high : function(x)).number() - *(low.number() ? low : function(x)).number()) / (to - from);
}

class Sight final : public MomentFigure {
  public:
    struct Place {
        double ahead_m = 0.0;
        std::vector<TargetSquare> squares;
    };
    Sight(const VisibilityTarget& target, const VisibilityParameters& asked, const glm::dvec3& eye_m, Pavement pavement, bool is_level,
          bool to_routes_end, std::vector<Place> places)
        : target_(target), asked_(asked), eye_m_(eye_m), pavement_(pavement), is_level_(is_level), to_routes_end_(to_routes_end),
          places_(std::move(places)) {}

    Value value(const Moment& moment) const override {
        if (is_level_)
            return target_level(lit(moment, 0), target_.reflectance, asked_);
        const std::vector<LineSample> levels = farthest_levels(moment);
        return known_detection(lit_line(levels, target_.level).last_m, levels, target_.level, to_routes_end_);
    }

    void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const override {
        if (is_level_) {
            add_place(gradient, moment, 0, weight);
            return;
        }
        const std::vector<LineSample> levels = farthest_levels(moment);
        const std::size_t first = places_.size() - levels.size();
        for (const ValueShare& one : lit_line_shares(levels, target_.level).last)
            add_place(gradient, moment, first + one.index, weight * one.by_value);
    }

  private:
    std::vector<TargetSquare> lit(const Moment& moment, std::size_t place) const {
        std::vector<TargetSquare> squares = places_[place].squares;
        light_squares(moment, eye_m_, asked_, pavement_, squares);
        return squares;
    }

    /// From the farthest place at which it is detected on: nearer ones decide nothing.
    std::vector<LineSample> farthest_levels(const Moment& moment) const {
        std::vector<LineSample> levels;
        for (std::size_t i = places_.size(); i-- > 0;) {
            levels.push_back({places_[i].ahead_m, places_[i].squares.empty()
                                                      ? std::nullopt
                                                      : target_level(lit(moment, i), target_.reflectance, asked_).number()});
            if (levels.back().lx && *levels.back().lx >= target_.level)
                break;
        }
        std::ranges::reverse(levels);
        return levels;
    }

    void add_place(BeamGradient& gradient, const Moment& moment, std::size_t place, double per_level) const {
        const std::vector<TargetSquare> squares = lit(moment, place);
        const auto clearest = std::ranges::max_element(squares, {}, [&](const TargetSquare& square) {
            return square_level(square, target_.reflectance, asked_).number().value_or(-1.0);
        });
        if (clearest->hidden)
            return;
        const Onlooker onlooker{asked_.age_years, asked_.time_s, asked_.k};
        const double shown = clearest->target_cdm2(target_.reflectance), behind = clearest->background_cdm2,
                     adapted = clearest->adaptation_cdm2, size = clearest->size_arcmin, scale = std::max(shown, behind);
        const double by_shown = slope_at([&](double x) { return visibility_level(x, behind, adapted, size, onlooker); }, shown, scale);
        fernlicht::add_gradient(gradient, moment, {clearest->middle_m, Facing::surface, clearest->face, clearest->unlit},
                                per_level * by_shown * clearest->left * target_.reflectance / pi);
        const auto add_road = [&](const TargetSquare& square, double by_luminance) {
            std::vector<double> per_cd = luminance_per_cd(moment, square.behind_m, square.road_up, pavement_material(pavement_), eye_m_);
            for (double& one : per_cd)
                one *= per_level * by_luminance;
            fernlicht::add_gradient(gradient, moment, square.behind_m, per_cd);
        };
        if (clearest->on_road)
            add_road(*clearest, slope_at([&](double x) { return visibility_level(shown, x, adapted, size, onlooker); }, behind, scale));
        const auto adapting = std::ranges::find_if(squares, [&](const TargetSquare& square) {
            return square.on_road && (&square == &*clearest || (!clearest->on_road && square.background_cdm2 == adapted));
        });
        if (adapting != squares.end())
            add_road(*adapting, slope_at([&](double x) { return visibility_level(shown, behind, x, size, onlooker); }, adapted, adapted));
    }

    const VisibilityTarget target_;
    const VisibilityParameters asked_;
    glm::dvec3 eye_m_;
    Pavement pavement_;
    bool is_level_, to_routes_end_;
    std::vector<Place> places_;
};

} // namespace

MomentFigurePointer evenness_figure(const ReadingKey& key, const HomogeneityParameters& asked, const Drive& drive, const Route& route,
                                    const Moment& moment) {
    Moment lit = moment;
    std::erase_if(lit.lamps, [](const LitLamp& lamp) { return lamp.intensity_factor == 0.0; });
    if (lit.lamps.empty())
        return nullptr;
    if (key.quantity == Quantity::uniformity) {
        const double at_m = moment.distance_m + drive.bumper_m + *key.distance_m;
        return at_m > route.length_m() ? nullptr : std::make_shared<Uniformity>(targets_across(route, at_m));
    }
    LanePlaces places = lane_places(drive, asked, route, lit, to_parent(moment.ego, driver_eye_m(drive)));
    if (key.quantity == Quantity::gradient_per_m || key.quantity == Quantity::gradient_per_deg)
        return std::make_shared<SteepestGradient>(key, asked.min_lx, std::move(places));
    if (key.quantity != Quantity::foreground && key.quantity != Quantity::foreground_ratio)
        throw std::logic_error("evenness_figure: " + name_of(key) + " has no figure");
    return std::make_shared<Foreground>(key.quantity == Quantity::foreground_ratio, std::move(places));
}

LightPlace surface_place(const ExtentGrid& grid, std::size_t point, Surface surface) {
    const Pose& pose = grid.surface[point];
    return surface == Surface::road ? LightPlace{pose.position_m, Facing::surface, pose.up()}
                                    : LightPlace{pose.position_m + grid.target_height_m * pose.up(), Facing::lamps, pose.up()};
}

MomentFigurePointer glare_figure(Quantity quantity, const LightPlace& eye, const GlareParameters& parameters,
                                 const Value& adaptation_cdm2) {
    return std::make_shared<Glare>(quantity, eye, parameters, adaptation_cdm2);
}

MomentFigurePointer margin_figure(const LightPlace& place, double limit_lx) { return std::make_shared<Margin>(place, limit_lx); }

MomentFigurePointer area_figure(const ReadingKey& key, const ExtentParameters& asked, const Drive& drive, const Route& route,
                                const Moment& moment) {
    const ExtentGrid grid = make_extent_grid(route, moment, drive.bumper_m, asked);
    const auto strip = std::ranges::find(grid.strips, key.lane, &LaneStrip::name);
    if (grid.ahead_m.size() < 2 || grid.offset_m.size() < 2 || strip == grid.strips.end())
        return nullptr;
    return std::make_shared<LaneArea>(key, asked.ahead_m - asked.cell_m, grid_of_lane(grid, *strip));
}

MomentFigurePointer sight_figure(const ReadingKey& key, const VisibilityTarget& target, Across across, const VisibilityParameters& asked,
                                 const Drive& drive, const Route& route, const Moment& moment) {
    const SeenLane seen(drive, route, asked, moment);
    const double bumper_m = moment.distance_m + drive.bumper_m, room_m = std::min(asked.ahead_m, route.length_m() - bumper_m);
    std::vector<Sight::Place> places;
    const auto add = [&](double ahead_m) {
        places.push_back({ahead_m, target_squares(moment, seen, route, bumper_m + ahead_m, across, target.size_m, target.squares)});
    };
    const bool is_level = key.quantity == Quantity::visibility_level;
    if (is_level && bumper_m + *key.distance_m > route.length_m())
        return nullptr;
    if (is_level)
        add(*key.distance_m);
    else
        for (std::size_t k = 1; static_cast<double>(k) * asked.step_m <= room_m; ++k)
            add(static_cast<double>(k) * asked.step_m);
    if (is_level && places.front().squares.empty())
        return nullptr;
    return std::make_shared<Sight>(target, asked, seen.eye.at_m, drive.road_surface.pavement, is_level, room_m < asked.ahead_m,
                                   std::move(places));
}

} // namespace fernlicht
