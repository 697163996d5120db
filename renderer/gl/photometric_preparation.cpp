// Which programs `photometric` will need: compiled before the first frame, dropped when their lamps are gone.
#include "renderer/gl/photometric_lighting.h"

#include <algorithm>
#include <set>

namespace fernlicht::gl {

void PhotometricLighting::set_for_preparing(const Shot& shot) {
    scene_.place(shot.moment.bodies);
    set_lamps(shot);
    if (shadows_) {
        shadows_->set(lamps_, lamp_beams_, shot.moment.ego.position_m);
        shadows_->compile(shot);
    }
    set_sun(shot);
    if (sun_ && shadows_)
        sun_->compile();
    make_traffic_shadows(shot.moment);
    if (traffic_shadows_)
        traffic_shadows_->compile();
    shot.targets.begin(shot.background, shot.sky_luminance_cdm2);
    context_.gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, block_);
    if (shot.moment.other_lamps.empty())
        return;
    traffic_.set(shot.moment, {}, shot.work, traffic_shadows_.get());
    traffic_.bind();
    if (traffic_shadows_)
        traffic_shadows_->bind();
    faces_.compile(shot);
    lamps_in_fog_.set(shot.moment, shot.camera);
    lamps_in_fog_.bind();
}

void PhotometricLighting::compile_visible(const Shot& shot) {
    shot.targets.begin_visible();
    for (const SurfaceClass& surface : scene_.classes())
        for (const bool moving : {surface.moving, false}) { // unpruned drawing takes what is out of view for plain
            Features f = features_of(shot, {surface, true, true, false, false, {}}, 0);
            f.surface.moving = moving;
            use_visible(f, shot);
            list_.draw_nothing(shot.moment.ego.position_m, scene_.moves());
        }
    context_.check("compiling variants");
}

void PhotometricLighting::prepare(const Shot& shot) {
    if (scene_.pieces().empty())
        return;
    set_for_preparing(shot);
    if (cpu_light_ && why_shader(shot).empty())
        return compile_visible(shot);
    const bool others = !shot.moment.other_lamps.empty();
    const int max_sun = sun_needs_ == 0 ? 0 : shadows_ && (!scene_.flat() || !pruned_) ? 2 : 1;
    for (const SurfaceClass& surface : scene_.classes())
        for (const auto& [lit, shadowed] : {std::pair(false, false), std::pair(true, false), std::pair(true, true)})
            for (const auto& [traffic, traffic_shadowed] : {std::pair(false, false), std::pair(true, false), std::pair(true, true)})
                for (int sun = std::min(sun_needs_, 1); sun <= max_sun; ++sun)
                    if (!traffic || others)
                        compile(features_of(shot, {surface, lit, shadowed, traffic, traffic_shadowed, {}}, sun), shot);
    if (fog_before_sky(shot) && (!lamps_.empty() || others))
        compile(background_features(shot), shot);
    context_.check("compiling variants");
}

void PhotometricLighting::prepare_here(const Shot& shot) {
    if (scene_.pieces().empty())
        return;
    set_for_preparing(shot);
    if (cpu_light_ && why_shader(shot).empty())
        return compile_visible(shot);
    std::vector<Group> groups = groups_for(shot);
    traffic_.bind();
    for (Group& group : groups) {
        group.traffic = group.traffic && traffic_.any();
        compile(features_of(shot, group, sun_needs_), shot);
    }
    if (fog_before_sky(shot) && (!lamps_.empty() || !shot.moment.other_lamps.empty()))
        compile(background_features(shot), shot);
    context_.check("compiling variants");
}

void PhotometricLighting::keep_programs_of(const std::vector<Moment>& moments) {
    std::set<int> shapes;
    for (const Moment& moment : moments)
        for (const LitLamp& lamp : shining(moment, !pruned_))
            shapes.insert(beams_.of(lamp.file).shape);
    std::erase_if(variants_, [&](const auto& variant) {
        return std::ranges::any_of(variant.first.beams, [&](int shape) { return !shapes.contains(shape); });
    });
}

} // namespace fernlicht::gl
