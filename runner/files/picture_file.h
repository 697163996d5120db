// Pictures on disk: EXR with linear, named channels and their units; PNG for eyes. The runner's one door to OpenImageIO.
// A display's profile as other programs read it.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/drives/play/frame.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

/// Whether write_exr has anything to write.
bool has_linear_picture(const Frame& frame);

/// Channels of the frame that are there, at least one, as 32-bit float: illuminance.lx, target.lx, luminance.cdm2, depth.m. Metadata carry
/// the moment (fernlicht:time_s ...), the car's pose and the view. Throws DeviceError with the path and the reason.
void write_exr(const Frame& frame, const Moment& moment, const View& view, const std::filesystem::path& path);

struct PictureChannel {
    std::string name;
    Image<float> values;
};
/// The same for any channels, at least one and all of the view's size, with lines of text for the metadata. Throws DeviceError.
void write_channels(const std::vector<PictureChannel>& channels, const Moment& moment, const View& view,
                    const std::vector<std::pair<std::string, std::string>>& texts, const std::filesystem::path& path);

/// What a picture says of itself.
struct PictureTags {
    std::string shown_by; ///< one line on tone mapper and display (display_pipeline.h); "": nothing is said
    std::string icc;      ///< the display's ICC profile; "": sRGB
};
/// 8-bit sRGB. Throws DeviceError.
void write_png(const Image<Rgb8>& picture, const std::filesystem::path& path);
void write_png(const Image<Rgb8>& picture, const PictureTags& tags, const std::filesystem::path& path);
/// Codes of 8 or 16 bits. Throws DeviceError.
void write_png(const Image<glm::u16vec3>& codes, int bits, const PictureTags& tags, const std::filesystem::path& path);

/// What a PNG says of itself. Throws InputError for what is no PNG.
PictureTags read_png_tags(const std::filesystem::path& path);

/// An 8-bit grey or RGB picture; grey becomes r = g = b. Throws InputError: missing, no PNG, cut short, other bits, with alpha, more than
/// 2^28 values.
Image<Rgb8> read_png(const std::filesystem::path& path);

/// All channels of an EXR file. Throws InputError: missing, no EXR, cut short, more than 2^28 values.
std::vector<PictureChannel> read_exr(const std::filesystem::path& path);

/// An ICC profile, version 4, of matrix and curves: the display's primaries, white, transfer curve (of pq up to its own peak) and peak
/// luminance. Black is not part of such profiles. Same profile, same bytes. Throws std::runtime_error where Little CMS cannot make one.
std::string icc_profile(const DisplayProfile& display);

} // namespace fernlicht
