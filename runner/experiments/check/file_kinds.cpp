#include "runner/experiments/check/file_kinds.h"

#include "metrics/beam/intake.h"
#include "metrics/folds/reading_names.h"
#include "metrics/folds/seeing_fold.h"
#include "metrics/strictness/strictness.h"
#include "renderer/technique.h"
#include "runner/experiments/fit/lux_points.h"
#include "runner/experiments/study/study_run.h"
#include "runner/files/picture_file.h"
#include "runner/findings/lamp_checks.h"
#include "runner/judge/known_failures.h"
#include "runner/play/stage.h"
#include "scenarios/can/can_database.h"
#include "scenarios/can/candump_stream.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/control/fmu/fmu_description.h"
#include "scenarios/control/fmu/zip_module.h"
#include "scenarios/display/display_profile.h"
#include "scenarios/drives/play/drive_log.h"
#include "scenarios/lamps/grid_recipe.h"
#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/models/model.h"
#include "scenarios/openscenario/play_story.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "scenarios/ratings/rating.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/values/files.h"
#include "scenarios/values/library_folders.h"
#include "scenarios/values/picture_decoding.h"
#include "scenarios/values/program_module.h"
#include "scenarios/values/refusals.h"
#include "scenarios/values/xml_file.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

namespace fernlicht {

FileProblem problem_of(const InputError& error) {
    const std::string text = error.what();
    const InputError::Where& where = error.where();
    std::size_t at = 0; // as InputError puts the place in front
    if (!where.file.empty())
        at += printable(where.file.string(), 400).size();
    if (where.line > 0)
        at += 1 + std::to_string(where.line).size();
    if (where.line > 0 && where.column > 0)
        at += 1 + std::to_string(where.column).size();
    return {where, true, text.substr(at > 0 ? std::min(at + 2, text.size()) : 0)};
}

bool FileLook::tries(const std::function<void()>& reads) {
    const std::vector<InputError> refused = all_refusals(reads);
    for (const InputError& error : refused)
        problems.push_back(problem_of(error));
    return refused.empty();
}

void FileLook::warn(const InputError::Where& where, const std::string& text) { problems.push_back({where, false, text}); }

namespace {

namespace fs = std::filesystem;

/// "FILE:LINE: text", as readers of XML warn.
void warn_as_told(FileLook& look, const fs::path& file, const std::string& told) {
    const std::string before = file.string() + ":";
    InputError::Where where{file, 0, 0, {}};
    std::string text = told;
    if (told.starts_with(before)) {
        const auto [end, error] = std::from_chars(told.data() + before.size(), told.data() + told.size(), where.line);
        if (error == std::errc{} && std::string_view(end, 1) == ":")
            text = told.substr(std::min(static_cast<std::size_t>(end - told.data()) + 2, told.size()));
    }
    look.warn(where, text);
}

/// The road and all else that is made before the first frame; with that gives the side of the road. Plug-ins are not run, nor what comes
/// after them.
void look_at_stage(const Drive& drive, FileLook& look, bool* left_hand = nullptr, const std::function<void(const Stage&)>& more = {}) {
    const bool has_plugins = std::ranges::any_of(
        drive.lamp_sets, [](const LampSet& lamp_set) { return lamp_set.control && !lamp_set.control->plugins.empty(); });
    if (has_plugins) {
        look.kind += ", its plug-ins not run";
        look.tries([&] { read_opendrive(drive.road_file); });
        return;
    }
    const bool is_staged = look.tries([&] {
        const Stage stage(drive);
        for (const std::string& warning : stage.network.warnings)
            warn_as_told(look, drive.road_file, warning);
        if (more)
            more(stage);
        if (left_hand)
            return void(*left_hand = left_hand_traffic(stage));
        LampFileChecks lamps;
        lamps.add(stage.drive, left_hand_traffic(stage));
        for (const std::string& warning : lamp_warnings(lamps.files()))
            look.warn({drive.file, 0, 0, {}}, warning);
    });
    if (!is_staged)
        look.tries([&] { refuse_each(drive); });
}

/// A drive's reader takes any name of a technique; the renderer alone knows which there are.
void look_at_technique(const YamlValue& document, const fs::path& path, FileLook& look) {
    for (const YamlMember& member : document.members)
        if (member.key == "technique" && member.value.kind == YamlValue::Kind::scalar)
            look.tries([&] { technique_named(member.value.text, path); });
}

/// What is only found wrong on the road knows its key alone: it stands where that does, or the nearest key above it.
void give_places(const YamlValue& document, const fs::path& path, FileLook& look) {
    for (FileProblem& problem : look.problems) {
        if (problem.where.line > 0 || fs::absolute(problem.where.file).lexically_normal() != fs::absolute(path).lexically_normal())
            continue;
        const YamlValue* in = &document;
        std::istringstream parts(problem.where.key);
        for (std::string part; in && std::getline(parts, part, '.');) {
            const auto member = std::ranges::find(in->members, part, &YamlMember::key);
            in = member == in->members.end() ? nullptr : &member->value;
            if (in) {
                problem.where.line = member->line;
                problem.where.column = member->column;
            }
        }
    }
}

void check_drive_file(const fs::path& path, FileLook& look) {
    std::optional<Drive> drive;
    FileLook first;
    if (!first.tries([&] { drive = read_drive(path); }) && first.problems.size() == 1 && first.problems[0].where.key == "lamp_sets" &&
        first.problems[0].text.find("missing") != std::string::npos) {
        DriveEdits edits;
        edits.lamp_sets = shipped_path("lamp_sets/halogen.yaml");
        first.problems.clear();
        if (first.tries([&] { drive = read_drive(path, edits); }))
            look.warn({path, 0, 0, {}}, "has no lamp sets: `fernlicht rate` brings some, `fernlicht run` refuses it");
    }
    YamlValue document; // of what is no YAML the reader has told
    FilesRead opened;
    FileLook().tries([&] { document = parse_yaml(read_file(path, opened), path); });
    const bool is_good = drive && first.problems.empty();
    look_at_technique(document, path, first);
    if (is_good && !first.problems.empty())
        drive->technique = Drive().technique; // so that the rest is looked at
    if (is_good)
        look_at_stage(*drive, first);
    give_places(document, path, first);
    look.kind += first.kind;
    std::ranges::move(first.problems, std::back_inserter(look.problems));
}

constexpr std::size_t most_cells = 500, most_problems = 1000;

/// Readings that a study names and no drive of it can have: each refusal by name, as the drive says it that was looked at first.
class StudyReadings {
  public:
    explicit StudyReadings(const Study& study) {
        if (std::ranges::any_of(study.axes, [](const StudyAxis& axis) { return axis.key.starts_with("measure."); }))
            return; // each point measures something else, and one drive is looked at
        for (const StudyLimit& limit : study.limits)
            asked_.emplace(limit.reading, Asked{{study.file, limit.line, 0, "limits"}, {}});
        if (study.decide != decides_by_default())
            for (const std::string& name : study.decide)
                asked_.emplace(name, Asked{{study.file, 0, 0, "decide"}, {}});
        std::erase_if(asked_, [](const auto& one) { return one.first.find_first_of("*?") != std::string::npos; });
    }
    void look_at(const Stage& stage) {
        const Readings readings = asked_.empty() ? Readings{} : SeeingFold(stage.drive, stage.route).readings();
        for (auto one = asked_.begin(); one != asked_.end();) {
            Drive drive = stage.drive;
            drive.file = one->second.where.file;
            drive.limits = {{one->first, 0.0, std::nullopt, one->second.where.line}};
            const std::vector<InputError> refused = all_refusals([&] { check_names(drive, readings, &stage.route); });
            if (!refused.empty() && one->second.why.empty()) {
                const std::string why = problem_of(refused.front()).text; // "limits: found ..."
                one->second.why = one->second.where.key + why.substr(why.find(':'));
            }
            one = refused.empty() ? asked_.erase(one) : std::next(one);
        }
    }
    void tell(FileLook& look) const {
        for (const auto& [name, asked] : asked_)
            look.problems.push_back({asked.where, true, asked.why});
    }

  private:
    struct Asked {
        InputError::Where where;
        std::string why;
    };
    std::map<std::string, Asked> asked_;
};

void check_study_file(const fs::path& path, FileLook& look) {
    std::optional<Study> study;
    if (!look.tries([&] { study = read_study(path); }))
        return;
    std::set<fs::path> drives(study->drives.begin(), study->drives.end());
    bool all_good = true;
    for (const fs::path& drive : drives) {
        const std::size_t before = look.problems.size();
        FileLook of_drive;
        all_good = of_drive.tries([&] { read_drive(drive); }) && all_good;
        std::ranges::move(of_drive.problems, std::back_inserter(look.problems));
        all_good = all_good && look.problems.size() == before;
    }
    if (!all_good)
        return; // each cell would say the same
    const std::vector<StudyCell> cells = cells_of(*study);
    if (cells.size() > most_cells)
        look.kind += fmt::format(", {} of {} cells", most_cells, cells.size());
    LampFileChecks lamps;
    const bool all_read = look.tries([&] {
        EachRead each;
        each([&] { refuse_unaimable(*study); });
        each([&] { refuse_unknown_readings(*study); });
        const std::size_t looked_at = std::min(cells.size(), most_cells);
        for (std::size_t i = 0; i < looked_at; ++i) // over all of the study
            each([&] { cell_drive(*study, cells[i * cells.size() / looked_at]); });
        each.end();
    });
    if (!all_read)
        return;
    std::set<std::size_t> drives_seen, lamps_seen;
    bool left_hand = false;
    StudyReadings readings(*study);
    const auto errors = [&] { return std::ranges::count(look.problems, true, &FileProblem::is_error); };
    const auto before = errors();
    for (const StudyCell& cell : cells) { // each road and each lamp once
        const bool is_new_drive = drives_seen.insert(cell.drive).second, is_new_lamp = lamps_seen.insert(cell.lamp).second;
        if (!is_new_drive && !is_new_lamp)
            continue;
        const Drive drive = cell_drive(*study, cell);
        if (is_new_drive)
            look_at_stage(drive, look, &left_hand, [&](const Stage& stage) { readings.look_at(stage); });
        if (is_new_lamp)
            lamps.add(drive, left_hand);
    }
    if (errors() == before) { // else some drive was not looked at
        readings.tell(look);
        FilesRead opened;
        give_places(parse_yaml(read_file(path, opened), path), path, look);
    }
    for (const std::string& warning : lamp_warnings(lamps.files()))
        look.warn({path, 0, 0, {}}, warning);
}

void check_lamp_set_file(const fs::path& path, FileLook& look) {
    DriveEdits edits;
    edits.lamp_sets = path;
    look.tries([&] { read_drive(shipped_file("drives/straight.yaml", "FERNLICHT_DATA"), edits); });
}

void check_view_set_file(const fs::path& path, FileLook& look) {
    DriveEdits edits;
    edits.values.emplace_back("view_set", quoted(fs::absolute(path).string()));
    look.tries([&] { read_drive(shipped_file("drives/straight.yaml", "FERNLICHT_DATA"), edits); });
}

void check_rating_file(const fs::path& path, FileLook& look) {
    std::optional<Rating> rating;
    if (!look.tries([&] { rating = read_rating(path); }))
        return;
    std::set<fs::path> drives;
    for (const RatingRow& row : rating->rows)
        if (drives.insert(row.drive).second)
            check_drive_file(row.drive, look);
    std::erase_if(look.problems, [](const FileProblem& one) { return !one.is_error; }); // lamp sets come with the rating
}

void check_lamp_file(const fs::path& path, FileLook& look) {
    look.tries([&] {
        const std::size_t refused = refusals_met();
        const LampFile lamp = read_lamp(path);
        if (refusals_met() > refused)
            return; // intensities that could not be read are 0 here: what they would lead to is no finding
        const Intake intake = check_intake(lamp);
        look.kind = fmt::format("{} ({})", look.kind, name_of(intake.function));
        for (const std::string& note : lamp.notes)
            warn_as_told(look, path, note);
        if (intake.function == BeamFunction::other)
            look.warn({path, 0, 0, name_of(IntakeFault::function)},
                      "its light is neither a low nor a high beam's, so nothing else of it was checked");
        for (const IntakeFinding& finding : intake.findings)
            look.warn({path, 0, 0, name_of(finding.fault)},
                      fmt::format("{}: {}{}", name_of(finding.fault), finding.text,
                                  finding.meaningless ? "; readings with it are meaningless" : " (doubtful)"));
    });
}

void check_road_file(const fs::path& path, FileLook& look) {
    look.tries([&] {
        for (const std::string& warning : read_opendrive(path).warnings)
            warn_as_told(look, path, warning);
    });
}

void check_storyboard_file(const fs::path& path, FileLook& look) {
    look.tries([&] {
        FilesRead opened;
        if (!XmlFile(path, opened, "OpenSCENARIO", "an OpenSCENARIO file").root().child("ParameterValueDistribution")) {
            const osc::Storyboard story = osc::read_storyboard(path);
            if (!story.road_file.empty())
                osc::play_story(story, read_opendrive(story.road_file), {.max_s = 0.1}); // where everybody begins is there
            for (const std::string& note : story.notes)
                warn_as_told(look, path, note);
            return;
        }
        look.kind = "parameter variations";
        const osc::Variations variations = osc::read_variations(path, opened);
        EachRead each;
        for (const auto& parameters : variations.cases)
            each([&] { osc::read_storyboard(variations.scenario, {.parameters = parameters}); });
        each.end();
    });
}

void check_candump_file(const fs::path& path, FileLook& look) {
    std::optional<CandumpStream> log;
    if (!look.tries([&] { log.emplace(path); }))
        return;
    std::size_t frames = 0;
    for (bool more = true; more && look.problems.size() < most_problems;)
        look.tries([&] {
            for (CandumpStream::What what{}; (what = log->next()) != CandumpStream::What::end;)
                frames += what == CandumpStream::What::frame;
            more = false;
        });
    if (frames == 0)
        look.warn({path, 0, 0, {}}, "holds no frame");
}

void check_dbc_file(const fs::path& path, FileLook& look) {
    look.tries([&] {
        FilesRead opened;
        for (const std::string& note : read_dbc(path, opened).notes)
            look.warn({path, 0, 0, {}}, note);
    });
}

void check_model_file(const fs::path& path, FileLook& look) {
    look.tries([&] {
        for (const std::string& note : read_model(path).notes)
            look.warn({path, 0, 0, {}}, note);
    });
}

/// Its description, and whether it has a binary for this machine; nothing of it is loaded.
void check_fmu_file(const fs::path& path, FileLook& look) {
    look.tries([&] {
        static const auto read_zip = reinterpret_cast<ReadZip*>(module_function("fernlicht-zip", "fernlicht_read_zip"));
        constexpr std::string_view description = "modelDescription.xml";
        std::string xml;
        std::set<std::string> platforms;
        ZipReader reader;
        reader.wants = [&](const std::string& name, std::uint64_t bytes) {
            if (name.starts_with("binaries/") && name.find('/', 9) != std::string::npos)
                platforms.insert(name.substr(9, name.find('/', 9) - 9));
            return name == description && bytes <= std::uint64_t{16} << 20;
        };
        reader.take = [&](std::string_view piece) { xml += piece; };
        try {
            read_zip(path.string(), reader);
        } catch (const std::invalid_argument& error) {
            throw InputError({path, 0, 0, {}}, error.what());
        }
        if (xml.empty())
            throw InputError({path, 0, 0, {}}, fmt::format("no {}", description), "an FMU");
        const FmuDescription read = read_fmu_description(path / description, xml);
#if defined(__aarch64__)
        const std::string here = "aarch64-linux";
#else
        const std::string here = read.version == 2 ? "linux64" : "x86_64-linux";
#endif
        if (!platforms.contains(here))
            throw InputError(
                {path, 0, 0, {}},
                fmt::format("found binaries for {}", platforms.empty() ? "no machine" : fmt::format("{}", fmt::join(platforms, ", "))),
                here + ", this machine's");
    });
}

/// Reads it whole, with what a reader takes beside the path.
template <auto read> void check_with_opened(const fs::path& path, FileLook& look) {
    look.tries([&] {
        FilesRead opened;
        read(path, opened);
    });
}
template <auto read> void check_alone(const fs::path& path, FileLook& look) {
    look.tries([&] { read(path); });
}

bool is_lamp(const FileHead& head) {
    std::string text;
    try {
        text = lamp_text(head.bytes, head.path);
    } catch (const InputError&) { // no text
        return false;
    }
    return std::ranges::any_of(lamp_formats(), [&](const LampFormat& format) {
        return !format.picture && (format.looks_so(text) ||
                                   (format.name != "pixel lamp" && format.name != "beam matrix" && head.ends_in({format.extensions})));
    });
}

bool is_png(const FileHead& head) { return head.begins_with("\x89PNG\r\n"); }
bool is_exr(const FileHead& head) { return head.begins_with({"\x76\x2f\x31\x01", 4}); }
bool is_beam_texture(const FileHead& head) { return (is_png(head) || is_exr(head)) && head.has("fernlicht:h_extent_deg"); }

/// The first line that is neither empty nor a comment.
std::string_view first_line(const FileHead& head) {
    std::string_view rest = head.bytes;
    while (!rest.empty()) {
        const std::string_view line = trimmed(rest.substr(0, rest.find('\n')));
        if (!line.empty() && line.front() != '#' && line.front() != ';')
            return line;
        rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
    }
    return {};
}

bool matches_first_line(const FileHead& head, const char* expression) {
    const std::string line(first_line(head).substr(0, 400));
    return std::regex_search(line, std::regex(expression));
}

bool is_candump(const FileHead& head) {
    return matches_first_line(head, R"(^\(\S.*\)\s+\S+\s+[0-9A-Fa-f]{3,8}\s*(#|\[))") ||
           matches_first_line(head, R"(^\S+\s+[0-9A-F]{3,8}\s+\[\d+\])");
}

/// Two numbers a line, behind names of columns or not.
bool is_spectrum(const FileHead& head) {
    if (!head.ends_in({".csv", ".txt", ".spd"}))
        return false;
    static const std::regex sample(R"((^|\n)\s*[2-9][0-9]{2}(\.[0-9]+)?\s*[,;\s]\s*[0-9][0-9.eE+-]*\s*(\r?\n|$))");
    return std::regex_search(head.bytes.substr(0, 2000), sample);
}

bool is_lux_points(const FileHead& head) { return head.ends_in({".csv"}) && matches_first_line(head, R"(\blux\b)"); }

void check_picture_file(const fs::path& path, FileLook& look) {
    look.tries([&] {
        FilesRead opened;
        const std::string bytes = read_file(path, opened);
        if (bytes.starts_with("\x76\x2f\x31\x01"))
            read_exr(path);
        else
            decode_picture(path, "", bytes, std::size_t{1} << 28);
    });
}

} // namespace

bool FileHead::begins_with(std::string_view text) const { return bytes.starts_with(text); }
bool FileHead::has(std::string_view text) const { return bytes.find(text) != std::string::npos; }
bool FileHead::has_key(std::string_view key) const {
    const std::string colon = std::string(key) + ":";
    return bytes.starts_with(colon) || has("\n" + colon) || bytes.starts_with("\xef\xbb\xbf" + colon) || bytes.starts_with("{" + colon);
}
bool FileHead::ends_in(std::initializer_list<std::string_view> extensions) const {
    std::string own = path.extension().string();
    std::ranges::transform(own, own.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::find(extensions, own) != extensions.end();
}

std::span<const FileKind> file_kinds() {
    static const FileKind kinds[]{
        {"study", [](const FileHead& head) { return head.has_key("fernlicht_study"); }, check_study_file},
        {"rating", [](const FileHead& head) { return head.has_key("fernlicht_rating"); }, check_rating_file},
        {"recipe", [](const FileHead& head) { return head.has_key("fernlicht_recipe"); }, check_with_opened<read_grid_recipe>},
        {"view set", [](const FileHead& head) { return head.has_key("fernlicht_views"); }, check_view_set_file},
        {"display", [](const FileHead& head) { return head.has_key("fernlicht_display"); }, check_with_opened<read_display_profile>},
        {"known failures", [](const FileHead& head) { return head.has_key("known"); }, check_alone<read_known_failures>},
        {"drive",
         [](const FileHead& head) {
             return head.has_key("fernlicht") || (head.ends_in({".yaml", ".yml"}) && (head.has_key("road") || head.has_key("storyboard")));
         },
         check_drive_file},
        {"lamp sets", [](const FileHead& head) { return head.has_key("lamp_sets"); }, check_lamp_set_file},
        {"lamp", is_lamp, check_lamp_file},
        {"lamp", is_beam_texture, check_lamp_file},
        {"road", [](const FileHead& head) { return head.has("<OpenDRIVE") || head.ends_in({".xodr"}); }, check_road_file},
        {"storyboard", [](const FileHead& head) { return head.has("<OpenSCENARIO") || head.ends_in({".xosc"}); }, check_storyboard_file},
        {"bus database", [](const FileHead& head) { return head.ends_in({".dbc"}) || head.has("\nBO_ "); }, check_dbc_file},
        {"recording", is_candump, check_candump_file},
        {"FMU", [](const FileHead& head) { return head.begins_with("PK") && head.ends_in({".fmu"}); }, check_fmu_file},
        {"model",
         [](const FileHead& head) {
             return head.begins_with("glTF") || head.ends_in({".gltf", ".glb"});
         },
         check_model_file},
        {"drive log", [](const FileHead& head) { return head.begins_with(std::string_view(drive_log_header).substr(0, 14)); },
         check_with_opened<read_drive_log>},
        {"lux readings", is_lux_points, check_with_opened<read_lux_points>},
        {"spectrum", is_spectrum, check_with_opened<read_spectrum>},
        {"picture", [](const FileHead& head) { return is_png(head) || is_exr(head) || head.begins_with("\xff\xd8\xff"); },
         check_picture_file, false},
        {"class of strictness",
         [](const FileHead& head) { return head.has_key("name") && (head.has_key("display") || head.has_key("linear")); },
         [](const fs::path& path, FileLook& look) { look.tries([&] { read_strictness(path.string()); }); }},
    };
    return kinds;
}

} // namespace fernlicht
