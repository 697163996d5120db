#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/stability/stability_case.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fnmatch.h>
#include <memory>

namespace fernlicht {
namespace {

struct StabilityFlags {
    std::vector<std::string> only{"*"};
    std::string backend = "auto", out;
    const OutputFormat* printed = nullptr; ///< when all cases are judged; nullptr: each as text, as it comes
    bool json = false, list = false, thorough = false;
};

/// Where the cases write their files: kept where the user names a folder, else gone with this value.
class TrialFolder {
  public:
    explicit TrialFolder(const std::string& asked) : path_(asked), kept_(!asked.empty()) {
        if (kept_) {
            std::error_code failed;
            if (std::filesystem::exists(path_, failed) && !std::filesystem::is_directory(path_, failed))
                throw InputError({path_, 0, 0, "--out"}, "is not a folder", "a folder for the cases' files");
            std::filesystem::create_directories(path_, failed);
            if (failed)
                throw InputError({path_, 0, 0, "--out"}, "cannot be made: " + failed.message(), "a folder that can be written to");
            return;
        }
        std::string name = (std::filesystem::temp_directory_path() / "fernlicht-stability-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw DeviceError("no folder can be made in " + std::filesystem::temp_directory_path().string());
        path_ = name;
    }
    ~TrialFolder() {
        std::error_code ignored;
        if (!kept_)
            std::filesystem::remove_all(path_, ignored);
    }
    TrialFolder(const TrialFolder&) = delete;
    TrialFolder& operator=(const TrialFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    bool kept_;
};

/// In the table's order, each once. Throws InputError for a pattern that fits none.
std::vector<const StabilityCase*> chosen_cases(const std::vector<std::string>& patterns) {
    std::vector<std::string> names;
    for (const StabilityCase& one : stability_cases())
        names.push_back(one.full_name());
    const auto fits = [](const std::string& pattern, const std::string& name) { return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0; };
    for (const std::string& pattern : patterns)
        if (std::ranges::none_of(names, [&](const std::string& name) { return fits(pattern, name); })) {
            const std::string nearest = nearest_name(pattern, names);
            throw InputError({{}, 0, 0, "--only"}, fmt::format("found '{}', which fits no case", printable(pattern)),
                             nearest.empty() ? "a pattern like 'lamp/*'; --list names the cases" : nearest);
        }
    std::vector<const StabilityCase*> chosen;
    for (const StabilityCase& one : stability_cases())
        if (std::ranges::any_of(patterns, [&](const std::string& pattern) { return fits(pattern, one.full_name()); }))
            chosen.push_back(&one);
    return chosen;
}

int try_cases(const StabilityFlags& flags) {
    const std::vector<const StabilityCase*> cases = chosen_cases(items_of("--only", flags.only));
    if (flags.list) {
        for (const StabilityCase* one : cases)
            fmt::print("{:<32} {}\n", one->full_name(), one->could_break);
        return 0;
    }
    const TrialFolder folder(flags.out);
    StabilityBench bench(flags.backend, folder.path(), flags.thorough);
    if (flags.backend != "auto")
        bench.device(); // what cannot be drawn with is no case that fails
    StabilityResult result;
    for (const StabilityCase* one : cases) {
        result.rows.push_back(judge(*one, bench));
        if (!flags.json && !flags.printed) {
            fmt::print("{}", document_text(document(result.rows.back())));
            std::fflush(stdout);
        }
    }
    result.device = bench.drew() ? bench.device().info().gl_renderer : "";
    if (flags.json)
        fmt::print("{}", stability_json(result));
    else if (flags.printed)
        fmt::print("{}", flags.printed->of_document(document(result)));
    else
        fmt::print("\n{}", document_text(document(result)));
    return std::ranges::all_of(result.rows, &StabilityRow::passed) ? 0 : 1;
}

} // namespace

void add_stability_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<StabilityFlags>();
    CLI::App* sub = app.add_subcommand("stability", "check extreme and degenerate inputs against bounds; exit with 1 if one fails");
    CLI::Option* only = add_shared(*sub, "--only", flags->only)->default_str("all");
    sub->add_flag_callback(
           "--equations", [flags] { flags->only = {"equation/*"}; }, "check the light equations one by one")
        ->excludes(only);
    CLI::Option* json = add_shared(*sub, "--json", flags->json);
    CLI::Option* list = add_shared(*sub, "--list", flags->list)->excludes(json);
    add_print_flags(*sub, flags->printed, {json, list});
    sub->add_flag("--thorough", flags->thorough, "search ten times as long");
    add_shared(*sub, "--backend", flags->backend);
    add_shared(*sub, "--out", flags->out);
    sub->footer("The cases' files are kept in the folder of --out.");
    sub->callback([flags, &chosen] { chosen = [flags] { return try_cases(*flags); }; });
}

} // namespace fernlicht
