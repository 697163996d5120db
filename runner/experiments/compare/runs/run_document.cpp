#include "metrics/readings/reading_labels.h"
#include "runner/experiments/compare/runs/run_comparison.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_settings = 40;

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

Cell number_cell(const std::optional<double>& value, const char* otherwise = "") {
    return value ? Cell(page_number(*value), *value) : Cell(otherwise);
}

Cell value_cell(const Value& value) {
    return value.measured() ? Cell(with_bound(value, page_number(*value.figure())), *value.figure()) : Cell("not measured");
}

Cell change_cell(const Value& change) {
    if (!change.measured())
        return "";
    const double size = *change.figure();
    return {with_bound(change, (size > 0.0 ? "+" : "") + page_number(size)), size};
}

std::string drive_words(const DriveComparison& drive) {
    const std::string &now = drive.now.lamp_set, &before = drive.before.lamp_set;
    return drive.now.drive + ", " + (now == before ? now : now + " / " + before);
}

Table changes_table(const std::string& name, const std::string& caption) {
    return {.name = name,
            .caption = caption,
            .columns = columns_of("row<|drive<|reading<|old|new|change|%|± numerical|± noise|± aim|unit<|is<"),
            .rows = {},
            .sortable = true,
            .led_to = true};
}

void add_change(Table& table, const DriveComparison& drive, const ReadingChange& change, const std::string& id) {
    const double percent = 100.0 * change.relative().value_or(0.0);
    if (change.kind != ChangeKind::real)
        table.quiet.push_back(table.rows.size());
    table.rows.push_back({id, drive_words(drive), reading_label(change.reading), value_cell(change.old_value), value_cell(change.new_value),
                          change_cell(change.change()), change.relative() ? Cell(signed_figure(percent, 1), percent) : Cell(""),
                          number_cell(change.uncertainty), number_cell(change.noise_effect), number_cell(change.aim_effect),
                          unit_label(change.unit()), Cell(change_name(change.kind)).hinted(change.reason_unknown)});
}

/// "reach at 1 lx on the road, own lane: 29.35 → 33.27 m, +3.923 (+13.4 %), ±0.095".
std::string change_text(const ReadingChange& c) {
    const auto short_value = [](const Value& value) {
        return value.measured() ? with_bound(value, fmt::format("{:.4g}", *value.figure())) : "not measured";
    };
    const Value change = c.change();
    std::string text = fmt::format("{}: {} → {}{}, {}", reading_label(c.reading), short_value(c.old_value), short_value(c.new_value),
                                   unit_suffix(c.unit()), with_bound(change, fmt::format("{:+.4g}", change.figure().value_or(0.0))));
    if (c.relative())
        text += fmt::format(" ({:+.1f} %)", 100.0 * *c.relative());
    if (c.uncertainty)
        text += ", " + open_words(*c.uncertainty,
                                  std::max(std::abs(c.old_value.figure().value_or(0.0)), std::abs(c.new_value.figure().value_or(0.0))));
    return text;
}

/// What the comparison comes to, in one sentence.
std::string runs_sentence(const RunComparison& runs) {
    std::size_t all = 0;
    for (const DriveComparison& drive : runs.drives)
        all += drive.changes.size();
    return all == 0 ? "No reading could be compared."
                    : fmt::format("Of {} readings that both runs have, {} changed for real, {} within what 0.1 degrees of aim would do, {} "
                                  "within numerical uncertainty and noise; of {} it is not known.",
                                  all, runs.count(ChangeKind::real), runs.count(ChangeKind::within_aim), runs.count(ChangeKind::none),
                                  runs.count(ChangeKind::unknown));
}

Section first_section(const RunComparison& runs) {
    const std::size_t real = runs.count(ChangeKind::real);
    const bool is_judged = !runs.strictness_name.empty();
    Section section{
        is_judged ? fmt::format("{}: {}", runs.strictness_name, runs.passed() ? "kept" : "not kept")
                  : (real == 0 ? "No" : fmt::format("{}", real)) + (real == 1 ? " real change" : " real changes"),
        {"A, old: " + runs.before.folder.string(), "B, new: " + runs.now.folder.string(), "differences are B − A", runs_sentence(runs)},
        2,
        false,
        !is_judged      ? "none"
        : runs.passed() ? "pass"
                        : "fail"};
    for (const std::string& sentence : runs.left_out)
        section.blocks.emplace_back("left out: " + sentence);
    if (runs.strictness_name.empty())
        return section;
    for (const std::string& why : runs.not_judged)
        section.blocks.emplace_back("not held to the strictness: " + why);
    section.blocks.emplace_back(fmt::format("strictness {}: {}", runs.strictness_name, runs.passed() ? "pass" : "FAIL"));
    return section;
}

Section largest_section(const RunComparison& runs) {
    Section section{"The largest changes", {}};
    for (const auto& [d, i] : runs.largest)
        section.blocks.emplace_back(
            fmt::format("{}; {}, row {}", change_text(runs.drives[d].changes[i]), drive_words(runs.drives[d]), row_id(d, i)));
    section.blocks.emplace_back(
        runs.largest.empty()
            ? "No deciding reading changed beyond numerical uncertainty, noise of the candela tables and 0.1° of aim."
            : "Of each deciding reading its largest real change, then the largest of these; size is the change over the larger of both "
              "values. Real is what exceeds numerical uncertainty and the noise of the candela tables, and what 0.1° of aim would do.");
    return section;
}

Section readings_section(const RunComparison& runs) {
    Table deciding = changes_table("readings", "The readings that decide"), others = changes_table("others", "");
    for (std::size_t d = 0; d < runs.drives.size(); ++d)
        for (std::size_t i = 0; i < runs.drives[d].changes.size(); ++i) {
            const RunChange& change = runs.drives[d].changes[i];
            add_change(change.decides ? deciding : others, runs.drives[d], change, row_id(d, i));
        }
    others.caption = fmt::format("All other readings ({}): other lanes, edges, limits, percentiles", others.rows.size());
    others.folded = true;
    return {"Readings",
            {"Click a heading to sort, again to reverse. ± numerical is the numerical uncertainty of the change (with that of repeats, "
             "where a run has them), ± noise what three standard deviations of the noise of the candela tables would do, ± aim what 0.1° "
             "of aim would do. Each line is the row of its id in "
             "compare.json and compare.csv.",
             Listing{{Cell("compare.json").linked("compare.json"), Cell("compare.csv").linked("compare.csv")}}, deciding, others},
            2,
            true};
}

/// By channel the frame that differs most.
Table worst_frames_table(const DriveComparison& drive) {
    struct Channel {
        std::string name;
        std::size_t frames = 0, equal = 0;
        const LayerComparison* worst = nullptr;
        double worst_s = 0.0;
    };
    std::vector<Channel> channels;
    for (const FramePair& frame : drive.frames)
        for (const LayerComparison& layer : frame.comparison.layers) {
            const std::string name = frame.view.name + ", " + layer.name;
            auto channel = std::ranges::find(channels, name, &Channel::name);
            if (channel == channels.end())
                channel = channels.insert(channels.end(), Channel{name});
            ++channel->frames;
            channel->equal += layer.histogram.equal == layer.histogram.pixels() ? 1U : 0U;
            if (!channel->worst || value_in(layer, "rmse").value_or(0.0) > value_in(*channel->worst, "rmse").value_or(0.0)) {
                channel->worst = &layer;
                channel->worst_s = frame.new_frame.time_s;
            }
        }
    Table table{"pictures-" + drive.name,
                "Stored frames, and of each channel the one that differs most",
                columns_of("pictures<|frames|equal|RMSE|largest|unit<|SSIM|most at [s]"),
                {}};
    for (const Channel& channel : channels) {
        const auto cell = [&](const char* name) {
            const std::optional<double> value = value_in(*channel.worst, name);
            return value ? Cell(fmt::format("{:.4g}", *value), *value) : Cell("not measured");
        };
        table.rows.push_back({channel.name,
                              std::to_string(channel.frames),
                              std::to_string(channel.equal),
                              cell("rmse"),
                              cell("max_error"),
                              unit_label(channel.worst->unit),
                              cell("ssim"),
                              {fmt::format("{:.2f}", channel.worst_s), channel.worst_s}});
    }
    return table;
}

/// What differs between the two that were played, and whether the frames are alike enough.
Section drive_section(const RunComparison& runs, const DriveComparison& drive) {
    Section section{drive.now.drive + ": " + drive.new_label() + " against " + drive.old_label(), {}};
    std::vector<DocumentPart>& blocks = section.blocks;
    if (drive.settings.empty()) {
        blocks.emplace_back("Both were played with the same settings.");
    } else {
        Table settings{"settings-" + drive.name, "What the drives set otherwise", columns_of("key<|A<|B<"), {}};
        const auto shown = [](const std::string& value) { return value.empty() ? "not set" : short_text(value, 160); };
        for (std::size_t i = 0; i < std::min(max_settings, drive.settings.size()); ++i)
            settings.rows.push_back(
                {short_text(drive.settings[i].key, 80), shown(drive.settings[i].old_value), shown(drive.settings[i].new_value)});
        blocks.emplace_back(std::move(settings));
        if (drive.settings.size() > max_settings)
            blocks.emplace_back(fmt::format("and {} more in compare.json", drive.settings.size() - max_settings));
    }
    for (const LampFilesDifference& lamps : drive.lamp_files) {
        const std::vector<std::string> sentences = sentences_of(lamps.difference);
        for (std::size_t i = 0; i < std::min<std::size_t>(5, sentences.size()); ++i)
            blocks.emplace_back(fmt::format("lamp {}: {}", lamps.lamps, sentences[i]));
        if (sentences.size() > 5)
            blocks.emplace_back(fmt::format("and {} more, all in compare.json", sentences.size() - 5));
    }
    for (const std::string& file : drive.new_bytes)
        blocks.emplace_back("other content: " + file);
    for (const std::string& sentence : drive.left_out)
        blocks.emplace_back("left out: " + sentence);
    for (const TimeChange& time : drive.times)
        blocks.emplace_back(time.kind == ChangeKind::unknown ? fmt::format("{}: not known: {}", name_of(time.reading), time.reason_unknown)
                                                             : fmt::format("{}; {}", change_text(time), change_name(time.kind)));
    if (!drive.frames.empty())
        blocks.emplace_back(worst_frames_table(drive));
    if (!drive.frames.empty() && std::ranges::all_of(drive.frames, &FramePair::is_equal))
        blocks.emplace_back(
            fmt::format("No pixel of any stored {} differs.", std::ranges::all_of(drive.frames, &FramePair::is_display)    ? "PNG"
                                                              : std::ranges::none_of(drive.frames, &FramePair::is_display) ? "EXR"
                                                                                                                           : "frame"));
    for (const FramePair& frame : drive.frames)
        if (!runs.strictness_name.empty() && !frame.comparison.passed()) {
            blocks.emplace_back(
                fmt::format("FAIL {}: {} does not keep {}", frame.new_frame.view, frame.file(frame.new_frame), runs.strictness_name));
            for (const std::string& failure : strictness_failures(frame.comparison))
                blocks.emplace_back("    " + failure);
        }
    return section;
}

/// A stored moment: both pictures, and what differs.
PictureStrip moment_strip(const DriveComparison& drive, const RunComparison& runs, const FramePair& frame) {
    PictureStrip strip{fmt::format("{}, {}, after {:.2f} s", drive.now.title, frame.new_frame.view, frame.new_frame.time_s),
                       {{std::filesystem::absolute(runs.before.folder / frame.old_frame.png).string(), drive.old_label()},
                        {std::filesystem::absolute(runs.now.folder / frame.new_frame.png).string(), drive.new_label()}}};
    const std::filesystem::path folder = std::filesystem::path(frame.pictures.front()).parent_path();
    for (const auto& [file, caption] :
         {std::pair("illuminance-difference.png", "Illuminance, B − A"), std::pair("illuminance-isolux.png", "Isolux lines of both"),
          std::pair("flip.png", "FLIP: what one sees who flips between both")})
        for (const FramePair& other : drive.frames)
            if (const std::string path = folder / file; std::ranges::count(other.pictures, path) > 0)
                strip.pictures.push_back({path, caption});
    return strip;
}

Table frames_table(const DriveComparison& drive) {
    Table table{"frames-" + drive.name,
                "Error figures of each frame and channel",
                columns_of("view<|at [s]|channel<|unit<|largest|RMSE|PSNR [dB]|pixels [%]|SSIM|FLIP"),
                {},
                true,
                false,
                true};
    for (const FramePair& frame : drive.frames)
        for (const LayerComparison& layer : frame.comparison.layers) {
            std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{
                frame.new_frame.view, Cell(figure(frame.new_frame.time_s, 2), frame.new_frame.time_s), layer.name, unit_label(layer.unit)});
            for (const char* name : {"max_error", "rmse", "psnr_db", "percent_different", "ssim"})
                cells.push_back(number_cell(value_in(layer, name)));
            cells.push_back(number_cell(value_in(layer, "flip_mean"), find_in(layer, "flip_mean") ? "not measured" : ""));
        }
    return table;
}

/// What takes a page to show.
Section pictures_section(const RunComparison& runs, const DriveComparison& drive) {
    Section section{drive.now.title + ", drawn", {}, 2, true};
    const auto add_plots = [&](bool of_light) { // lamps and what goes over the way stand before the moments, light from above after them
        for (const ComparedFigure& drawn : drive.figures)
            if (drawn.name.starts_with("lux") == of_light)
                section.blocks.emplace_back(drawn.plot());
    };
    add_plots(false);
    for (const FramePair& frame : drive.frames)
        if (!frame.pictures.empty() && frame.is_display)
            section.blocks.emplace_back(moment_strip(drive, runs, frame));
    add_plots(true);
    if (!drive.times.empty()) {
        Table times =
            changes_table("times-" + drive.name,
                          "Times of passes: medians; ± numerical is half the range from the 5th to the 95th percentile of both runs' "
                          "frames. The runs are two sittings, and what else the machine did counts, too: fernlicht bench times "
                          "in turns");
        for (const TimeChange& time : drive.times)
            add_change(times, drive, time, name_of(time.reading));
        section.blocks.emplace_back(std::move(times));
    }
    if (!drive.frames.empty()) {
        section.blocks.emplace_back(frames_table(drive));
        section.blocks.emplace_back("frames.csv has all figures; the pictures of the moments drawn lie in frames/" + drive.name + ".");
    }
    return section;
}

} // namespace

Document document(const RunComparison& runs) {
    Document document{short_text(runs.now.folder.filename().string() + " against " + runs.before.folder.filename().string(), 160),
                      {first_section(runs), largest_section(runs), readings_section(runs)}};
    for (const DriveComparison& drive : runs.drives)
        for (Section section : {drive_section(runs, drive), pictures_section(runs, drive)})
            document.sections.push_back(std::move(section));
    Table folders{"runs", "", columns_of("<|folder<|played<|with<|command<"), {}};
    for (const auto& [label, run] : {std::pair("A, old", &runs.before), std::pair("B, new", &runs.now)})
        folders.rows.push_back({label, run->folder.string(), run->started_utc,
                                run->version + ", " + run->backend + ", " + run->gl_renderer + ", " + run->cpu, run->command});
    document.sections.push_back({"The runs", {folders}, 2, true});
    return document;
}

} // namespace fernlicht
