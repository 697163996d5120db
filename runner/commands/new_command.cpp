#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/findings/run_context.h"
#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/library_folders.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

/// What can be begun with: a file of starters/, and how its copies are called and used.
struct Starter {
    std::string_view kind, extension, file, schema;
    const char* what;
    std::vector<const char*> next; ///< {} is the file
};

const std::vector<Starter>& lamps() {
    static const std::vector<Starter> all{
        {"table",
         ".csv",
         "lamp.csv",
         "",
         "a low beam as a table of candela, for a spreadsheet",
         {"lamp {} --check", "lamp {} --regulation r149-c", "run first-light --lamp {} --watch"}},
        {"ies",
         ".ies",
         "lamp.csv",
         "",
         "the same low beam in IES LM-63",
         {"lamp {} --check", "lamp {} --regulation r149-c", "run first-light --lamp {} --watch"}},
        {"pixels",
         ".yaml",
         "pixels.yaml",
         "pixel-lamp",
         "a pixel lamp for a high beam",
         {"lamp {}", "run first-light --lamp high={} --watch"}},
    };
    return all;
}

const Starter drive_starter{"", ".yaml", "drive.yaml", "drive", "a drive of 6 s in two lamps", {"check {}", "run {}", "run {} --watch"}};
const Starter study_starter{"",
                            ".yaml",
                            "study.yaml",
                            "study",
                            "a study of two lamps on two roads",
                            {"check {}", "study {} --frames 0:4 --no-accuracy", "study {}"}};

struct NewFlags {
    std::string name, kind;
    bool force = false;
};

/// By --kind, else by what the name ends in.
const Starter& lamp_starter(const NewFlags& flags) {
    const fs::path name = flags.name;
    std::vector<std::string_view> kinds, extensions;
    for (const Starter& one : lamps()) {
        kinds.push_back(one.kind);
        extensions.push_back(one.extension);
        if (flags.kind.empty() ? name.extension() == one.extension : flags.kind == one.kind)
            return one;
    }
    if (!flags.kind.empty())
        refuse_flag("--kind", flags.kind, fmt::format("{}", fmt::join(kinds, ", ")).c_str());
    if (name.has_extension())
        refuse_flag("NAME", flags.name, fmt::format("a name that ends in {}, or in none", fmt::join(extensions, ", ")).c_str());
    return lamps().front();
}

/// Where editors find the schema: as installed, or in the sources.
std::string schema_line(std::string_view schema) {
    std::error_code ignored;
    for (const fs::path& folder : library_folders())
        for (const fs::path& place : {folder / "schemas", folder.parent_path()})
            if (const fs::path file = place / fmt::format("{}.schema.json", schema); fs::exists(file, ignored))
                return fmt::format("# yaml-language-server: $schema={}\n", file.string());
    return "";
}

void write_new(const Starter& starter, const fs::path& path) {
    const fs::path file = shipped_file(fs::path("starters") / starter.file, "new");
    if (starter.kind == "ies") {
        LampFile lamp = read_lamp(file);
        lamp.opened.clear();
        return write_lamp(lamp, path);
    }
    FilesRead opened;
    std::string text = read_file(file, opened);
    if (!starter.schema.empty())
        text.replace(0, text.find('\n') + 1, schema_line(starter.schema));
    write_file(path, text);
}

int begin(const Starter& starter, const NewFlags& flags, const char* usual_name) {
    fs::path path = flags.name.empty() ? fs::path(usual_name) : fs::path(flags.name);
    refuse_windows_path(path, {{}, 0, 0, "NAME"});
    if (path.extension() != starter.extension) {
        if (path.has_extension())
            refuse_flag("NAME", flags.name, fmt::format("a name that ends in {}, or in none", starter.extension).c_str());
        path += starter.extension;
    }
    if (std::error_code ignored; fs::is_directory(path, ignored))
        refuse_flag("NAME", path.string(), "the name of a file, not of a folder");
    if (const fs::path folder = path.parent_path(); !folder.empty() && !fs::is_directory(folder))
        throw InputError({{}, 0, 0, "NAME"}, "there is no folder " + printable(folder.string(), 400), "a file in a folder that is there");
    check_target("NAME", path, flags.force);
    write_new(starter, path);
    fmt::print("{}: {}. Next:\n", path.string(), starter.what);
    for (const char* const next : starter.next)
        fmt::print("  fernlicht {}\n", fmt::format(fmt::runtime(next), shell_quoted({path.string()})));
    return 0;
}

} // namespace

void add_new_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    CLI::App* const sub = app.add_subcommand("new", "write a file to start from, with comments: a lamp, a drive or a study");
    sub->require_subcommand(1);
    const auto add = [&](const char* name, const char* text, const std::function<const Starter&(const NewFlags&)>& choose) {
        const auto flags = std::make_shared<NewFlags>();
        CLI::App* const one = sub->add_subcommand(name, text);
        one->add_option("NAME", flags->name, "name of the file")->default_str(name);
        add_shared(*one, "--force", flags->force);
        one->callback([flags, choose, name, &chosen] { chosen = [flags, choose, name] { return begin(choose(*flags), *flags, name); }; });
        return std::pair(one, flags);
    };
    const auto [lamp, flags] = add("lamp", "a low beam as a table (.csv) or in IES (.ies), or a pixel lamp (.yaml)", lamp_starter);
    lamp->add_option("--kind", flags->kind, "what to write")->option_text("table|ies|pixels")->default_str("as the name ends, else table");
    add("drive", "a drive of six seconds in two lamps", [](const NewFlags&) -> const Starter& { return drive_starter; });
    add("study", "a study that compares two lamps on two roads", [](const NewFlags&) -> const Starter& { return study_starter; });
}

} // namespace fernlicht
