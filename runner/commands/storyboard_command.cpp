#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "scenarios/openscenario/play_story.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/xml_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <iterator>
#include <memory>

namespace fernlicht {
namespace {

struct StoryboardFlags {
    std::filesystem::path file;
    std::vector<std::string> road_folders, parameters;
    std::string road, out;
    double max_s = 60.0, step_s = 0.01;
    bool lenient = false, brief = false, force = false;
};

osc::StoryboardOptions options_of(const StoryboardFlags& flags) {
    osc::StoryboardOptions options;
    options.lenient = flags.lenient;
    options.road = flags.road;
    for (const std::string& folder : flags.road_folders)
        options.road_folders.emplace_back(folder);
    for (const std::string& parameter : flags.parameters) {
        const std::size_t at = parameter.find('=');
        if (at == std::string::npos || at == 0)
            refuse_flag("--parameter", parameter, "NAME=VALUE");
        options.parameters[parameter.substr(0, at)] = parameter.substr(at + 1);
    }
    return options;
}

/// One row for each step and entity that is there.
void add_rows(const osc::PlayedStory& story, const RoadNetwork& network, int number, std::string& out) {
    for (std::size_t i = 0; i < story.ticks(); ++i)
        for (const osc::PlayedEntity& entity : story.entities) {
            const osc::EntitySample& at = entity.samples[i];
            if (!at.present)
                continue;
            std::string name = entity.entity.name;
            std::ranges::replace(name, ',', ' ');
            fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", number,
                           static_cast<double>(i) * story.step_s, name, at.position_m.x, at.position_m.y, at.position_m.z, at.heading_rad,
                           at.pitch_rad, at.roll_rad, at.speed_mps, at.road < network.roads.size() ? network.roads[at.road].id : "",
                           at.lane, at.s_m, at.t_m, at.visible ? 1 : 0);
        }
}

/// Plays one storyboard; tells what is in it and how it ended.
void play(const StoryboardFlags& flags, const std::filesystem::path& file, const osc::StoryboardOptions& options, int number,
          std::string& rows) {
    const osc::Storyboard story = osc::read_storyboard(file, options);
    const RoadNetwork network = story.road_file.empty() ? RoadNetwork{} : read_opendrive(story.road_file);
    const osc::PlayedStory played = osc::play_story(story, network, {.step_s = flags.step_s, .max_s = flags.max_s});
    add_rows(played, network, number, rows);
    std::FILE* const told = flags.out == "-" ? stderr : stdout;
    fmt::print(told, "{}: {:.6g} s, until {}\n", file.string(),
               static_cast<double>(std::max<std::size_t>(played.ticks(), 1) - 1) * played.step_s, played.end);
    if (flags.brief)
        return;
    for (const osc::PlayedEntity& entity : played.entities) {
        const osc::EntitySample last = entity.samples.empty() ? osc::EntitySample{} : entity.samples.back();
        if (last.present)
            fmt::print(told, "  {}: at ({:.3f}, {:.3f}, {:.3f}) m, {:.3f} m/s, {} light changes\n", printable(entity.entity.name),
                       last.position_m.x, last.position_m.y, last.position_m.z, last.speed_mps, entity.lights.size());
        else
            fmt::print(told, "  {}: not there at the end\n", printable(entity.entity.name));
    }
    for (const auto* notes : {&story.notes, &played.notes})
        for (const std::string& note : *notes)
            fmt::print(told, "  note: {}\n", note);
}

bool is_variation(const std::filesystem::path& file) {
    FilesRead ignored;
    return XmlFile(file, ignored, "OpenSCENARIO", "an OpenSCENARIO file").root().child("ParameterValueDistribution");
}

int run(const StoryboardFlags& flags) {
    if (!(flags.max_s > 0.0 && flags.max_s <= 1e5))
        refuse_flag("--duration", fmt::format("{}", flags.max_s), "seconds above 0, at most 100 000");
    if (!(flags.step_s >= 1e-4 && flags.step_s <= 1.0))
        refuse_flag("--step", fmt::format("{}", flags.step_s), "seconds from 0.0001 to 1");
    check_target("--out", flags.out, flags.force);
    osc::StoryboardOptions options = options_of(flags);
    std::string rows = "case,time_s,entity,x_m,y_m,z_m,heading_rad,pitch_rad,roll_rad,speed_mps,road,lane,s_m,t_m,visible\n";
    if (is_variation(flags.file)) {
        FilesRead opened;
        const osc::Variations variations = osc::read_variations(flags.file, opened);
        int number = 0;
        for (const auto& values : variations.cases) {
            std::string told;
            for (const auto& [name, value] : values) {
                options.parameters[name] = value;
                told += fmt::format(" {}={}", printable(name), printable(value));
            }
            fmt::print(flags.out == "-" ? stderr : stdout, "case {}:{}\n", number, told);
            play(flags, variations.scenario, options, number++, rows);
        }
    } else {
        play(flags, flags.file, options, 0, rows);
    }
    if (!flags.out.empty())
        write_file(flags.out, rows);
    return 0;
}

} // namespace

void add_storyboard_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<StoryboardFlags>();
    CLI::App* sub = app.add_subcommand("storyboard", "play an OpenSCENARIO XML file without rendering, and report where everything goes");
    sub->add_option("FILE", flags->file, "storyboard or parameter variation, of which all cases are played; or - for standard input")
        ->required();
    add_shared(*sub, "--road", flags->road);
    add_shared(*sub, "--road-folder", flags->road_folders);
    sub->add_option("--parameter", flags->parameters, "value of a parameter that the file declares")
        ->option_text("NAME=VALUE")
        ->allow_extra_args(false);
    add_shared(*sub, "--duration", flags->max_s)->default_str("60 at most");
    sub->add_option("--step", flags->step_s, "time step in seconds")->option_text("S")->capture_default_str();
    add_shared(*sub, "-o,--out", flags->out);
    add_shared(*sub, "--force", flags->force);
    add_shared(*sub, "--lenient", flags->lenient);
    sub->add_flag("--brief", flags->brief, "list neither entities nor notes");
    sub->footer("The file of --out is a CSV with one row per step and entity; what is printed goes to standard error beside `--out -`.");
    sub->callback([flags, &chosen] { chosen = [flags] { return run(*flags); }; });
}

} // namespace fernlicht
