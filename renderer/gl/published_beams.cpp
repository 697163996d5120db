#include "renderer/gl/published_beams.h"

#include "renderer/gl/scene/beams.h"
#include "renderer/merged_beam.h"
#include "renderer/published_light.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace fernlicht::gl {
namespace {

constexpr std::size_t most_arrangements = 4;
constexpr double same_within = 1e-6;

/// Texels [z][y][x] with the outermost ones black.
template <class T> std::vector<T> framed(std::vector<T> texels, int width, int height, int depth) {
    std::size_t i = 0;
    for (int z = 0; z < depth; ++z)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x, ++i)
                if (x == 0 || y == 0 || x == width - 1 || y == height - 1 || (depth > 1 && (z == 0 || z == depth - 1)))
                    texels[i] = T{0};
    return texels;
}

void set_linear(const GladGLContext& gl, GLuint texture) {
    gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

} // namespace

LampArrangement::LampArrangement(const Moment& moment) {
    for (const LitLamp& lamp : moment.lamps)
        if (lamp.intensity_factor > 0.0) {
            lamps_.push_back(lamp);
            lamps_.back().pose = {to_local(moment.ego, lamp.pose.position_m), glm::transpose(moment.ego.axes) * lamp.pose.axes};
        }
}

bool LampArrangement::same_as(const LampArrangement& other) const {
    return std::ranges::equal(lamps_, other.lamps_, [](const LitLamp& a, const LitLamp& b) {
        bool same = a.file == b.file && a.intensity_factor == b.intensity_factor &&
                    glm::distance(a.pose.position_m, b.pose.position_m) < same_within;
        for (int axis = 0; axis < 3; ++axis)
            same = same && glm::distance(a.pose.axes[axis], b.pose.axes[axis]) < same_within;
        return same;
    });
}

UploadedBeam PublishedBeams::upload(const ProjectedBeam& beam) {
    const GladGLContext& gl = context_.gl;
    UploadedBeam uploaded{beam.window, beam.steps.empty() ? 1.0 : beam.scale_lx, beam.scale_lx, beam.worst_error_of_peak,
                          make_texture(context_, format_of_texels(beam.bits), beam.width, beam.height)};
    set_linear(gl, uploaded.texture);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const auto send = [&](GLenum type, const void* texels) {
        gl.TextureSubImage2D(uploaded.texture, 0, 0, 0, beam.width, beam.height, GL_RED, type, texels);
    };
    if (beam.steps.empty())
        send(GL_FLOAT, framed(beam.lx, beam.width, beam.height, 1).data());
    else if (beam.bits == 16)
        send(GL_UNSIGNED_SHORT, framed(beam.steps, beam.width, beam.height, 1).data());
    else
        send(GL_UNSIGNED_BYTE, framed(std::vector<std::uint8_t>(beam.steps.begin(), beam.steps.end()), beam.width, beam.height, 1).data());
    texture_bytes_ += beam.bytes();
    context_.check("uploading a projected beam");
    return uploaded;
}

const UploadedBeam& PublishedBeams::of(const std::shared_ptr<const LampFile>& file) {
    const auto known = beams_.find(file);
    if (known != beams_.end())
        return known->second;
    return beams_.emplace(file, upload(make_projected_beam(file->table, texels_))).first->second;
}

double PublishedBeams::error_of_peak(const LampFile& file) const {
    const auto known = std::ranges::find_if(beams_, [&](const auto& entry) { return entry.first.get() == &file; });
    return known != beams_.end() ? known->second.worst_error_of_peak : make_projected_beam(file.table, texels_).worst_error_of_peak;
}

const std::vector<Spot>& PublishedBeams::spots_of(const std::shared_ptr<const LampFile>& file) {
    const auto known = spots_.find(file);
    return known != spots_.end() ? known->second : spots_.emplace(file, fit_spots(file->table, most_spots).spots).first->second;
}

template <class Made, class Make> const Made& PublishedBeams::kept(std::list<Kept<Made>>& list, const Moment& moment, Make make) {
    const LampArrangement arrangement(moment);
    for (auto it = list.begin(); it != list.end(); ++it)
        if (it->arrangement.same_as(arrangement)) {
            list.splice(list.begin(), list, it);
            return it->made;
        }
    const std::size_t before = texture_bytes_;
    Made made = make();
    list.push_front({arrangement, std::move(made), texture_bytes_ - before});
    if (list.size() > most_arrangements) {
        texture_bytes_ -= list.back().bytes;
        list.pop_back();
    }
    return list.front().made;
}

const UploadedBeam& PublishedBeams::merged(const Moment& moment) {
    return kept(merged_, moment, [&] { return upload(make_merged_beam(moment.lamps, texels_)); });
}

const UploadedMap& PublishedBeams::ground_map(const Moment& moment) {
    return kept(maps_, moment, [&] {
        const LightMap2d map = bake_ground(moment);
        UploadedMap uploaded{map.ahead, map.left, {}, make_texture(context_, GL_R32F, map.ahead.cells, map.left.cells)};
        set_linear(context_.gl, uploaded.texture);
        context_.gl.TextureSubImage2D(uploaded.texture, 0, 0, 0, map.ahead.cells, map.left.cells, GL_RED, GL_FLOAT,
                                      framed(map.lx, map.ahead.cells, map.left.cells, 1).data());
        texture_bytes_ += map.bytes();
        context_.check("uploading a light map");
        return uploaded;
    });
}

const UploadedMap& PublishedBeams::volume_map(const Moment& moment) {
    return kept(maps_, moment, [&] {
        const GladGLContext& gl = context_.gl;
        const LightMap3d map = bake_volume(moment);
        GLuint name = 0;
        gl.CreateTextures(GL_TEXTURE_3D, 1, &name);
        UploadedMap uploaded{map.ahead, map.left, map.up, Texture(context_, name)};
        gl.TextureStorage3D(name, 1, GL_R32F, map.ahead.cells, map.left.cells, map.up.cells);
        set_linear(gl, name);
        for (const auto direction : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
            gl.TextureParameteri(name, static_cast<GLenum>(direction), GL_CLAMP_TO_EDGE);
        gl.TextureSubImage3D(name, 0, 0, 0, 0, map.ahead.cells, map.left.cells, map.up.cells, GL_RED, GL_FLOAT,
                             framed(map.lx, map.ahead.cells, map.left.cells, map.up.cells).data());
        texture_bytes_ += map.bytes();
        context_.check("uploading a light map");
        return uploaded;
    });
}

} // namespace fernlicht::gl
