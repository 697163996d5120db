#include "scenarios/values/jpeg_file.h"

#include <array>
#include <cstdio> // jpeglib.h wants FILE

#include <jpeglib.h>
#include <stdexcept>

namespace fernlicht {
namespace {

/// Some ten are usual; each takes as long as the whole picture.
constexpr int max_scans = 500;

class JpegReader {
  public:
    explicit JpegReader(std::string_view bytes) {
        jpeg_.err = jpeg_std_error(&errors_);
        errors_.error_exit = [](j_common_ptr jpeg) {
            std::array<char, JMSG_LENGTH_MAX> why{};
            jpeg->err->format_message(jpeg, why.data());
            throw std::runtime_error(why.data());
        };
        errors_.output_message = [](j_common_ptr) {};
        jpeg_create_decompress(&jpeg_);
        progress_.progress_monitor = [](j_common_ptr jpeg) {
            if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > max_scans)
                throw std::runtime_error("it has more scans than any camera writes");
        };
        jpeg_.progress = &progress_;
        jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<unsigned long>(bytes.size()));
    }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }

    JpegPicture head() {
        jpeg_read_header(&jpeg_, TRUE);
        is_cmyk_ = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
        if (is_cmyk_)
            jpeg_.out_color_space = JCS_CMYK;
        return {static_cast<int>(jpeg_.image_width), static_cast<int>(jpeg_.image_height), is_cmyk_ ? 3 : jpeg_.num_components, {}};
    }

    void read(JpegPicture& picture) {
        jpeg_start_decompress(&jpeg_);
        const auto width = static_cast<std::size_t>(picture.width), channels = static_cast<std::size_t>(picture.channels);
        if (static_cast<int>(jpeg_.output_width) != picture.width || jpeg_.output_components != (is_cmyk_ ? 4 : picture.channels))
            throw std::runtime_error("its head says otherwise");
        picture.bytes.resize(width * channels * static_cast<std::size_t>(picture.height));
        std::vector<std::uint8_t> cmyk(is_cmyk_ ? width * 4 : 0);
        for (std::uint8_t* row = picture.bytes.data(); jpeg_.output_scanline < jpeg_.output_height; row += width * channels) {
            JSAMPROW into = is_cmyk_ ? cmyk.data() : row;
            jpeg_read_scanlines(&jpeg_, &into, 1);
            // Stored as what is left of the light.
            for (std::size_t i = 0; i < cmyk.size(); i += 4)
                for (std::size_t c = 0; c < 3; ++c) {
                    constexpr float scale = 1.0F / 255.0F;
                    const float light = static_cast<float>(cmyk[i + c]) * scale * (static_cast<float>(cmyk[i + 3]) * scale);
                    row[i / 4 * 3 + c] = static_cast<std::uint8_t>(light * 255.0F + 0.5F);
                }
        }
    }

  private:
    jpeg_error_mgr errors_{};
    jpeg_progress_mgr progress_{};
    jpeg_decompress_struct jpeg_{};
    bool is_cmyk_ = false;
};

} // namespace

JpegPicture decode_jpeg(std::string_view bytes, const std::function<void(const JpegPicture&)>& check) {
    JpegReader reader(bytes);
    JpegPicture picture = reader.head();
    check(picture);
    reader.read(picture);
    return picture;
}

} // namespace fernlicht
