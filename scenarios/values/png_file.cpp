#include "scenarios/values/png_file.h"

#include <algorithm>
#include <bit>
#include <png.h>
#include <stdexcept>

namespace fernlicht {
namespace {

[[noreturn]] void throw_reason(png_structp, png_const_charp why) { throw std::runtime_error(why); }
void pass_over(png_structp, png_const_charp) {}

constexpr const char* ends_early = "it ends early";

/// Else libpng takes as much memory as a chunk claims to hold before it reads any of it.
void refuse_chunks_beyond(std::string_view bytes) {
    constexpr std::size_t head_bytes = 8, sum_bytes = 4;
    for (bytes.remove_prefix(head_bytes); bytes.size() >= head_bytes && bytes.substr(4, 4) != "IEND";) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8U | static_cast<unsigned char>(bytes[i]);
        if (length > bytes.size() - head_bytes)
            throw std::runtime_error(ends_early);
        bytes.remove_prefix(std::min(bytes.size(), head_bytes + length + sum_bytes));
    }
}

class PngReader {
  public:
    explicit PngReader(std::string_view bytes) : left_(bytes) {
        if (!bytes.starts_with("\x89PNG\r\n\x1a\n"))
            throw std::runtime_error("it is no PNG");
        refuse_chunks_beyond(bytes);
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, throw_reason, pass_over);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_)
            throw std::runtime_error("no memory");
        png_set_chunk_malloc_max(png_, 4U << 20U); // texts and profiles inflate before sizes are checked
        png_set_chunk_cache_max(png_, 64);
        png_set_read_fn(png_, this, [](png_structp png, png_bytep to, std::size_t count) {
            std::string_view& left = static_cast<PngReader*>(png_get_io_ptr(png))->left_;
            if (count > left.size())
                png_error(png, ends_early);
            std::copy_n(left.data(), count, reinterpret_cast<char*>(to));
            left.remove_prefix(count);
        });
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    PngHead head() {
        png_read_info(png_, info_);
        png_set_expand(png_); // to 8 bits, colours and alpha
        if constexpr (std::endian::native == std::endian::little)
            png_set_swap(png_);
        png_read_update_info(png_, info_);
        PngHead head{static_cast<int>(png_get_image_width(png_, info_)),
                     static_cast<int>(png_get_image_height(png_, info_)),
                     png_get_channels(png_, info_),
                     png_get_bit_depth(png_, info_),
                     {},
                     {}};
        png_textp texts = nullptr;
        const int count = png_get_text(png_, info_, &texts, nullptr);
        for (int i = 0; i < count; ++i)
            head.texts.insert_or_assign(texts[i].key, texts[i].text);
        png_charp name = nullptr;
        png_bytep profile = nullptr;
        png_uint_32 length = 0;
        int compression = 0;
        if (png_get_iCCP(png_, info_, &name, &compression, &profile, &length) != 0)
            head.icc.assign(reinterpret_cast<const char*>(profile), length);
        return head;
    }

    std::vector<std::uint8_t> pixels() {
        const std::size_t row_bytes = png_get_rowbytes(png_, info_);
        std::vector<std::uint8_t> out(row_bytes * png_get_image_height(png_, info_));
        std::vector<png_bytep> rows;
        for (std::size_t at = 0; at < out.size(); at += row_bytes)
            rows.push_back(out.data() + at);
        png_read_image(png_, rows.data());
        return out;
    }

  private:
    std::string_view left_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

class PngWriter {
  public:
    PngWriter() {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, throw_reason, pass_over);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_)
            throw std::runtime_error("no memory");
        png_set_write_fn(
            png_, &bytes_,
            [](png_structp png, png_bytep data, std::size_t length) {
                static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), length);
            },
            nullptr);
    }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }

    void say_what_it_is(const std::string& icc, const std::vector<std::pair<std::string, std::string>>& texts) {
        png_set_oFFs(png_, info_, 0, 0, PNG_OFFSET_PIXEL);
        if (icc.empty())
            png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_ABSOLUTE);
        else
            png_set_iCCP(png_, info_, "Embedded Profile", PNG_COMPRESSION_TYPE_BASE, reinterpret_cast<png_const_bytep>(icc.data()),
                         static_cast<png_uint_32>(icc.size()));
        for (const auto& [key, value] : texts) {
            png_text text{};
            text.compression = PNG_TEXT_COMPRESSION_NONE;
            text.key = const_cast<char*>(key.c_str()); // both are only read from
            text.text = const_cast<char*>(value.c_str());
            png_set_text(png_, info_, &text, 1);
        }
    }

    void size(const PngPixels& pixels, int zlib_level) {
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(pixels.width), static_cast<png_uint_32>(pixels.height), pixels.bits,
                     PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_option(png_, PNG_SKIP_sRGB_CHECK_PROFILE, PNG_OPTION_ON); // a display's profile is its own
        png_set_filter(png_, 0, PNG_FILTER_NONE);
        png_set_compression_level(png_, zlib_level);
    }

    std::string write(const PngPixels& pixels) {
        png_write_info(png_, info_);
        if (std::endian::native == std::endian::little && pixels.bits == 16)
            png_set_swap(png_);
        const std::size_t row_bytes = static_cast<std::size_t>(pixels.width) * 3 * static_cast<std::size_t>(pixels.bits) / 8;
        for (int y = 0; y < pixels.height; ++y)
            png_write_row(png_, static_cast<png_const_bytep>(pixels.rgb) + static_cast<std::size_t>(y) * row_bytes);
        png_write_end(png_, info_);
        return std::move(bytes_);
    }

  private:
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::string bytes_;
};

} // namespace

bool is_whole_png(std::string_view bytes) {
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

PngHead decode_png_head(std::string_view bytes) { return PngReader(bytes).head(); }

PngPicture decode_png(std::string_view bytes, const std::function<void(const PngHead&)>& check) {
    PngReader reader(bytes);
    PngPicture picture{reader.head(), {}};
    check(picture.head);
    picture.bytes = reader.pixels();
    return picture;
}

std::string encode_png(const PngPixels& pixels, int zlib_level) {
    PngWriter writer;
    writer.size(pixels, zlib_level);
    return writer.write(pixels);
}

std::string encode_png(const PngPixels& pixels, int zlib_level, const std::string& icc,
                       const std::vector<std::pair<std::string, std::string>>& texts) {
    PngWriter writer;
    writer.size(pixels, zlib_level);
    writer.say_what_it_is(icc, texts);
    return writer.write(pixels);
}

} // namespace fernlicht
