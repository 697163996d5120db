#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/run/run_drives.h"
#include "runner/experiments/shadows/shadow_study.h"
#include "runner/files/log.h"
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
    const auto [width, height] = two_numbers("--shadow-map", flags.texels, 'x', false, "WIDTHxHEIGHT, e.g. 1024x512");
    if (std::min(width, height) < 16 || std::max(width, height) > 8192)
        refuse_flag("--shadow-map", flags.texels, "16 to 8192 each way");
    request.options.width = width;
    request.options.height = height;
    if (flags.lamp_radius_m != 0.0 && !(flags.lamp_radius_m >= 0.001 && flags.lamp_radius_m <= 0.5))
        refuse_flag("--lamp-radius", fmt::format("{}", flags.lamp_radius_m), "0, or 0.001 to 0.5 m");
    if (!(flags.floor_lx >= shadow_floor_lx && flags.floor_lx <= 10.0))
        refuse_flag("--floor-lx", fmt::format("{}", flags.floor_lx), "0.001 to 10 lx");
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
    request.lamp =
        flags.lamp.empty() && request.scenes.front() != "none" ? shipped_file("lamps/xenon-low.ies", "--scene-lamp") : flags.lamp;
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
        tell(LogLevel::warning, "incomplete: " + result.interrupted);
    for (const std::string& missing : result.missing)
        tell(LogLevel::warning, "missing: " + missing);
    return result.interrupted.empty() ? 0 : 1;
}

} // namespace

void add_shadows_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<ShadowsFlags>();
    CLI::App* sub = app.add_subcommand("shadows", "measure how wrong each shadow method is against ray tracing, and what it costs");
    add_shared(*sub, "DRIVES", flags->drives);
    sub->add_option("--methods", flags->methods, "shadow methods to compare")
        ->option_text("NAME,...")
        ->allow_extra_args(false)
        ->default_str("all");
    sub->add_option("--scenes", flags->scenes, "hard scenes to take, * and ? allowed, or none")
        ->option_text("NAME,...")
        ->allow_extra_args(false)
        ->default_str("all");
    sub->add_option("--shadow-map", flags->texels, "texels of each shadow map")->option_text("WIDTHxHEIGHT")->capture_default_str();
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    sub->add_option("--scene-lamp", flags->lamp, "lamp file for the hard scenes")
        ->option_text("FILE")
        ->default_str("our lamps/xenon-low.ies");
    add_recipe_flag(*sub, flags->recipe);
    add_shared(*sub, "--lamp-radius", flags->lamp_radius_m)->capture_default_str();
    sub->add_option("--floor-lx", flags->floor_lx, "leave out points that get less than this without shadows")
        ->option_text("LX")
        ->capture_default_str();
    add_shared(*sub, "--vertical-fov", flags->vertical_fov_deg)->default_str(fmt::format("{:.1f}", flags->vertical_fov_deg));
    add_shared(*sub, "--count", flags->moments)->check(CLI::Range(1, 100))->capture_default_str();
    add_shared(*sub, "--rounds", flags->rounds)->check(CLI::Range(1, 100000))->capture_default_str();
    add_shared(*sub, "--resolution", flags->resolution)->capture_default_str();
    add_seed_flag(*sub, flags->seed);
    add_shared(*sub, "--backend", flags->backend);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    add_print_flags(*sub, flags->printed);
    add_shared(*sub, "--quiet", flags->quiet);
    sub->footer(
        "Drives come on top of the hard scenes. Without a --lamp-radius soft shadows are not measured. docs/shadows.md tells more.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return shadows(*flags, command); }; });
}

} // namespace fernlicht
