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
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <strings.h>
#include <thread>
#include <tuple>

namespace fernlicht {
namespace {

constexpr std::size_t magic_and_version = 8;
constexpr std::uint32_t magic = 20000630, tiled = 0x200, not_flat = 0x800, several_parts = 0x1000; // bits of the version

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i > 0; --i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
    return value;
}

/// Whether an attribute ends where OpenEXR ends reading it: of most types it reads what they take, whatever the file says.
bool has_its_size(std::string_view type, std::string_view value) {
    static const std::map<std::string_view, std::size_t> sizes{{"box2i", 16},
                                                               {"box2f", 16},
                                                               {"chromaticities", 32},
                                                               {"compression", 1},
                                                               {"deepImageState", 1},
                                                               {"double", 8},
                                                               {"envmap", 1},
                                                               {"float", 4},
                                                               {"int", 4},
                                                               {"keycode", 28},
                                                               {"lineOrder", 1},
                                                               {"m33f", 36},
                                                               {"m33d", 72},
                                                               {"m44f", 64},
                                                               {"m44d", 128},
                                                               {"rational", 8},
                                                               {"tiledesc", 9},
                                                               {"timecode", 8},
                                                               {"v2i", 8},
                                                               {"v2f", 8},
                                                               {"v2d", 16},
                                                               {"v3i", 12},
                                                               {"v3f", 12},
                                                               {"v3d", 24}};
    if (const auto found = sizes.find(type); found != sizes.end())
        return value.size() == found->second;
    if (type == "chlist") { // channels, each a name, a zero and 16 bytes, and a zero
        for (std::size_t end = value.find('\0'); end != 0; end = value.find('\0')) {
            if (end == std::string_view::npos || value.size() - end < 17)
                return false;
            value.remove_prefix(end + 17);
        }
        return value.size() == 1;
    }
    if (type == "stringvector") {
        while (value.size() >= 4 && little_endian(value, 0) <= value.size() - 4)
            value.remove_prefix(4 + little_endian(value, 0));
        return value.empty();
    }
    return type == "floatvector" ? value.size() % 4 == 0 : type != "idmanifest";
}

/// Parts of attributes, each with name, zero, type, zero, size and value, up to an empty name.
bool has_whole_headers(std::string_view bytes) {
    if (bytes.size() < magic_and_version || little_endian(bytes, 0) != magic)
        return false;
    const bool several = (little_endian(bytes, 4) & several_parts) != 0;
    std::size_t at = magic_and_version;
    do {
        for (std::size_t end = bytes.find('\0', at); end != at; end = bytes.find('\0', at)) {
            const std::size_t type = end == std::string_view::npos ? end : end + 1;
            end = type == std::string_view::npos ? type : bytes.find('\0', type);
            if (end == std::string_view::npos || bytes.size() - end < 5)
                return false;
            at = end + 5;
            const std::uint32_t size = little_endian(bytes, end + 1);
            if (size > bytes.size() - at || !has_its_size(bytes.substr(type, end - type), bytes.substr(at, size)))
                return false;
            at += size;
        }
        ++at;
    } while (several && at < bytes.size() && bytes[at] != '\0');
    return true;
}

std::int64_t lines_of_chunk(Imf::Compression compression) {
    constexpr std::int64_t lines[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return static_cast<std::size_t>(compression) < std::size(lines) ? lines[compression] : 1;
}

std::int64_t bytes_of_pixel(const Imf::ChannelList& channels) {
    std::int64_t bytes = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        bytes += channel.channel().type == Imf::HALF ? 2 : 4;
    return bytes;
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

/// As OpenEXR takes them.
std::vector<Imf::Header> headers_of(std::string_view bytes) {
    auto version = static_cast<int>(little_endian(bytes, 4));
    const auto has = [version](std::uint32_t bit) { return (static_cast<std::uint32_t>(version) & bit) != 0; };
    InMemory stream(bytes);
    stream.seekg(magic_and_version);
    std::vector<Imf::Header> headers;
    do {
        Imf::Header header;
        header.readFrom(stream, version);
        if (header.readsNothing())
            break;
        if (!has(several_parts) && !has(not_flat)) // a part's own word may be wrong
            header.setType(has(tiled) ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
        if (!header.hasType() || !Imf::isSupportedType(header.type()) || (headers.empty() && Imf::isDeepData(header.type())))
            throw std::runtime_error("its pixels are neither scan lines nor tiles");
        headers.push_back(std::move(header));
    } while (has(several_parts));
    if (headers.empty())
        throw std::runtime_error("it has no picture");
    return headers;
}

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
    const Imath::Box2i& window = header.dataWindow();
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

void check_exr_headers(std::string_view bytes) {
    if (!has_whole_headers(bytes))
        throw std::runtime_error("it is no EXR, ends early or is damaged");
    constexpr std::int64_t max_side = std::int64_t{1} << 30, max_block = std::int64_t{1} << 27;
    constexpr std::int64_t offset_bytes = 8, most_shortened = 1400; // pxr24: zip's 1032 of three bytes in four
    const auto file_bytes = static_cast<std::int64_t>(bytes.size());
    std::int64_t chunks = 0;
    for (const Imf::Header& header : headers_of(bytes)) {
        const Imath::Box2i window = header.dataWindow();
        const std::int64_t columns = std::int64_t{window.max.x} - window.min.x + 1, rows = std::int64_t{window.max.y} - window.min.y + 1;
        const std::int64_t pixel_bytes = bytes_of_pixel(header.channels());
        const std::string size = fmt::format("{} x {} pixels of {} bytes", columns, rows, pixel_bytes);
        if (columns < 1 || rows < 1 || columns > max_side || rows > max_side || pixel_bytes < 1 || pixel_bytes > max_block)
            throw std::runtime_error("it claims " + size);
        std::int64_t block_columns = columns, block_rows = lines_of_chunk(header.compression());
        if (Imf::isTiled(header.type())) {
            block_columns = header.hasTileDescription() ? header.tileDescription().xSize : 0;
            block_rows = header.hasTileDescription() ? header.tileDescription().ySize : 0;
        }
        if (block_columns < 1 || block_rows < 1 || block_columns > max_block / block_rows / pixel_bytes)
            throw std::runtime_error(fmt::format("it claims blocks of {} x {} pixels of {} bytes", block_columns, block_rows, pixel_bytes));
        chunks += parts_in(columns, block_columns) * parts_in(rows, block_rows); // of 2^60 at most, and few of them go on
        if (chunks > file_bytes / offset_bytes || (!Imf::isDeepData(header.type()) && header.compression() < Imf::DWAA_COMPRESSION &&
                                                   columns * rows / most_shortened > file_bytes / pixel_bytes))
            throw std::runtime_error(fmt::format("it claims {} in a file of {} bytes", size, bytes.size()));
    }
}

ExrPicture decode_exr(std::string_view bytes, const ChooseChannels& choose) {
    check_exr_headers(bytes);
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
