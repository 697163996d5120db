#include "scenarios/values/picture_decoding.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/exr_file.h"
#include "scenarios/values/jpeg_file.h"
#include "scenarios/values/png_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

struct EightBits {
    int width = 0, height = 0;
    std::size_t channels = 0;
    std::vector<std::uint8_t> levels;
};

std::uint16_t sample_16(const PngPicture& picture, std::size_t i) {
    std::uint16_t sample = 0;
    std::memcpy(&sample, picture.bytes.data() + 2 * i, sizeof sample);
    return sample;
}

/// Each 0 to 1. Products, not quotients: they round otherwise.
std::vector<float> parts_of_white(const PngPicture& picture) {
    if (picture.head.bits == 8) {
        std::vector<float> out(picture.bytes.size());
        std::ranges::transform(picture.bytes, out.begin(), [](std::uint8_t level) { return static_cast<float>(level) * (1.0F / 255.0F); });
        return out;
    }
    std::vector<float> out(picture.bytes.size() / 2);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<float>(sample_16(picture, i)) * (1.0F / 65535.0F);
    return out;
}

EightBits eight_bits(PngPicture picture) {
    EightBits out{picture.head.width, picture.head.height, static_cast<std::size_t>(picture.head.channels), {}};
    if (picture.head.bits == 8) {
        out.levels = std::move(picture.bytes);
        return out;
    }
    out.levels.resize(picture.bytes.size() / 2);
    std::ranges::transform(parts_of_white(picture), out.levels.begin(),
                           [](float part) { return static_cast<std::uint8_t>(std::floor(part * 255.0F + 0.5F)); });
    return out;
}

/// Our own channel, three colours, or the only one there is. Alpha is no light.
std::pair<std::size_t, std::size_t> channels_of_light(const ExrHead& head) {
    const auto own = std::ranges::find(head.channels, "illuminance.lx");
    if (own != head.channels.end())
        return {static_cast<std::size_t>(own - head.channels.begin()), 1};
    return {0, head.channels.size() >= 3 ? 3 : 1};
}

} // namespace

DecodedPicture decode_picture(const std::filesystem::path& file, const std::string& key, const std::string& bytes, std::size_t max_pixels) {
    const auto fail = [&](const std::string& found, const std::string& expected) { throw InputError({file, 0, 0, key}, found, expected); };
    const bool png = bytes.starts_with("\x89PNG"), jpeg = bytes.starts_with("\xFF\xD8\xFF");
    if (!png && !jpeg)
        fail("a picture that is neither PNG nor JPEG", "one of them");
    if (png ? !is_whole_png(bytes) : bytes.rfind("\xFF\xD9") == std::string::npos)
        fail("a picture that ends early or is damaged", "a whole one");
    const auto check = [&](int width, int height, int channels) {
        if (width < 1 || height < 1 || channels < 1 || channels > 4 ||
            static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > max_pixels)
            fail(fmt::format("a picture of {} x {} pixels and {} channels", width, height, channels),
                 fmt::format("1 to 4 channels and at most {} pixels", max_pixels));
    };
    EightBits picture;
    try {
        if (png) {
            picture = eight_bits(decode_png(bytes, [&](const PngHead& head) { check(head.width, head.height, head.channels); }));
        } else {
            JpegPicture read = decode_jpeg(bytes, [&](const JpegPicture& head) { check(head.width, head.height, head.channels); });
            picture = {read.width, read.height, static_cast<std::size_t>(read.channels), std::move(read.bytes)};
        }
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        fail("a picture that cannot be decoded: " + printable(error.what(), 200), png ? "a whole PNG" : "a whole JPEG");
    }
    const std::size_t channels = picture.channels, size = picture.levels.size() / channels;
    DecodedPicture out{picture.width, picture.height, std::vector<std::uint8_t>(size * 4, 255)};
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t c = 0; c < 4; ++c)
            if (channels >= 3 ? c < channels : c < 3 || channels == 2)
                out.rgba[4 * i + c] = picture.levels[i * channels + (channels >= 3 ? c : c < 3 ? 0 : 1)];
    return out;
}

TextureImage decode_texture(const std::filesystem::path& path, const std::string& bytes, std::size_t max_pixels, int least_side) {
    const auto fail = [&](const std::string& found) { throw InputError({path, 0, 0, {}}, found, "a PNG or EXR picture"); };
    const bool png = bytes.starts_with("\x89PNG");
    if (png && !is_whole_png(bytes))
        fail("ends early or is damaged");
    const auto check = [&](int width, int height, std::size_t channels) {
        if (width < least_side || height < least_side || channels < 1 || channels > 64)
            fail(fmt::format("has {} x {} pixels of {} channels", width, height, channels));
        if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > max_pixels)
            throw InputError({path, 0, 0, {}}, fmt::format("has {} x {} pixels", width, height), fmt::format("at most {}", max_pixels));
    };
    TextureImage out;
    std::vector<Image<float>> light; // one channel, or three
    try {
        if (png) {
            PngPicture read =
                decode_png(bytes, [&](const PngHead& head) { check(head.width, head.height, static_cast<std::size_t>(head.channels)); });
            const std::vector<float> parts = parts_of_white(read);
            const auto channels = static_cast<std::size_t>(read.head.channels);
            light.assign(channels >= 3 ? 3 : 1, Image<float>(read.head.width, read.head.height));
            for (std::size_t c = 0; c < light.size(); ++c)
                for (std::size_t i = 0; i < light[c].size(); ++i)
                    light[c].pixels()[i] = parts[i * channels + c];
            out.pixel_type = read.head.bits == 8 ? "uint8" : "uint16";
            out.attributes = std::move(read.head.texts);
        } else {
            ExrPicture read = decode_exr(bytes, [&](const ExrHead& head) {
                check(head.width, head.height, head.channels.size());
                const auto taken = channels_of_light(head);
                const auto first = head.channels.begin() + static_cast<std::ptrdiff_t>(taken.first);
                out.channels.assign(first, first + static_cast<std::ptrdiff_t>(taken.second));
                return taken;
            });
            light = std::move(read.channels);
            out.pixel_type = read.head.pixel_type;
            out.attributes = std::move(read.head.texts);
        }
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        fail("cannot be decoded: " + printable(error.what(), 200));
    }
    if (light.size() == 1) {
        out.value = std::move(light[0]);
        return out;
    }
    out.value = Image<float>(light[0].width(), light[0].height());
    for (std::size_t i = 0; i < out.value.size(); ++i) {
        const float r = light[0].pixels()[i], g = light[1].pixels()[i], b = light[2].pixels()[i];
        out.value.pixels()[i] = 0.2126F * r + 0.7152F * g + 0.0722F * b;
        out.was_coloured = out.was_coloured || !(r == g && g == b);
    }
    return out;
}

std::string encode_texture(const Image<float>& value, const std::string& channel, const std::map<std::string, std::string>& attributes) {
    return encode_exr({{channel, &value}}, {attributes.begin(), attributes.end()}, 4);
}

} // namespace fernlicht
