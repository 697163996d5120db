// What a picture of `photometric` did not need, in words.
#include "renderer/gl/photometric_lighting.h"

#include <fmt/format.h>

namespace fernlicht::gl {
namespace {

/// Headlamps bring less to a road: bounds beyond this say nothing.
constexpr double max_useful_bound_lx = 1000.0;

} // namespace

void PhotometricLighting::note_what_is_left_out(const Shot& shot, const std::vector<Group>& groups) {
    pruned_features_.clear();
    if (!pruned_)
        return;
    const auto say = [&](std::string what, std::string why) { pruned_features_.push_back({std::move(what), std::move(why)}); };
    if (const std::size_t off = shot.moment.lamps.size() - lamps_.size(); off > 0)
        say(fmt::format("{} of {} lamps", off, shot.moment.lamps.size()), "switched off");
    if (traffic_.left_out() > 0)
        say(fmt::format("other lamps: {} of {}", traffic_.left_out(), traffic_.units()),
            fmt::format("bring less than {} lx to anything in view", shot.moment.min_traffic_lx));
    if (const TrafficReport& r = traffic_.report(); r.merged + r.by_vertex + r.point + r.left_out > 0)
        say(fmt::format("other lamps one by one: of {} lights on places of all pictures, {} as one beam for two lamps, {} by "
                        "vertex, {} as a point, {} not at all",
                        r.each + r.merged + r.by_vertex + r.point + r.left_out, r.merged, r.by_vertex, r.point, r.left_out),
            fmt::format(
                "by bounds all that is rendered is off by at most {:.2g} lx at any place, all that is left out brings at most {:.2g} lx",
                r.worst_drawn_lx, r.worst_left_out_lx));
    else if (shot.moment.other_lamps.empty())
        say("other lamps", "there are none");
    if (traffic_shadows_ && traffic_shadows_->max_units_left_out() > 0)
        say(fmt::format("shadow maps of other lamps: those of up to {} pairs or single lamps in a picture",
                        traffic_shadows_->max_units_left_out()),
            fmt::format("there are {} maps for the strongest; ", max_traffic_maps) +
                (traffic_shadows_->worst_left_out_lx() <= max_useful_bound_lx
                     ? fmt::format("by bounds the rest bring at most {:.2g} lx together to any place where their shadows may be missing",
                                   traffic_shadows_->worst_left_out_lx())
                     : "no useful bound is known of other lamps' light whose shadows may be missing: one of them stands within the "
                       "radius of a piece that it may light, and bounds take a piece's nearest point"));
    else if (traffic_shadows_ && !traffic_shadows_->any() && !shot.moment.other_lamps.empty())
        say("shadow maps of other lamps",
            fmt::format("nothing stands where one brings more than {} lx", min_traffic_shadow * shot.moment.min_traffic_lx));
    if (!shadows_)
        say("shadows", "the shadow method is none");
    else if (!shadows_->needed())
        say(shadows_->title(), scene_.flat() ? "the scene is flat, nothing stands in a beam" : "nothing stands in a beam");
    if (shot.moment.daylight.horizontal_illuminance_lx == 0.0)
        say("sky light", "it is night");
    if (shot.moment.weather.extinction_per_m == 0.0)
        say("fog", "the air is clear");
    if (lamps_in_fog_.left_out() > 0)
        say(fmt::format("other lamps' beams in the fog: {} of {}", lamps_in_fog_.left_out(), shot.moment.other_lamps.size()),
            fmt::format("give the air less than {:.2g} cd/m2 anywhere", static_cast<double>(lamps_in_fog_.min_cdm2())));
    if (shot.moment.weather.wetness == 0.0)
        say("water on the road", "it is dry");
    if (shot.moment.daylight.direct() == nullptr)
        say("sun and moon", "neither shines");
    std::size_t drawn = 0, dark = 0, unshaded = 0;
    for (const Group& group : groups) {
        drawn += group.pieces.size();
        dark += group.lit ? 0 : group.pieces.size();
        unshaded += group.lit && !group.shadowed ? group.pieces.size() : 0;
    }
    if (drawn < scene_.pieces().size())
        say(fmt::format("{} of {} pieces of the scene", scene_.pieces().size() - drawn, scene_.pieces().size()), "out of view");
    if (dark > 0)
        say(fmt::format("lamps on {} of {} pieces in view", dark, drawn), "outside every beam");
    if (unshaded > 0 && shadows_ && shadows_->needed())
        say(fmt::format("shadow look-ups on {} of {} pieces in view", unshaded, drawn), "no caster stands between them and a lamp");
    if (!scene_.has([](const SurfaceClass& c) { return c.retroreflecting; }))
        say("retroreflection", "no material of the scene retroreflects");
    if (!scene_.has([](const SurfaceClass& c) { return c.glossy; }))
        say("gloss of dry surfaces", "no material of the scene has any");
    if (!scene_.has([](const SurfaceClass& c) { return c.texture > 0; }))
        say("surface textures", "no material of the scene has one");
    if (!scene_.has([](const SurfaceClass& c) { return c.emissive; }))
        say("emission", "nothing in the scene shines by itself");
}

} // namespace fernlicht::gl
