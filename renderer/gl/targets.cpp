#include "renderer/gl/targets.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>

namespace fernlicht::gl {
namespace {

struct Format {
    const char* name;
    GLenum internal, layout, type;
};
constexpr Format formats[] = {{"COLOUR", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
                              {"ILLUMINANCE", GL_R32F, GL_RED, GL_FLOAT},
                              {"TARGET", GL_R32F, GL_RED, GL_FLOAT},
                              {"LUMINANCE", GL_R32F, GL_RED, GL_FLOAT},
                              {"DEPTH", GL_R32F, GL_RED, GL_FLOAT},
                              {"IDS", GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}};

} // namespace

bool Targets::is_wanted(const Wanted& wanted, Result result) {
    const bool all[] = {wanted.colour, wanted.illuminance, wanted.target, wanted.luminance, wanted.depth, wanted.ids};
    return all[result];
}

int Targets::slot(const Wanted& wanted, Result result) {
    int place = 0;
    for (int r = 0; r < result; ++r)
        place += is_wanted(wanted, static_cast<Result>(r)) ? 1 : 0;
    return place;
}

std::vector<Program::Define> Targets::defines(const Wanted& wanted) {
    std::vector<Program::Define> list;
    for (int r = 0; r < result_count; ++r) {
        const auto result = static_cast<Result>(r);
        list.push_back({std::string("WANT_") + formats[r].name, is_wanted(wanted, result) ? "1" : "0"});
        list.push_back({std::string("OUT_") + formats[r].name, std::to_string(slot(wanted, result))});
    }
    return list;
}

Targets::Targets(Context& context, int width, int height, const Wanted& wanted) : context_(context), width_(width), height_(height), wanted_(wanted) {
    const GladGLContext& gl = context.gl;
    framebuffer_ = make_framebuffer(context);
    std::vector<GLenum> draw_buffers;
    for (int r = 0; r < result_count; ++r) {
        const auto result = static_cast<Result>(r);
        if (!is_wanted(wanted, result))
            continue;
        textures_[r] = make_texture(context, formats[r].internal, width, height);
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot(wanted, result));
        gl.NamedFramebufferTexture(framebuffer_, attachment, textures_[r], 0);
        draw_buffers.push_back(attachment);
    }
    depth_ = make_texture(context, GL_DEPTH_COMPONENT32F, width, height);
    gl.NamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
    gl.NamedFramebufferDrawBuffers(framebuffer_, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    if (const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
        throw DeviceError(fmt::format("{} cannot draw into {} x {} targets (status 0x{:04x})", context.info.gl_renderer, width, height, status));
    context.check("making targets");
}

void Targets::begin(const glm::vec3& background, float sky_luminance_cdm2) {
    const GladGLContext& gl = context_.gl;
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.Viewport(0, 0, width_, height_);
    for (int r = 0; r < result_count; ++r) {
        const auto result = static_cast<Result>(r);
        if (!is_wanted(wanted_, result))
            continue;
        const GLint place = slot(wanted_, result);
        const float value[4] = {result == colour ? background.r : (result == luminance ? sky_luminance_cdm2 : 0.0F), background.g, background.b, 1.0F};
        const GLuint zero[4] = {0, 0, 0, 0};
        if (result == ids)
            gl.ClearNamedFramebufferuiv(framebuffer_, GL_COLOR, place, zero);
        else
            gl.ClearNamedFramebufferfv(framebuffer_, GL_COLOR, place, value);
    }
    const float far_away = 0.0F;
    gl.ClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_away);
}

void Targets::read(Frame& frame) {
    const GladGLContext& gl = context_.gl;
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    const auto read_one = [&](Result result, void* pixels) {
        gl.NamedFramebufferReadBuffer(framebuffer_, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot(wanted_, result)));
        gl.ReadPixels(0, 0, width_, height_, formats[result].layout, formats[result].type, pixels);
    };
    const auto read_floats = [&](Result result, Image<float>& image) {
        if (!is_wanted(wanted_, result))
            return;
        image = Image<float>(width_, height_);
        read_one(result, image.data());
    };
    read_floats(illuminance, frame.illuminance_lx);
    read_floats(target, frame.target_lx);
    read_floats(luminance, frame.luminance_cdm2);
    read_floats(depth, frame.depth_m);
    if (wanted_.ids) {
        frame.ids = Image<std::uint32_t>(width_, height_);
        read_one(ids, frame.ids.data());
    }
    if (wanted_.colour) {
        frame.colour = Image<Rgb8>(width_, height_);
        rgba_.resize(frame.colour.size() * 4);
        read_one(colour, rgba_.data());
        for (std::size_t i = 0; i < frame.colour.size(); ++i)
            frame.colour.pixels()[i] = {rgba_[4 * i], rgba_[4 * i + 1], rgba_[4 * i + 2]};
    }
    context_.check("reading a frame");
}

} // namespace fernlicht::gl
