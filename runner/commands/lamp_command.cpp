#include "runner/commands/lamp_command.h"

#include "runner/commands/commands.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/watch.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/compare/lamps/lamp_description.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/files/json_text.h"
#include "runner/files/output_folder.h"
#include "runner/findings/plots/isocandela.h"
#include "runner/write/document.h"
#include "runner/write/plots/png.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/lamps/level_track.h"
#include "scenarios/lamps/pixel_state.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

LampFile modelled(const std::string& name) {
    std::vector<std::string> names;
    for (const LampModel& model : lamp_models()) {
        if (model.name == name)
            return lamp_of_model(model);
        names.push_back(model.name);
    }
    throw InputError({{}, 0, 0, "--lamp-model"}, "found '" + printable(name) + "'", fmt::format("one of {}", fmt::join(names, ", ")));
}

void scale(LampFile& lamp, double factor) {
    if (!(factor > 0.0) || !(factor <= 1e6))
        throw InputError({{}, 0, 0, "--scale"}, fmt::format("found {}", factor), "a number above 0, up to 1000000");
    lamp.table = scaled(std::move(lamp.table), factor);
    if (lamp.measured)
        lamp.measured = scaled(std::move(*lamp.measured), factor);
    if (lamp.declared_flux_lm)
        *lamp.declared_flux_lm *= factor;
    lamp.notes.push_back(fmt::format("intensities scaled by {}", factor));
}

void add(LampFile& lamp, const LampFile& other) {
    lamp.table = sum(lamp.table, other.table);
    lamp.measured.reset();
    if (lamp.declared_flux_lm && other.declared_flux_lm)
        *lamp.declared_flux_lm += *other.declared_flux_lm;
    else
        lamp.declared_flux_lm.reset();
    lamp.notes.push_back(fmt::format("added: {}", other.name));
}

void subtract(LampFile& lamp, const LampFile& other) {
    std::size_t clamped = 0;
    lamp.table = difference(lamp.table, other.table, clamped);
    lamp.measured.reset();
    lamp.declared_flux_lm.reset();
    lamp.notes.push_back(
        fmt::format("subtracted: {}; {} of {} samples would be negative and were set to 0", other.name, clamped, lamp.table.cd.size()));
}

/// What was done to a lamp, for files that are written of it. What its labels say is of the lamp before.
void label_changes(LampFile& lamp, const std::vector<std::string>& changes) {
    if (!changes.empty())
        lamp.labels.emplace_back("OTHER", fmt::format("changed, other texts are of the lamp before: {}", fmt::join(changes, "; ")));
}

/// A pixel lamp as it shines at that time of a file of levels, with its own delays, or as it shone in a run: an ordinary lamp from then on.
void set_levels(LampFile& lamp, const std::filesystem::path& file, double time_s, const std::string& of_lamp) {
    if (!lamp.pixels)
        throw InputError({file, 0, 0, "--levels"}, "found levels of a lamp without pixels", "a pixel lamp (docs/pixel-lamps.md)");
    std::optional<ShownLevels> shown = read_shown_levels(file, *lamp.pixels, of_lamp, time_s, lamp.opened);
    if (!shown && !of_lamp.empty())
        throw InputError({file, 0, 0, "--levels-lamp"}, "found with levels that belong to no lamp of a car", "levels-*.csv of a run");
    if (!shown)
        shown.emplace(ShownLevels{1.0, read_levels(file, std::make_shared<const LampFile>(lamp), lamp.opened)->levels(time_s)});
    const PixelState state = PixelStates(lamp.pixels).of(shown->pixels);
    const std::size_t count = lamp.pixels->count();
    const std::size_t boxes = state.dark.size() + state.more_dark;
    std::string dark = boxes > 1 ? fmt::format("; dark in {} boxes", boxes) : "";
    for (const AngleBox& box : state.dark)
        dark += fmt::format("{}H {:.4g} to {:.4g}, V {:.4g} to {:.4g}",
                            &box != &state.dark.front() ? "; "
                            : boxes > 1                 ? ": "
                                                        : "; dark at ",
                            box.left_deg, box.right_deg, box.bottom_deg, box.top_deg);
    if (state.more_dark > 0)
        dark += fmt::format("; and {} more", state.more_dark);
    const std::string whole = shown->level == 1.0 ? "" : fmt::format(", the lamp as a whole at {:.4g} %", 100.0 * shown->level);
    lamp.notes.push_back(fmt::format("levels of {} at {:g} s: {} of {} parts shine, {:.4g} % of the flux{}{}", file.filename().string(),
                                     time_s, state.lit, count, 100.0 * state.flux, whole, dark));
    lamp.table = lamp.pixels->table(shown->pixels);
    if (shown->level != 1.0)
        lamp.table = scaled(std::move(lamp.table), shown->level);
    lamp.pixels.reset();
}

LampFile read_other(const std::filesystem::path& path, const LampReadOptions& reading, LampFile& lamp) {
    LampFile other = read_lamp(path, reading);
    lamp.opened.insert(lamp.opened.end(), other.opened.begin(), other.opened.end());
    return other;
}

/// What is read is never replaced, what else is there by --force alone.
void refuse_to_overwrite(const LampRequest& request, const std::filesystem::path& out, const char* option) {
    if (out == "-")
        return;
    const auto same = [&](const std::filesystem::path& in) {
        std::error_code ignored; // a path that is not there is no input
        return !in.empty() && std::filesystem::equivalent(in, out, ignored);
    };
    bool input = same(request.file);
    input = input || same(request.against) || same(request.levels) || same(request.other_side);
    for (const auto* list : {&request.add, &request.subtract})
        for (const auto& path : *list)
            input = input || same(path);
    if (input)
        throw InputError({out, 0, 0, option}, "found a file that is read", "another name to write to");
    if (!request.force && std::filesystem::exists(std::filesystem::symlink_status(out)))
        throw InputError({out, 0, 0, option}, "found a file of that name", "another name to write to, or --force");
    refuse_unwritable(option, out, {}, true);
}

std::optional<plots::AngleWindow> window_of(const std::vector<double>& edges) {
    if (edges.empty())
        return std::nullopt;
    const plots::AngleWindow w{edges.at(0), edges.at(1), edges.at(2), edges.at(3)};
    const bool fits = w.left_deg >= -180.0 && w.left_deg < w.right_deg && w.right_deg <= 360.0 && w.bottom_deg >= -90.0 &&
                      w.bottom_deg < w.top_deg && w.top_deg <= 90.0;
    if (!fits)
        throw InputError({{}, 0, 0, "--window"}, fmt::format("found {}", fmt::join(edges, " ")),
                         "degrees of the left, right, bottom and top edge");
    return w;
}

void check_picture_name(const std::filesystem::path& path) {
    if (!path.empty() && path != "-" && path.extension() != ".png" && path.extension() != ".svg")
        throw InputError({path, 0, 0, "--picture"}, fmt::format("found extension '{}'", printable(path.extension().string())),
                         ".svg or .png");
}

/// An option with a fixed set of words; another word is an InputError.
template <class Value> void add_choice(CLI::App& command, const std::string& name, Value& value,
                                       std::vector<std::pair<std::string, Value>> choices, const char* text) {
    std::vector<std::string> words;
    for (const auto& choice : choices)
        words.push_back(choice.first);
    const std::string expected = fmt::format("{}", fmt::join(words, "|"));
    command
        .add_option_function<std::string>(
            name,
            [name, &value, choices = std::move(choices), expected](const std::string& word) {
                for (const auto& choice : choices) {
                    if (choice.first == word) {
                        value = choice.second;
                        return;
                    }
                }
                throw InputError({{}, 0, 0, name}, "found '" + printable(word) + "'", expected);
            },
            text)
        ->option_text(expected);
}

void add_texture_options(CLI::App& command, LampReadOptions& reading) {
    const char* group = "Beam textures (where the image has no metadata)";
    command.add_option("--texture-scale", reading.texture_scale_lx, "lux for a pixel value of 1 (8-bit: 255)")
        ->option_text("LX")
        ->group(group);
    command.add_option("--texture-distance", reading.texture_distance_m, "distance in metres of --texture-scale")
        ->option_text("M")
        ->capture_default_str()
        ->group(group);
    const auto extent = [&](const char* name, double(&edges)[2], const char* names, const char* text) {
        command
            .add_option_function<std::vector<double>>(
                name,
                [&edges](const std::vector<double>& values) {
                    edges[0] = values[0];
                    edges[1] = values[1];
                },
                text)
            ->expected(2)
            ->option_text(names)
            ->group(group);
    };
    extent("--texture-h", reading.texture_h_extent_deg, "LEFT RIGHT", "left and right edge in degrees");
    extent("--texture-v", reading.texture_v_extent_deg, "BOTTOM TOP", "bottom and top edge in degrees");
}

/// In place of the description; the picture is that of the difference.
int tell_apart(const LampFile& lamp, const LampRequest& request) {
    if (request.spots || !request.convert.empty())
        throw InputError({{}, 0, 0, "--against"}, "found --spots or --convert beside it", "one of them");
    const LampFile other = read_lamp(request.against, request.reading);
    const LampDifference difference = difference_of(lamp, other, request.noise_relative);
    if (!request.picture.empty()) {
        write_lamp_picture(difference_figure(lamp, other, difference), request);
    }
    if (request.json)
        fmt::print("{}", json_text(difference_json(difference)));
    else if (request.picture != "-") {
        for (const auto& [what, text] : difference_lines(lamp, other, difference))
            fmt::print("{:<14} {}\n", what, text);
        fmt::print("\n{}", table_text(named_places_table(difference)));
    }
    return 0;
}

} // namespace

void write_lamp_picture(const plots::Figure& figure, const LampRequest& request) {
    const bool as_png = request.picture.extension() == ".png";
    const std::string svg = plots::svg_of(figure, as_png ? 0 : plots::drawing_zlib);
    write_file(request.picture, as_png ? plots::png_of_svg(svg) : svg);
}

LampFile lamp_of(const LampRequest& request) {
    if (request.file.empty() == request.model.empty())
        throw InputError({}, request.file.empty() ? "found no lamp" : "found both a file and --lamp-model",
                         "a lamp file or --lamp-model NAME");
    LampFile lamp = request.model.empty() ? read_lamp(request.file, request.reading) : modelled(request.model);
    if (lamp.pixels && request.reading != LampReadOptions{.rule = request.reading.rule, .recipe = request.reading.recipe})
        throw InputError({request.file, 0, 0, {}}, "found --axis or a flag of textures for a pixel lamp", "none of them");
    if (!request.model.empty())
        lamp.table.rule = request.reading.rule;
    std::vector<std::string> changes;
    if (request.levels.empty() != !request.levels_s)
        throw InputError({{}, 0, 0, request.levels_s ? "--at" : "--levels"}, "found it alone", "--levels FILE and --at S, both or neither");
    if (request.levels_s) {
        if (!(*request.levels_s >= 0.0 && *request.levels_s <= 1e6))
            throw InputError({{}, 0, 0, "--at"}, fmt::format("found {}", *request.levels_s), "a time from 0 to 1000000 s");
        set_levels(lamp, request.levels, *request.levels_s, request.levels_lamp);
        changes.push_back(fmt::format("pixels as in {} at {:g} s", request.levels.filename().string(), *request.levels_s));
    }
    if (request.scale != 1.0) {
        scale(lamp, request.scale);
        changes.push_back(fmt::format("scaled by {}", request.scale));
    }
    if (request.mirror) {
        mirror(lamp);
        lamp.notes.emplace_back("mirrored: left and right exchanged");
        changes.emplace_back("mirrored, left and right traffic exchanged");
    }
    for (const auto& path : request.add) {
        const LampFile other = read_other(path, request.reading, lamp);
        add(lamp, other);
        changes.push_back("added " + other.name);
    }
    for (const auto& path : request.subtract) {
        const LampFile other = read_other(path, request.reading, lamp);
        subtract(lamp, other);
        changes.push_back("subtracted " + other.name);
    }
    label_changes(lamp, changes);
    return lamp;
}

int lamp_command(const LampRequest& request) {
    if (request.check)
        return lamp_check(request);
    refuse_check_options(request);
    if (!request.regulation.empty())
        return lamp_regulation(request);
    check_picture_name(request.picture);
    const bool prints_file = request.picture == "-" || request.convert == "-";
    if (prints_file && (request.json || request.picture == request.convert))
        throw InputError({{}, 0, 0, request.picture == "-" ? "--picture" : "--convert"},
                         fmt::format("found standard output beside {}", request.json ? "--json" : "--convert"), "one thing to print");
    if (!request.picture.empty())
        refuse_to_overwrite(request, request.picture, "--picture");
    if (request.cut_off)
        return lamp_cut_off(request);
    refuse_regulation_options(request);
    if (request.spots && (*request.spots < 1 || *request.spots > max_spots))
        throw InputError({{}, 0, 0, "--spots"}, fmt::format("found {}", *request.spots), fmt::format("1 to {}", max_spots));
    if (!request.convert.empty())
        refuse_to_overwrite(request, request.convert, "--convert");
    const LampFile lamp = lamp_of(request);
    if (!request.against.empty())
        return tell_apart(lamp, request);
    LampDescription description = describe(lamp);
    if (request.spots)
        description.spots = fit_spots(lamp.table, *request.spots);
    if (!request.convert.empty())
        write_lamp(lamp, request.convert);
    if (!request.picture.empty())
        write_lamp_picture(plots::isocandela_diagram(lamp.table, lamp.name, window_of(request.window)), request);
    if (!prints_file)
        fmt::print("{}", request.json ? json_of(description) : text_of(description));
    return 0;
}

namespace {

int lamp_turn(LampRequest request, WatchTurn& turn) {
    if (request.watch) {
        for (const std::filesystem::path* const file :
             {&request.file, &request.against, &request.levels, &request.reading.recipe, &request.aim_by})
            turn.reads(*file);
        for (const auto* const files : {&request.add, &request.subtract})
            for (const std::filesystem::path& file : *files)
                turn.reads(file);
        turn.reads(lamp_of(request).opened);
        request.force = request.force || turn.is_again(); // its own files
    }
    return lamp_command(request);
}

} // namespace

void add_lamp_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto request = std::make_shared<LampRequest>();
    CLI::App* command = app.add_subcommand("lamp", "describe a lamp file; scale, mirror, add, convert or plot it");
    take_shipped_lamps(command->add_option(
        "FILE", request->file, lamp_format_list() + "; text grids with --recipe; a shipped one by name; or - for standard input"));
    add_shared(*command, "--lamp-model", request->model);
    add_shared(*command, "--json", request->json);
    add_shared(*command, "--picture", request->picture);
    add_shared(*command, "--force", request->force);
    command->add_option("--window", request->window, "edges of the picture in degrees")
        ->expected(4)
        ->option_text("LEFT RIGHT BOTTOM TOP")
        ->allow_extra_args(false);
    command->add_option("--spots", request->spots, "fit this many OpenGL 1.x spot lights, 1 to 8, and report the residual");
    command
        ->add_option("--convert", request->convert,
                     "new file for the lamp: .ies (LM-63-2002, type A), .csv (beam matrix) or .exr (beam texture); - prints LM-63")
        ->option_text("FILE");
    command
        ->add_option("--levels", request->levels,
                     "of a pixel lamp: levels of its pixels over time (CSV), as a drive takes them, or levels-*.csv of a run")
        ->option_text("FILE");
    command->add_option("--levels-lamp", request->levels_lamp, "with levels-*.csv of several lamps: which lamp to take")
        ->option_text("NAME");
    command
        ->add_option_function<double>(
            "--at", [request](double s) { request->levels_s = s; }, "with --levels: the time in seconds at which the lamp is looked at")
        ->option_text("S");
    command->add_option("--scale", request->scale, "multiply the intensities")->option_text("FACTOR")->capture_default_str();
    command->add_flag("--mirror", request->mirror, "swap left and right: right-hand to left-hand traffic and back");
    command->add_option("--add", request->add, "add another lamp's light")->option_text("FILE")->allow_extra_args(false);
    command->add_option("--subtract", request->subtract, "subtract another lamp's light; negative results become 0 and are counted")
        ->option_text("FILE")
        ->allow_extra_args(false);
    command
        ->add_option("--other-side", request->other_side,
                     "the lamp of the other side, for --check and for tables that judge half the sum of both")
        ->option_text("FILE");
    take_shipped_lamps(command->add_option("--against", request->against,
                                           "report what differs from this lamp (aim, cut-off, level, zones, and at 75R, 50V, B50L, kerb "
                                           "shoulder, foreground and other named places) and what is only noise"))
        ->option_text("FILE");
    add_shared_taken(*command, "--noise", [request](const std::string& text) { request->noise_relative = share_of("--noise", text); });
    add_choice(*command, "--rule", request->reading.rule, {{"linear", BetweenSamples::linear_cd}, {"log", BetweenSamples::log_cd}},
               "interpolation between samples: linear (in cd) or log (in log cd)");
    add_choice(*command, "--axis", request->reading.type_c_axis,
               {{"automatic", TypeCAxis::automatic}, {"horizontal", TypeCAxis::horizontal}, {"nadir", TypeCAxis::nadir}},
               "where Type C and EULUMDAT beams point");
    add_recipe_flag(*command, request->reading.recipe);
    add_texture_options(*command, request->reading);
    add_check_options(*command, *request);
    add_regulation_options(*command, *request);
    command->footer(
        "Changes are applied in this order: levels, scale, mirror, add, subtract; those from scale on to the lamp of --other-side, too. "
        "The picture, .svg or .png, is the isocandela diagram; "
        "with --against the difference, with --cut-off its scans and the elbow. What goes to standard output takes the place of the "
        "description.");
    add_watch_flag(*command, request->watch);
    command->callback([request, &chosen] {
        chosen = [request] { return watched(request->watch, [&](WatchTurn& turn) { return lamp_turn(*request, turn); }); };
    });
}

} // namespace fernlicht
