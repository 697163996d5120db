#include "runner/files/picture_file.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/exr_file.h"
#include "scenarios/values/files.h"
#include "scenarios/values/jpeg_file.h"
#include "scenarios/values/png_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <lcms2.h>
#include <memory>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr std::size_t max_values = std::size_t{1} << 28, max_file_bytes = std::size_t{1} << 30;
constexpr const char* shown_by_key = "fernlicht:shown_by";

std::map<std::string, ExrAttribute> context_of(const Moment& moment, const View& view) {
    std::map<std::string, ExrAttribute> context{
        {"fernlicht:view", view.name},
        {"fernlicht:tick", moment.tick},
        {"fernlicht:time_s", moment.time_s},
        {"fernlicht:distance_m", moment.distance_m},
        {"fernlicht:speed_mps", moment.speed_mps},
        {"fernlicht:ego_position_m", moment.ego.position_m},
        {"fernlicht:ego_forward", moment.ego.forward()},
        {"capDate", std::string("1970:01:01 00:00:00")}, // as files of earlier versions have it
    };
    double near_field_m = 0.0; // pixels nearer to a lamp than this are near-field
    for (const LitLamp& lamp : moment.lamps)
        near_field_m = std::max(near_field_m, lamp.photometric_distance_m);
    context.emplace("fernlicht:near_field_below_m", near_field_m);
    if (view.projection == Projection::perspective)
        context.emplace("fernlicht:vertical_fov_deg", degrees(view.vertical_fov_rad));
    return context;
}

void write_encoded(const std::filesystem::path& path, const std::function<std::string()>& encode) {
    std::string bytes;
    try {
        bytes = encode();
    } catch (const std::exception& error) {
        throw DeviceError(path.string() + ": cannot be written: " + error.what());
    }
    write_file(path, bytes);
}

void write_rgb(const PngPixels& pixels, const PictureTags& tags, const std::filesystem::path& path) {
    std::vector<std::pair<std::string, std::string>> texts;
    if (tags.icc.empty())
        texts.emplace_back("oiio:ColorSpace", "sRGB"); // as files of earlier versions have it
    if (!tags.shown_by.empty())
        texts.emplace_back(shown_by_key, tags.shown_by);
    write_encoded(path, [&] { return encode_png(pixels, 6, tags.icc, texts); }); // docs/decisions/0004
}

void write_images(const std::vector<std::pair<std::string, const Image<float>*>>& images, const Moment& moment, const View& view,
                  const std::vector<std::pair<std::string, std::string>>& texts, const std::filesystem::path& path) {
    std::map<std::string, ExrAttribute> attributes = context_of(moment, view);
    for (const auto& [name, text] : texts)
        attributes.insert_or_assign(name, text);
    // Other levels take up to half as long again for 2 % fewer bytes (docs/decisions/0004).
    write_encoded(path, [&] { return encode_exr(images, attributes, 1); });
}

/// Reads the file and calls `read` with its bytes; what that throws becomes a refusal.
template <class Read> auto read_bytes(const std::filesystem::path& path, const char* expected, const Read& read)
    -> decltype(read(std::string())) {
    FilesRead opened;
    const std::string bytes = read_file(path, opened, max_file_bytes, true);
    try {
        return read(bytes);
    } catch (const std::exception& error) {
        throw InputError({path, 0, 0, {}}, "cannot be read: " + printable(error.what(), 200), expected);
    }
}

void check_size(int width, int height, std::size_t channels) {
    if (width < 1 || height < 1 ||
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > max_values / std::max<std::size_t>(1, channels))
        throw std::runtime_error(fmt::format("it claims {} x {} pixels of {} channels", width, height, channels));
}

Image<Rgb8> rgb_of(int width, int height, int channels, const std::vector<std::uint8_t>& levels) {
    Image<Rgb8> picture(width, height);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const std::uint8_t* level = levels.data() + i * static_cast<std::size_t>(channels);
        picture.pixels()[i] = channels == 3 ? Rgb8{level[0], level[1], level[2]} : Rgb8{level[0], level[0], level[0]};
    }
    return picture;
}

void check_display(int width, int height, int channels, int bits) {
    if (bits != 8 || (channels != 1 && channels != 3))
        throw std::runtime_error(fmt::format("{} channels of {} bits", channels, bits));
    check_size(width, height, 3);
}

} // namespace

bool has_linear_picture(const Frame& frame) {
    return !frame.illuminance_lx.empty() || !frame.target_lx.empty() || !frame.luminance_cdm2.empty() || !frame.depth_m.empty();
}

void write_exr(const Frame& frame, const Moment& moment, const View& view, const std::filesystem::path& path) {
    const std::array<std::pair<const char*, const Image<float>*>, 4> possible{{{"illuminance.lx", &frame.illuminance_lx},
                                                                               {"target.lx", &frame.target_lx},
                                                                               {"luminance.cdm2", &frame.luminance_cdm2},
                                                                               {"depth.m", &frame.depth_m}}};
    std::vector<std::pair<std::string, const Image<float>*>> images;
    for (const auto& [name, image] : possible)
        if (!image->empty())
            images.emplace_back(name, image);
    write_images(images, moment, view, {}, path);
}

void write_channels(const std::vector<PictureChannel>& channels, const Moment& moment, const View& view,
                    const std::vector<std::pair<std::string, std::string>>& texts, const std::filesystem::path& path) {
    std::vector<std::pair<std::string, const Image<float>*>> images;
    for (const PictureChannel& channel : channels)
        images.emplace_back(channel.name, &channel.values);
    write_images(images, moment, view, texts, path);
}

void write_png(const Image<Rgb8>& picture, const std::filesystem::path& path) { write_png(picture, PictureTags{}, path); }

void write_png(const Image<Rgb8>& picture, const PictureTags& tags, const std::filesystem::path& path) {
    write_rgb({picture.width(), picture.height(), 8, picture.data()}, tags, path);
}

void write_png(const Image<glm::u16vec3>& codes, int bits, const PictureTags& tags, const std::filesystem::path& path) {
    if (bits == 16) {
        write_rgb({codes.width(), codes.height(), 16, codes.data()}, tags, path);
        return;
    }
    Image<Rgb8> picture(codes.width(), codes.height());
    std::ranges::transform(codes.pixels(), picture.data(), [](const glm::u16vec3& code) {
        return Rgb8{static_cast<std::uint8_t>(code.r), static_cast<std::uint8_t>(code.g), static_cast<std::uint8_t>(code.b)};
    });
    write_png(picture, tags, path);
}

PictureTags read_png_tags(const std::filesystem::path& path) {
    return read_bytes(path, "a PNG picture", [](const std::string& bytes) {
        PngHead head = decode_png_head(bytes);
        return PictureTags{std::move(head.texts[shown_by_key]), std::move(head.icc)};
    });
}

Image<Rgb8> read_png(const std::filesystem::path& path) {
    return read_bytes(path, "a PNG picture of 8 bits, grey or RGB", [](const std::string& bytes) {
        const PngPicture read =
            decode_png(bytes, [](const PngHead& head) { check_display(head.width, head.height, head.channels, head.bits); });
        return rgb_of(read.head.width, read.head.height, read.head.channels, read.bytes);
    });
}

std::vector<PictureChannel> read_exr(const std::filesystem::path& path) {
    return read_bytes(path, "an EXR picture", [](const std::string& bytes) {
        ExrPicture read = decode_exr(bytes, [](const ExrHead& head) {
            check_size(head.width, head.height, head.channels.size());
            return std::pair(std::size_t{0}, head.channels.size());
        });
        std::vector<PictureChannel> channels;
        for (std::size_t c = 0; c < read.channels.size(); ++c)
            channels.push_back({std::move(read.head.channels[c]), std::move(read.channels[c])});
        return channels;
    });
}

namespace {

constexpr std::size_t curve_points = 4096, date_at = 24, date_bytes = 12;
constexpr std::array<unsigned char, date_bytes> no_date{7, 208, 0, 1, 0, 1,
                                                        0, 0,   0, 0, 0, 0}; // 2000-01-01: bytes must not depend on the clock

cmsCIExyY chromaticity(const glm::dvec3& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    return {xyz.x / sum, xyz.y / sum, 1.0};
}

cmsToneCurve* curve_of(const DisplayProfile& display) {
    constexpr double srgb[] = {2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045};
    switch (display.transfer) {
    case TransferKind::linear:
        return cmsBuildGamma(nullptr, 1.0);
    case TransferKind::gamma:
        return cmsBuildGamma(nullptr, display.gamma);
    case TransferKind::srgb:
        return cmsBuildParametricToneCurve(nullptr, 4, srgb);
    case TransferKind::pq:
        break;
    }
    std::vector<cmsUInt16Number> table(curve_points);
    for (std::size_t i = 0; i < curve_points; ++i) {
        const double share = decoded(display, static_cast<double>(i) / (curve_points - 1));
        table[i] = static_cast<cmsUInt16Number>(std::floor(65535.0 * std::clamp(share, 0.0, 1.0) + 0.5));
    }
    return cmsBuildTabulatedToneCurve16(nullptr, curve_points, table.data());
}

} // namespace

std::string icc_profile(const DisplayProfile& display) {
    const cmsCIExyY white = chromaticity(display.xyz_from_rgb * glm::dvec3(1.0));
    const cmsCIExyYTRIPLE primaries{chromaticity(display.xyz_from_rgb[0]), chromaticity(display.xyz_from_rgb[1]),
                                    chromaticity(display.xyz_from_rgb[2])};
    const std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)> curve(curve_of(display), cmsFreeToneCurve);
    if (!curve)
        throw std::runtime_error("Little CMS cannot make a transfer curve");
    cmsToneCurve* const curves[3] = {curve.get(), curve.get(), curve.get()};
    const std::unique_ptr<void, int (*)(void*)> profile(cmsCreateRGBProfile(&white, &primaries, curves), cmsCloseProfile);
    if (!profile)
        throw std::runtime_error("Little CMS cannot make a profile of these primaries");
    const cmsCIEXYZ luminance{0.0, display.peak_cdm2(), 0.0};
    const std::unique_ptr<cmsMLU, void (*)(cmsMLU*)> title(cmsMLUalloc(nullptr, 1), cmsMLUfree);
    cmsMLUsetASCII(title.get(), "en", "US", display.title.c_str());
    cmsWriteTag(profile.get(), cmsSigLuminanceTag, &luminance);
    cmsWriteTag(profile.get(), cmsSigProfileDescriptionTag, title.get());
    cmsUInt32Number bytes = 0;
    std::string icc;
    if (cmsSaveProfileToMem(profile.get(), nullptr, &bytes) != 0) {
        icc.resize(bytes);
        if (cmsSaveProfileToMem(profile.get(), icc.data(), &bytes) == 0)
            bytes = 0;
    }
    if (bytes < date_at + date_bytes)
        throw std::runtime_error("Little CMS cannot write a profile");
    std::copy(no_date.begin(), no_date.end(), icc.begin() + date_at);
    return icc;
}

} // namespace fernlicht
