#include "runner/commands/commands.h"

#include "metrics/images/flip.h"
#include "metrics/strictness/strictness.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/picture_comparison.h"
#include "runner/experiments/compare/runs/run_comparison.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/files/page_link.h"
#include "runner/findings/library_versions.h"
#include "runner/findings/run_context.h"
#include "runner/write/document.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <fmt/format.h>
#include <limits>
#include <memory>

namespace fernlicht {
namespace {

struct CompareFlags {
    std::filesystem::path reference, tested, out, recipe;
    std::string strictness, pictures = "3", regulation, noise;
    bool lamps = false;
    std::optional<double> pixels_per_degree, view_fov_deg;
    bool json = false;
};

enum class ComparedKind { pictures, runs, lamps };

double pixels_per_degree(const CompareFlags& flags, int height_px) {
    const auto in_range = [](const char* flag, double value) {
        if (!has_flip_at(value))
            throw InputError({{}, 0, 0, flag}, fmt::format("found {:g} pixels per degree", value), "1 to 1000 of them");
        return value;
    };
    if (flags.pixels_per_degree)
        return in_range("--ppd", *flags.pixels_per_degree);
    if (!flags.view_fov_deg)
        return default_pixels_per_degree;
    if (!(*flags.view_fov_deg > 0.0 && *flags.view_fov_deg < 180.0))
        throw InputError({{}, 0, 0, "--vertical-fov"}, fmt::format("found {:g}", *flags.view_fov_deg), "degrees above 0 and below 180");
    return in_range("--vertical-fov", pixels_per_degree_of_view(radians(*flags.view_fov_deg), height_px));
}

/// The folder of --out, where there is one, and what goes into it.
class Results {
  public:
    explicit Results(const CompareFlags& flags) : flags_(flags) {
        if (!flags.out.empty())
            folder_.emplace(flags.out);
    }
    bool are_kept() const { return folder_.has_value(); }
    const std::filesystem::path& folder() const { return folder_->path(); }
    TakePlot take() const {
        return [this](const Plot& plot) { write_plot(plot, folder() / plot.name); };
    }

    /// The page, the other files, all of them complete; then what is printed. `tables`: by name.
    template <class Found>
    void finish(const Found& found, JsonMembers (*members)(Found&), const std::vector<std::pair<std::string, std::string>>& tables = {}) {
        const Document told = document(found);
        const std::string json = json_text(as_json(found, members));
        if (folder_) {
            write_file(folder() / "compare.json", json);
            for (const auto& [name, content] : tables)
                write_file(folder() / name, content);
            write_document(told, found, folder(), "report");
            folder_->finish();
        }
        fmt::print("{}", flags_.json ? json : document_text(told));
        if (folder_ && !flags_.json)
            fmt::print("\n{}\n", page_link(folder() / "report.html"));
    }

  private:
    const CompareFlags& flags_;
    std::optional<OutputFolder> folder_;
};

/// Without time and machine: equal inputs give equal bytes.
RunContext command_context(const std::vector<std::string>& command) {
    RunContext context;
    context.versions = library_versions();
    context.command = shell_quoted(command);
    return context;
}

std::optional<StrictnessClass> strictness_of(const CompareFlags& flags) {
    return flags.strictness.empty() ? std::nullopt : std::optional(read_strictness(flags.strictness));
}

int compare_two_pictures(const CompareFlags& flags, const std::vector<std::string>& command) {
    const std::optional<StrictnessClass> strictness = strictness_of(flags);
    PicturesFound found;
    found.context = command_context(command);
    StepTimes times;
    found.pair = read_picture_pair(flags.reference, flags.tested);
    times.step("reading");
    const double density = pixels_per_degree(flags, found.pair.height);
    Results results(flags);
    found.comparison = compare_pictures(found.pair, density, strictness ? &*strictness : nullptr, &times);
    if (results.are_kept())
        found.pictures = draw_difference(found.comparison, found.pair, results.take());
    times.step("drawing");
    results.finish(found, pictures_members);
    if (!flags.json)
        tell(LogLevel::info, times.text());
    return found.comparison.passed() ? 0 : 1;
}

std::size_t pictured_moments(const std::string& text) {
    if (text == "all")
        return std::numeric_limits<std::size_t>::max();
    std::size_t moments = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), moments);
    if (error != std::errc() || end != text.data() + text.size() || moments > 100000)
        throw InputError({{}, 0, 0, "--pictures"}, "found '" + printable(text) + "'", "all, or a number of moments");
    return moments;
}

int compare_two_runs(const CompareFlags& flags, const std::vector<std::string>& command) {
    if (flags.view_fov_deg)
        throw InputError({{}, 0, 0, "--vertical-fov"}, "found beside two runs", "none: the drives say what their views see");
    RunCompareOptions options;
    if (flags.pixels_per_degree)
        options.pixels_per_degree = pixels_per_degree(flags, 0);
    const std::size_t pictured = pictured_moments(flags.pictures);
    const std::optional<StrictnessClass> strictness = strictness_of(flags);
    options.strictness = strictness ? &*strictness : nullptr;
    RunFolder before = read_run_folder(flags.reference), now = read_run_folder(flags.tested);
    Results results(flags);
    RunComparison runs = compare_runs(std::move(before), std::move(now), options);
    runs.context = command_context(command);
    if (results.are_kept())
        draw_runs(runs, options, pictured, results.take());
    results.finish(runs, runs_members, {{"compare.csv", runs_csv(runs)}, {"frames.csv", frames_csv(runs)}});
    return runs.passed() ? 0 : 1;
}

int compare_two_lamps(const CompareFlags& flags, const std::vector<std::string>& command) {
    const double noise = flags.noise.empty() ? 0.0 : share_of("--noise", flags.noise);
    LampPairComparison lamps = compare_lamp_files(flags.reference, flags.tested, {noise, flags.regulation, flags.recipe});
    lamps.context = command_context(command);
    Results results(flags);
    if (results.are_kept())
        lamps.figures = lamp_figures(lamps);
    results.finish(lamps, lamps_members, {{"compare.csv", lamps_csv(lamps)}});
    return lamps.passed() ? 0 : 1;
}

/// What a path is, by what lies there. Beam textures are pictures, too: --as-lamps says that they are meant as lamps.
ComparedKind kind_of(const std::filesystem::path& path, bool lamps) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return ComparedKind::runs;
    return lamps || !is_picture(path) ? ComparedKind::lamps : ComparedKind::pictures;
}

const char* name_of(ComparedKind kind) {
    return kind == ComparedKind::runs ? "a folder" : kind == ComparedKind::pictures ? "a picture" : "no picture";
}

/// What belongs to another kind of comparison is refused rather than ignored.
void refuse_foreign_flags(const CompareFlags& flags, ComparedKind kind) {
    const auto refuse = [](bool given, const char* flag, const char* expected) {
        if (given)
            throw InputError({{}, 0, 0, flag}, "found beside what it says nothing of", expected);
    };
    if (kind != ComparedKind::lamps) {
        refuse(!flags.regulation.empty(), "--regulation", "two lamps");
        refuse(!flags.noise.empty(), "--noise", "two lamps");
        refuse(!flags.recipe.empty(), "--recipe", "two lamps");
        refuse(flags.lamps, "--as-lamps", "two lamps");
        return;
    }
    refuse(!flags.strictness.empty(), "--strictness", "two pictures or two runs");
    refuse(flags.pixels_per_degree.has_value(), "--ppd", "two pictures or two runs");
    refuse(flags.view_fov_deg.has_value(), "--vertical-fov", "two pictures");
}

int compare(const CompareFlags& flags, const std::vector<std::string>& command) {
    const ComparedKind first = kind_of(flags.reference, flags.lamps), second = kind_of(flags.tested, flags.lamps);
    if (first != second)
        throw InputError({flags.tested, 0, 0, {}}, fmt::format("is {}", name_of(second)),
                         fmt::format("{} as A is", first == ComparedKind::lamps
                                                       ? "a lamp file (--as-lamps takes pictures for beam textures)"
                                                       : name_of(first)));
    refuse_foreign_flags(flags, first);
    if (first == ComparedKind::runs)
        return compare_two_runs(flags, command);
    if (first == ComparedKind::pictures)
        return compare_two_pictures(flags, command);
    return compare_two_lamps(flags, command);
}

} // namespace

void add_compare_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<CompareFlags>();
    CLI::App* sub = app.add_subcommand(
        "compare", "show how two pictures, runs or lamps differ, in numbers and pictures, and whether they are close enough");
    take_shipped_lamps(sub->add_option("A", flags->reference,
                                       "the reference: a picture (PNG or EXR as run writes them), a run's folder, or a lamp: a file, or a "
                                       "shipped one by name"))
        ->required();
    take_shipped_lamps(sub->add_option("B", flags->tested, "what to compare with A, of the same kind"))->required();
    sub->add_option("--strictness", flags->strictness,
                    "exit with 1 if B fails it: identical, same-driver, same-light, same-picture, or a YAML file (docs/comparing.md)")
        ->option_text("NAME|FILE");
    CLI::Option* density = add_shared(*sub, "--ppd", flags->pixels_per_degree)->default_str("67.02");
    add_shared(*sub, "--vertical-fov", flags->view_fov_deg)->excludes(density);
    add_shared(*sub, "--out", flags->out);
    sub->add_option("--pictures", flags->pictures, "of two runs: moments to show of each drive and view")
        ->option_text("N|all")
        ->capture_default_str();
    add_shared(*sub, "--regulation", flags->regulation);
    add_shared(*sub, "--noise", flags->noise);
    add_recipe_flag(*sub, flags->recipe);
    sub->add_flag("--as-lamps", flags->lamps, "read pictures as beam textures");
    add_shared(*sub, "--json", flags->json);
    sub->footer("FLIP sees by --ppd or --vertical-fov. With --regulation, which two lamps may have, exit code 1 where B does not pass.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return compare(*flags, command); }; });
}

} // namespace fernlicht
