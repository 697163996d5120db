#include "metrics/folds/seeing_fold.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace fernlicht {
namespace {

/// What is asked for, one after the other, in the order of reports.
template <class Do, class... Folds> void each_asked(const Do& act, Folds&... folds) {
    const auto one = [&](auto& fold) {
        if (fold)
            act(*fold);
    };
    (one(folds), ...);
}

void check_place(const Drive& drive, const Route& route, const std::string& key, double at_m) {
    if (at_m > route.length_m())
        throw InputError({drive.file, 0, 0, key}, fmt::format("found {} m", at_m),
                         fmt::format("a place on the route, which is {:.1f} m long", route.length_m()));
}

} // namespace

SeeingFold::SeeingFold(const Drive& drive, const Route& route, const Nudge& nudge, SeeingPart part) : nudge_(nudge) {
    const SeeingParameters& asked = drive.seeing;
    const bool medians = part != SeeingPart::of_every_moment, others = part != SeeingPart::medians;
    if (asked.sensors && others) {
        for (const Sensor& sensor : asked.sensors->points)
            check_place(drive, route, fmt::format("measure.sensors.points.{}.at_m", sensor.name), sensor.at_m);
        sensors_.emplace(drive, route);
    }
    if (asked.glare && others) {
        for (const GlareObserver& observer : asked.glare->oncoming)
            check_place(drive, route, fmt::format("measure.glare.oncoming.{}.at_m", observer.name), observer.at_m);
        oncoming_.emplace(drive, route, nudge);
        if (asked.glare->mirrors)
            mirrors_.emplace(drive, route, nudge);
        if (!drive.traffic.empty())
            traffic_.emplace(drive, route);
    }
    if (asked.visibility && medians)
        visibility_.emplace(drive, route);
    if (asked.homogeneity && medians)
        homogeneity_.emplace(drive, route);
    if (asked.places && others)
        places_.emplace(drive, route);
    if (others && std::ranges::any_of(drive.lamp_sets, [](const LampSet& lamp_set) { return lamp_set.control != nullptr; }))
        control_.emplace(drive, route, nudge);
}

void SeeingFold::add(const Moment& as_is, const LampSet& lamp_set) {
    const Moment moment = nudged(as_is, nudge_);
    const auto add = [&](const char* name, auto& fold, const auto&... more) {
        if (!fold)
            return;
        const TraceSpan span(name, "measure");
        fold->add(moment, more...);
    };
    add("sensors", sensors_);
    add("glare of traffic", traffic_);
    add("visibility", visibility_);
    add("homogeneity", homogeneity_);
    add("places", places_);
    add("glare of oncoming drivers", oncoming_, lamp_set);
    add("glare in mirrors", mirrors_, lamp_set);
    add("control", control_, lamp_set);
}

Readings SeeingFold::readings() const {
    Readings all;
    each_asked([&](const auto& fold) { std::ranges::copy(fold.readings(), std::back_inserter(all)); }, sensors_, oncoming_, mirrors_,
               traffic_, visibility_, homogeneity_, places_, control_);
    return all;
}

std::vector<SeeingSeries> SeeingFold::series() const {
    std::vector<SeeingSeries> all; // places are told at distances ahead, not over the drive
    each_asked([&](const auto& fold) { std::ranges::copy(fold.series(), std::back_inserter(all)); }, sensors_, oncoming_, mirrors_,
               visibility_, homogeneity_, control_);
    return all;
}

} // namespace fernlicht
