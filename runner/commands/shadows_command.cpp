#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/experiments/run/run_drives.h"
#include "runner/experiments/shadows/shadow_study.h"
#include "runner/files/page_link.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/library_folders.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct ShadowsFlags {
    std::vector<std::filesystem::path> drives;
    std::string lamp_set, backend = "auto", out, texels = "1024x512", resolution = "512x384";
    const OutputFormat* tables = nullptr;
    std::vector<std::string> methods, scenes{"*"};
    std::filesystem::path lamp, recipe;
    double lamp_radius_m = ShadowSettings{}.lamp_radius_m, floor_lx = shadow_floor_lx, vertical_fov_deg = degrees(View{}.vertical_fov_rad);
    int moments = 3, rounds = 7;
    std::uint64_t seed = 1;
    const OutputFormat* printed = nullptr; ///< of the paper; nullptr: the page as text
    bool quiet = false;
};

/// One of those that draw: not auto, which takes one of them.
ShadowMethod drawn_method_named(const std::string& item) {
    std::vector<std::string_view> known;
    for (const ShadowMethodName& row : shadow_method_names()) {
        if (row.name == item)
            return row.method;
        known.push_back(row.name);
    }
    if (item == name(ShadowMethod::automatic))
        refuse_flag("--methods", item, "methods by their names: auto takes one of them (fernlicht run DRIVE --shadows auto)");
    const std::string nearest = nearest_name(item, known);
    throw InputError({{}, 0, 0, "--methods"}, "found '" + printable(item) + "'",
                     fmt::format("one of {}{}", fmt::join(known, ", "), nearest.empty() ? "" : " (nearest: '" + nearest + "')"));
}

std::vector<ShadowMethod> methods_of(const std::vector<std::string>& lists) {
    std::vector<ShadowMethod> methods;
    for (const std::string& item : items_of("--methods", lists)) {
        methods.push_back(drawn_method_named(item));
        if (std::ranges::count(methods, methods.back()) > 1)
            refuse_flag("--methods", item + " twice", "each method once");
    }
    if (methods.empty())
        for (const ShadowMethodName& row : shadow_method_names())
            methods.push_back(row.method);
    return methods;
}

int shadows(const ShadowsFlags& flags, const std::vector<std::string>& command) {
    ShadowRequest request;
    request.options.methods = methods_of(flags.methods);
    const auto [width, height] = two_numbers("--map-texels", flags.texels, 'x', false, "WIDTHxHEIGHT, e.g. 1024x512");
    if (std::min(width, height) < 16 || std::max(width, height) > 8192)
        refuse_flag("--map-texels", flags.texels, "16 to 8192 each way");
    request.options.width = width;
    request.options.height = height;
    if (flags.lamp_radius_m != 0.0 && !(flags.lamp_radius_m >= 0.001 && flags.lamp_radius_m <= 0.5))
        refuse_flag("--lamp-radius", fmt::format("{}", flags.lamp_radius_m), "0, or 0.001 to 0.5 m");
    if (!(flags.floor_lx >= shadow_floor_lx && flags.floor_lx <= 10.0))
        refuse_flag("--floor", fmt::format("{}", flags.floor_lx), "0.001 to 10 lx");
    if (!(flags.vertical_fov_deg >= 1.0 && flags.vertical_fov_deg <= 120.0))
        refuse_flag("--vertical-fov", fmt::format("{}", flags.vertical_fov_deg), "1 to 120 degrees");
    request.vertical_fov_rad = radians(flags.vertical_fov_deg);
    request.options.lamp_radius_m = flags.lamp_radius_m;
    request.options.floor_lx = flags.floor_lx;
    request.options.rounds = flags.rounds;
    request.options.timed_px = resolution_of(flags.resolution);
    request.options.seed = flags.seed;
    request.scenes = items_of("--scenes", flags.scenes);
    if (request.scenes.size() > 1 && std::ranges::count(request.scenes, "none") > 0)
        refuse_flag("--scenes", fmt::format("{}", fmt::join(request.scenes, ",")), "none alone, or names of scenes");
    request.lamp = flags.lamp.empty() && request.scenes.front() != "none" ? shipped_file("lamps/xenon-low.ies", "--lamp") : flags.lamp;
    request.recipe = flags.recipe;
    for (const std::filesystem::path& file : flags.drives)
        request.drives.push_back(read_drive(named_file("drive", file, "DRIVE")));
    refuse_equal_names(request.drives);
    request.lamp_set = flags.lamp_set;
    request.moments = flags.moments;
    request.backend = flags.backend;
    request.folder = result_folder(flags.out, "shadows");
    request.command = command;
    request.quiet = flags.quiet;
    request.write = [&](const ShadowResult& result) {
        write_file(request.folder / "shadows.json", json_text(as_json(result, shadow_members)));
        write_file(request.folder / "shadows.csv", shadow_csv(result));
        write_document(document(result), result, request.folder, "shadows", flags.tables);
    };
    const ShadowResult result = run_shadow_study(request);
    fmt::print("{}\n{}\n", flags.printed ? flags.printed->of_document(shadow_paper(result)) : document_text(document(result)),
               page_link(request.folder / "shadows.html"));
    if (!result.interrupted.empty())
        fmt::print("incomplete: {}\n", result.interrupted);
    for (const std::string& missing : result.missing)
        fmt::print("missing: {}\n", missing);
    return result.interrupted.empty() ? 0 : 1;
}

} // namespace

void add_shadows_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<ShadowsFlags>();
    CLI::App* sub = app.add_subcommand("shadows", "measure how wrong each shadow method is against ray tracing, and what it costs");
    sub->add_option("DRIVE", flags->drives, "drive files (YAML), in addition to the hard scenes");
    sub->add_option("--methods", flags->methods, "comma-separated names (default: all)")->allow_extra_args(false);
    sub->add_option("--scenes", flags->scenes, "comma-separated names of hard scenes, * and ? allowed, or none (default: all)")
        ->allow_extra_args(false)
        ->default_str("");
    sub->add_option("--map-texels", flags->texels, "WIDTHxHEIGHT of each map")->capture_default_str();
    sub->add_option("--lamp-set", flags->lamp_set, "lamp set of the drives (default: the first of each)");
    sub->add_option("--lamp", flags->lamp, "lamp file for the hard scenes (default: our lamps/xenon-low.ies)");
    add_recipe_flag(*sub, flags->recipe);
    sub->add_option("--lamp-radius", flags->lamp_radius_m, "radius in m of lamps as discs, for soft shadows; 0: do not measure them")
        ->capture_default_str();
    sub->add_option("--floor", flags->floor_lx, "lx; points that get less than this without shadows do not count")->capture_default_str();
    sub->add_option("--vertical-fov", flags->vertical_fov_deg, "vertical field of view in degrees in the hard scenes, 4:3")
        ->default_str(fmt::format("{:.1f}", flags->vertical_fov_deg));
    sub->add_option("--count", flags->moments, "moments of each drive, spread evenly")->check(CLI::Range(1, 100))->capture_default_str();
    sub->add_option("--rounds", flags->rounds, "number of timing rounds; in each, every method renders the moments once")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    sub->add_option("--resolution", flags->resolution, "WIDTHxHEIGHT of the timed frames")->capture_default_str();
    add_seed_flag(*sub, flags->seed, "seed of the order in each round");
    sub->add_option("--backend", flags->backend, backend_names);
    sub->add_option("--out", flags->out, "new or empty folder for the results");
    add_tables_flag(*sub, flags->tables);
    add_print_flags(*sub, flags->printed);
    sub->add_flag("--quiet", flags->quiet, "show no progress");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return shadows(*flags, command); }; });
}

} // namespace fernlicht
