// Which light each reading follows from, and which moments decide it.
#include "metrics/folds/glare_fold.h"
#include "metrics/folds/place_fold.h"
#include "metrics/glare/wet_road.h"
#include "metrics/importance/reading_of_light.h"
#include "metrics/road/lit_road.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {
namespace {

/// Of quantile_of() by those of the values that are numbers and may count.
ValueShares quantile_shares(const std::vector<Value>& values, double share, const std::function<bool(std::size_t)>& counts = nullptr) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i].measured() && (!counts || counts(i)))
            order.push_back(i);
    if (order.empty())
        return {};
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return *values[i].figure(); });
    const double place = share * static_cast<double>(order.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, order.size() - 1);
    const double rest = place - static_cast<double>(below);
    return {{order[below], 1.0 - rest}, {order[above], rest}};
}

ValueShares largest_shares(const std::vector<Value>& values) {
    const auto found = std::ranges::max_element(values, {}, [](const Value& value) { return value.number().value_or(-1.0); });
    return found == values.end() ? ValueShares{} : ValueShares{{static_cast<std::size_t>(found - values.begin()), 1.0}};
}

std::vector<std::string> reasons_of(const std::vector<Value>& figures) {
    std::vector<std::string> reasons;
    for (const Value& figure : figures)
        reasons.push_back(figure.reason());
    return reasons;
}

/// A quantile of the moments in a range, or the largest figure of it, both ends among them.
bool is_figure_of_eye(Quantity quantity) {
    return quantity == Quantity::glare_veiling || quantity == Quantity::glare_increment || quantity == Quantity::glare_de_boer;
}

Value value_in_range(const FollowedFigure& followed, double near_m, double far_m, const std::optional<double>& share, bool of_largest) {
    const std::string none = "no moment of the drive was measured";
    return share ? followed.quantile_between(near_m, far_m, *share, none) : followed.extreme_between(near_m, far_m, of_largest, none);
}

ValueShares shares_in_range(const Approach& approach, const std::vector<Value>& figures, double near_m, double far_m,
                            const std::optional<double>& share, bool of_largest) {
    const auto within = [&](std::size_t i) { return approach[i].distance_m >= near_m && approach[i].distance_m <= far_m; };
    if (share)
        return quantile_shares(figures, *share, within);
    ValueShares best = quantile_shares(figures, of_largest ? 1.0 : 0.0, within);
    constexpr double none = std::numeric_limits<double>::infinity();
    double worst = !best.empty() ? *figures[best.front().index].number() : of_largest ? -none : none;
    for (const double end_m : {far_m, near_m}) {
        const double here = value_at(approach, end_m).number().value_or(worst);
        if (of_largest ? here > worst : here < worst) {
            worst = here;
            best = value_at_shares(approach, end_m);
        }
    }
    return best;
}

/// Of each lamp, whether the road stands before it.
std::vector<bool> hidden_by_road(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point_m) {
    const RoadBetween road(route, moment.distance_m, to_m);
    std::vector<bool> hidden;
    for (const LitLamp& lamp : moment.lamps)
        hidden.push_back(lamp.intensity_factor > 0.0 && road.hides(lamp.pose.position_m, point_m));
    return hidden;
}

} // namespace

void ReadingOfLight::refuse(const ReadingKey& key, const std::string& expected) const {
    throw InputError({{}, 0, 0, asked_by_}, "found '" + name_of(key) + "'", expected);
}

double ReadingOfLight::share_of_statistic(const ReadingKey& key) const {
    switch (key.statistic) {
    case Statistic::none:
    case Statistic::median:
        return 0.5;
    case Statistic::minimum:
        return 0.0;
    case Statistic::maximum:
        return 1.0;
    case Statistic::p05:
        return 0.05;
    case Statistic::p95:
        return 0.95;
    default:
        refuse(key, "a median, a quantile or an extreme");
    }
}

ReadingOfLight::ReadingOfLight(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments,
                               std::string asked_by, const LampSet* lamp_set)
    : quantity_(key.quantity), asked_by_(std::move(asked_by)) {
    using enum Quantity;
    const bool of_eye =
        (key.quantity == glare_facing || key.quantity == glare_eye || is_figure_of_eye(key.quantity)) && !key.subject.empty();
    const bool of_evenness = key.quantity == gradient_per_m || key.quantity == gradient_per_deg || key.quantity == foreground ||
                             key.quantity == foreground_ratio || key.quantity == uniformity;
    const bool of_sight = key.quantity == detection || key.quantity == visibility_level;
    const bool of_extent = key.quantity == reach || key.quantity == width || key.quantity == area;
    const bool of_light = key.quantity == sensor_reach || key.quantity == sensor_illuminance || key.quantity == kerb_illuminance ||
                          key.quantity == mirror_illuminance || of_eye;
    if (key.aspect != Aspect::value || !(of_light || of_extent || of_evenness || of_sight))
        refuse(key, fmt::format("a reading that is light or where light ends: {}", importance_readings));
    const auto mirroring = [&](const Moment& moment) { return mirrors(moment.weather, drive.road_surface.pavement); };
    if (of_light && std::ranges::any_of(moments, mirroring))
        refuse(key, "a dry road without gloss: what another mirrors to a place comes from more than one direction of the beam");
    if (of_sight &&
        std::ranges::any_of(moments, [&](const Moment& moment) { return mirroring(moment) || moment.weather.extinction_per_m > 0.0; }))
        refuse(key, "clear air and a dry road without gloss: what fog scatters before a target and a road mirrors onto it comes from all "
                    "over the beam");
    if (key.quantity == area)
        add_area(key, drive, route, moments);
    else if (of_extent)
        add_lines(key, drive, route, moments);
    else if (of_evenness)
        add_evenness(key, drive, route, moments);
    else if (of_sight)
        add_sight(key, drive, route, moments);
    else if (of_eye)
        add_eye(key, drive, route, moments, lamp_set ? *lamp_set : drive.lamp_sets.front());
    else if (key.quantity == kerb_illuminance)
        add_kerb(key, drive, route, moments);
    else if (key.quantity == mirror_illuminance)
        add_mirror(key, drive, route, moments);
    else
        add_sensor(key, drive, route, moments);
}

void ReadingOfLight::add_place(std::size_t moment, double to_go_m, LightPlace place) {
    InMoment& part = parts_.emplace_back(InMoment{moment, to_go_m});
    part.samples.emplace_back().places.push_back(std::move(place));
}

void ReadingOfLight::add_lines(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments) {
    if (!drive.extent)
        refuse(key, "a drive that measures its extent");
    const bool all = key.lane == "all";
    if (all && key.quantity == Quantity::reach && key.place == ReadingPlace::none)
        refuse(key, "the reach of one lane: of all, another line may reach farthest with every change");
    const Surface surface = key.surface == ReadingSurface::road ? Surface::road : Surface::target;
    threshold_lx_ = key.threshold.value;
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const ExtentGrid grid = make_extent_grid(route, moments[k], drive.bumper_m, *drive.extent);
        if (grid.ahead_m.size() < 2 || grid.offset_m.size() < 2)
            continue;
        const std::size_t columns = grid.offset_m.size();
        const auto place = [&](std::size_t row, std::size_t column) { return surface_place(grid, row * columns + column, surface); };
        const auto sample = [&](double at_m, std::size_t row, double along, double offset_m) {
            const std::size_t left = column_left_of(grid.offset_m, offset_m);
            Sample one{at_m};
            one.across = (offset_m - grid.offset_m[left - 1]) / (grid.offset_m[left] - grid.offset_m[left - 1]);
            one.along = along;
            one.places = {place(row, left - 1)};
            if (one.across > 0.0 || along > 0.0)
                one.places.push_back(place(row, left));
            if (along > 0.0)
                one.places.insert(one.places.end(), {place(row + 1, left - 1), place(row + 1, left)});
            return one;
        };
        const auto strip = std::ranges::find(grid.strips, key.lane, &LaneStrip::name);
        if (!all && strip == grid.strips.end())
            continue;
        const auto span_in = [&](std::size_t row) {
            return all ? std::optional(LaneSpan{grid.offset_m.back(), grid.offset_m.front()}) : strip->spans[row];
        };
        InMoment part{k};
        if (key.quantity == Quantity::reach) {
            part.whole_m = drive.extent->ahead_m - drive.extent->cell_m;
            for (std::size_t row = 0; row < grid.ahead_m.size(); ++row) {
                const std::optional<LaneSpan> span = span_in(row);
                if (!span) {
                    part.samples.push_back({grid.ahead_m[row], false});
                    continue;
                }
                const double offset_m = key.place == ReadingPlace::left_edge    ? span->left_m
                                        : key.place == ReadingPlace::right_edge ? span->right_m
                                                                                : 0.5 * (span->left_m + span->right_m);
                part.samples.push_back(sample(grid.ahead_m[row], row, 0.0, offset_m));
            }
        } else {
            const double at_m = *key.distance_m;
            if (at_m > grid.ahead_m.back())
                continue;
            const auto above = std::ranges::upper_bound(grid.ahead_m, at_m) - grid.ahead_m.begin();
            const auto row = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ssize(grid.ahead_m) - 2));
            const double along = (at_m - grid.ahead_m[row]) / (grid.ahead_m[row + 1] - grid.ahead_m[row]);
            const std::optional<LaneSpan> near = span_in(row), far = span_in(row + 1);
            if ((along < 1.0 && !near) || (along > 0.0 && !far))
                continue;
            const LaneSpan &from = near ? *near : *far, &to = far ? *far : *near;
            const double right_m = std::lerp(from.right_m, to.right_m, along), left_m = std::lerp(from.left_m, to.left_m, along);
            part.may_go_on = all;
            part.samples.push_back(sample(right_m, row, along, right_m));
            for (const double offset_m : grid.offset_m)
                if (offset_m > right_m && offset_m < left_m)
                    part.samples.push_back(sample(offset_m, row, along, offset_m));
            part.samples.push_back(sample(left_m, row, along, left_m));
        }
        parts_.push_back(std::move(part));
    }
    take_quantile(share_of_statistic(key));
}

/// Of those moments that have a figure.
void ReadingOfLight::take_quantile(double share, const std::string& why_none) {
    quantile_ = share;
    over_moments_ = [share, why_none](const std::vector<Value>& figures) {
        CensoredSamples samples(why_none);
        for (const Value& figure : figures)
            samples.add(figure);
        return OverMoments{samples.quantile(share), quantile_shares(figures, share)};
    };
}

/// As a median that some moment lacks.
void ReadingOfLight::take_median(bool everywhere, const std::string& why_not) {
    quantile_ = 0.5;
    over_moments_ = [everywhere, why_not](const std::vector<Value>& figures) {
        std::vector<double> numbers;
        for (const Value& figure : figures)
            if (figure.number())
                numbers.push_back(*figure.number());
        return OverMoments{everywhere && numbers.size() == figures.size() ? median_value(numbers, "no moment was played")
                                                                          : Value::not_measured(why_not),
                           quantile_shares(figures, 0.5)};
    };
}

void ReadingOfLight::add_figures(const std::vector<Moment>& moments, const std::function<MomentFigurePointer(const Moment&)>& figure_of) {
    std::vector<MomentFigurePointer> figures(moments.size());
    oneapi::tbb::parallel_for(std::size_t{0}, moments.size(), [&](std::size_t k) { figures[k] = figure_of(moments[k]); });
    for (std::size_t k = 0; k < moments.size(); ++k)
        if (figures[k]) {
            parts_.emplace_back(InMoment{k});
            parts_.back().of = std::move(figures[k]);
        }
}

void ReadingOfLight::add_area(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments) {
    if (!drive.extent)
        refuse(key, "a drive that measures its extent");
    if (key.lane == "all")
        refuse(key, "the area of one lane");
    add_figures(moments, [&](const Moment& moment) { return area_figure(key, *drive.extent, drive, route, moment); });
    take_quantile(share_of_statistic(key));
}

void ReadingOfLight::add_evenness(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments) {
    const HomogeneityParameters asked = drive.seeing.homogeneity.value_or(HomogeneityParameters{});
    add_figures(moments, [&](const Moment& moment) { return evenness_figure(key, asked, drive, route, moment); });
    take_quantile(share_of_statistic(key), "no lamp was lit in any moment");
}

void ReadingOfLight::add_sight(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments) {
    const VisibilityParameters asked = drive.seeing.visibility.value_or(VisibilityParameters{});
    const VisibilityTarget* sought = nullptr;
    Across place = Across::own_centre;
    std::vector<std::string> names;
    for (const VisibilityTarget& target : asked.targets)
        for (const Across across : target.places) {
            const ReadingKey one = detection_key(target, across);
            if (one.subject == key.subject && one.lane == key.lane && one.place == key.place) {
                sought = &target;
                place = across;
            }
            names.push_back(fmt::format("{}, {}", target.name, place_name(across)));
        }
    if (!sought)
        refuse(key, fmt::format("a target at one of its places: {}", fmt::join(names, "; ")));
    add_figures(moments, [&](const Moment& moment) { return sight_figure(key, *sought, place, asked, drive, route, moment); });
    if (key.quantity == Quantity::detection)
        take_quantile(share_of_statistic(key));
    else
        take_median(parts_.size() == moments.size(), "no such lane, beyond the route's end, or no level in some moment");
}

ReadingOfLight::ReadingOfLight(const std::vector<LimitedLight>& lights) : quantity_(Quantity::sensor_illuminance) {
    for (const LimitedLight& light : lights) {
        parts_.emplace_back(InMoment{light.moment});
        parts_.back().of = margin_figure(light.place, light.limit_lx);
    }
    take_quantile(0.0);
}

void ReadingOfLight::add_sensor(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments) {
    std::vector<std::string> names;
    const Sensor* sensor = nullptr;
    if (drive.seeing.sensors)
        for (const Sensor& one : drive.seeing.sensors->points) {
            names.push_back(one.name);
            sensor = one.name == key.subject ? &one : sensor;
        }
    if (!sensor)
        refuse(key, names.empty() ? "a drive with sensors" : fmt::format("one of its sensors: {}", fmt::join(names, ", ")));
    const std::optional<Pose> surface = place_on_road(route, sensor->across, sensor->at_m);
    if (!surface)
        refuse(key, fmt::format("a place that is there: there is no {} at {} m", place_name(sensor->across), sensor->at_m));
    const glm::dvec3 point_m = surface->position_m + sensor->above_m * surface->up();
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const double to_go_m = sensor->at_m - moments[k].distance_m - drive.bumper_m;
        passed_ = passed_ || to_go_m < 0.0;
        if (to_go_m >= 0.0)
            add_place(k, to_go_m, {point_m, Facing::lamps, {}, hidden_by_road(moments[k], route, sensor->at_m, point_m)});
    }
    if (key.quantity == Quantity::sensor_reach)
        over_moments_ = [this, limit = key.threshold.value](const std::vector<Value>& figures) {
            const Approach samples = approach(figures);
            return OverMoments{reached_from_m(samples, limit, passed_), reached_from_shares(samples, limit)};
        };
    else if (key.distance_m)
        over_moments_ = [this, at_m = *key.distance_m](const std::vector<Value>& figures) {
            const Approach samples = approach(figures);
            return OverMoments{value_at(samples, at_m), value_at_shares(samples, at_m)};
        };
    else {
        quantile_ = 1.0;
        over_moments_ = [this](const std::vector<Value>& figures) {
            return OverMoments{Value::of(largest(approach(figures)), "no moment of the drive before this place was measured"),
                               largest_shares(figures)};
        };
    }
}

void ReadingOfLight::add_eye(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments,
                             const LampSet& lamp_set) {
    std::vector<std::string> names;
    const GlareObserver* observer = nullptr;
    if (drive.seeing.glare)
        for (const GlareObserver& one : drive.seeing.glare->oncoming) {
            names.push_back(one.name);
            observer = one.name == key.subject ? &one : observer;
        }
    if (!observer)
        refuse(key, names.empty() ? "a drive with oncoming drivers (`glare`)"
                                  : fmt::format("one of its oncoming drivers: {}", fmt::join(names, ", ")));
    const std::optional<OncomingEye> eye = oncoming_eye(route, *observer);
    if (!eye)
        refuse(key, fmt::format("a place that is there: there is no oncoming lane at {} m", observer->at_m));
    std::optional<Value> adapted; // to the moment's sky and weather
    for (std::size_t k = 0; k < moments.size(); ++k)
        if (const double to_go_m = observer->at_m - moments[k].distance_m - drive.bumper_m; to_go_m >= 0.0) {
            add_place(k, to_go_m,
                      {eye->place_m, key.quantity == Quantity::glare_facing ? Facing::lamps : Facing::eye, eye->gaze,
                       hidden_by_road(moments[k], route, observer->at_m, eye->place_m)});
            if (is_figure_of_eye(key.quantity)) {
                if (key.quantity != Quantity::glare_veiling &&
                    !(adapted && moments[k].daylight == moments[k - 1].daylight && moments[k].weather == moments[k - 1].weather))
                    adapted = oncoming_adaptation_cdm2(drive, route, lamp_set,
                                                       oncoming_driver(drive, route, observer->at_m, observer->eye_height_m),
                                                       observer->at_m, moments[k]);
                parts_.back().of = glare_figure(key.quantity, parts_.back().samples.front().places.front(), *drive.seeing.glare,
                                                adapted.value_or(Value()));
            }
        }
    const bool of_largest = key.quantity != Quantity::glare_de_boer;
    const Statistic worst = of_largest ? Statistic::maximum : Statistic::minimum;
    if (key.to_m) {
        const std::optional<double> share = key.statistic == worst ? std::nullopt : std::optional(share_of_statistic(key));
        // Light at the ends of the range is taken from between moments: of an extreme the next beyond them counts, too.
        quantile_ = share.value_or(of_largest ? 1.0 : 0.0);
        counted_from_m_ = *key.distance_m;
        counted_to_m_ = *key.to_m;
        if (!share)
            for (const InMoment& part : parts_) {
                if (part.to_go_m < *key.distance_m)
                    counted_from_m_ = counted_from_m_ < *key.distance_m ? std::max(counted_from_m_, part.to_go_m) : part.to_go_m;
                if (part.to_go_m > *key.to_m)
                    counted_to_m_ = counted_to_m_ > *key.to_m ? std::min(counted_to_m_, part.to_go_m) : part.to_go_m;
            }
        over_moments_ = [this, near_m = *key.distance_m, far_m = *key.to_m, share, of_largest](const std::vector<Value>& figures) {
            const FollowedFigure followed{approach(figures), reasons_of(figures)};
            return OverMoments{value_in_range(followed, near_m, far_m, share, of_largest),
                               shares_in_range(followed.approach, figures, near_m, far_m, share, of_largest)};
        };
    } else if (key.distance_m) {
        over_moments_ = [this, at_m = *key.distance_m](const std::vector<Value>& figures) {
            const Approach samples = approach(figures);
            return OverMoments{value_at(samples, at_m), value_at_shares(samples, at_m)};
        };
    } else if (key.statistic == worst) {
        quantile_ = of_largest ? 1.0 : 0.0;
        over_moments_ = [this, of_largest](const std::vector<Value>& figures) {
            const FollowedFigure followed{approach(figures), reasons_of(figures)};
            return OverMoments{followed.missing().empty() ? Value::of(of_largest ? largest(followed.approach) : smallest(followed.approach),
                                                                      "no moment of the drive was measured")
                                                          : Value::not_measured("in some moment: " + followed.missing()),
                               of_largest ? largest_shares(figures) : quantile_shares(figures, 0.0)};
        };
    } else {
        refuse(key, "the worst of the approach (_max, of de Boer's rating _min), or a range of it");
    }
}

void ReadingOfLight::add_kerb(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments) {
    bool everywhere = true; // else the median is not measured
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const double at_m = moments[k].distance_m + drive.bumper_m + *key.distance_m;
        const std::optional<Pose> edge = at_m <= route.length_m() ? place_on_road(route, Across::right_edge, at_m) : std::optional<Pose>();
        everywhere = everywhere && edge;
        if (!edge)
            continue;
        const bool on_road = key.surface == ReadingSurface::road;
        const glm::dvec3 point_m = edge->position_m + (on_road ? 0.0 : kerb_target_m) * edge->up();
        add_place(k, 0.0,
                  {point_m, on_road ? Facing::surface : Facing::lamps, edge->up(), hidden_by_road(moments[k], route, at_m, point_m)});
    }
    take_median(everywhere, "no such lane, or beyond the route's end, in some moment");
}

void ReadingOfLight::add_mirror(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments) {
    const bool asked = drive.seeing.glare && drive.seeing.glare->mirrors;
    const std::vector<Mirror> mirrors = asked ? drive.seeing.glare->mirrors->mirrors : std::vector<Mirror>{};
    const auto mirror = std::ranges::find(mirrors, key.subject, &Mirror::name);
    if (mirror == mirrors.end())
        refuse(key, "a drive with glare in a mirror of this name");
    for (std::size_t k = 0; k < moments.size(); ++k) {
        const double ahead_m = moments[k].distance_m + drive.bumper_m + *key.distance_m;
        if (ahead_m + drive.wheelbase_m > route.length_m())
            continue;
        const glm::dvec3 point_m = to_parent(ego_pose(route, ahead_m, drive.wheelbase_m), mirror->position_m);
        add_place(k, 0.0, {point_m, Facing::lamps, {}, hidden_by_road(moments[k], route, ahead_m, point_m)});
    }
    take_quantile(share_of_statistic(key), "the car ahead is beyond the route's end in every moment");
}

} // namespace fernlicht
