#include "renderer/gl/scene/draw_list.h"

#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

/// Row i of a matrix that GLM stores by columns.
glm::dvec4 row(const glm::dmat4& m, int i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

/// Of right, up and forward: below 0 in a perspective, above it in a mirror's image of one, 0 without a perspective.
double handedness(const glm::dmat4& clip) {
    return glm::dot(glm::cross(glm::dvec3(row(clip, 0)), glm::dvec3(row(clip, 1))), glm::dvec3(row(clip, 3)));
}

} // namespace

Frustum::Frustum(const glm::dmat4& clip_from_ego) {
    const glm::dvec4 x = row(clip_from_ego, 0), y = row(clip_from_ego, 1), w = row(clip_from_ego, 3);
    const glm::dvec4 sides[] = {w + x, w - x, w + y, w - y};
    for (int i = 0; i < 4; ++i)
        planes[i] = sides[i] / glm::length(glm::dvec3(sides[i]));
}

bool Frustum::outside(const glm::dvec3& centre_m, double radius_m) const {
    for (const glm::dvec4& plane : planes)
        if (glm::dot(glm::dvec3(plane), centre_m) + plane.w < -radius_m)
            return true;
    return false;
}

DrawList::DrawList(Context& context, const SceneBuffers& scene)
    : context_(context), scene_(scene),
      place_buffer_(make_buffer(context, std::vector<glm::vec4>(scene.pieces().size() + 1), GL_DYNAMIC_STORAGE_BIT)),
      command_buffer_(make_buffer(context, std::vector<Command>(scene.pieces().size() + 1), GL_DYNAMIC_STORAGE_BIT)) {}

void DrawList::start(const glm::dvec3& ego_m, bool extras, bool numbered) {
    with_extras_ = extras;
    numbered_ = numbered;
    drawn_pieces_.clear();
    extras_.clear();
    if (extras && extra_buffer_ == 0)
        extra_buffer_ = make_buffer(context_, std::vector<PieceExtra>(scene_.pieces().size() + 1), GL_DYNAMIC_STORAGE_BIT);
    ego_m_ = ego_m;
    places_.clear();
    commands_.clear();
    closed_.clear();
    calls_.clear();
    triangles_ = 0;
}

int DrawList::add(std::span<const std::uint32_t> pieces, const std::vector<PieceExtra>* traffic) {
    calls_.push_back({commands_.size(), pieces.size()});
    for (const std::uint32_t index : pieces) {
        const Piece& piece = scene_.pieces()[index];
        commands_.push_back({piece.index_count, 1, piece.first_index, piece.base_vertex, static_cast<GLuint>(places_.size())});
        closed_.push_back(piece.closed);
        // The id that a pixel shows is the mesh's place in the scene + 1, exact in a float up to 16 million meshes.
        float number = static_cast<float>(piece.mesh + 1) * (piece.ground ? -1.0F : 1.0F);
        if (numbered_) {
            const DrawnPiece* const before = drawn_pieces_.empty() ? nullptr : &drawn_pieces_.back();
            const std::uint32_t first = before == nullptr ? 1 : before->first_id + before->corners;
            drawn_pieces_.push_back({first, static_cast<std::uint32_t>(piece.base_vertex), piece.vertex_count, piece.origin_m - ego_m_,
                                     turn_of(piece), piece.mesh, piece.ground});
            number = static_cast<float>(static_cast<std::int64_t>(first) - piece.base_vertex);
        }
        places_.emplace_back(glm::vec3(piece.origin_m - ego_m_), number);
        triangles_ += piece.index_count / 3;
        if (with_extras_) {
            extras_.push_back(traffic != nullptr ? (*traffic)[index] : PieceExtra{});
            extras_.back().turn = piece.turn;
        }
    }
    return static_cast<int>(calls_.size()) - 1;
}

int DrawList::add_nothing() {
    calls_.push_back({commands_.size(), 1});
    commands_.push_back({3, 1, 0, 0, static_cast<GLuint>(places_.size())});
    closed_.push_back(false);
    places_.emplace_back(0.0F);
    if (with_extras_)
        extras_.emplace_back();
    return static_cast<int>(calls_.size()) - 1;
}

void DrawList::upload() {
    update_buffer(context_, place_buffer_, places_);
    update_buffer(context_, command_buffer_, commands_);
    if (with_extras_)
        update_buffer(context_, extra_buffer_, extras_);
}

void DrawList::draw_commands(std::size_t first, std::size_t end) const {
    context_.gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * sizeof(Command)),
                                          static_cast<GLsizei>(end - first), 0);
}

int DrawList::draw(int call, const glm::dmat4* clip) const {
    const Call& c = calls_[static_cast<std::size_t>(call)];
    if (c.count == 0)
        return 0;
    const GladGLContext& gl = context_.gl;
    scene_.bind(place_buffer_, with_extras_ ? static_cast<GLuint>(extra_buffer_) : 0);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_);
    const std::size_t end = c.first + c.count;
    const double hand = clip == nullptr ? 0.0 : handedness(*clip);
    if (hand == 0.0) {
        draw_commands(c.first, end);
        return 1;
    }
    gl.FrontFace(hand < 0.0 ? GL_CCW : GL_CW);
    int calls = 0;
    for (std::size_t first = c.first, next; first < end; first = next, ++calls) {
        next = first + 1;
        while (next < end && closed_[next] == closed_[first])
            ++next;
        (closed_[first] ? gl.Enable : gl.Disable)(GL_CULL_FACE);
        draw_commands(first, next);
    }
    gl.Disable(GL_CULL_FACE);
    gl.FrontFace(GL_CCW);
    return calls;
}

void DrawList::draw_nothing(const glm::dvec3& ego_m, bool extras) {
    start(ego_m, extras);
    const int call = add_nothing();
    upload();
    draw(call);
}

Program depth_program(Context& context, bool moving) {
    return {context, "depth.vert.glsl", "", moving ? std::vector<Program::Define>{{"MOVING", "1"}} : std::vector<Program::Define>{}};
}

DepthPass::DepthPass(Context& context, const SceneBuffers& scene, bool moving)
    : context_(context), moving_(moving), program_(depth_program(context, moving)), list_(context, scene),
      target_(make_framebuffer(context)) {}

void DepthPass::begin(int width, int height, int beside) {
    width_ = width;
    height_ = height;
    program_.use();
    context_.gl.Viewport(beside, beside, width - 2 * beside, height - 2 * beside);
    context_.gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    context_.gl.Enable(GL_SCISSOR_TEST);
}

void DepthPass::set_pieces(const glm::dvec3& ego_m, std::span<const std::uint32_t> pieces) {
    list_.start(ego_m, moving_);
    list_.add(pieces);
    list_.upload();
    pieces_ = static_cast<int>(pieces.size());
}

void DepthPass::draw(GLuint map, const glm::dmat4& clip, Work& work, GLint layer, double ground_lowered) {
    const GladGLContext& gl = context_.gl;
    if (layer < 0)
        gl.NamedFramebufferTexture(target_, GL_DEPTH_ATTACHMENT, map, 0);
    else
        gl.NamedFramebufferTextureLayer(target_, GL_DEPTH_ATTACHMENT, map, 0, layer);
    gl.NamedFramebufferDrawBuffer(target_, GL_NONE);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target_);
    const float far_away = 0.0F;
    gl.Scissor(0, 0, width_, height_);
    gl.ClearNamedFramebufferfv(target_, GL_DEPTH, 0, &far_away);
    gl.Scissor(1, 1, width_ - 2, height_ - 2);
    program_.set("clip_from_ego", glm::mat4(clip));
    program_.set("ground_lowered", ground_lowered);
    list_.draw(0); // from both sides: a front narrower than a texel may show none of it, where the back behind it does
    ++work.passes;
    ++work.shadow_maps_drawn;
    work.draws += pieces_;
    work.triangles += list_.triangles();
}

void DepthPass::end(const char* doing) {
    context_.gl.Disable(GL_SCISSOR_TEST);
    context_.gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    context_.check(doing);
}

void DepthPass::compile(int width, int height) {
    const GladGLContext& gl = context_.gl;
    const Texture scratch = make_texture(context_, GL_DEPTH_COMPONENT32F, width, height);
    gl.NamedFramebufferTexture(target_, GL_DEPTH_ATTACHMENT, scratch, 0);
    gl.NamedFramebufferDrawBuffer(target_, GL_NONE);
    GLint bound = 0;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target_);
    program_.use();
    list_.draw_nothing(glm::dvec3(0.0), moving_);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
    context_.check("compiling the shadow pass");
}

} // namespace fernlicht::gl
