#include "scenarios/values/picture_decoding.h"

#include "scenarios/values/errors.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

struct Channels {
    int first = 0, count = 1;
};

/// Our own channel, three colours, or the only one there is. Alpha is no light.
Channels channels_of(const OIIO::ImageSpec& spec) {
    for (int c = 0; c < spec.nchannels; ++c)
        if (spec.channelnames[static_cast<std::size_t>(c)] == "illuminance.lx")
            return {c, 1};
    return {0, spec.nchannels >= 3 ? 3 : 1};
}

/// Whether the chunks follow one another up to IEND. OpenImageIO 2.4 leaks when libpng runs out of bytes.
bool whole_png(const std::string& bytes) {
    constexpr std::size_t frame = 12; // length, type, check sum
    for (std::size_t at = 8; at + frame <= bytes.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
        if (length > bytes.size() - at - frame)
            return false;
        if (bytes.compare(at + 4, 4, "IEND") == 0)
            return true;
        at += frame + length;
    }
    return false;
}

} // namespace

bool has_whole_exr_header(std::string_view bytes) {
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i > 0; --i)
            value = value << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
        return value;
    };
    constexpr std::size_t magic_and_version = 8;
    constexpr std::uint32_t magic = 20000630, several_parts = 0x1000;
    std::size_t at = magic_and_version;
    if (bytes.size() < at || number(0) != magic)
        return false;
    do { // a part: attributes, each with name, zero, type, zero, size and value, up to an empty name
        for (std::size_t end = bytes.find('\0', at); end != at; end = bytes.find('\0', at)) {
            end = end == std::string_view::npos ? end : bytes.find('\0', end + 1);
            if (end == std::string_view::npos || bytes.size() - end < 5)
                return false;
            at = end + 5;
            const std::uint32_t size = number(end + 1);
            if (size > bytes.size() - at)
                return false;
            at += size;
        }
        ++at;
    } while ((number(4) & several_parts) != 0 && at < bytes.size() && bytes[at] != '\0');
    return true;
}

DecodedPicture decode_picture(const std::filesystem::path& file, const std::string& key, const std::string& bytes, std::size_t max_pixels) {
    const auto fail = [&](const std::string& found, const std::string& expected) { throw InputError({file, 0, 0, key}, found, expected); };
    const bool png = bytes.starts_with("\x89PNG"), jpeg = bytes.starts_with("\xFF\xD8\xFF");
    if (!png && !jpeg)
        fail("a picture that is neither PNG nor JPEG", "one of them");
    if (png ? !whole_png(bytes) : bytes.rfind("\xFF\xD9") == std::string::npos)
        fail("a picture that ends early or is damaged", "a whole one");
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto in = OIIO::ImageInput::create(png ? "png" : "jpeg");
    if (!in || !in->set_ioproxy(&memory) || !in->open(png ? "picture.png" : "picture.jpg", spec, config))
        fail("a picture that cannot be decoded: " + printable(in ? in->geterror() : OIIO::geterror(), 200), "PNG or JPEG");
    const auto width = static_cast<std::size_t>(spec.width), height = static_cast<std::size_t>(spec.height);
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.nchannels > 4 || width * height > max_pixels)
        fail(fmt::format("a picture of {} x {} pixels and {} channels", spec.width, spec.height, spec.nchannels),
             fmt::format("1 to 4 channels and at most {} pixels", max_pixels));
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<std::uint8_t> pixels(width * height * channels);
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data()))
        fail("a picture that cannot be decoded: " + printable(in->geterror(), 200), "a whole one");
    DecodedPicture out{spec.width, spec.height, std::vector<std::uint8_t>(width * height * 4, 255)};
    for (std::size_t i = 0; i < width * height; ++i)
        for (std::size_t c = 0; c < 4; ++c)
            if (channels >= 3 ? c < channels : c < 3 || channels == 2)
                out.rgba[4 * i + c] = pixels[i * channels + (channels >= 3 ? c : c < 3 ? 0 : 1)];
    return out;
}

TextureImage decode_texture(const std::filesystem::path& path, const std::string& bytes, std::size_t max_pixels) {
    const auto fail = [&](const std::string& found) { throw InputError({path, 0, 0, {}}, found, "a PNG or EXR picture"); };
    const bool png = bytes.starts_with("\x89PNG");
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size()); // only read from; the type wants it so
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (png ? !whole_png(bytes) : bytes.starts_with("v/1\1") && !has_whole_exr_header(bytes))
        fail("ends early or is damaged");
    const auto in = OIIO::ImageInput::create(png ? "png" : "openexr");
    OIIO::ImageSpec spec;
    if (!in || !in->set_ioproxy(&memory) || !in->open(png ? "texture.png" : "texture.exr", spec, config)) {
        const std::string reason = in ? in->geterror() : OIIO::geterror();
        fail("cannot be decoded: " + printable(reason, 200));
    }
    if (spec.width < 2 || spec.height < 2 || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > 64)
        fail(fmt::format("has {} x {} x {} pixels of {} channels", spec.width, spec.height, spec.depth, spec.nchannels));
    if (static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) > max_pixels)
        throw InputError({path, 0, 0, {}}, fmt::format("has {} x {} pixels", spec.width, spec.height),
                         fmt::format("at most {}", max_pixels));
    const Channels channels = channels_of(spec);
    TextureImage out;
    out.value = Image<float>(spec.width, spec.height);
    std::vector<float> pixels(out.value.size() * static_cast<std::size_t>(channels.count));
    if (!in->read_image(0, 0, channels.first, channels.first + channels.count, OIIO::TypeDesc::FLOAT, pixels.data()))
        fail("cannot be decoded: " + printable(in->geterror(), 200));
    for (std::size_t i = 0; i < out.value.size(); ++i) {
        const float* p = &pixels[i * static_cast<std::size_t>(channels.count)];
        out.value.pixels()[i] = channels.count == 1 ? p[0] : 0.2126F * p[0] + 0.7152F * p[1] + 0.0722F * p[2];
        out.was_coloured = out.was_coloured || (channels.count == 3 && !(p[0] == p[1] && p[1] == p[2]));
    }
    out.pixel_type = spec.format.c_str();
    for (const auto& attribute : spec.extra_attribs)
        if (attribute.type() == OIIO::TypeDesc::STRING)
            out.attributes.emplace(attribute.name().string(), attribute.get_string());
    return out;
}

std::string encode_texture(const Image<float>& value, const std::string& channel, const std::map<std::string, std::string>& attributes) {
    std::vector<unsigned char> buffer;
    OIIO::Filesystem::IOVecOutput memory(buffer);
    OIIO::ImageSpec spec(value.width(), value.height(), 1, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {channel};
    spec.attribute("compression", "zip");
    for (const auto& [name, text] : attributes)
        spec.attribute(name, text);
    const auto out = OIIO::ImageOutput::create("texture.exr", &memory);
    if (!out || !out->open("texture.exr", spec) || !out->write_image(OIIO::TypeDesc::FLOAT, value.data()) || !out->close())
        throw std::runtime_error("EXR cannot be encoded: " + (out ? out->geterror() : OIIO::geterror()));
    return {buffer.begin(), buffer.end()};
}

} // namespace fernlicht
