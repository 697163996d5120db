#include "metrics/importance/reading_of_light.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace fernlicht {

double ReadingOfLight::Sample::column_lx(const Moment& moment, std::size_t side) const {
    const double near = light_lx(moment, places[side]);
    return along == 0.0 ? near : between_samples(near, light_lx(moment, places[side + 2]), along);
}

double ReadingOfLight::Sample::lx(const Moment& moment) const {
    return across == 0.0 ? column_lx(moment, 0) : between_samples(column_lx(moment, 0), column_lx(moment, 1), across);
}

void ReadingOfLight::Sample::add_gradient(BeamGradient& gradient, const Moment& moment, double per_lx) const {
    const auto add_column = [&](std::size_t side, double per_column_lx) {
        std::pair shares(1.0, 0.0);
        if (along > 0.0) {
            shares = between_samples_shares(light_lx(moment, places[side]), light_lx(moment, places[side + 2]), along);
            fernlicht::add_gradient(gradient, moment, places[side + 2], per_column_lx * shares.second);
        }
        fernlicht::add_gradient(gradient, moment, places[side], per_column_lx * shares.first);
    };
    std::pair shares(1.0, 0.0);
    if (across > 0.0) {
        shares = between_samples_shares(column_lx(moment, 0), column_lx(moment, 1), across);
        add_column(1, per_lx * shares.second);
    }
    add_column(0, per_lx * shares.first);
}

std::vector<LineSample> ReadingOfLight::line(const InMoment& part, const Moment& moment) const {
    std::vector<LineSample> samples;
    samples.reserve(part.samples.size());
    for (const Sample& sample : part.samples)
        samples.push_back({sample.at_m, sample.there ? std::optional(sample.lx(moment)) : std::nullopt});
    return samples;
}

/// As runner/findings/summary.cpp takes the extents of a moment.
Value ReadingOfLight::figure(const InMoment& part, const Moment& moment) const {
    if (part.of)
        return part.of->value(moment);
    if (quantity_ != Quantity::reach && quantity_ != Quantity::width)
        return part.samples.front().lx(moment);
    const LitLine lit = lit_line(line(part, moment), threshold_lx_);
    if (quantity_ == Quantity::width) {
        const bool goes_on =
            part.may_go_on && lit.lit && (lit.first_m <= part.samples.front().at_m || lit.last_m >= part.samples.back().at_m);
        return goes_on ? Value::at_least(lit.lit_m) : Value(lit.lit_m);
    }
    if (lit.lit_at_end)
        return lit.last_m < part.whole_m ? Value::not_measured("cut off by the end of the road or lane") : Value::at_least(lit.last_m);
    return lit.last_m;
}

std::vector<Value> ReadingOfLight::figures(const std::vector<Moment>& moments) const {
    std::vector<Value> all;
    all.reserve(parts_.size());
    for (const InMoment& part : parts_)
        all.push_back(figure(part, moments[part.moment]));
    return all;
}

Approach ReadingOfLight::approach(const std::vector<Value>& figures) const {
    Approach approach;
    for (std::size_t i = 0; i < parts_.size(); ++i)
        approach.push_back({0.0, parts_[i].to_go_m, figures[i].number()});
    return approach;
}

void ReadingOfLight::add_gradient_of(BeamGradient& gradient, const InMoment& part, const Moment& moment, double weight) const {
    if (part.of) {
        part.of->add_gradient(gradient, moment, weight);
        return;
    }
    if (quantity_ != Quantity::reach && quantity_ != Quantity::width) {
        part.samples.front().add_gradient(gradient, moment, weight);
        return;
    }
    const LitLineShares shares = lit_line_shares(line(part, moment), threshold_lx_);
    for (const ValueShare& one : quantity_ == Quantity::reach ? shares.last : shares.lit)
        part.samples[one.index].add_gradient(gradient, moment, weight * one.by_value);
}

Value ReadingOfLight::value(const std::vector<Moment>& moments) const { return over_moments_(figures(moments)).value; }

/// A gradient over a table means one table.
static void refuse_changing_tables(const std::vector<Moment>& moments) {
    for (const Moment& moment : moments)
        for (const LitLamp& lamp : moment.lamps)
            if (lamp.file->state_of)
                throw InputError({{}, 0, 0, "lamp " + lamp.name}, "pixels that dim while driving",
                                 "lamps whose candela tables stay as they are");
}

ReadingOfLight::Found ReadingOfLight::gradient(const std::vector<Moment>& moments) const {
    refuse_changing_tables(moments);
    const std::vector<Value> all = figures(moments);
    OverMoments over = over_moments_(all);
    Found found{std::move(over.value), {}, {}};
    if (!found.value.number())
        return found;
    std::ranges::sort(over.shares, {}, &ValueShare::index);
    for (const auto& [index, share] : over.shares) {
        if (share == 0.0)
            continue;
        const InMoment& part = parts_[index];
        found.deciders.push_back({part.moment, share, all[index]});
        add_gradient_of(found.gradient, part, moments[part.moment], share);
    }
    return found;
}

void ReadingOfLight::each_side_figure(const std::vector<Moment>& moments, bool at_least,
                                      const std::function<void(double, const BeamGradient&)>& take) const {
    refuse_changing_tables(moments);
    if (!quantile_) {
        const Found found = gradient(moments);
        if (found.value.number())
            take(*found.value.number(), found.gradient);
        return;
    }
    const std::vector<Value> all = figures(moments);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].measured() && parts_[i].to_go_m >= counted_from_m_ && parts_[i].to_go_m <= counted_to_m_)
            order.push_back(i);
    if (order.empty())
        return;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return *all[i].figure(); });
    const double place = *quantile_ * static_cast<double>(order.size() - 1);
    const auto from = static_cast<std::ptrdiff_t>(at_least ? std::floor(place) : 0.0);
    const auto to = static_cast<std::ptrdiff_t>(at_least ? static_cast<double>(order.size()) : std::ceil(place) + 1.0);
    for (auto i = order.begin() + from; i != order.begin() + to; ++i) {
        BeamGradient gradient;
        add_gradient_of(gradient, parts_[*i], moments[parts_[*i].moment], 1.0);
        take(*all[*i].figure(), gradient);
    }
}

BeamGradient ReadingOfLight::mean_gradient(const std::vector<Moment>& moments) const {
    if (std::ranges::any_of(parts_, [](const InMoment& part) { return part.to_go_m > 0.0; }))
        return {};
    std::vector<const InMoment*> counted;
    for (const InMoment& part : parts_)
        if (figure(part, moments[part.moment]).number())
            counted.push_back(&part);
    BeamGradient gradient;
    for (const InMoment* part : counted)
        add_gradient_of(gradient, *part, moments[part->moment], 1.0 / static_cast<double>(counted.size()));
    return gradient;
}

} // namespace fernlicht
