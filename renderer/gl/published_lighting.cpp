#include "renderer/gl/published_lighting.h"

#include "renderer/gl/scene/beams.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <sstream>
#include <tuple>

namespace fernlicht::gl {
namespace {

constexpr double cd_per_lx = 625.0; // at 25 m

/// The row's words over what is so unless a row says otherwise. The last three are for C++, the others for the shaders.
std::map<std::string, std::string> features_of(const Technique& technique) {
    std::map<std::string, std::string> features{
        {"LIGHT", "NONE"}, {"DISTANCE", "NONE"}, {"ONE_DISTANCE", "0"}, {"BEHIND", "NONE"}, {"TONE", "NONE"},
        {"SUN", "0"},      {"AMBIENT", "0"},     {"EMISSIVE", "NONE"},  {"CONSTANTS", "0"}, {"FRAGMENT_TEXTURES_ONLY", "0"},
        {"MERGED", "0"},   {"LOWERED", "0"},     {"MATRIX", "RIGHT"}};
    std::istringstream words{std::string(technique.features)};
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        features.at(word.substr(0, equals)) = word.substr(equals + 1);
    }
    return features;
}

int published_bits(const FrameOutputs& w) { return (w.colour ? 1 : 0) | (w.illuminance ? 2 : 0) | (w.depth ? 4 : 0) | (w.ids ? 8 : 0); }

/// From left to right, as the car sees it.
std::vector<LitLamp> from_left(const Moment& moment) {
    std::vector<LitLamp> lamps = shining(moment, false);
    std::ranges::stable_sort(lamps, std::ranges::greater{},
                             [&](const LitLamp& lamp) { return to_local(moment.ego, lamp.pose.position_m).y; });
    return lamps;
}

constexpr std::size_t max_arrangements = 4;
constexpr double same_within = 1e-6;

/// Texels [z][y][x] with the outermost ones black.
template <class T> std::vector<T> framed(std::vector<T> texels, int width, int height, int depth) {
    if (texels.empty())
        return texels;
    std::size_t i = 0;
    for (int z = 0; z < depth; ++z)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x, ++i)
                if (x == 0 || y == 0 || x == width - 1 || y == height - 1 || (depth > 1 && (z == 0 || z == depth - 1)))
                    texels[i] = T{0};
    return texels;
}

/// Within a micrometre and a microradian: moving the car rounds more than nothing.
bool same_arrangement(const std::vector<LitLamp>& lamps, const std::vector<LitLamp>& others) {
    return std::ranges::equal(lamps, others, [](const LitLamp& a, const LitLamp& b) {
        bool same = a.file == b.file && a.intensity_factor == b.intensity_factor &&
                    glm::distance(a.pose.position_m, b.pose.position_m) < same_within;
        for (int axis = 0; axis < 3; ++axis)
            same = same && glm::distance(a.pose.axes[axis], b.pose.axes[axis]) < same_within;
        return same;
    });
}

void set_linear(const GladGLContext& gl, GLuint texture) {
    gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

} // namespace

PublishedLighting::PublishedLighting(Context& context, const Scene& scene, const RendererSettings& settings)
    : context_(context), settings_(settings), technique_(technique_named(settings.technique)), features_(features_of(technique_)),
      scene_(context, scene, true), beams_(context, settings.beams.value_or(projected_texels)), list_(context, scene_),
      lamp_block_(make_buffer(context, std::vector<PackedLamp>(max_lamps), GL_DYNAMIC_STORAGE_BIT)),
      spot_block_(make_buffer(context, std::vector<PackedSpot>(max_lamps * max_spots), GL_DYNAMIC_STORAGE_BIT)) {}

void PublishedLighting::set_projected_lamp(const LitLamp& lamp, const UploadedBeam& beam, const glm::dvec3& ego_m) {
    Pose pose = lamp.pose;
    if (is("LOWERED", "1"))
        pose.axes = pose.axes * axes_from_angles(0.0, -lowered_rad, 0.0);
    const glm::dmat4 texture = is("MATRIX", "PRINTED") ? texture_from_lamp_as_printed(beam.window) : texture_from_lamp(beam.window);
    double gain = lamp.intensity_factor * beam.lx_a_unit;
    if (is("TONE", "SHARE"))
        gain *= beam.peak_lx > 0.0 ? 1.0 / beam.peak_lx : 0.0;
    else if (!is("DISTANCE", "NONE"))
        gain *= cd_per_lx;
    packed_.push_back({glm::mat4(texture * lamp_from_ego(pose, ego_m)), four(pose.position_m - ego_m, gain)});
    textures_.push_back(beam.texture);
}

void PublishedLighting::set_spots(const LitLamp& lamp, const glm::dvec3& ego_m) {
    packed_.push_back({glm::mat4(1.0F), four(lamp.pose.position_m - ego_m, lamp.intensity_factor)});
    std::vector<Spot> spots = beams_.spots_of(lamp.file);
    spots.resize(max_spots, Spot{0.0, 0.0, 0.0, 0.0, 0.0}); // dark ones
    for (const Spot& spot : spots) {
        const double h = radians(spot.h_deg), v = radians(spot.v_deg);
        const glm::dvec3 axis = -lamp.pose.left() * (std::sin(h) * std::cos(v)) + lamp.pose.up() * std::sin(v) +
                                lamp.pose.forward() * (std::cos(h) * std::cos(v));
        spots_.push_back({four(axis, spot.exponent), glm::vec4(spot.cd, std::cos(radians(spot.cutoff_deg)), 0.0, 0.0)});
    }
}

void PublishedLighting::set_lamps(const Shot& shot) {
    const Moment& moment = shot.moment;
    const glm::dvec3& ego_m = moment.ego.position_m;
    packed_.clear();
    spots_.clear();
    textures_.clear();
    map_ = nullptr;
    lamps_ = computed_lamps_ = 0;
    const std::vector<LitLamp> lamps = from_left(moment);
    if (is("LIGHT", "NONE") || lamps.empty())
        return;
    if (is("LIGHT", "GROUND_MAP") || is("LIGHT", "VOLUME_MAP")) {
        map_ = &beams_.light_map(moment, is("LIGHT", "VOLUME_MAP"));
        textures_.push_back(map_->texture);
        lamps_ = 1;
        return;
    }
    if (is("MERGED", "1")) {
        LitLamp all;
        all.pose = merged_pose(moment.lamps);
        set_projected_lamp(all, beams_.merged(moment), ego_m);
    } else {
        for (const LitLamp& lamp : lamps)
            if (is("LIGHT", "SPOTS"))
                set_spots(lamp, ego_m);
            else
                set_projected_lamp(lamp, beams_.of(lamp.file), ego_m);
    }
    lamps_ = computed_lamps_ = static_cast<int>(packed_.size());
    update_buffer(context_, lamp_block_, packed_);
    update_buffer(context_, spot_block_, spots_);
}

const Program& PublishedLighting::variant(const Variant& wish, const FrameOutputs& outputs) {
    if (const auto known = variants_.find(wish); known != variants_.end())
        return known->second;
    std::vector<Program::Define> d = Targets::defines(outputs);
    const auto define = [&](const char* name, std::string value) { d.push_back({name, std::move(value)}); };
    if (scene_.moves())
        define("MOVING", "1");
    for (const auto& [name, value] : features_)
        d.push_back({name, name == "EMISSIVE" && wish.pass == 2 ? "NONE" : value}); // once is enough
    add_lamp_defines(d, static_cast<std::size_t>(wish.lamps));
    define("SPOT_COUNT", std::to_string(max_spots));
    define("PASS", std::to_string(wish.pass));
    define("TEXTURED", wish.texture > 0 ? "1" : "0");
    define("TEXTURE_MODE", std::to_string(wish.texture - 1));
    const RationalMapper mapper = published_mapper(settings_.tone_mapper, is("SUN", "1"));
    define("L_MAX", literal(mapper.l_max_lx));
    define("RATIONAL_S", literal(mapper.s));
    define("REFERENCE_LIGHT", literal(reference_light_lx));
    define("SHEETING_RL", literal(sheeting_rl));
    define("EMISSIVE_REACH", literal(emissive_reach_m));
    define("PROJECTION_NEAR", literal(projection_near_m));
    if (map_ != nullptr) {
        const auto vector = [](auto of, const UploadedMap& m) {
            return fmt::format("vec3({}, {}, {})", literal(of(m.ahead)), literal(of(m.left)), literal(of(m.up)));
        };
        define("MAP_FROM", vector([](const LightMapAxis& a) { return a.from_m; }, *map_));
        define("MAP_INVERSE_SPAN", vector([](const LightMapAxis& a) { return 1.0 / (a.to_m - a.from_m); }, *map_));
        define("MAP_GROWTH", literal(map_->ahead.growth));
    }
    return variants_.emplace(wish, Program(context_, "published.vert.glsl", "published.frag.glsl", d)).first->second;
}

void PublishedLighting::use(const Program& program, const Shot& shot) const {
    program.use();
    const double tod = time_of_day(shot.moment.daylight);
    program.set("clip_from_ego", glm::mat4(shot.camera.clip_from_ego));
    program.set("car_axes", glm::mat3(shot.moment.ego.axes));
    program.set("eye_m", glm::vec3(shot.camera.eye_m));
    program.set("eye_axis", glm::vec3(shot.camera.axis));
    program.set("sun_lx", is("SUN", "1") ? tod * sun_max_lx : 0.0);
    program.set("ambient", std::min(global_ambient + tod, 1.0));
}

void PublishedLighting::bind() const {
    const GladGLContext& gl = context_.gl;
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, lamp_block_);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, spot_block_);
    for (std::size_t i = 0; i < textures_.size(); ++i)
        gl.BindTextureUnit(static_cast<GLuint>(i), textures_[i]);
}

/// The second pass adds colours and lux where the first one has drawn; depth and ids it writes again.
void PublishedLighting::start_pass(int pass, const Shot& shot) const {
    if (pass < 2)
        return;
    const GladGLContext& gl = context_.gl;
    gl.DepthFunc(GL_EQUAL);
    gl.DepthMask(GL_FALSE);
    gl.BlendFunc(GL_ONE, GL_ONE);
    const GLuint adding = (shot.outputs.colour ? 1U : 0U) + (shot.outputs.illuminance ? 1U : 0U); // they come first (Targets)
    for (GLuint slot = 0; slot < adding; ++slot)
        gl.Enablei(GL_BLEND, slot);
}

void PublishedLighting::end_passes() const {
    context_.gl.DepthFunc(GL_GREATER);
    context_.gl.DepthMask(GL_TRUE);
    context_.gl.Disable(GL_BLEND);
}

/// The pieces in view by what their textures take; closed bodies first, near ones first in each.
std::vector<PublishedLighting::Group> PublishedLighting::groups_for(const Shot& shot, std::size_t& pieces) const {
    const glm::dvec3 ego_m = shot.moment.ego.position_m;
    const Frustum frustum(shot.camera.clip_from_ego);
    std::map<int, std::vector<std::tuple<bool, double, std::uint32_t>>> sorted;
    for (const std::uint32_t i : scene_.near(ego_m)) {
        const Piece& piece = scene_.pieces()[i];
        const glm::dvec3 centre = centre_of(piece, ego_m);
        const double distance = glm::length(centre) - piece.radius_m;
        if (piece.is_shown(shot.camera.is_map) && distance <= farthest_drawn_m && !frustum.outside(centre, piece.radius_m))
            sorted[shot.outputs.colour ? piece.surface.texture : 0].emplace_back(!piece.closed, distance, i);
    }
    std::vector<Group> groups;
    pieces = 0;
    for (auto& [texture, near] : sorted) {
        std::ranges::sort(near);
        groups.push_back({texture, {}});
        for (const auto& [open, distance, index] : near)
            groups.back().pieces.push_back(index);
        pieces += near.size();
    }
    return groups;
}

void PublishedLighting::draw(const Shot& shot) {
    scene_.place(shot.moment.bodies);
    set_lamps(shot);
    shot.targets.begin(shot.background, shot.sky_luminance_cdm2);
    std::size_t pieces = 0;
    const std::vector<Group> groups = groups_for(shot, pieces);
    list_.start(shot.moment.ego.position_m, scene_.moves());
    for (const Group& group : groups)
        list_.add(group.pieces);
    list_.upload();
    bind();
    for (int k = 0; k < technique_.passes; ++k) {
        const int pass = first_pass() + k;
        shot.clock.begin(pass == 2 ? "lamps" : "scene");
        start_pass(pass, shot);
        for (std::size_t g = 0; g < groups.size(); ++g) {
            use(variant({lamps_, groups[g].texture, pass, published_bits(shot.outputs)}, shot.outputs), shot);
            shot.work.calls += list_.draw(static_cast<int>(g), &shot.camera.clip_from_ego);
            const int samplers = (pass == 1 ? 0 : static_cast<int>(textures_.size())) + (groups[g].texture > 0 ? 1 : 0);
            shot.work.samplers = std::max(shot.work.samplers, samplers);
        }
        shot.clock.end();
        ++shot.work.passes;
        shot.work.draws += static_cast<int>(pieces);
        shot.work.triangles += list_.triangles();
    }
    end_passes();
    context_.check("rendering the scene");
    shot.work.lamps = computed_lamps_;
    shot.work.texture_bytes = beams_.texture_bytes() + scene_.texture_bytes();
    pruned_features_.clear();
    const auto off = std::ranges::count(shot.moment.lamps, 0.0, &LitLamp::intensity_factor);
    if (off > 0)
        pruned_features_.push_back({fmt::format("{} of {} lamps", off, shot.moment.lamps.size()), "switched off"});
    if (pieces < scene_.pieces().size())
        pruned_features_.push_back(
            {fmt::format("{} of {} pieces of the scene", scene_.pieces().size() - pieces, scene_.pieces().size()), "out of view"});
}

std::optional<double> PublishedLighting::beam_error(const LampFile& lamp) const {
    if (is("LIGHT", "SPOTS"))
        return fit_spots(lamp.table, max_spots).worst_of_peak;
    if ((is("LIGHT", "PROJECTED") || is("LIGHT", "VERTEX_PROJECTED")) && is("MERGED", "0"))
        return beams_.error_of_peak(lamp);
    return std::nullopt;
}

void PublishedLighting::prepare(const Shot& shot) {
    set_lamps(shot);
    if (scene_.pieces().empty())
        return;
    shot.targets.begin(shot.background, shot.sky_luminance_cdm2);
    bind();
    for (int k = 0; k < technique_.passes; ++k) {
        const int pass = first_pass() + k;
        start_pass(pass, shot);
        for (const SurfaceClass& surface : scene_.classes()) {
            const Variant wish{lamps_, shot.outputs.colour ? surface.texture : 0, pass, published_bits(shot.outputs)};
            if (variants_.contains(wish))
                continue;
            use(variant(wish, shot.outputs), shot);
            list_.draw_nothing(shot.moment.ego.position_m, scene_.moves());
        }
    }
    end_passes();
    context_.check("compiling variants");
}

UploadedBeam PublishedBeams::upload(const ProjectedBeam& beam) {
    UploadedBeam uploaded{beam.window,
                          beam.steps.empty() ? 1.0 : beam.scale_lx,
                          beam.scale_lx,
                          beam.worst_error_of_peak,
                          make_texels(context_, beam.width, beam.height, beam.bits, framed(beam.lx, beam.width, beam.height, 1),
                                      framed(beam.steps, beam.width, beam.height, 1)),
                          beam.bytes()};
    set_linear(context_.gl, uploaded.texture);
    texture_bytes_ += beam.bytes();
    context_.check("uploading a projected beam");
    return uploaded;
}

void PublishedBeams::forget_other_states(const LampFile& file) {
    if (!file.state_of)
        return;
    const auto same_lamp = [&](const auto& entry) { return entry.first->state_of == file.state_of; };
    for (const auto& entry : beams_)
        texture_bytes_ -= same_lamp(entry) ? entry.second.bytes : 0;
    std::erase_if(beams_, same_lamp);
    std::erase_if(spots_, same_lamp);
}

const UploadedBeam& PublishedBeams::of(const std::shared_ptr<const LampFile>& file) {
    const auto known = beams_.find(file);
    if (known != beams_.end())
        return known->second;
    forget_other_states(*file);
    return beams_.emplace(file, upload(make_projected_beam(file->table, texels_))).first->second;
}

double PublishedBeams::error_of_peak(const LampFile& file) const {
    const auto known = std::ranges::find_if(beams_, [&](const auto& entry) { return entry.first.get() == &file; });
    return known != beams_.end() ? known->second.worst_error_of_peak : make_projected_beam(file.table, texels_).worst_error_of_peak;
}

const std::vector<Spot>& PublishedBeams::spots_of(const std::shared_ptr<const LampFile>& file) {
    const auto known = spots_.find(file);
    if (known != spots_.end())
        return known->second;
    forget_other_states(*file);
    return spots_.emplace(file, fit_spots(file->table, max_spots).spots).first->second;
}

template <class Made, class Make> const Made& PublishedBeams::kept(std::list<Kept<Made>>& list, const Moment& moment, Make make) {
    const std::vector<LitLamp> arrangement = shining_in(moment.ego, moment.lamps);
    for (auto it = list.begin(); it != list.end(); ++it)
        if (same_arrangement(it->arrangement, arrangement)) {
            list.splice(list.begin(), list, it);
            return it->made;
        }
    const std::size_t before = texture_bytes_;
    Made made = make();
    list.push_front({arrangement, std::move(made), texture_bytes_ - before});
    if (list.size() > max_arrangements) {
        texture_bytes_ -= list.back().bytes;
        list.pop_back();
    }
    return list.front().made;
}

const UploadedBeam& PublishedBeams::merged(const Moment& moment) {
    return kept(merged_, moment, [&] { return upload(make_merged_beam(moment.lamps, texels_)); });
}

const UploadedMap& PublishedBeams::light_map(const Moment& moment, bool volume) {
    return kept(maps_, moment, [&] {
        const GladGLContext& gl = context_.gl;
        const LightMap map = volume ? bake_volume(moment) : bake_ground(moment);
        const int x = map.ahead.cells, y = map.left.cells, z = map.up.cells;
        const std::vector<float> texels = framed(map.lx, x, y, z);
        UploadedMap uploaded{map.ahead, map.left, volume ? map.up : LightMapAxis{}, {}};
        if (volume) {
            uploaded.texture = new_texture(context_, GL_TEXTURE_3D);
            gl.TextureStorage3D(uploaded.texture, 1, GL_R32F, x, y, z);
            for (const auto direction : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
                gl.TextureParameteri(uploaded.texture, static_cast<GLenum>(direction), GL_CLAMP_TO_EDGE);
            gl.TextureSubImage3D(uploaded.texture, 0, 0, 0, 0, x, y, z, GL_RED, GL_FLOAT, texels.data());
        } else {
            uploaded.texture = make_texture(context_, GL_R32F, x, y);
            gl.TextureSubImage2D(uploaded.texture, 0, 0, 0, x, y, GL_RED, GL_FLOAT, texels.data());
        }
        set_linear(gl, uploaded.texture);
        texture_bytes_ += map.bytes();
        context_.check("uploading a light map");
        return uploaded;
    });
}

} // namespace fernlicht::gl
