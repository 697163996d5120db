#include "runner/experiments/reference/checkpoint.h"

#include "runner/files/durable_files.h"
#include "runner/files/output_folder.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/version.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <type_traits>

namespace fernlicht {
namespace {

/// The file: this word, the inputs as text, an empty line, the hash of what follows, then the numbers as they lie in memory.
constexpr std::string_view magic = "fernlicht reference checkpoint 2\n";
constexpr std::size_t hash_digits = 32, max_named = 3;
const std::string content_of = "content of ";

using Input = std::pair<std::string, std::string>; ///< name, value
using Inputs = std::vector<Input>;
Inputs inputs_of(std::string_view text) {
    Inputs lines;
    for (std::size_t end = text.find('\n'); end != std::string_view::npos; text.remove_prefix(end + 1), end = text.find('\n')) {
        const std::string_view line = text.substr(0, end);
        const std::size_t tab = std::min(line.find('\t'), line.size());
        lines.emplace_back(line.substr(0, tab), line.substr(std::min(tab + 1, line.size())));
    }
    return lines;
}

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

ReferenceImage blank(const View& view, const FrameOutputs& outputs) {
    ReferenceImage image;
    const auto sized = [&](auto& pixels) { pixels = std::decay_t<decltype(pixels)>(view.width_px, view.height_px); };
    for (const auto& [estimate, has_output] :
         {std::pair(&image.illuminance_lx, outputs.illuminance), std::pair(&image.target_lx, outputs.target),
          std::pair(&image.luminance_cdm2, outputs.luminance)})
        if (has_output) {
            sized(estimate->mean);
            sized(estimate->standard_error);
        }
    sized(image.ids);
    sized(image.samples);
    sized(image.mixed);
    return image;
}

} // namespace

std::string checkpoint_inputs(const ReferenceResult& result, const Drive& drive) {
    const ReferenceSettings& s = result.settings;
    const SolverSettings& v = s.solver;
    std::string text;
    const auto add = [&](const std::string& name, const auto& value) { text += fmt::format("{}\t{}\n", name, value); };
    const std::string resolved = write_drive(drive);
    add("version", program_version);
    add("--lamp-set", printable(result.lamp_set));
    add("--view", printable(result.view.name));
    add("width in pixels", result.view.width_px), add("height in pixels", result.view.height_px);
    add("--moment", fmt::format("{} s", result.moment.time_s));
    add("--integrator", integrator_name(s.integrator));
    add("--target-error", s.target_error), add("--max-samples", s.max_samples);
    add("--lamp-radius", s.lamp_radius_m), add("--seed", s.seed);
    add("--smooth-depth", s.max_smooth), add("--reach", v.reach_m), add("--patch", v.patch_m);
    add("--form-factor-rays", v.form_factor_rays), add("--residual", v.residual), add("--photons", v.photons);
    add("--photon-radius", v.radius_m), add("final gathering", v.final_gather);
    add("footprint", static_cast<int>(s.footprint)), add("floor_lx", s.floor_lx), add("floor_cdm2", s.floor_cdm2);
    add("least samples", s.min_samples), add("most bounces", s.max_bounces);
    add("target height", s.target_height_m), add("shadows", s.shadows), add("tick", result.moment.tick);
    for (const FileRead& file : result.context.inputs)
        add(content_of + printable(file.path.string(), 400), file.xxh128);
    add(content_of + "the drive with its files and changes", content_hash(resolved.data(), resolved.size()));
    return text;
}

std::string differing_inputs(const std::string& then, const std::string& now) {
    const Inputs before = inputs_of(then), after = inputs_of(now);
    std::vector<std::string> differences;
    for (const auto& [name, value] : after) {
        const auto old = std::ranges::find(before, name, &Input::first);
        if (old != before.end() && old->second == value)
            continue;
        if (name.starts_with(content_of))
            differences.push_back("other " + name);
        else
            differences.push_back(fmt::format("{} {}, now {}", name, old == before.end() ? "unknown" : printable(old->second), value));
    }
    for (const auto& [name, value] : before)
        if (std::ranges::find(after, name, &Input::first) == after.end())
            differences.push_back(printable(name, 400) + " no more");
    if (differences.size() > max_named) {
        const std::size_t others = differences.size() - max_named;
        differences.resize(max_named);
        differences.push_back(fmt::format("{} more", others));
    }
    return fmt::format("{}", fmt::join(differences, "; "));
}

std::filesystem::path checkpoint_file(const std::filesystem::path& folder) { return folder / "checkpoint.bin"; }

void write_checkpoint(const ReferenceImage& image, const std::string& inputs, const std::filesystem::path& folder) {
    std::string payload;
    append(payload, image.seconds);
    append(payload, image.rays);
    for_each_image(image, [&](const auto& pixels) { append_pixels(payload, pixels); });
    const std::filesystem::path next = folder / "checkpoint.next";
    write_durably(next, std::string(magic) + inputs + '\n' + content_hash(payload.data(), payload.size()) + payload);
    rename_durably(next, checkpoint_file(folder));
}

ReferenceImage read_checkpoint(const std::string& inputs, const View& view, const FrameOutputs& outputs,
                               const std::filesystem::path& folder) {
    const std::filesystem::path path = checkpoint_file(folder);
    const auto refuse = [&](const std::string& found, const char* expected) {
        throw InputError({path, 0, 0, "--resume"}, found, expected);
    };
    if (!std::filesystem::exists(path) && !is_marked_incomplete(folder) && std::filesystem::exists(folder / "reference.json"))
        refuse("found a picture that is finished", "the folder of a reference that was interrupted");
    if (!std::filesystem::exists(path))
        refuse("found no checkpoint there", "the folder of a reference that was interrupted");
    FilesRead ignored;
    const std::string bytes = read_file(path, ignored, std::size_t{1} << 32);
    const std::string_view all = bytes;
    const std::size_t inputs_end = all.find("\n\n"), head = inputs_end + 2 + hash_digits;
    if (!all.starts_with(magic) || inputs_end == std::string_view::npos || all.size() < head)
        refuse("found something else", "a checkpoint of this version of fernlicht");
    if (const std::string then(all.substr(magic.size(), inputs_end + 1 - magic.size())); then != inputs)
        refuse("found the checkpoint of another picture: " + differing_inputs(then, inputs),
               "the same drive, files, flags and version as when it was interrupted");
    const std::string_view payload = all.substr(head);
    ReferenceImage image = blank(view, outputs);
    if (payload.size() != payload_bytes(image) || content_hash(payload.data(), payload.size()) != all.substr(inputs_end + 2, hash_digits))
        refuse("found a checkpoint that is damaged", "one that is whole");
    Reader reader(payload);
    reader.take(image.seconds);
    reader.take(image.rays);
    for_each_image(image, [&](auto& pixels) { reader.take_pixels(pixels); });
    return image;
}

} // namespace fernlicht
