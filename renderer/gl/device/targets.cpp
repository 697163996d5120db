#include "renderer/gl/device/targets.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>

namespace fernlicht::gl {
namespace {

struct Format {
    const char* name;
    bool FrameOutputs::*outputs;
    GLenum internal, layout, type;
};
constexpr Format formats[] = {{"COLOUR", &FrameOutputs::colour, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
                              {"ILLUMINANCE", &FrameOutputs::illuminance, GL_R32F, GL_RED, GL_FLOAT},
                              {"TARGET", &FrameOutputs::target, GL_R32F, GL_RED, GL_FLOAT},
                              {"LUMINANCE", &FrameOutputs::luminance, GL_R32F, GL_RED, GL_FLOAT},
                              {"LIGHT", &FrameOutputs::light, GL_RGBA32F, GL_RGBA, GL_FLOAT}, // three channels need not be drawable
                              {"DEPTH", &FrameOutputs::depth, GL_R32F, GL_RED, GL_FLOAT},
                              {"IDS", &FrameOutputs::ids, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}};

} // namespace

std::vector<Targets::Result> Targets::results_of(const FrameOutputs& outputs) {
    std::vector<Result> results;
    for (int r = 0; r < result_count; ++r)
        if (outputs.*formats[r].outputs)
            results.push_back(static_cast<Result>(r));
    return results;
}

std::vector<Program::Define> Targets::defines(const FrameOutputs& outputs) {
    std::vector<Program::Define> list;
    int slot = 0;
    for (const Format& format : formats) {
        const bool has_output = outputs.*format.outputs;
        list.push_back({std::string("WANT_") + format.name, has_output ? "1" : "0"});
        list.push_back({std::string("OUT_") + format.name, std::to_string(slot)});
        slot += has_output ? 1 : 0;
    }
    list.push_back({"WANT_SEEN", outputs.seen() ? "1" : "0"});
    return list;
}

Targets::Targets(Context& context, int width, int height, const FrameOutputs& outputs)
    : context_(context), width_(width), height_(height), results_(results_of(outputs)), framebuffer_(make_framebuffer(context)) {
    const GladGLContext& gl = context.gl;
    std::vector<GLenum> draw_buffers;
    for (const Result result : results_) {
        textures_.push_back(make_texture(context, formats[result].internal, width, height));
        draw_buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(draw_buffers.size()));
        gl.NamedFramebufferTexture(framebuffer_, draw_buffers.back(), textures_.back(), 0);
    }
    depth_ = make_texture(context, GL_DEPTH_COMPONENT32F, width, height);
    gl.NamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
    gl.NamedFramebufferDrawBuffers(framebuffer_, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    if (const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
        throw DeviceError(
            fmt::format("{} cannot render into {} x {} targets (status 0x{:04x})", context.info.gl_renderer, width, height, status));
    context.check("making targets");
}

void Targets::clear_depth(GLuint framebuffer, std::span<const PixelBox> looked_at) {
    const GladGLContext& gl = context_.gl;
    const float far_away = 0.0F, nearest = 1.0F;
    gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, looked_at.empty() ? &far_away : &nearest);
    if (looked_at.empty())
        return;
    gl.Enable(GL_SCISSOR_TEST);
    for (const PixelBox& box : looked_at) {
        gl.Scissor(box.x, box.y, box.width, box.height);
        gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_away);
    }
    gl.Disable(GL_SCISSOR_TEST);
}

void Targets::begin(const glm::vec3& background, float sky_luminance_cdm2, std::span<const PixelBox> looked_at) {
    const GladGLContext& gl = context_.gl;
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.Viewport(0, 0, width_, height_);
    for (std::size_t slot = 0; slot < results_.size(); ++slot) {
        const Result result = results_[slot];
        const float sky = result == luminance || result == light ? sky_luminance_cdm2 : 0.0F;
        const glm::vec4 value(result == colour ? background : glm::vec3(sky), 1.0F);
        const GLuint zero[4] = {0, 0, 0, 0};
        if (result == ids)
            gl.ClearNamedFramebufferuiv(framebuffer_, GL_COLOR, static_cast<GLint>(slot), zero);
        else
            gl.ClearNamedFramebufferfv(framebuffer_, GL_COLOR, static_cast<GLint>(slot), &value[0]);
    }
    clear_depth(framebuffer_, looked_at);
}

void Targets::begin_visible(std::span<const PixelBox> looked_at) {
    const GladGLContext& gl = context_.gl;
    if (visible_ == 0) {
        visible_ = make_texture(context_, GL_RG32UI, width_, height_);
        visible_framebuffer_ = make_framebuffer(context_);
        gl.NamedFramebufferTexture(visible_framebuffer_, GL_COLOR_ATTACHMENT0, visible_, 0);
        gl.NamedFramebufferTexture(visible_framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
        context_.check("making targets");
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, visible_framebuffer_);
    gl.Viewport(0, 0, width_, height_);
    const GLuint nothing[4] = {0, 0, 0, 0};
    gl.ClearNamedFramebufferuiv(visible_framebuffer_, GL_COLOR, 0, nothing);
    clear_depth(visible_framebuffer_, looked_at);
}

void Targets::read_visible(std::vector<std::uint32_t>& pixels) {
    const GladGLContext& gl = context_.gl;
    pixels.resize(std::size_t{2} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, visible_framebuffer_);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, width_, height_, GL_RG_INTEGER, GL_UNSIGNED_INT, pixels.data());
    context_.check("reading what is visible");
}

std::size_t Targets::bytes_of(Result result) const {
    return std::size_t{result == light ? 16U : 4U} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

void Targets::read_pixels(std::size_t slot, void* place) {
    const GladGLContext& gl = context_.gl;
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.NamedFramebufferReadBuffer(framebuffer_, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot));
    gl.ReadPixels(0, 0, width_, height_, formats[results_[slot]].layout, formats[results_[slot]].type, place);
}

template <class Fill> Frame Targets::make_frame(Fill fill) {
    Frame frame;
    std::size_t slot = 0;
    const auto take = [&](Result result, auto& image) {
        if (slot == results_.size() || results_[slot] != result)
            return;
        image = std::remove_reference_t<decltype(image)>(width_, height_);
        fill(slot++, image.data(), bytes_of(result));
    };
    Image<std::uint32_t> rgba;
    Image<glm::vec4> light_and_one;
    take(colour, rgba);
    take(illuminance, frame.illuminance_lx);
    take(target, frame.target_lx);
    take(luminance, frame.luminance_cdm2);
    take(light, light_and_one);
    take(depth, frame.depth_m);
    take(ids, frame.ids);
    if (!light_and_one.empty()) {
        frame.light = Image<glm::vec3>(width_, height_);
        std::ranges::transform(light_and_one.pixels(), frame.light.pixels().begin(), [](const glm::vec4& l) { return glm::vec3(l); });
    }
    if (!rgba.empty()) {
        frame.colour = Image<Rgb8>(width_, height_);
        const auto* bytes = reinterpret_cast<const unsigned char*>(rgba.data());
        for (std::size_t i = 0; i < frame.colour.size(); ++i)
            frame.colour.pixels()[i] = {bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2]};
    }
    return frame;
}

Frame Targets::read() {
    Frame frame = make_frame([&](std::size_t slot, void* destination, std::size_t) { read_pixels(slot, destination); });
    context_.check("reading a frame");
    return frame;
}

Targets::Reading Targets::start_read() {
    std::size_t bytes = 0;
    for (const Result result : results_)
        bytes += bytes_of(result);
    Reading reading{make_read_buffer(context_, bytes), bytes};
    const GladGLContext& gl = context_.gl;
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, reading.pixels);
    std::uintptr_t offset = 0;
    for (std::size_t slot = 0; slot < results_.size(); ++slot) {
        read_pixels(slot, reinterpret_cast<void*>(offset));
        offset += bytes_of(results_[slot]);
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
    const auto* mapped =
        static_cast<const std::byte*>(gl.MapNamedBufferRange(reading.pixels, 0, static_cast<GLsizeiptr>(reading.bytes), GL_MAP_READ_BIT));
    if (mapped == nullptr)
        throw DeviceError(fmt::format("{} cannot map a frame's pixels", context_.info.gl_renderer));
    Frame frame = make_frame([&](std::size_t, void* destination, std::size_t size) {
        std::memcpy(destination, mapped, size);
        mapped += size;
    });
    gl.UnmapNamedBuffer(reading.pixels);
    context_.check("reading a frame");
    return frame;
}

} // namespace fernlicht::gl
