#include "scenarios/values/jpeg_file.h"

#include <array>
#include <cmath>
#include <cstdio> // jpeglib.h wants FILE
#include <cstdlib>

#include <jpeglib.h>
#include <stdexcept>

namespace fernlicht {
namespace {

/// Some ten are usual; each takes as long as the whole picture.
constexpr int max_scans = 500;

/// Errors are thrown, warnings passed over.
void throw_errors(jpeg_error_mgr& errors) {
    jpeg_std_error(&errors);
    errors.error_exit = [](j_common_ptr jpeg) {
        std::array<char, JMSG_LENGTH_MAX> why{};
        jpeg->err->format_message(jpeg, why.data());
        throw std::runtime_error(why.data());
    };
    errors.output_message = [](j_common_ptr) {};
}

class JpegReader {
  public:
    explicit JpegReader(std::string_view bytes) {
        throw_errors(errors_);
        jpeg_.err = &errors_;
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
                    row[i / 4 * 3 + c] = static_cast<std::uint8_t>(std::floor(light * 255.0F + 0.5F));
                }
        }
    }

  private:
    jpeg_error_mgr errors_{};
    jpeg_progress_mgr progress_{};
    jpeg_decompress_struct jpeg_{};
    bool is_cmyk_ = false;
};

class JpegWriter {
  public:
    JpegWriter() {
        throw_errors(errors_);
        jpeg_.err = &errors_;
        jpeg_create_compress(&jpeg_);
        jpeg_mem_dest(&jpeg_, &bytes_, &size_);
    }
    JpegWriter(const JpegWriter&) = delete;
    JpegWriter& operator=(const JpegWriter&) = delete;
    ~JpegWriter() {
        jpeg_destroy_compress(&jpeg_);
        std::free(bytes_); // libjpeg's own, by malloc
    }

    std::string write(const JpegPicture& picture, int quality) {
        jpeg_.image_width = static_cast<JDIMENSION>(picture.width);
        jpeg_.image_height = static_cast<JDIMENSION>(picture.height);
        jpeg_.input_components = 3;
        jpeg_.in_color_space = JCS_RGB;
        jpeg_set_defaults(&jpeg_);
        jpeg_set_quality(&jpeg_, quality, TRUE);
        jpeg_.comp_info[0].h_samp_factor = jpeg_.comp_info[0].v_samp_factor = 1;
        jpeg_.optimize_coding = TRUE;
        jpeg_.dct_method = JDCT_ISLOW;
        jpeg_start_compress(&jpeg_, TRUE);
        while (jpeg_.next_scanline < jpeg_.image_height) {
            JSAMPROW row =
                const_cast<JSAMPROW>(picture.bytes.data()) + std::size_t{jpeg_.next_scanline} * std::size_t{jpeg_.image_width} * 3;
            jpeg_write_scanlines(&jpeg_, &row, 1);
        }
        jpeg_finish_compress(&jpeg_);
        return {reinterpret_cast<const char*>(bytes_), size_};
    }

  private:
    jpeg_error_mgr errors_{};
    jpeg_compress_struct jpeg_{};
    unsigned char* bytes_ = nullptr;
    unsigned long size_ = 0;
};

} // namespace

std::string encode_jpeg(const JpegPicture& picture, int quality) { return JpegWriter().write(picture, quality); }

JpegPicture decode_jpeg(std::string_view bytes, const std::function<void(const JpegPicture&)>& check) {
    JpegReader reader(bytes);
    JpegPicture picture = reader.head();
    check(picture);
    reader.read(picture);
    return picture;
}

} // namespace fernlicht
