#include "runner/files/picture_file.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/picture_decoding.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <array>
#include <lcms2.h>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace fernlicht {
namespace {

/// Writes beside `path` and renames into place, so that an interrupted run leaves no half picture under a good name.
void write_whole(const std::filesystem::path& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* pixels) {
    std::filesystem::path part = path;
    part.replace_extension(".part" + path.extension().string());
    const auto fail = [&](const std::string& reason) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw DeviceError(path.string() + ": cannot be written: " + reason);
    };
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path.string());
    if (!output)
        fail(OIIO::geterror());
    if (!output->open(part.string(), spec) || !output->write_image(type, pixels) || !output->close())
        fail(output->geterror());
    std::error_code error;
    std::filesystem::rename(part, path, error);
    if (error)
        fail(error.message());
}

void add_context(OIIO::ImageSpec& spec, const Moment& moment, const View& view) {
    spec.attribute("fernlicht:view", view.name);
    spec.attribute("fernlicht:tick", moment.tick);
    const auto number = [&](const char* name, double value) { spec.attribute(name, OIIO::TypeDesc::DOUBLE, &value); };
    number("fernlicht:time_s", moment.time_s);
    number("fernlicht:distance_m", moment.distance_m);
    number("fernlicht:speed_mps", moment.speed_mps);
    const std::array<double, 3> position{moment.ego.position_m.x, moment.ego.position_m.y, moment.ego.position_m.z};
    spec.attribute("fernlicht:ego_position_m", OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE, 3), position.data());
    const std::array<double, 3> forward{moment.ego.forward().x, moment.ego.forward().y, moment.ego.forward().z};
    spec.attribute("fernlicht:ego_forward", OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE, 3), forward.data());
    double near_field_m = 0.0; // pixels nearer to a lamp than this are near-field
    for (const LitLamp& lamp : moment.lamps)
        near_field_m = std::max(near_field_m, lamp.photometric_distance_m);
    number("fernlicht:near_field_below_m", near_field_m);
    if (view.projection == Projection::perspective)
        number("fernlicht:vertical_fov_deg", degrees(view.vertical_fov_rad));
}

constexpr const char* shown_by_key = "fernlicht:shown_by";

OIIO::ImageSpec png_spec(int width, int height, OIIO::TypeDesc type, const PictureTags& tags) {
    OIIO::ImageSpec spec(width, height, 3, type);
    if (tags.icc.empty())
        spec.attribute("oiio:ColorSpace", "sRGB");
    else
        spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(tags.icc.size())), tags.icc.data());
    if (!tags.shown_by.empty())
        spec.attribute(shown_by_key, tags.shown_by);
    spec.attribute("png:compressionLevel", 6);
    spec.attribute("png:filter",
                   0x08); // none, PNG_FILTER_NONE: nights compress better and three times as fast without (docs/decisions/0004)
    return spec;
}

void write_images(const std::vector<std::string>& names, const std::vector<const Image<float>*>& images, const Moment& moment,
                  const View& view, const std::vector<std::pair<std::string, std::string>>& texts, const std::filesystem::path& path) {
    OIIO::ImageSpec spec(view.width_px, view.height_px, static_cast<int>(images.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = names;
    spec.attribute("compression", "zip:1"); // docs/decisions/0004: the other levels take up to half as long again for 2 % fewer bytes
    spec.attribute("DateTime", "1970:01:01 00:00:00"); // else OpenImageIO writes the time of day, and no two runs are alike
    add_context(spec, moment, view);
    for (const auto& [name, text] : texts)
        spec.attribute(name, text);
    std::vector<float> pixels(images.size() * static_cast<std::size_t>(view.width_px) * static_cast<std::size_t>(view.height_px));
    for (std::size_t c = 0; c < images.size(); ++c)
        for (std::size_t i = 0; i < images[c]->size(); ++i)
            pixels[i * images.size() + c] = images[c]->pixels()[i];
    write_whole(path, spec, OIIO::TypeDesc::FLOAT, pixels.data());
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
    std::vector<const Image<float>*> images;
    std::vector<std::string> names;
    for (const auto& [name, image] : possible)
        if (!image->empty()) {
            names.emplace_back(name);
            images.push_back(image);
        }
    write_images(names, images, moment, view, {}, path);
}

void write_channels(const std::vector<PictureChannel>& channels, const Moment& moment, const View& view,
                    const std::vector<std::pair<std::string, std::string>>& texts, const std::filesystem::path& path) {
    std::vector<const Image<float>*> images;
    std::vector<std::string> names;
    for (const PictureChannel& channel : channels) {
        names.push_back(channel.name);
        images.push_back(&channel.values);
    }
    write_images(names, images, moment, view, texts, path);
}

void write_png(const Image<Rgb8>& picture, const std::filesystem::path& path) { write_png(picture, PictureTags{}, path); }

void write_png(const Image<Rgb8>& picture, const PictureTags& tags, const std::filesystem::path& path) {
    write_whole(path, png_spec(picture.width(), picture.height(), OIIO::TypeDesc::UINT8, tags), OIIO::TypeDesc::UINT8, picture.data());
}

void write_png(const Image<glm::u16vec3>& codes, int bits, const PictureTags& tags, const std::filesystem::path& path) {
    if (bits == 16) {
        write_whole(path, png_spec(codes.width(), codes.height(), OIIO::TypeDesc::UINT16, tags), OIIO::TypeDesc::UINT16, codes.data());
        return;
    }
    Image<Rgb8> picture(codes.width(), codes.height());
    std::ranges::transform(codes.pixels(), picture.data(), [](const glm::u16vec3& code) {
        return Rgb8{static_cast<std::uint8_t>(code.r), static_cast<std::uint8_t>(code.g), static_cast<std::uint8_t>(code.b)};
    });
    write_png(picture, tags, path);
}

PictureTags read_png_tags(const std::filesystem::path& path) {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
    if (!input || std::string_view(input->format_name()) != "png")
        throw InputError({path, 0, 0, {}}, "cannot be read: " + printable(input ? "no PNG" : OIIO::geterror(), 200), "a PNG picture");
    PictureTags tags{std::string(input->spec().get_string_attribute(shown_by_key)), {}};
    if (const OIIO::ParamValue* const icc = input->spec().find_attribute("ICCProfile"))
        tags.icc.assign(static_cast<const char*>(icc->data()), static_cast<std::size_t>(icc->datasize()));
    return tags;
}

Image<Rgb8> read_png(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& found) {
        throw InputError({path, 0, 0, {}}, "cannot be read: " + printable(found.substr(0, found.find('\n')), 200),
                         "a PNG picture of 8 bits, grey or RGB");
    };
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
    if (!input)
        refuse(OIIO::geterror());
    if (std::string_view(input->format_name()) != "png")
        refuse(std::string("is ") + input->format_name());
    const OIIO::ImageSpec spec = input->spec();
    if (spec.format != OIIO::TypeDesc::UINT8 || (spec.nchannels != 1 && spec.nchannels != 3))
        refuse(std::to_string(spec.nchannels) + " channels of " + spec.format.c_str());
    if (spec.width <= 0 || spec.height <= 0 || spec.image_pixels() > (OIIO::imagesize_t{1} << 28) / 3)
        refuse("it claims " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels");
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<std::uint8_t> levels(static_cast<std::size_t>(spec.image_pixels()) * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, levels.data()))
        refuse(input->geterror());
    Image<Rgb8> picture(spec.width, spec.height);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const std::uint8_t* level = levels.data() + i * channels;
        picture.pixels()[i] = channels == 3 ? Rgb8{level[0], level[1], level[2]} : Rgb8{level[0], level[0], level[0]};
    }
    return picture;
}

std::vector<PictureChannel> read_exr(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& found) {
        throw InputError({path, 0, 0, {}}, "cannot be read: " + printable(found, 200), "an EXR picture");
    };
    FilesRead opened;
    std::string bytes = read_file(path, opened, std::size_t{1} << 30, true);
    if (!has_whole_exr_header(bytes))
        refuse("it is no EXR, ends early or is damaged");
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec;
    if (!input || !input->set_ioproxy(&memory) || !input->open(path.string(), spec))
        refuse(input ? input->geterror() : OIIO::geterror());
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0 ||
        spec.image_pixels() * static_cast<OIIO::imagesize_t>(spec.nchannels) > (OIIO::imagesize_t{1} << 28))
        refuse("it claims " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels of " +
               std::to_string(spec.nchannels) + " channels");
    const auto count = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> pixels(static_cast<std::size_t>(spec.image_pixels()) * count);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
        refuse(input->geterror());
    std::vector<PictureChannel> channels;
    for (std::size_t c = 0; c < count; ++c) {
        PictureChannel channel{spec.channel_name(static_cast<int>(c)), Image<float>(spec.width, spec.height)};
        for (std::size_t i = 0; i < channel.values.size(); ++i)
            channel.values.pixels()[i] = pixels[i * count + c];
        channels.push_back(std::move(channel));
    }
    return channels;
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
        table[i] = static_cast<cmsUInt16Number>(65535.0 * std::clamp(share, 0.0, 1.0) + 0.5);
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
