#include "metrics/readings/reading_words.h"
#include "metrics/readings/unit_words.h"
#include "report_files.h"
#include "runner/experiments/compare/runs/run_writers.h"
#include "runner/experiments/compare/strictness_failures.h"
#include "runner/files/clean_text.h"
#include "runner/write/page_base.h"
#include "runner/write/plots/png.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <kainjow/mustache.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using kainjow::mustache::data;
using List = data::type;

constexpr std::size_t embedded_bytes = std::size_t{48} << 20; // of pictures as they lie on disk
constexpr std::size_t most_settings = 40;

/// With as many digits as tell it apart: readings reach from thousandths of a lux to thousands of square metres.
std::string page_number(double value) {
    const double size = std::abs(value);
    if (size > 0.0 && size < 1e-3) { // "4.3e-7"
        std::string text = fmt::format("{:.1e}", value);
        const std::size_t e = text.find('e');
        return text.substr(0, e + 1) + std::to_string(std::stoi(text.substr(e + 1)));
    }
    return figure(value, size >= 1000.0 || size == 0.0 ? 0 : std::clamp(3 - static_cast<int>(std::ceil(std::log10(size))), 1, 6));
}
std::string signed_number(double value) { return value > 0.0 ? "+" + page_number(value) : page_number(value); }
std::string optional_number(const std::optional<double>& value, const char* otherwise = "") {
    return value ? page_number(*value) : otherwise;
}
std::string page_value(const Value& value) { return value.measured() ? with_bound(value, page_number(*value.figure())) : "not measured"; }
std::string sort_key(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

data change_part(const DriveComparison& drive, const ReadingChange& change, const std::string& id) {
    const Value found = change.change();
    const bool has_percent = change.relative().has_value();
    const double percent = 100.0 * change.relative().value_or(0.0);
    data part;
    part.set("id", id);
    part.set("drive", clean_text(drive.now->drive));
    part.set("lamps", clean_text(drive.now->variant == drive.before->variant ? drive.now->variant
                                                                             : drive.now->variant + " / " + drive.before->variant));
    part.set("reading", clean_text(reading_in_words(change.reading)));
    part.set("name", clean_text(name_of(change.reading)));
    part.set("unit", clean_text(unit_in_words(change.unit())));
    part.set("old", page_value(change.old_value));
    part.set("new", page_value(change.new_value));
    part.set("old_key", sort_key(change.old_value.figure()));
    part.set("new_key", sort_key(change.new_value.figure()));
    part.set("delta", found.measured() ? with_bound(found, signed_number(*found.figure())) : "");
    part.set("delta_key", sort_key(found.figure()));
    part.set("percent", has_percent ? signed_figure(percent, 1) : "");
    part.set("percent_key", has_percent ? fmt::format("{}", percent) : "");
    part.set("has_percent", has_percent);
    part.set("uncertainty", optional_number(change.uncertainty));
    part.set("uncertainty_key", sort_key(change.uncertainty));
    part.set("aim", optional_number(change.by_aim));
    part.set("aim_key", sort_key(change.by_aim));
    part.set("noise", optional_number(change.by_noise));
    part.set("noise_key", sort_key(change.by_noise));
    part.set("has_noise", change.by_noise.value_or(0.0) > 0.0);
    part.set("has_aim", change.by_aim.has_value());
    part.set("kind", change_name(change.kind));
    part.set("why_not", clean_text(change.why_not));
    part.set("class", change.kind == ChangeKind::real ? "real" : "quiet");
    return part;
}

data texts_part(const std::vector<std::string>& texts) {
    data list{List::list};
    for (const std::string& text : texts)
        list.push_back(clean_text(text));
    return list;
}

data verdict_part(const RunComparison& runs) {
    data part, failures{List::list};
    const bool judged = !runs.strictness_name.empty();
    for (const DriveComparison& drive : runs.drives)
        for (const FramePair& frame : drive.frames)
            if (!frame.comparison.passed())
                failures.push_back(clean_text(fmt::format("{}: {} does not keep it: {}", drive.name, frame.file(frame.new_frame),
                                                          fmt::join(strictness_failures(frame.comparison), "; "))));
    for (const std::string& why : runs.not_judged)
        failures.push_back(clean_text("not held to it: " + why));
    const std::size_t real = runs.count(ChangeKind::real);
    part.set("class", !judged ? "" : runs.passed() ? "pass" : "fail");
    part.set("judged", judged);
    part.set("mark", !judged ? "" : runs.passed() ? "✓" : "✗");
    part.set("word", judged ? fmt::format("{}: {}", runs.strictness_name, runs.passed() ? "kept" : "not kept")
                            : fmt::format("{} {}", real == 0 ? "No" : fmt::format("{}", real), real == 1 ? "real change" : "real changes"));
    part.set("sentence", runs_sentence(runs));
    part.set("failures", failures);
    part.set("left_out", texts_part(runs.left_out));
    part.set("has_left_out", !runs.left_out.empty());
    return part;
}

data settings_part(const DriveComparison& drive) {
    data list{List::list};
    for (std::size_t i = 0; i < std::min(most_settings, drive.settings.size()); ++i) {
        const YamlChange& setting = drive.settings[i];
        data row;
        row.set("key", short_text(setting.key, 80));
        row.set("old", setting.old_value.empty() ? "not set" : short_text(setting.old_value, 160));
        row.set("new", setting.new_value.empty() ? "not set" : short_text(setting.new_value, 160));
        list.push_back(row);
    }
    return list;
}

data figures_part(const DriveComparison& drive, const std::string& prefix) {
    data list{List::list};
    for (const ComparedFigure& figure : drive.figures)
        if (figure.name.starts_with(prefix)) {
            data part;
            part.set("svg", figure.svg);
            part.set("title", clean_text(figure.title));
            part.set("link", relative_link("figures/" + figure.name));
            list.push_back(part);
        }
    return list;
}

/// Bytes for the page, or "" where the page has enough.
std::string embedded(const fs::path& file, std::size_t& budget) {
    FilesRead ignored;
    const std::string bytes = read_file(file, ignored);
    if (bytes.size() > budget)
        return {};
    budget -= bytes.size();
    return plots::base64(bytes);
}

/// A stored moment: old and new under a slider, what differs beside it.
data strips_part(const DriveComparison& drive, const RunComparison& runs, const fs::path& folder, std::size_t& budget) {
    data list{List::list};
    for (const FramePair& frame : drive.frames) {
        if (frame.folder.empty() || !frame.is_display)
            continue;
        data part, pictures{List::list};
        part.set("title",
                 clean_text(fmt::format("{}, {}, after {:.2f} s", drive.now->title, frame.new_frame.view, frame.new_frame.time_s)));
        part.set("new_name", clean_text(drive.new_label()));
        part.set("old_name", clean_text(drive.old_label()));
        part.set("old_picture", embedded(runs.before.folder / frame.old_frame.png, budget));
        part.set("new_picture", embedded(runs.now.folder / frame.new_frame.png, budget));
        const auto add = [&](const std::string& name, const char* caption) {
            const fs::path file = folder / frame.folder / (name + ".png");
            if (!fs::exists(file))
                return;
            data picture;
            picture.set("bytes", embedded(file, budget));
            picture.set("caption", caption);
            picture.set("link", relative_link(frame.folder + "/" + name + ".png"));
            pictures.push_back(picture);
        };
        add("illuminance-difference", "Illuminance, B − A");
        add("illuminance-isolux", "Isolux lines of both");
        add("flip", "FLIP: what one sees who flips between both");
        part.set("pictures", pictures);
        list.push_back(part);
    }
    return list;
}

data frames_part(const DriveComparison& drive) {
    data list{List::list};
    for (const FramePair& frame : drive.frames)
        for (const LayerComparison& layer : frame.comparison.layers) {
            data row;
            row.set("view", clean_text(frame.new_frame.view));
            row.set("time", figure(frame.new_frame.time_s, 2));
            row.set("channel", clean_text(layer.name));
            row.set("unit", clean_text(unit_in_words(layer.unit)));
            for (const char* name : {"max_error", "rmse", "psnr_db", "percent_different", "ssim", "flip_mean"}) {
                row.set(name, optional_number(value_in(layer, name)));
                row.set(name + std::string("_key"), sort_key(value_in(layer, name)));
            }
            if (const auto flip = std::ranges::find(layer.values, "flip_mean", &ComparedValue::name); flip != layer.values.end())
                row.set("flip_mean", optional_number(flip->value, "not measured"));
            row.set("drawn", !frame.folder.empty());
            row.set("link", relative_link(frame.folder + "/" + (frame.files.empty() ? "" : frame.files.front())));
            list.push_back(row);
        }
    return list;
}

data drive_part(const RunComparison& runs, std::size_t index, const fs::path& folder, std::size_t& budget) {
    const DriveComparison& drive = runs.drives[index];
    data part, times{List::list};
    part.set("title", clean_text(drive.now->title));
    part.set("name", clean_text(drive.name));
    part.set("labels", clean_text(drive.new_label() + " against " + drive.old_label()));
    part.set("settings", settings_part(drive));
    part.set("has_settings", !drive.settings.empty());
    part.set("more_settings", drive.settings.size() > most_settings
                                  ? fmt::format("and {} more in compare.json", drive.settings.size() - most_settings)
                                  : "");
    part.set("new_bytes", texts_part(drive.new_bytes));
    part.set("has_new_bytes", !drive.new_bytes.empty());
    part.set("left_out", texts_part(drive.left_out));
    part.set("has_left_out", !drive.left_out.empty());
    data lamps{List::list};
    for (const LampFilesDifference& files : drive.lamp_files) {
        data row;
        row.set("names", clean_text(files.lamps));
        const std::vector<std::string> sentences = sentences_of(files.difference);
        row.set("sentences", texts_part({sentences.begin(), sentences.begin() + std::min<std::ptrdiff_t>(5, std::ssize(sentences))}));
        row.set("more", sentences.size() > 5 ? fmt::format("and {} more, all in compare.json", sentences.size() - 5) : "");
        lamps.push_back(row);
    }
    part.set("lamp_files", lamps);
    part.set("lamp_figures", figures_part(drive, "lamps_"));
    for (const TimeChange& time : drive.times)
        times.push_back(change_part(drive, time, ""));
    part.set("times", times);
    part.set("has_times", !drive.times.empty());
    for (const char* prefix : {"reach", "glare", "lux"}) {
        part.set(prefix, figures_part(drive, prefix));
        part.set("has_" + std::string(prefix),
                 std::ranges::any_of(drive.figures, [&](const ComparedFigure& f) { return f.name.starts_with(prefix); }));
    }
    part.set("strips", strips_part(drive, runs, folder, budget));
    part.set("frames", frames_part(drive));
    part.set("has_frames", !drive.frames.empty());
    part.set("all_equal", !drive.frames.empty() && std::ranges::all_of(drive.frames, &FramePair::is_equal));
    return part;
}

data run_part(const char* label, const RunFolder& run) {
    data part;
    part.set("label", label);
    part.set("folder", clean_text(run.folder.string()));
    part.set("command", clean_text(run.command));
    part.set("started", clean_text(run.started_utc));
    part.set("machine", clean_text(run.version + ", " + run.backend + ", " + run.gl_renderer + ", " + run.cpu));
    return part;
}

} // namespace

std::string runs_html(const RunComparison& runs, const fs::path& folder) {
    data page, largest{List::list}, rows{List::list}, others{List::list}, drives{List::list}, both{List::list};
    for (const auto& [d, i] : runs.largest)
        largest.push_back(change_part(runs.drives[d], runs.drives[d].changes[i], row_id(d, i)));
    std::size_t rest = 0, budget = embedded_bytes;
    for (std::size_t d = 0; d < runs.drives.size(); ++d) {
        for (std::size_t i = 0; i < runs.drives[d].changes.size(); ++i) {
            const bool decides = runs.drives[d].decides(runs.drives[d].changes[i].reading);
            (decides ? rows : others).push_back(change_part(runs.drives[d], runs.drives[d].changes[i], row_id(d, i)));
            rest += decides ? 0U : 1U;
        }
        drives.push_back(drive_part(runs, d, folder, budget));
    }
    both.push_back(run_part("A, old", runs.before));
    both.push_back(run_part("B, new", runs.now));
    page.set("title", short_text(runs.now.folder.filename().string() + " against " + runs.before.folder.filename().string(), 160));
    page.set("style",
             std::string(report_file("report.css")) + std::string(report_file("document.css")) + std::string(report_file("compare.css")));
    page.set("script", std::string(report_file("document.js")));
    page.set("verdict", verdict_part(runs));
    page.set("largest", largest);
    page.set("has_largest", !runs.largest.empty());
    page.set("rows", rows);
    page.set("others", others);
    page.set("other_count", fmt::format("{}", rest));
    page.set("several", runs.drives.size() > 1);
    page.set("drives", drives);
    page.set("runs", both);
    kainjow::mustache::mustache page_template{std::string(report_file("runs.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("runs.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
