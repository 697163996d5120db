#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/accuracy/drive_error.h"
#include "runner/experiments/reference/reference_run.h"
#include "runner/files/log.h"
#include "runner/findings/run_context.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

namespace fernlicht {
namespace {

/// The flags as typed.
struct ReferenceFlags {
    std::filesystem::path drive;
    std::vector<std::string> lamps;
    std::filesystem::path recipe;
    std::string lamp_set, view, road, resolution, out, target_error = "0.5%", integrator = "direct";
    double moment_s = 0.0;
    std::optional<double> lamp_radius_m; ///< not given: as the drive draws them
    int max_smooth = ReferenceSettings{}.max_smooth;
    SolverSettings solver;
    bool no_gather = false;
    int max_samples = ReferenceSettings{}.max_samples;
    std::uint64_t seed = 1;
    bool resume = false, quiet = false;
    std::vector<std::string> given; ///< names of the options that were typed
};

/// Options that mean something to some integrators alone.
struct Belonging {
    const char* flag;
    std::vector<Integrator> users;
};
const std::vector<Belonging>& belongings() {
    using enum Integrator;
    static const std::vector<Belonging> all{{"--smooth-depth", {whitted}},     {"--reach", {radiosity, photon_map}},
                                            {"--patch", {radiosity}},          {"--form-factor-rays", {radiosity}},
                                            {"--residual", {radiosity}},       {"--photons", {photon_map}},
                                            {"--photon-radius", {photon_map}}, {"--no-gather", {radiosity, photon_map}}};
    return all;
}

/// Refuses what would be ignored.
void check_given(const ReferenceFlags& flags) {
    const auto is_given = [&](const char* flag) { return std::ranges::count(flags.given, flag) > 0; };
    for (const Belonging& one : belongings())
        if (is_given(one.flag) && !std::ranges::count(one.users, *integrator_of(flags.integrator))) {
            std::string users;
            for (const Integrator user : one.users)
                users += (users.empty() ? "" : " or ") + integrator_name(user);
            throw InputError({{}, 0, 0, one.flag}, "found --integrator " + flags.integrator + ", which makes no use of it",
                             "--integrator " + users);
        }
    if (flags.no_gather && is_given("--max-samples"))
        throw InputError({{}, 0, 0, "--max-samples"}, "found --no-gather, which takes as few samples as there can be", "one of the two");
    for (const auto& [flag, text] :
         {std::pair("--view", &flags.view), std::pair("--lamp-set", &flags.lamp_set), std::pair("--road", &flags.road),
          std::pair("--resolution", &flags.resolution), std::pair("--out", &flags.out)})
        if (is_given(flag) && text->empty())
            refuse_flag(flag, *text, "something, or the option left out");
}

DriveEdits edits_of(const ReferenceFlags& flags) {
    DriveEdits edits;
    edits.lamps = lamps_of(flags.lamps);
    edits.lamp_recipe = flags.recipe;
    if (!flags.road.empty())
        edits.road = flags.road;
    if (!flags.resolution.empty())
        edits.resolution = resolution_of(flags.resolution);
    return edits;
}

ReferenceSettings settings_of(const ReferenceFlags& flags) {
    ReferenceSettings settings;
    settings.integrator = *integrator_of(flags.integrator);
    settings.max_smooth = flags.max_smooth;
    settings.solver = flags.solver;
    settings.solver.final_gather = !flags.no_gather;
    settings.target_error = share_of("--target-error", flags.target_error);
    settings.max_samples = flags.max_samples;
    settings.seed = flags.seed;
    return settings;
}

/// `reference` draws, `baselines` looks after what was accepted: who took the one for the other is led there.
void check_name(const ReferenceFlags& flags) {
    std::error_code ignored;
    for (const char* action : {"list", "show", "diff", "remove"})
        if (flags.drive == action && !std::filesystem::exists(flags.drive, ignored))
            throw InputError({{}, 0, 0, "DRIVE"}, fmt::format("found '{}'", action),
                             fmt::format("a drive file; baselines are looked at with `fernlicht baselines {}`", action));
}

int draw_reference(const ReferenceFlags& flags, const std::vector<std::string>& command) {
    check_name(flags);
    check_given(flags);
    if (flags.resume && flags.out.empty())
        throw InputError({{}, 0, 0, "--resume"}, "found no --out", "the folder of the reference that was interrupted");
    ReferenceRequest request;
    request.settings = settings_of(flags);
    request.drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits_of(flags));
    request.settings.lamp_radius_m = flags.lamp_radius_m.value_or(lamp_disc_radius_m(request.drive));
    request.lamp_set = flags.lamp_set;
    request.view = flags.view;
    request.moment_s = flags.moment_s;
    request.folder = result_folder(flags.out, request.drive.name + "-reference");
    request.resolution_asked = !flags.resolution.empty();
    request.resume = flags.resume;
    request.quiet = flags.quiet;
    request.command = command;
    request.write = [&request](const ReferenceResult& found) {
        for (const Plot& plot : false_colours(found))
            write_plot(plot, request.folder / plot.name);
    };
    const ReferenceResult result = run_reference(request);
    fmt::print("{}", document_text(document(result)));
    if (!result.interrupted.empty())
        tell(LogLevel::warning, fmt::format("incomplete: {}; the same command with --resume --out {} goes on", result.interrupted,
                                            shell_quoted({request.folder.string()})));
    fmt::print("{}\n", (request.folder / "reference.exr").string());
    return result.interrupted.empty() ? 0 : 1;
}

void add_solver_options(CLI::App& sub, ReferenceFlags& flags) {
    SolverSettings& solver = flags.solver;
    sub.add_option("--smooth-depth", flags.max_smooth, "whitted: most mirrors and glass surfaces in sequence")
        ->check(CLI::Range(0, 64))
        ->capture_default_str();
    sub.add_option("--reach", solver.reach_m, "radiosity, photon-map: metres around the car within which surfaces reflect light")
        ->option_text("M")
        ->check(CLI::Range(1.0, 2000.0))
        ->capture_default_str();
    sub.add_option("--patch", solver.patch_m, "radiosity: width of a patch in metres")
        ->option_text("M")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    sub.add_option("--form-factor-rays", solver.form_factor_rays, "radiosity: rays per patch, rounded to a multiple of 16")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    sub.add_option("--residual", solver.residual, "radiosity: share of the light left undistributed when iteration stops")
        ->check(CLI::Range(1e-14, 1.0))
        ->capture_default_str();
    sub.add_option("--photons", solver.photons, "photon-map: photons emitted, rounded to a multiple of 16")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 26))
        ->capture_default_str();
    sub.add_option("--photon-radius", solver.radius_m, "photon-map: metres over which light is averaged")
        ->option_text("M")
        ->check(CLI::Range(0.001, 100.0))
        ->capture_default_str();
    sub.add_flag("--no-gather", flags.no_gather, "radiosity, photon-map: show the solution without final gathering");
}

} // namespace

void add_reference_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<ReferenceFlags>();
    CLI::App* sub = app.add_subcommand("reference", "ray-trace one moment, each pixel with its standard error");
    add_shared(*sub, "DRIVE", flags->drive)->required();
    add_shared(*sub, "--moment", flags->moment_s)->capture_default_str();
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    sub->add_option("--view", flags->view, "view of the drive")->option_text("NAME")->default_str("the driver's");
    sub->add_option("--integrator", flags->integrator,
                    "direct: light of lamps and sky; path: with bounced light; whitted, radiosity, photon-map: the classical methods")
        ->check(CLI::IsMember({"direct", "path", "whitted", "radiosity", "photon-map"}))
        ->option_text("NAME")
        ->capture_default_str();
    add_solver_options(*sub, *flags);
    add_shared(*sub, "--target-error", flags->target_error)->capture_default_str();
    add_shared(*sub, "--max-samples", flags->max_samples)->check(CLI::Range(16, 1 << 24))->capture_default_str();
    add_shared(*sub, "--lamp-radius", flags->lamp_radius_m)
        ->check(CLI::Range(0.0, 1.0))
        ->default_str("lamp_radius_m of a drive with soft-map shadows, else 0");
    add_shared(*sub, "--lamp", flags->lamps);
    add_recipe_flag(*sub, flags->recipe);
    add_shared(*sub, "--road", flags->road);
    add_shared(*sub, "--resolution", flags->resolution);
    add_seed_flag(*sub, flags->seed);
    add_shared(*sub, "--out", flags->out);
    add_shared(*sub, "--resume", flags->resume);
    add_shared(*sub, "--quiet", flags->quiet);
    sub->footer("--max-samples are rounded down to a power of two, and at least 128 where light bounces. docs/reference.md tells more.");
    sub->callback([flags, command, sub, &chosen] {
        for (const CLI::Option* option : std::as_const(*sub).get_options())
            if (option->count() > 0)
                flags->given.push_back(option->get_name());
        chosen = [flags, command] { return draw_reference(*flags, command); };
    });
}

} // namespace fernlicht
