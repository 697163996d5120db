// fernlicht-openimageio.so: pictures in OpenImageIO's formats. It alone is linked with the library, which brings some 200 others.
#include "runner/files/other_picture.h"

#include <OpenImageIO/imageio.h>
#include <stdexcept>

namespace fernlicht {

extern "C" __attribute__((visibility("default"))) void fernlicht_read_with_openimageio(const std::filesystem::path& path,
                                                                                       std::size_t max_values, OtherPicture& picture) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string(), &config);
    if (!input)
        throw std::runtime_error(OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    const auto channels = static_cast<std::size_t>(std::max(0, spec.nchannels));
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || channels < 1 || spec.deep || spec.image_pixels() > max_values / channels)
        throw std::runtime_error(std::to_string(spec.width) + " x " + std::to_string(spec.height) + " x " + std::to_string(spec.depth) +
                                 " pixels of " + std::to_string(spec.nchannels) + " channels");
    const auto read = [&]<class T>(OIIO::TypeDesc type, std::vector<T> values) {
        if (!input->read_image(0, 0, 0, spec.nchannels, type, values.data()))
            throw std::runtime_error(input->geterror());
        return values;
    };
    const std::size_t values = channels * static_cast<std::size_t>(spec.image_pixels());
    if (spec.format == OIIO::TypeDesc::UINT8) {
        if (channels != 1 && channels != 3)
            throw std::runtime_error(std::to_string(channels) + " channels of 8 bits");
        const std::vector<std::uint8_t> levels = read(OIIO::TypeDesc::UINT8, std::vector<std::uint8_t>(values));
        picture.display = Image<Rgb8>(spec.width, spec.height);
        for (std::size_t i = 0; i < picture.display.size(); ++i) {
            const std::uint8_t* level = levels.data() + i * channels;
            picture.display.pixels()[i] = channels == 3 ? Rgb8{level[0], level[1], level[2]} : Rgb8{level[0], level[0], level[0]};
        }
        return;
    }
    const std::vector<float> numbers = read(OIIO::TypeDesc::FLOAT, std::vector<float>(values));
    for (std::size_t c = 0; c < channels; ++c) {
        PictureChannel& channel = picture.linear.emplace_back(PictureChannel{spec.channel_name(static_cast<int>(c)), {}});
        channel.values = Image<float>(spec.width, spec.height);
        for (std::size_t i = 0; i < channel.values.size(); ++i)
            channel.values.pixels()[i] = numbers[i * channels + c];
    }
}

} // namespace fernlicht
