#include "renderer/gl/photometric_lighting.h"
#include "renderer/gl/device/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <iterator>
#include <tuple>

namespace fernlicht::gl {
namespace {

/// More lamps than this have their constants in the uniform block instead of in the limited number of a vertex's outputs.
constexpr std::size_t max_lamps_by_vertex = 4;
/// Of the sky behind fog: beyond all that is drawn.
constexpr double background_m = 5000.0;
/// Vertices that a float counts, and as many in a picture's list.
constexpr std::size_t max_numbered = std::size_t{1} << 23;

/// "vec4(...), vec4(...)": constants of a variant, one a lamp.
template <class One> std::string list(const std::vector<const Beam*>& beams, One one) {
    std::string text;
    for (const Beam* beam : beams)
        text += (text.empty() ? "" : ", ") + one(*beam);
    return text;
}

/// Without any of it, unpruned drawing leaves all of it out too: its shaders take seconds to compile on a CPU.
bool has_weather(const Moment& moment) {
    return moment.daylight.direct() != nullptr || moment.weather.extinction_per_m > 0.0 || moment.weather.wetness > 0.0;
}

void set_weather_uniforms(const GladGLContext& gl, const Program& program, const Shot& shot) {
    const Weather& weather = shot.moment.weather;
    const auto extinction = static_cast<float>(weather.extinction_per_m);
    const auto scattering = static_cast<float>(weather.extinction_per_m * weather.scattering_albedo);
    const bool seen_through = !shot.camera.is_map; // maps show the ground without the air above it
    program.set("fog", glm::vec4(extinction, seen_through ? extinction : 0.0F, seen_through ? scattering : 0.0F, weather.asymmetry));
    program.set("wetness", weather.wetness);
    program.set("sky_cdm2", static_cast<double>(shot.sky_luminance_cdm2));
    const Camera& camera = shot.camera;
    glm::vec3 corners[3];
    for (int i = 0; i < 3; ++i) {
        const double across = i == 1 ? 3.0 : -1.0, up = i == 2 ? 3.0 : -1.0;
        corners[i] = glm::vec3(camera.eye_m + background_m * (camera.axis + across * camera.half_extent.x * camera.right +
                                                              up * camera.half_extent.y * camera.up));
    }
    gl.Uniform3fv(program.uniform("background_m"), 3, &corners[0][0]);
}

} // namespace

bool fog_before_sky(const Shot& shot) { return shot.moment.weather.extinction_per_m > 0.0 && !shot.camera.is_map && shot.outputs.seen(); }

PhotometricLighting::PhotometricLighting(Context& context, const Scene& scene, const RendererSettings& settings, bool pruned)
    : context_(context), settings_(settings), pruned_(pruned),
      scene_(context, scene, false, light_pass_for(context.info, settings.light_pass) == LightPass::cpu),
      beams_(context, settings.beams, light_pass_for(context.info, settings.light_pass) == LightPass::cpu),
      shadows_(make_shadows(context, scene_, settings.shadows, {settings.target_height_m, pruned, settings.shadow_eye})),
      traffic_(context, scene_, beams_, settings.traffic_levels, pruned), lamps_in_fog_(context, beams_, pruned),
      faces_(context, settings.tone_mapper, settings.white), list_(context, scene_),
      block_(make_buffer(context, std::vector<Packed>(max_lamps), GL_DYNAMIC_STORAGE_BIT)) {
    if (light_pass_for(context.info, settings.light_pass) == LightPass::cpu)
        cpu_light_.emplace(scene, settings.tone_mapper, settings.white, settings.target_height_m, settings.sources, settings.light_level);
}

std::string PhotometricLighting::why_shader(const Shot& shot) const {
    const Moment& moment = shot.moment;
    if (!context_.info.software)
        return "a GPU looks textures up in finer steps than the CPU is told of";
    if (scene_.surfaces().corners.size() > max_numbered)
        return fmt::format("the scene has more than {} vertices", max_numbered);
    if (!moment.other_lamps.empty())
        return "lamps of others";
    if (has_weather(moment))
        return "sun, moon, fog and water";
    if (shadows_ && !shadows_->has_look_ups())
        return fmt::format("{}: they are marked in the picture", shadows_->title());
    return "";
}

const Program& PhotometricLighting::visible_program(bool textured, bool moving) {
    if (const auto known = visible_programs_.find({textured, moving}); known != visible_programs_.end())
        return known->second;
    std::vector<Program::Define> d{{"TEXTURED", flag(textured)}};
    if (moving)
        d.push_back({"MOVING", "1"});
    return visible_programs_.try_emplace({textured, moving}, Program(context_, "visible.vert.glsl", "visible.frag.glsl", d)).first->second;
}

void PhotometricLighting::use_visible(const Features& features, const Shot& shot) {
    const Program& program = visible_program(features.surface.texture > 0, features.surface.moving);
    program.use();
    program.set("clip_from_ego", glm::mat4(shot.camera.clip_from_ego));
}

void PhotometricLighting::light_visible(const Shot& shot, const std::vector<Group>& groups) {
    std::vector<DrawnPiece>& pieces = list_.drawn_pieces();
    std::size_t next = 0;
    bool shadowed = false;
    for (const Group& group : groups)
        for (std::size_t i = 0; i < group.pieces.size(); ++i, ++next) {
            pieces[next].lit = group.lit;
            pieces[next].shadowed = group.shadowed;
            shadowed = shadowed || group.shadowed;
        }
    const bool looked_up = shadows_ && shadowed && !lamps_.empty() && (!pruned_ || shadows_->needed());
    const std::span<const ShadowLookUp> look_ups = looked_up ? shadows_->look_ups() : std::span<const ShadowLookUp>();
    std::vector<DrawnLamp> lamps;
    for (std::size_t i = 0; i < lamps_.size(); ++i)
        lamps.push_back({&lamps_[i], &lamp_beams_[i]->grid, lamp_beams_[i]->steep, looked_up ? &look_ups[i] : nullptr});
    if (!shot.lit)
        shot.lit.emplace();
    cpu_light_->draw({shot.camera, shot.targets.width(), shot.targets.height(), visible_, pieces, lamps, shot.moment.ego.position_m,
                      shot.moment.daylight.horizontal_illuminance_lx, shot.sky_luminance_cdm2, shot.background, shot.outputs,
                      shot.work.light ? &*shot.work.light : nullptr},
                     scene_.surfaces(), *shot.lit);
}

void PhotometricLighting::set_lamps(const Shot& shot) {
    lamps_ = shining(shot.moment, !pruned_);
    // By what is mounted, not by what is on: pruning must not change how a pixel is computed.
    // By vertex it is quick on llvmpipe alone, and GPUs have fewer inputs of fragments than fog, traffic and four lamps ask for.
    by_vertex_ = context_.info.software &&
                 shot.moment.lamps.size() <= (shot.moment.other_lamps.empty() ? max_lamps_by_vertex : max_lamps_by_vertex / 2);
    lamp_beams_.clear();
    packed_.clear();
    for (const LitLamp& lamp : lamps_) {
        lamp_beams_.push_back(&beams_.of(lamp.file));
        const glm::dvec3 at = lamp.pose.position_m - shot.moment.ego.position_m;
        const glm::dvec3 eye = to_lamp_space(lamp, shot.camera.is_map ? -shot.camera.axis : shot.camera.eye_m - at);
        const glm::dvec3 raise = to_lamp_space(lamp, {0.0, 0.0, settings_.target_height_m});
        packed_.push_back({four(at), four(-lamp.pose.left()), four(lamp.pose.up()), four(lamp.pose.forward()),
                           four(lamp.colour.linear_srgb, lamp.intensity_factor * lamp_beams_.back()->cd_a_unit),
                           four(eye, shot.camera.is_map ? 0.0 : 1.0), four(raise)});
    }
    update_buffer(context_, block_, packed_);
}

void PhotometricLighting::set_sun(const Shot& shot) {
    const bool everything = !pruned_ && has_weather(shot.moment);
    if (!sun_ && (everything || shot.moment.daylight.direct() != nullptr))
        sun_ = std::make_unique<SunLight>(context_, scene_);
    if (sun_)
        sun_->set(shot.moment, shadows_ && !scene_.flat());
    const bool shines = sun_ && sun_->shines();
    sun_needs_ = everything ? 1 + (shadows_ ? 1 : 0) : !shines ? 0 : sun_->casts() ? 2 : 1;
}

void PhotometricLighting::make_traffic_shadows(const Moment& moment) {
    if (!traffic_shadows_ && !moment.other_lamps.empty() && settings_.shadows.any() && settings_.traffic_shadows && !scene_.flat())
        traffic_shadows_ = std::make_unique<TrafficShadows>(context_, scene_, settings_.shadows, pruned_);
}

PhotometricLighting::Features PhotometricLighting::features_of(const Shot& shot, const Group& group, int sun) const {
    const SurfaceClass& surface = group.surface;
    Features f;
    f.sun = sun;
    f.everything = !pruned_;
    f.by_vertex = by_vertex_;
    f.sky = !pruned_ || shot.moment.daylight.horizontal_illuminance_lx > 0.0;
    const bool reflects = shot.outputs.seen();
    const bool everything = !pruned_ && has_weather(shot.moment);
    f.fog = everything || shot.moment.weather.extinction_per_m > 0.0;
    f.lamps_in_fog = f.fog && reflects && !shot.camera.is_map && !shot.moment.other_lamps.empty(); // though all may be too faint
    f.wet = reflects && (everything || shot.moment.weather.wetness > 0.0);
    f.outputs = output_bits(shot.outputs);
    f.traffic = group.traffic || (!pruned_ && !shot.moment.other_lamps.empty());
    f.traffic_shadows = f.traffic && traffic_shadows_ && (group.traffic_shadowed || !pruned_);
    if (group.lit || !pruned_ || (f.fog && reflects && !shot.camera.is_map)) // in fog, beams are seen from beside
        for (const Beam* beam : lamp_beams_)
            f.beams.push_back(beam->shape);
    f.shadows = !f.beams.empty() && (group.shadowed || !pruned_) && shadows_;
    if (pruned_ && reflects)
        f.surface = {surface.texture,
                     surface.retroreflecting && (!f.beams.empty() || f.traffic),
                     surface.emissive && settings_.sources,
                     surface.moving,
                     surface.tinted && (!f.beams.empty() || f.traffic),
                     surface.glossy && (!f.beams.empty() || f.traffic || f.sky || sun > 0),
                     surface.beads && f.wet && (!f.beams.empty() || f.traffic)};
    else if (!pruned_)
        f.surface = {scene_.has([](const SurfaceClass& c) { return c.texture > 0; }) ? 1 : 0,
                     true,
                     settings_.sources,
                     surface.moving,
                     scene_.has([](const SurfaceClass& c) { return c.tinted; }),
                     reflects && scene_.has([](const SurfaceClass& c) { return c.glossy; }),
                     f.wet && scene_.has([](const SurfaceClass& c) { return c.beads; })};
    f.surface.moving = surface.moving;
    return f;
}

const PhotometricLighting::Compiled& PhotometricLighting::variant(const Features& f, const FrameOutputs& outputs) {
    if (const auto known = variants_.find(f); known != variants_.end())
        return known->second;
    std::vector<const Beam*> beams = f.beams.empty() ? std::vector<const Beam*>{} : lamp_beams_;
    std::vector<Program::Define> d = Targets::defines(outputs);
    const auto define = [&](const char* name, std::string value) { d.push_back({name, std::move(value)}); };
    add_lamp_defines(d, beams.size());
    define("LAMPS_BY_VERTEX", flag(f.by_vertex));
    define("SHADOWS", flag(f.shadows));
    define("SKY", flag(f.sky));
    define("SUN", flag(f.sun > 0));
    define("SUN_SHADOWS", flag(f.sun > 1));
    define("FOG", flag(f.fog));
    define("FOG_SAMPLES", std::to_string(settings_.fog_samples));
    define("LAMPS_IN_FOG", flag(f.lamps_in_fog));
    define("AIR_BOUND", flag(pruned_));
    define("WET", flag(f.wet));
    define("WET_ALPHA", literal(wet_roughness));
    define("GLOSS", flag(f.surface.glossy));
    define("BEADS", flag(f.surface.beads));
    define("BACKGROUND", flag(f.background));
    define("RETRO", flag(f.surface.retroreflecting));
    define("RETRO_TINT", flag(f.surface.tinted));
    define("TRAFFIC", flag(f.traffic));
    if (f.traffic) {
        define("TRAFFIC_CELLS_A_METRE", literal(1.0 / traffic_cell_m));
        define("TRAFFIC_CELLS_AHEAD", std::to_string(traffic_cells_ahead));
        define("TRAFFIC_CELLS_ACROSS", std::to_string(traffic_cells_across));
        define("TRAFFIC_SHADOWS", flag(f.traffic_shadows));
        if (f.traffic_shadows) {
            const std::vector<Program::Define> more = traffic_shadows_->defines();
            d.insert(d.end(), more.begin(), more.end());
        }
    }
    if (f.surface.moving)
        define("MOVING", "1");
    define("EMISSIVE", flag(f.surface.emissive));
    define("TEXTURED", f.surface.texture == 0 ? "0" : (f.everything ? "2" : "1"));
    define("TEXTURE_MODE", std::to_string(f.surface.texture - 1));
    define("TARGET_HEIGHT", literal(settings_.target_height_m));
    add_tone_defines(d, settings_.tone_mapper, settings_.white);
    define("BEAM_GRIDS", list(beams, [](const Beam& b) {
               return fmt::format("vec4({}, {}, {}, {})", literal(b.grid.h_first_rad), literal(b.grid.v_first_rad),
                                  literal(1.0 / b.grid.h_step_rad), literal(1.0 / b.grid.v_step_rad));
           }));
    define("BEAM_COUNTS", list(beams, [](const Beam& b) { return fmt::format("vec2({}.0, {}.0)", b.grid.width, b.grid.height); }));
    define("BEAM_PER_COUNTS", list(beams, [](const Beam& b) {
               return fmt::format("vec2({}, {})", literal(1.0 / b.grid.width), literal(1.0 / b.grid.height));
           }));
    define("BEAM_STEEP", list(beams, [](const Beam& b) { return std::string(b.steep ? "true" : "false"); }));
    if (f.shadows) {
        const std::vector<Program::Define> more = shadows_->defines(beams);
        d.insert(d.end(), more.begin(), more.end());
    }
    Program program(context_, "photometric.vert.glsl", "photometric.frag.glsl", d);
    return variants_
        .emplace(f, Compiled{std::move(program), f.traffic, f.shadows, f.sun > 0, f.fog || f.wet || f.surface.glossy, f.lamps_in_fog})
        .first->second;
}

void PhotometricLighting::use(const Compiled& v, const Shot& shot) const {
    v.program.use();
    if (v.shadows)
        shadows_->set_uniforms(v.program);
    v.program.set("clip_from_ego", glm::mat4(shot.camera.clip_from_ego));
    v.program.set("eye_m", glm::vec3(shot.camera.eye_m));
    v.program.set("eye_axis", four(shot.camera.axis, shot.camera.is_map ? 0.0 : 1.0));
    if (v.traffic)
        v.program.set("traffic_grid", traffic_.grid());
    v.program.set("sky_lx", shot.moment.daylight.horizontal_illuminance_lx);
    if (v.sun)
        sun_->set_uniforms(v.program);
    if (v.weather)
        set_weather_uniforms(context_.gl, v.program, shot);
    if (v.lamps_in_fog) {
        v.program.set("air_lamp_count", lamps_in_fog_.count());
        v.program.set("air_min_cdm2", static_cast<double>(lamps_in_fog_.min_cdm2()));
    }
}

void PhotometricLighting::compile(const Features& features, const Shot& shot) {
    if (variants_.contains(features))
        return;
    use(variant(features, shot.outputs), shot);
    list_.draw_nothing(shot.moment.ego.position_m, scene_.moves() || !shot.moment.other_lamps.empty());
}

PhotometricLighting::Features PhotometricLighting::background_features(const Shot& shot) const {
    Features f = features_of(shot, {{}, true, false, false, false, {}}, 0);
    f.background = true;
    f.shadows = f.sky = f.wet = f.traffic = f.traffic_shadows = false;
    f.surface = {};
    return f;
}

/// In fog the lamps are seen before the sky too.
void PhotometricLighting::draw_background(const Shot& shot) {
    if (!fog_before_sky(shot) || (lamps_.empty() && shot.moment.other_lamps.empty()) || scene_.pieces().empty())
        return;
    scene_.bind(0);
    use(variant(background_features(shot), shot.outputs), shot);
    context_.gl.DrawArrays(GL_TRIANGLES, 0, 3);
    ++shot.work.calls;
}

/// The pieces in view by what lighting them takes; closed bodies first, which hide most, near ones first in each, in an order that pruning
/// does not change.
std::vector<PhotometricLighting::Group> PhotometricLighting::groups_for(const Shot& shot) {
    const glm::dvec3 ego_m = shot.moment.ego.position_m;
    const Frustum frustum(shot.camera.clip_from_ego);
    std::map<std::tuple<SurfaceClass, bool, bool, bool, bool>, std::vector<std::tuple<bool, double, std::uint32_t>>> sorted;
    std::vector<std::uint32_t> unseen, unseen_moving, seen;
    std::vector<double> distances;
    for (const std::uint32_t i : scene_.near(ego_m)) {
        const Piece& piece = scene_.pieces()[i];
        const glm::dvec3 centre = centre_of(piece, ego_m);
        if (!piece.is_shown(shot.camera.is_map))
            continue;
        const double distance = glm::length(centre) - piece.radius_m;
        if (distance > farthest_drawn_m)
            continue;
        if (frustum.outside(centre, piece.radius_m)) {
            (piece.surface.moving ? unseen_moving : unseen).push_back(i);
            continue;
        }
        seen.push_back(i);
        distances.push_back(distance);
    }
    traffic_.set(shot.moment, seen, shot.work, traffic_shadows_.get());
    for (std::size_t s = 0; s < seen.size(); ++s) {
        const std::uint32_t i = seen[s];
        const Piece& piece = scene_.pieces()[i];
        const glm::dvec3 centre = centre_of(piece, ego_m);
        bool lit = false;
        for (std::size_t k = 0; k < lamps_.size() && !lit; ++k)
            lit = lamps_[k].intensity_factor > 0.0 &&
                  lamp_beams_[k]->bounds.max_towards(to_lamp_space(lamps_[k], centre - (lamps_[k].pose.position_m - ego_m)),
                                                     piece.radius_m + (shot.outputs.target ? settings_.target_height_m : 0.0)) > 0.0;
        const bool shadowed = lit && shadows_ && shadows_->reach(piece, shot.outputs.target ? settings_.target_height_m : 0.0);
        const bool traffic = traffic_.any() && traffic_.reach(i);
        sorted[{piece.surface, lit, shadowed, traffic, traffic && traffic_shadows_ && traffic_shadows_->reach(i)}].emplace_back(
            !piece.closed, distances[s], i);
    }
    std::vector<Group> groups;
    for (auto& [key, pieces] : sorted) {
        std::ranges::sort(pieces);
        Group group{std::get<0>(key), std::get<1>(key), std::get<2>(key), std::get<3>(key), std::get<4>(key), {}};
        std::ranges::transform(pieces, std::back_inserter(group.pieces), [](const auto& p) { return std::get<2>(p); });
        groups.push_back(std::move(group));
    }
    if (!pruned_ && !unseen.empty())
        groups.push_back({{}, true, true, true, true, std::move(unseen)}); // culled by nothing but the rasteriser
    if (!pruned_ && !unseen_moving.empty())
        groups.push_back({{.moving = true}, true, true, true, true, std::move(unseen_moving)});
    return groups;
}

void PhotometricLighting::draw(const Shot& shot) {
    const GladGLContext& gl = context_.gl;
    scene_.place(shot.moment.bodies);
    set_lamps(shot);
    if (shadows_) {
        shadows_->set(lamps_, lamp_beams_, shot.moment.ego.position_m);
        if (!lamps_.empty() && (!pruned_ || shadows_->needed()))
            shadows_->draw(shot);
    }
    lamps_in_fog_.set(shot.moment, shot.camera);
    set_sun(shot);
    if (sun_needs_ > 1) {
        shot.clock.begin("sun's shadow map");
        sun_->draw(shot.work);
        shot.clock.end();
    }
    make_traffic_shadows(shot.moment);
    std::vector<Group> groups;
    if (traffic_shadows_) {
        shot.clock.begin("shadow maps of others");
        groups = groups_for(shot);
        if (traffic_shadows_->any())
            traffic_shadows_->draw(shot);
        traffic_shadows_->bind();
        shot.clock.end();
    }
    shot.clock.begin("scene");
    const bool on_cpu = cpu_light_ && why_shader(shot).empty();
    if (on_cpu)
        shot.targets.begin_visible(shot.view.looked_at);
    else
        shot.targets.begin(shot.background, shot.sky_luminance_cdm2, shot.view.looked_at);
    if (!traffic_shadows_)
        groups = groups_for(shot);
    list_.start(shot.moment.ego.position_m, scene_.moves() || traffic_.any(), on_cpu);
    for (const Group& group : groups)
        list_.add(group.pieces, traffic_.any() ? &traffic_.lists() : nullptr);
    list_.upload();
    if (traffic_.any())
        traffic_.bind();
    lamps_in_fog_.bind();
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, block_);
    for (std::size_t i = 0; i < lamp_beams_.size(); ++i)
        gl.BindTextureUnit(static_cast<GLuint>(i), lamp_beams_[i]->texture);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        groups[g].traffic = groups[g].traffic && traffic_.any();
        const Features f = features_of(shot, groups[g], sun_needs_);
        if (on_cpu)
            use_visible(f, shot);
        else
            use(variant(f, shot.outputs), shot);
        shot.work.calls += list_.draw(static_cast<int>(g), &shot.camera.clip_from_ego);
        shot.work.draws += static_cast<int>(groups[g].pieces.size());
        shot.work.lamps = std::max(shot.work.lamps, static_cast<int>(f.beams.size()));
        shot.work.features += static_cast<int>(f.beams.size()) * (f.shadows ? 2 : 1) + (f.sky ? 1 : 0) + f.sun + (f.fog ? 1 : 0) +
                              (f.lamps_in_fog ? lamps_in_fog_.count() : 0) + (f.wet ? 1 : 0) + (f.surface.retroreflecting ? 1 : 0) +
                              (f.surface.tinted ? 1 : 0) + (f.surface.glossy ? 1 : 0) + (f.surface.beads ? 1 : 0) +
                              (f.surface.emissive ? 1 : 0) + (f.surface.texture > 0 ? 1 : 0);
        const int textures = static_cast<int>(f.beams.size()) * (f.shadows ? 2 : 1) + (f.surface.texture > 0 ? 1 : 0) +
                             (f.sun > 1 ? 1 : 0) + (f.traffic_shadows ? 1 : 0);
        shot.work.samplers = std::max(shot.work.samplers, textures);
    }
    if (!on_cpu) {
        shot.lit.reset();
        draw_background(shot);
        if (settings_.sources)
            faces_.draw(shot);
    }
    context_.check("rendering the scene");
    shot.clock.end();
    if (on_cpu) {
        shot.clock.begin("reading what is visible");
        shot.targets.read_visible(visible_);
        shot.clock.end();
        shot.clock.begin("light");
        light_visible(shot, groups);
        shot.clock.end();
    }
    ++shot.work.passes;
    shot.work.triangles += list_.triangles();
    shot.work.texture_bytes = beams_.texture_bytes() + (shadows_ ? shadows_->texture_bytes() : 0) + scene_.texture_bytes() +
                              (sun_ ? sun_->texture_bytes() : 0) + (traffic_shadows_ ? traffic_shadows_->texture_bytes() : 0);
    note_what_is_left_out(shot, groups);
}

} // namespace fernlicht::gl
