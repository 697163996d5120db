#include "scenarios/values/exr_file.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <stdexcept>
#include <strings.h>
#include <thread>
#include <tuple>

namespace fernlicht {
namespace {

/// What a part's header says of the memory that it takes.
struct ExrPart {
    std::int64_t width = 0, height = 0, tile_width = 0, tile_height = 0, pixel_bytes = 0;
    unsigned compression = 0;
    bool is_tiled = false, is_deep = false, is_known = false;
};

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i > 0; --i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
    return value;
}

/// Pixel types of a channel list: each a name, a zero, the type and 12 more bytes.
std::int64_t bytes_of_channels(std::string_view list) {
    std::int64_t bytes = 0;
    while (!list.empty() && list[0] != '\0') {
        const std::size_t end = list.find('\0');
        if (end == std::string_view::npos || list.size() - end < 17)
            break; // OpenEXR says what is wrong
        bytes += little_endian(list, end + 1) == 1 ? 2 : 4;
        list.remove_prefix(end + 17);
    }
    return bytes;
}

void take(ExrPart& part, std::string_view name, std::string_view value) {
    const auto number = [&](std::size_t at) { return static_cast<std::int64_t>(static_cast<std::int32_t>(little_endian(value, at))); };
    if (name == "dataWindow" && value.size() == 16) {
        part.width = number(8) - number(0) + 1;
        part.height = number(12) - number(4) + 1;
    } else if (name == "tiles" && value.size() == 9) {
        part.tile_width = little_endian(value, 0);
        part.tile_height = little_endian(value, 4);
    } else if (name == "compression" && value.size() == 1) {
        part.compression = static_cast<unsigned char>(value[0]);
    } else if (name == "channels") {
        part.pixel_bytes = bytes_of_channels(value);
    } else if (name == "type") {
        part.is_tiled = value == "tiledimage" || value == "deeptile";
        part.is_deep = value == "deepscanline" || value == "deeptile";
        part.is_known = part.is_tiled || part.is_deep || value == "scanlineimage";
    }
}

/// A part: attributes, each with name, zero, type, zero, size and value, up to an empty name. Nothing where one is longer than the file.
std::optional<std::vector<ExrPart>> parts_of(std::string_view bytes) {
    constexpr std::size_t magic_and_version = 8;
    constexpr std::uint32_t magic = 20000630, tiled = 0x200, deep = 0x800, several_parts = 0x1000;
    if (bytes.size() < magic_and_version || little_endian(bytes, 0) != magic)
        return {};
    const std::uint32_t version = little_endian(bytes, 4);
    std::vector<ExrPart> parts;
    std::size_t at = magic_and_version;
    do {
        ExrPart part;
        for (std::size_t end = bytes.find('\0', at); end != at; end = bytes.find('\0', at)) {
            if (end == std::string_view::npos)
                return {};
            const std::string_view name = bytes.substr(at, end - at);
            end = bytes.find('\0', end + 1);
            if (end == std::string_view::npos || bytes.size() - end < 5)
                return {};
            at = end + 5;
            const std::uint32_t size = little_endian(bytes, end + 1);
            if (size > bytes.size() - at)
                return {};
            take(part, name, bytes.substr(at, size));
            at += size;
        }
        ++at;
        if ((version & several_parts) == 0) { // its type may lack or be wrong
            part.is_tiled = (version & tiled) != 0;
            part.is_deep = (version & deep) != 0;
            part.is_known = true;
        }
        parts.push_back(part);
    } while ((version & several_parts) != 0 && at < bytes.size() && bytes[at] != '\0');
    return parts;
}

std::int64_t lines_of_chunk(unsigned compression) {
    constexpr std::int64_t lines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256}; // in the order of OpenEXR's Compression
    return compression < std::size(lines) ? lines[compression] : 1;
}

std::int64_t parts_in(std::int64_t whole, std::int64_t part) { return (whole - 1) / part + 1; }

class InMemory : public Imf::IStream {
  public:
    explicit InMemory(std::string_view bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char to[], int count) override {
        if (count < 0 || at_ > bytes_.size() || bytes_.size() - at_ < static_cast<std::size_t>(count))
            throw Iex::InputExc("it ends early");
        std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
        at_ += static_cast<std::size_t>(count);
        return true;
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t to) override { at_ = to; }

  private:
    std::string_view bytes_;
    std::uint64_t at_ = 0;
};

class IntoMemory : public Imf::OStream {
  public:
    explicit IntoMemory(std::string& bytes) : OStream("memory"), bytes_(bytes) {}
    void write(const char from[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        bytes_.resize(std::max(bytes_.size(), at_ + size));
        std::memcpy(bytes_.data() + at_, from, size);
        at_ += size;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t to) override { at_ = to; }

  private:
    std::string& bytes_;
    std::uint64_t at_ = 0;
};

void use_all_threads() {
    static const bool done = (Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency())), true);
    static_cast<void>(done);
}

/// A channel's name in two, and its place among those of its layer: colours first. In a layer with x and y, or x and z, these are no
/// colours.
struct ChannelName {
    std::string whole, layer, end;
    std::size_t place = 0;
};

bool same_letters(const std::string& a, const char* b) { return ::strcasecmp(a.c_str(), b) == 0; }

std::vector<std::string> ordered(const Imf::ChannelList& list) {
    static constexpr const char *colours[] = {"R",     "Red", "G",  "Green", "B",  "Blue", "Y",  "real", "imag",  "A",
                                              "Alpha", "AR",  "RA", "AG",    "GA", "AB",   "BA", "Z",    "Depth", "Zback"},
                                *places[] = {"R", "Red",   "G",  "Green", "B",  "Blue", "X",  "Y",  "Z",     "real", "imag",
                                             "A", "Alpha", "AR", "RA",    "AG", "GA",   "AB", "BA", "Depth", "Zback"};
    std::vector<ChannelName> names;
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
        const std::string whole = channel.name();
        const std::size_t cut = whole.rfind('.') + 1; // 0 without a point
        names.push_back({whole, whole.substr(0, cut), whole.substr(cut)});
    }
    for (ChannelName& name : names) {
        const auto layer_has = [&](const char* end) {
            return std::ranges::any_of(names, [&](const ChannelName& n) { return n.layer == name.layer && same_letters(n.end, end); });
        };
        const auto same = [&](const char* other) { return same_letters(name.end, other); };
        name.place = layer_has("X") && (layer_has("Y") || layer_has("Z"))
                         ? static_cast<std::size_t>(std::ranges::find_if(places, same) - std::begin(places))
                         : static_cast<std::size_t>(std::ranges::find_if(colours, same) - std::begin(colours));
    }
    std::ranges::sort(names, {}, [](const ChannelName& n) { return std::tie(n.layer, n.place, n.end); });
    std::vector<std::string> out;
    for (ChannelName& name : names)
        out.push_back(std::move(name.whole));
    return out;
}

ExrHead head_of(const Imf::Header& header) {
    const Imath::Box2i window = header.dataWindow();
    ExrHead head{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, ordered(header.channels()), {}, {}};
    static constexpr const char* types[] = {"uint", "half", "float"};
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw std::runtime_error(fmt::format("channel {} has fewer pixels than the picture", channel.name()));
        const char* type = types[channel.channel().type];
        head.pixel_type = head.pixel_type.empty() || head.pixel_type == type ? type : "float";
    }
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()); text && !text->value().empty())
            head.texts.emplace(attribute.name(), text->value());
    return head;
}

/// A slice whose pixel 0, 0 is where the window's origin wants it.
template <class T> Imf::Slice slice_of(Imf::PixelType type, T* pixels, const Imath::Box2i& window, int width) {
    return Imf::Slice::Make(type, pixels, Imath::V2i(window.min.x, window.min.y), width, window.max.y - window.min.y + 1, sizeof(T),
                            sizeof(T) * static_cast<std::size_t>(width));
}

} // namespace

std::string why_no_exr(std::string_view bytes) {
    const std::optional<std::vector<ExrPart>> parts = parts_of(bytes);
    if (!parts)
        return "it is no EXR, ends early or is damaged";
    constexpr std::int64_t max_side = std::int64_t{1} << 30, max_block = std::int64_t{1} << 27;
    constexpr std::int64_t offset_bytes = 8, best_zip = 1100; // zip's tokens are 1032 times shorter at best
    const auto file_bytes = static_cast<std::int64_t>(bytes.size());
    std::int64_t chunks = 0;
    for (const ExrPart& part : *parts) {
        const std::string size = fmt::format("{} x {} pixels of {} bytes", part.width, part.height, part.pixel_bytes);
        if (part.width < 1 || part.height < 1 || part.width > max_side || part.height > max_side || part.pixel_bytes > max_block)
            return "it claims " + size;
        if (!part.is_known)
            return "a part is neither scan lines nor tiles";
        if (part.is_tiled && (part.tile_width < 1 || part.tile_height < 1))
            return "its tiles have no size";
        const std::int64_t width = part.is_tiled ? part.tile_width : part.width,
                           height = part.is_tiled ? part.tile_height : lines_of_chunk(part.compression);
        if (width > max_block / height / std::max<std::int64_t>(1, part.pixel_bytes))
            return fmt::format("it claims blocks of {} x {} pixels of {} bytes", width, height, part.pixel_bytes);
        chunks += parts_in(part.width, width) * parts_in(part.height, height); // at most 2^60 each, and more than the file holds ends this
        if (chunks > file_bytes / offset_bytes)
            return fmt::format("it claims {} in a file of {} bytes", size, bytes.size());
        const bool in_bytes = part.compression <= Imf::ZIP_COMPRESSION && !part.is_deep;
        if (in_bytes && part.width * part.height / best_zip > file_bytes / std::max<std::int64_t>(1, part.pixel_bytes))
            return fmt::format("it claims {} in a file of {} bytes", size, bytes.size());
    }
    return parts->front().is_deep ? "its pixels are deep" : "";
}

ExrPicture decode_exr(std::string_view bytes, const ChooseChannels& choose) {
    if (const std::string why = why_no_exr(bytes); !why.empty())
        throw std::runtime_error(why);
    use_all_threads();
    InMemory stream(bytes);
    Imf::MultiPartInputFile file(stream);
    Imf::InputPart part(file, 0);
    ExrPicture picture{head_of(part.header()), {}};
    const auto [first, count] = choose(picture.head);
    const Imath::Box2i window = part.header().dataWindow();
    Imf::FrameBuffer frame;
    std::map<std::size_t, std::vector<std::uint32_t>> whole_numbers;
    picture.channels.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& name = picture.head.channels.at(first + i);
        Image<float>& values = picture.channels.emplace_back(picture.head.width, picture.head.height);
        if (part.header().channels()[name].type != Imf::UINT)
            frame.insert(name, slice_of(Imf::FLOAT, values.data(), window, picture.head.width));
        else
            frame.insert(name, slice_of(Imf::UINT, (whole_numbers[i] = std::vector<std::uint32_t>(values.size())).data(), window,
                                        picture.head.width));
    }
    part.setFrameBuffer(frame);
    part.readPixels(window.min.y, window.max.y);
    for (const auto& [i, numbers] : whole_numbers)
        std::ranges::transform(numbers, picture.channels[i].data(), [](std::uint32_t number) {
            return static_cast<float>(number) * (1.0F / static_cast<float>(std::numeric_limits<std::uint32_t>::max()));
        });
    return picture;
}

std::string encode_exr(const std::vector<std::pair<std::string, const Image<float>*>>& channels,
                       const std::map<std::string, ExrAttribute>& attributes, int zip_level) {
    use_all_threads();
    const int width = channels.at(0).second->width(), height = channels.at(0).second->height();
    Imf::Header header(width, height, 1.0F, Imath::V2f(0.0F, 0.0F), 1.0F, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
    header.zipCompressionLevel() = zip_level;
    Imf::FrameBuffer frame;
    for (const auto& [name, image] : channels) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        frame.insert(name, slice_of(Imf::FLOAT, image->data(), header.dataWindow(), width));
    }
    for (const auto& [name, value] : attributes) {
        if (const auto* text = std::get_if<std::string>(&value))
            header.insert(name, Imf::StringAttribute(*text));
        else if (const auto* whole = std::get_if<int>(&value))
            header.insert(name, Imf::IntAttribute(*whole));
        else if (const auto* number = std::get_if<double>(&value))
            header.insert(name, Imf::DoubleAttribute(*number));
        else if (const auto* point = std::get_if<glm::dvec3>(&value))
            header.insert(name, Imf::V3dAttribute(Imath::V3d(point->x, point->y, point->z)));
    }
    std::string bytes;
    IntoMemory stream(bytes);
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writePixels(height);
    } // writes the table of chunks
    return bytes;
}

} // namespace fernlicht
