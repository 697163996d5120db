#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/aliasing/aliasing_run.h"
#include "runner/files/log.h"
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
    std::filesystem::path sequence, supersampled;
    std::optional<double> rate_hz, pixels_per_degree, view_fov_deg;
};

SurfaceFilter filter_of(const std::string& text) {
    for (const SurfaceFilter filter : {SurfaceFilter::mipmapped, SurfaceFilter::none, SurfaceFilter::trilinear})
        if (filter_name(filter) == text)
            return filter;
    refuse_flag("--texture-filters", text, "none, mipmapped or trilinear");
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
    check_once("--texture-filters", request.filters, flags.filters);
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
    if (!flags.supersampled.empty())
        request.against = flags.supersampled;
    if (!flags.frames.empty())
        request.frames = two_numbers("--frames", flags.frames, ':', false, "FIRST:LAST, e.g. 60:75");
    if (!flags.rate_hz)
        throw InputError({{}, 0, 0, "--rate"}, "is missing", "frames per second of the sequence");
    if (!(*flags.rate_hz >= 8.0 && *flags.rate_hz <= 10000.0)) // flicker begins at 4 Hz
        refuse_flag("--rate", fmt::format("{:g}", *flags.rate_hz), "8 to 10000 frames per second");
    request.rate_hz = *flags.rate_hz;
    if (flags.pixels_per_degree.has_value() == flags.view_fov_deg.has_value())
        throw InputError({{}, 0, 0, "--ppd"}, flags.pixels_per_degree ? "found --vertical-fov too" : "is missing",
                         "either pixels per degree or --vertical-fov, the vertical angle of the view in degrees");
    if (flags.pixels_per_degree && !(*flags.pixels_per_degree >= 1.0 && *flags.pixels_per_degree <= 1000.0))
        refuse_flag("--ppd", fmt::format("{:g}", *flags.pixels_per_degree), "1 to 1000 pixels per degree");
    if (flags.view_fov_deg && !(*flags.view_fov_deg > 0.0 && *flags.view_fov_deg < 180.0))
        refuse_flag("--vertical-fov", fmt::format("{:g}", *flags.view_fov_deg), "degrees above 0 and below 180");
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
        tell(LogLevel::warning, "incomplete: " + result.interrupted);
    const bool measured =
        !ranked(result).empty() || std::ranges::any_of(result.rows, [](const AliasingRow& row) { return row.temporal.has_value(); });
    return result.interrupted.empty() && measured ? 0 : 1;
}

} // namespace

void add_aliasing_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<AliasingFlags>();
    CLI::App* sub = app.add_subcommand("aliasing", "measure aliasing: how much of a picture is not in the scene, by way of rendering");
    add_shared(*sub, "DRIVE", flags->drive);
    add_shared(*sub, "--moment", flags->moment_s)->default_str("the middle one");
    add_shared(*sub, "--frames", flags->frames);
    sub->add_flag("--flow", flags->flow, "with --frames: compare optical flow with the known motion, too");
    CLI::Option* const sequence = sub->add_option("--sequence", flags->sequence,
                                                  "instead of a drive: numbered PNG or EXR frames from elsewhere, a folder or BEGIN*END")
                                      ->option_text("FOLDER");
    sub->add_option("--supersampled", flags->supersampled, "the same frames at 4, 6 ... 16 times the resolution in each direction")
        ->option_text("FOLDER")
        ->needs(sequence);
    add_shared(*sub, "--rate", flags->rate_hz)->needs(sequence);
    add_shared(*sub, "--ppd", flags->pixels_per_degree)->needs(sequence);
    add_shared(*sub, "--vertical-fov", flags->view_fov_deg)->needs(sequence);
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    add_shared(*sub, "--techniques", flags->techniques)->delimiter(',')->default_str("the drive's");
    add_shared(*sub, "--beams", flags->beams)->delimiter(',')->default_str("the drive's and eight-bit");
    sub->add_option("--samples", flags->samples, "samples per pixel: 1, 4, 9 or 16")
        ->option_text("N,...")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->default_str("1,4");
    sub->add_option("--texture-filters", flags->filters, "texture filters: none, mipmapped or trilinear")
        ->option_text("NAME,...")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->default_str("mipmapped,none,trilinear");
    sub->add_option("--supersample", flags->supersample, "resolution of the reference in each direction, as a multiple: even, 4 to 16")
        ->capture_default_str();
    sub->add_option("--values", flags->picture,
                    "what is measured: luminance of the scene in cd/m2, or the tone-mapped picture on a display")
        ->check(CLI::IsMember({"luminance", "display"}))
        ->option_text("luminance|display")
        ->capture_default_str();
    sub->add_option("--level", flags->level_lx, "illuminance in lux of the line whose jaggedness is measured")
        ->option_text("LX")
        ->capture_default_str();
    add_shared(*sub, "--resolution", flags->resolution)->default_str("the drive's");
    add_shared(*sub, "--backend", flags->backend);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    add_shared(*sub, "--quiet", flags->quiet);
    for (const char* of_drives : {"--moment", "--lamp-set", "--techniques", "--beams", "--samples", "--texture-filters", "--supersample",
                                  "--values", "--level", "--resolution", "--backend", "--flow"})
        sequence->excludes(of_drives);
    sub->footer(
        "Of beams, samples and filters the first holds for all, the others are varied. 8 to 64 --frames measure flicker and crawl, too. "
        "A --sequence needs --rate, and --ppd or --vertical-fov. docs/aliasing.md tells more.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return aliasing(*flags, command); }; });
}

} // namespace fernlicht
