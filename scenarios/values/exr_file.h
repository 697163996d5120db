// OpenEXR in memory. Headers are held against the length of the file before OpenEXR takes memory for what they claim.
#pragma once

#include "scenarios/values/image.h"

#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace fernlicht {

/// Of the first part, which is the picture.
struct ExrHead {
    int width = 0, height = 0;
    std::vector<std::string> channels;        ///< by layer, then colours, alpha and depth, then by name
    std::string pixel_type;                   ///< "half", "float" or "uint"; "float" where channels differ
    std::map<std::string, std::string> texts; ///< attributes that are text and not empty
};

struct ExrPicture {
    ExrHead head;
    std::vector<Image<float>> channels; ///< those chosen, in order; whole numbers as parts of 2^32 - 1
};

/// From the first channel on so many; throws what is to come out where the picture is not wanted.
using ChooseChannels = std::function<std::pair<std::size_t, std::size_t>(const ExrHead&)>;

/// `choose` sees the head before there is memory for pixels. Throws std::runtime_error with a reason for what is no EXR, is cut short or
/// damaged, is deep or has channels of fewer pixels.
ExrPicture decode_exr(std::string_view bytes, const ChooseChannels& choose);

/// Throws std::runtime_error where headers ask for more than the file can hold. OpenEXR 3.1 takes the memory that a header asks for before
/// it reads what should fill it.
void check_exr_headers(std::string_view bytes);

using ExrAttribute = std::variant<std::string, int, double, glm::dvec3>;
/// 32-bit float in scan lines, zip at a level of 1 to 9. Throws std::runtime_error where the library cannot.
std::string encode_exr(const std::vector<std::pair<std::string, const Image<float>*>>& channels,
                       const std::map<std::string, ExrAttribute>& attributes, int zip_level);

} // namespace fernlicht
