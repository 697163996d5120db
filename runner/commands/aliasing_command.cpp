#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/experiments/aliasing/aliasing_run.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct AliasingFlags {
    std::filesystem::path drive;
    std::optional<double> moment_s;
    std::string lamp_set, frames, resolution, backend = "auto", out, picture = "luminance";
    const OutputFormat* tables = nullptr;
    std::vector<std::string> techniques, beams, filters{"mipmapped", "none", "trilinear"};
    std::vector<int> samples{1, 4};
    int supersample = 4;
    double level_lx = 1.0;
    bool quiet = false, flow = false;
    std::filesystem::path sequence, against;
    std::optional<double> rate_hz, pixels_per_degree, view_fov_deg;
};

SurfaceFilter filter_of(const std::string& text) {
    for (const SurfaceFilter filter : {SurfaceFilter::mipmapped, SurfaceFilter::none, SurfaceFilter::trilinear})
        if (filter_name(filter) == text)
            return filter;
    refuse_flag("--filter", text, "none, mipmapped or trilinear");
}

/// Refuses a value that comes twice.
template <class Value> void check_once(const char* flag, const std::vector<Value>& values, const std::vector<std::string>& texts) {
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (values[i] == values[j])
                refuse_flag(flag, texts[i] + " twice", "each value once");
}

AliasingRequest request_of(const AliasingFlags& flags) {
    AliasingRequest request;
    DriveEdits edits;
    if (!flags.resolution.empty())
        edits.resolution = resolution_of(flags.resolution);
    for (const std::string& filter : flags.filters)
        request.filters.push_back(filter_of(filter));
    check_once("--filter", request.filters, flags.filters);
    std::vector<std::string> sample_texts;
    for (const int samples : flags.samples) {
        if (samples != 1 && samples != 4 && samples != 9 && samples != 16)
            refuse_flag("--samples", fmt::format("{}", samples), "1, 4, 9 or 16");
        request.samples.push_back(samples);
        sample_texts.push_back(fmt::format("{}", samples));
    }
    check_once("--samples", request.samples, sample_texts);
    if (flags.supersample < 4 || flags.supersample > 16 || flags.supersample % 2 != 0)
        refuse_flag("--supersample", fmt::format("{}", flags.supersample), "an even number, 4 to 16");
    if (!(flags.level_lx > 0.0 && flags.level_lx < 1e6))
        refuse_flag("--level", fmt::format("{}", flags.level_lx), "lux above 0");
    if (!flags.frames.empty() && flags.moment_s)
        throw InputError({{}, 0, 0, "--moment"}, "found --frames too", "one of the two");
    if (!flags.frames.empty())
        request.frames = two_numbers("--frames", flags.frames, ':', false, "FIRST:LAST, e.g. 60:75");
    request.drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits);
    request.beams = beams_of(flags.beams);
    if (request.beams.empty()) {
        request.beams.push_back(request.drive.beams);
        if (request.drive.beams != eight_bit_texels)
            request.beams.push_back(eight_bit_texels);
    }
    check_once("--beams", request.beams, flags.beams);
    request.moment_s = flags.moment_s;
    request.lamp_set = flags.lamp_set;
    request.techniques = flags.techniques;
    request.supersample = flags.supersample;
    request.displayed = flags.picture == "display";
    request.level_lx = flags.level_lx;
    request.backend = flags.backend;
    request.quiet = flags.quiet;
    request.flow = flags.flow;
    return request;
}

SequenceRequest sequence_request_of(const AliasingFlags& flags) {
    SequenceRequest request;
    request.sequence = flags.sequence;
    if (!flags.against.empty())
        request.against = flags.against;
    if (!flags.frames.empty())
        request.frames = two_numbers("--frames", flags.frames, ':', false, "FIRST:LAST, e.g. 60:75");
    if (!flags.rate_hz)
        throw InputError({{}, 0, 0, "--rate"}, "is missing", "frames per second of the sequence");
    if (!(*flags.rate_hz >= 8.0 && *flags.rate_hz <= 10000.0)) // flicker begins at 4 Hz
        refuse_flag("--rate", fmt::format("{:g}", *flags.rate_hz), "8 to 10000 frames per second");
    request.rate_hz = *flags.rate_hz;
    if (flags.pixels_per_degree.has_value() == flags.view_fov_deg.has_value())
        throw InputError({{}, 0, 0, "--ppd"}, flags.pixels_per_degree ? "found --view-fov too" : "is missing",
                         "either pixels per degree or --view-fov, the vertical angle of the view in degrees");
    if (flags.pixels_per_degree && !(*flags.pixels_per_degree >= 1.0 && *flags.pixels_per_degree <= 1000.0))
        refuse_flag("--ppd", fmt::format("{:g}", *flags.pixels_per_degree), "1 to 1000 pixels per degree");
    if (flags.view_fov_deg && !(*flags.view_fov_deg > 0.0 && *flags.view_fov_deg < 180.0))
        refuse_flag("--view-fov", fmt::format("{:g}", *flags.view_fov_deg), "degrees above 0 and below 180");
    request.pixels_per_degree = flags.pixels_per_degree;
    request.view_fov_deg = flags.view_fov_deg;
    request.quiet = flags.quiet;
    return request;
}

AliasingResult run(const AliasingFlags& flags, const std::vector<std::string>& command, std::filesystem::path& folder) {
    const auto place = [&](const std::string& name) {
        folder = result_folder(flags.out, name + "-aliasing");
        return folder;
    };
    const auto write = [&](const AliasingResult& result) {
        write_file(folder / "aliasing.json", json_text(as_json(result, aliasing_members)));
        write_file(folder / "aliasing.csv", aliasing_csv(result));
        write_document(document(result), result, folder, "aliasing", flags.tables);
    };
    if (!flags.sequence.empty()) {
        SequenceRequest request = sequence_request_of(flags);
        request.write = write;
        request.command = command;
        request.folder = place("sequence");
        return run_sequence_aliasing(request);
    }
    AliasingRequest request = request_of(flags);
    request.write = write;
    request.command = command;
    request.folder = place(request.drive.name);
    return run_aliasing(request);
}

int aliasing(const AliasingFlags& flags, const std::vector<std::string>& command) {
    if (flags.sequence.empty() == flags.drive.empty())
        throw InputError({{}, 0, 0, "DRIVE"}, flags.drive.empty() ? "is missing" : "found --sequence too",
                         "a drive file, or --sequence with a folder of frames");
    std::filesystem::path folder;
    const AliasingResult result = run(flags, command, folder);
    fmt::print("{}\n{}\n", document_text(document(result)), page_link(folder / "aliasing.html"));
    if (!result.interrupted.empty())
        fmt::print("incomplete: {}\n", result.interrupted);
    const bool measured =
        !ranked(result).empty() || std::ranges::any_of(result.rows, [](const AliasingRow& row) { return row.temporal.has_value(); });
    return result.interrupted.empty() && measured ? 0 : 1;
}

} // namespace

void add_aliasing_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<AliasingFlags>();
    CLI::App* sub = app.add_subcommand("aliasing", "measure how much of a picture is not in the scene, by how it is rendered");
    sub->add_option("DRIVE", flags->drive, "drive file (YAML)");
    sub->add_option("--moment", flags->moment_s, "seconds into the drive; renders the nearest moment (default: the middle one)");
    sub->add_option("--frames", flags->frames, "FIRST:LAST, 8 to 64 consecutive moments: also measure flicker and crawl");
    sub->add_flag("--flow", flags->flow, "with --frames: also compare optical flow with the known motion");
    CLI::Option* const sequence = sub->add_option(
        "--sequence", flags->sequence, "instead of a drive: folder of numbered PNG or EXR frames from elsewhere, or FOLDER/BEGIN*END");
    sub->add_option("--against", flags->against, "the same frames at 4, 6 ... 16 times the resolution in each direction")->needs(sequence);
    sub->add_option("--rate", flags->rate_hz, "frames per second of the sequence")->needs(sequence);
    sub->add_option("--ppd", flags->pixels_per_degree, "pixels per degree of the sequence")->needs(sequence);
    sub->add_option("--view-fov", flags->view_fov_deg, "vertical field of view of the sequence in degrees, instead of --ppd")
        ->needs(sequence);
    sub->add_option("--lamp-set", flags->lamp_set, "lamp set of the drive (default: its first)");
    const auto list = [&](const char* name, auto& values, const char* text) {
        return sub->add_option(name, values, text)->delimiter(',')->allow_extra_args(false);
    };
    list("--techniques", flags->techniques, "comma-separated names (default: the drive's)");
    list("--beams", flags->beams,
         "float, eight-bit or WIDTHxHEIGHTxBITS,...: the first for all, the others varied (default: the drive's and eight-bit)");
    list("--samples", flags->samples, "1, 4, 9 or 16 per pixel: the first for all, the others varied")->capture_default_str();
    list("--filter", flags->filters, "texture filter: none, mipmapped or trilinear; the first for all, the others varied")
        ->capture_default_str();
    sub->add_option("--supersample", flags->supersample, "resolution of the reference in each direction, as a multiple: even, 4 to 16")
        ->capture_default_str();
    sub->add_option("--picture", flags->picture, "luminance: of the scene, in cd/m2; display: of the tone-mapped picture on a display")
        ->check(CLI::IsMember({"luminance", "display"}))
        ->capture_default_str();
    sub->add_option("--level", flags->level_lx, "illuminance in lux of the line whose jaggedness is measured")->capture_default_str();
    sub->add_option("--resolution", flags->resolution, "WIDTHxHEIGHT of the view (default: the drive's)");
    sub->add_option("--backend", flags->backend, backend_names);
    sub->add_option("--out", flags->out, "new or empty folder for the results");
    add_tables_flag(*sub, flags->tables);
    sub->add_flag("--quiet", flags->quiet, "show no progress");
    for (const char* of_drives : {"--moment", "--lamp-set", "--techniques", "--beams", "--samples", "--filter", "--supersample",
                                  "--picture", "--level", "--resolution", "--backend", "--flow"})
        sequence->excludes(of_drives);
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return aliasing(*flags, command); }; });
}

} // namespace fernlicht
