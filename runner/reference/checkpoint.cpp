#include "runner/reference/checkpoint.h"

#include "runner/durable_files.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <array>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>

namespace fernlicht {
namespace {

/// The file: this word, the hash of the inputs, the hash of what follows, then the numbers as they lie in memory.
constexpr std::string_view magic = "fernlicht reference checkpoint 1\n";
constexpr std::size_t hash_digits = 32;

template <class T> void append(std::string& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

template <class T> void append_pixels(std::string& bytes, const Image<T>& image) {
    bytes.append(reinterpret_cast<const char*>(image.data()), image.size() * sizeof(T));
}

/// Takes numbers off the front; whoever calls has checked the length.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}
    template <class T> void take(T& value) {
        std::memcpy(&value, bytes_.data(), sizeof(value));
        bytes_.remove_prefix(sizeof(value));
    }
    template <class T> void take_pixels(Image<T>& image) {
        std::memcpy(image.data(), bytes_.data(), image.size() * sizeof(T));
        bytes_.remove_prefix(image.size() * sizeof(T));
    }

  private:
    std::string_view bytes_;
};

/// Of an image, in the file's order. `image` may be const or not.
template <class Picture, class Use> void for_each_image(Picture& image, Use use) {
    for (auto* estimate : {&image.illuminance_lx, &image.target_lx, &image.luminance_cdm2}) {
        use(estimate->mean);
        use(estimate->standard_error);
    }
    use(image.ids);
    use(image.samples);
    use(image.mixed);
}

std::size_t payload_bytes(ReferenceImage& image) {
    std::size_t bytes = sizeof(image.seconds) + sizeof(image.rays);
    for_each_image(image, [&](const auto& pixels) { bytes += pixels.size() * sizeof(*pixels.data()); });
    return bytes;
}

ReferenceImage blank(const View& view, const Wanted& wanted) {
    ReferenceImage image;
    const auto sized = [&](auto& pixels) { pixels = std::decay_t<decltype(pixels)>(view.width_px, view.height_px); };
    for (const auto& [estimate, is_wanted] :
         {std::pair(&image.illuminance_lx, wanted.illuminance), std::pair(&image.target_lx, wanted.target),
          std::pair(&image.luminance_cdm2, wanted.luminance)})
        if (is_wanted) {
            sized(estimate->mean);
            sized(estimate->standard_error);
        }
    sized(image.ids);
    sized(image.samples);
    sized(image.mixed);
    return image;
}

} // namespace

std::string hash_of_inputs(const ReferenceResult& result, const Drive& drive) {
    const ReferenceSettings& s = result.settings;
    std::string text = fmt::format("{}\n{}\n{} {} {} {}\n", FERNLICHT_VERSION, write_drive(drive), result.variant, result.moment.tick,
                                   result.view.name, result.wanted.target);
    text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", static_cast<int>(s.integrator), static_cast<int>(s.footprint),
                        s.target_error, s.floor_lx, s.floor_cdm2, s.least_samples, s.most_samples, s.most_bounces, s.lamp_radius_m,
                        s.target_height_m, s.shadows, s.seed);
    text += fmt::format("{} {} {} {} {} {} {} {}\n", s.most_smooth, s.solver.reach_m, s.solver.patch_m, s.solver.form_factor_rays,
                        s.solver.residual, s.solver.photons, s.solver.radius_m, s.solver.final_gather);
    for (const FileRead& file : result.context.inputs)
        text += file.xxh128 + "\n";
    return content_hash(text.data(), text.size());
}

std::filesystem::path checkpoint_file(const std::filesystem::path& folder) { return folder / "checkpoint.bin"; }

void write_checkpoint(const ReferenceImage& image, const std::string& inputs_hash, const std::filesystem::path& folder) {
    std::string payload;
    append(payload, image.seconds);
    append(payload, image.rays);
    for_each_image(image, [&](const auto& pixels) { append_pixels(payload, pixels); });
    const std::filesystem::path next = folder / "checkpoint.next";
    write_durably(next, std::string(magic) + inputs_hash + content_hash(payload.data(), payload.size()) + payload);
    rename_durably(next, checkpoint_file(folder));
}

ReferenceImage read_checkpoint(const std::string& inputs_hash, const View& view, const Wanted& wanted,
                               const std::filesystem::path& folder) {
    const std::filesystem::path path = checkpoint_file(folder);
    const auto refuse = [&](const char* found, const char* expected) { throw InputError({path, 0, 0, "--resume"}, found, expected); };
    if (!std::filesystem::exists(path))
        refuse("found no checkpoint there", "the folder of a reference that was interrupted");
    FilesRead ignored;
    const std::string bytes = read_file(path, ignored, std::size_t{1} << 32);
    const std::string_view all = bytes;
    const std::size_t head = magic.size() + 2 * hash_digits;
    if (all.size() < head || !all.starts_with(magic))
        refuse("found something else", "a checkpoint of this version of fernlicht");
    if (all.substr(magic.size(), hash_digits) != inputs_hash)
        refuse("found the checkpoint of another picture", "the same drive, files, flags and version as when it was interrupted");
    const std::string_view payload = all.substr(head);
    ReferenceImage image = blank(view, wanted);
    if (payload.size() != payload_bytes(image) ||
        content_hash(payload.data(), payload.size()) != all.substr(magic.size() + hash_digits, hash_digits))
        refuse("found a checkpoint that is damaged", "one that is whole");
    Reader reader(payload);
    reader.take(image.seconds);
    reader.take(image.rays);
    for_each_image(image, [&](auto& pixels) { reader.take_pixels(pixels); });
    return image;
}

} // namespace fernlicht
