#include "renderer/gl/device/targets.h"

#include "scenarios/values/errors.h"

#include <cstring>
#include <fmt/format.h>
#include <type_traits>

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
                              {"LIGHT", GL_RGBA32F, GL_RGBA, GL_FLOAT}, // three channels need not be drawable
                              {"DEPTH", GL_R32F, GL_RED, GL_FLOAT},
                              {"IDS", GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}};

} // namespace

bool Targets::is_wanted(const Wanted& wanted, Result result) {
    const bool all[] = {wanted.colour, wanted.illuminance, wanted.target, wanted.luminance, wanted.light, wanted.depth, wanted.ids};
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
    list.push_back({"WANT_SEEN", wanted.seen() ? "1" : "0"});
    return list;
}

Targets::Targets(Context& context, int width, int height, const Wanted& wanted)
    : context_(context), width_(width), height_(height), wanted_(wanted) {
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
        throw DeviceError(
            fmt::format("{} cannot draw into {} x {} targets (status 0x{:04x})", context.info.gl_renderer, width, height, status));
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
        const float sky = result == luminance || result == light ? sky_luminance_cdm2 : 0.0F;
        const float value[4] = {result == colour ? background.r : sky, result == colour ? background.g : sky,
                                result == colour ? background.b : sky, 1.0F};
        const GLuint zero[4] = {0, 0, 0, 0};
        if (result == ids)
            gl.ClearNamedFramebufferuiv(framebuffer_, GL_COLOR, place, zero);
        else
            gl.ClearNamedFramebufferfv(framebuffer_, GL_COLOR, place, value);
    }
    const float far_away = 0.0F;
    gl.ClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_away);
}

std::size_t Targets::bytes_of(Result result) const {
    return is_wanted(wanted_, result)
               ? std::size_t{result == light ? 16U : 4U} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)
               : 0;
}

void Targets::read_pixels(Result result, void* place) {
    const GladGLContext& gl = context_.gl;
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.NamedFramebufferReadBuffer(framebuffer_, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot(wanted_, result)));
    gl.ReadPixels(0, 0, width_, height_, formats[result].layout, formats[result].type, place);
}

template <class Fill> Frame Targets::make_frame(Fill fill) {
    Frame frame;
    const auto take = [&](Result result, auto& image) {
        if (!is_wanted(wanted_, result))
            return;
        image = std::remove_reference_t<decltype(image)>(width_, height_);
        fill(result, image.data(), bytes_of(result));
    };
    take(illuminance, frame.illuminance_lx);
    take(target, frame.target_lx);
    take(luminance, frame.luminance_cdm2);
    take(depth, frame.depth_m);
    take(ids, frame.ids);
    Image<glm::vec4> light_and_one;
    take(light, light_and_one);
    if (wanted_.light) {
        frame.light = Image<glm::vec3>(width_, height_);
        for (std::size_t i = 0; i < frame.light.size(); ++i)
            frame.light.pixels()[i] = glm::vec3(light_and_one.pixels()[i]);
    }
    Image<std::uint32_t> rgba;
    take(colour, rgba);
    if (wanted_.colour) {
        frame.colour = Image<Rgb8>(width_, height_);
        const auto* bytes = reinterpret_cast<const unsigned char*>(rgba.data());
        for (std::size_t i = 0; i < frame.colour.size(); ++i)
            frame.colour.pixels()[i] = {bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2]};
    }
    return frame;
}

Frame Targets::read() {
    Frame frame = make_frame([&](Result result, void* destination, std::size_t) { read_pixels(result, destination); });
    context_.check("reading a frame");
    return frame;
}

Targets::Reading Targets::start_read() {
    std::size_t bytes = 0;
    for (int r = 0; r < result_count; ++r)
        bytes += bytes_of(static_cast<Result>(r));
    Reading reading{make_read_buffer(context_, bytes), nullptr};
    const GladGLContext& gl = context_.gl;
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, reading.pixels);
    std::uintptr_t offset = 0;
    for (int r = 0; r < result_count; ++r) {
        const auto result = static_cast<Result>(r);
        if (is_wanted(wanted_, result))
            read_pixels(result, reinterpret_cast<void*>(offset));
        offset += bytes_of(result);
    }
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    reading.drawn = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.Flush();
    context_.check("starting to read a frame");
    return reading;
}

Frame Targets::finish_read(Reading reading) {
    const GladGLContext& gl = context_.gl;
    constexpr GLuint64 a_minute_ns = 60'000'000'000;
    const GLenum waited = gl.ClientWaitSync(reading.drawn, GL_SYNC_FLUSH_COMMANDS_BIT, a_minute_ns);
    gl.DeleteSync(reading.drawn);
    if (waited == GL_TIMEOUT_EXPIRED || waited == GL_WAIT_FAILED)
        throw DeviceError(fmt::format("{} did not finish a frame within a minute", context_.info.gl_renderer));
    std::size_t offsets[result_count] = {};
    std::size_t bytes = 0;
    for (int r = 0; r < result_count; ++r) {
        offsets[r] = bytes;
        bytes += bytes_of(static_cast<Result>(r));
    }
    const auto* mapped =
        static_cast<const std::byte*>(gl.MapNamedBufferRange(reading.pixels, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT));
    if (mapped == nullptr)
        throw DeviceError(fmt::format("{} cannot map a frame's pixels", context_.info.gl_renderer));
    Frame frame =
        make_frame([&](Result result, void* destination, std::size_t size) { std::memcpy(destination, mapped + offsets[result], size); });
    gl.UnmapNamedBuffer(reading.pixels);
    context_.check("reading a frame");
    return frame;
}

} // namespace fernlicht::gl
