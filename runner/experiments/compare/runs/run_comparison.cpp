#include "runner/experiments/compare/runs/run_comparison.h"

#include "metrics/images/flip.h"
#include "metrics/statistics/statistics.h"
#include "runner/experiments/compare/runs/run_pairs.h"
#include "runner/files/picture_file.h"
#include "runner/findings/summary.h"
#include "runner/play/capture.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

/// Names of at most four, and how many more.
std::string some_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, names.size()); ++i)
        text += (i == 0 ? "" : ", ") + names[i];
    return names.size() > 4 ? fmt::format("{} and {} more", text, names.size() - 4) : text;
}

bool is_deciding(const ReadingKey& reading, const DriveComparison& drives) {
    const auto is_limited = [&](const RunDrive& drive) {
        const YamlValue* limits = member_of(drive.resolved, "limits");
        return limits && std::ranges::any_of(limits->items, [&](const YamlValue& limit) {
                   const YamlValue* limited = member_of(limit, "reading");
                   return limited && key_of(limited->text) == reading;
               });
    };
    return !is_extent(reading) || place_among(reading, decides_by_default()) || is_limited(drives.before) || is_limited(drives.now);
}

void compare_readings(DriveComparison& drive) {
    const RunDrive &before = drive.before, &now = drive.now;
    if (before.time_s != now.time_s) {
        drive.left_out.push_back(fmt::format("all readings: A played {} moments and B {}, not the same ones, and readings are those of the "
                                             "moments played",
                                             before.time_s.size(), now.time_s.size()));
        return;
    }
    const MeasureChange measured = measure_change(before.resolved, now.resolved);
    if (!measured.extent.empty())
        drive.left_out.push_back("reach, width and area: measured otherwise (" + measured.extent + ")");
    if (!measured.others.empty())
        drive.left_out.push_back("readings that are no extents: measured otherwise (" + measured.others + ")");
    std::vector<std::string> only_old, only_new;
    for (const auto& [key, reading] : now.readings)
        if (!before.readings.contains(key))
            only_new.push_back(name_of(key));
    for (const auto& [key, reading] : before.readings) {
        if (is_uncertainty(key) || is_time(key) || (is_extent(key) ? !measured.extent.empty() : !measured.others.empty()))
            continue;
        if (now.readings.contains(key))
            drive.changes.push_back({change_of_reading(key, now, before, drive.lamp_noise()), is_deciding(key, drive)});
        else
            only_old.push_back(name_of(key));
    }
    if (!only_old.empty())
        drive.left_out.push_back("readings of A alone: " + some_of(only_old));
    if (!only_new.empty())
        drive.left_out.push_back("readings of B alone: " + some_of(only_new));
}

void compare_times(DriveComparison& drive) {
    for (const auto& [pass, now] : drive.now.pass_s) {
        const auto other = drive.before.pass_s.find(pass);
        if (other == drive.before.pass_s.end())
            continue;
        const std::optional<Spread> a = spread_of(other->second), b = spread_of(now);
        TimeChange change;
        change.reading = {.quantity = Quantity::pass_time, .subject = pass_subject(pass), .statistic = Statistic::median};
        change.old_samples = other->second.size();
        change.new_samples = now.size();
        if (a)
            change.old_value = 1e3 * a->median;
        if (b)
            change.new_value = 1e3 * b->median;
        if (!a || !b || std::min(change.old_samples, change.new_samples) < fewest_rounds) {
            change.reason_unknown = fmt::format("{} and {} frames were timed, and fewer than {} tell nothing", change.old_samples,
                                                change.new_samples, fewest_rounds);
        } else {
            change.uncertainty = 0.5e3 * std::hypot(a->p95 - a->p05, b->p95 - b->p05);
            change.kind = change.least() <= *change.uncertainty ? ChangeKind::none : ChangeKind::real;
        }
        drive.times.push_back(change);
    }
}

const View* view_of(const RunDrive& drive, const std::string& name) {
    const auto found = std::ranges::find(drive.views, name, &View::name);
    return found == drive.views.end() ? nullptr : &*found;
}

/// "" where pictures of the view show the same place on the same pixels.
std::string why_not_view(const View* before, const View* now) {
    if (!before || !now)
        return "a resolved drive does not have it";
    if (before->width_px != now->width_px || before->height_px != now->height_px)
        return fmt::format("another resolution, {} x {} and {} x {} pixels", before->width_px, before->height_px, now->width_px,
                           now->height_px);
    return *before == *now ? "" : "it looks from another place, another way or over another field";
}

/// Whether two PNGs were shown in different ways, or one that cannot be compared. Runs of older versions, which knew nothing but sRGB, say
/// it by their tone mapper alone.
bool other_display(const RunDrive& before, const RunDrive& now, const FramePair& pair) {
    const PictureTags a = read_png_tags(before.folder / pair.file(pair.old_frame)),
                      b = read_png_tags(now.folder / pair.file(pair.new_frame));
    const auto is_other = [](const std::string& tag, const std::string& than) {
        return than.empty() ? !tag.ends_with("; display srgb") : tag != than;
    };
    const bool other = a.shown_by.empty() ? !b.shown_by.empty() && is_other(b.shown_by, {}) : is_other(a.shown_by, b.shown_by);
    return before.tone_mapper != now.tone_mapper || other || !a.icc.empty() || !b.icc.empty();
}

/// Frames that both have, and in words which were left out.
void pair_frames(DriveComparison& drive) {
    const RunDrive &before = drive.before, &now = drive.now;
    std::set<std::string> told;
    std::size_t alone = now.frames.size(), old_alone = 0;
    bool png_alone = false, exr_alone = false, other_tones = false;
    for (const StoredFrame& old_frame : before.frames) {
        const auto found = std::ranges::find_if(now.frames, [&](const StoredFrame& f) {
            return f.view == old_frame.view && f.tick == old_frame.tick && f.time_s == old_frame.time_s;
        });
        if (found == now.frames.end()) {
            ++old_alone;
            continue;
        }
        --alone;
        const View *old_view = view_of(before, old_frame.view), *view = view_of(now, old_frame.view);
        if (const std::string why = why_not_view(old_view, view); !why.empty()) {
            if (told.insert(old_frame.view).second)
                drive.left_out.push_back(fmt::format("pictures of the view {}: {}", printable(old_frame.view), why));
            continue;
        }
        for (const bool is_display : {true, false}) {
            FramePair pair;
            pair.old_frame = old_frame;
            pair.new_frame = *found;
            pair.is_display = is_display;
            pair.view = *view;
            const bool old_has = !pair.file(old_frame).empty(), new_has = !pair.file(*found).empty();
            if (old_has != new_has)
                (is_display ? png_alone : exr_alone) = true;
            else if (is_display && old_has && other_display(before, now, pair))
                other_tones = true;
            else if (old_has)
                drive.frames.push_back(std::move(pair));
        }
    }
    if (other_tones)
        drive.left_out.emplace_back("PNGs: shown by another tone mapper, at another exposure or white, or for another display than sRGB; "
                                    "the EXRs of the same moments are "
                                    "compared");
    if (png_alone)
        drive.left_out.emplace_back("PNGs that one run alone stored");
    if (exr_alone)
        drive.left_out.emplace_back("EXRs that one run alone stored");
    if (old_alone > 0)
        drive.left_out.push_back(fmt::format("{} stored frames of A that B does not have", old_alone));
    if (alone > 0)
        drive.left_out.push_back(fmt::format("{} stored frames of B that A does not have", alone));
}

void drop_maps(PictureComparison& comparison) {
    for (LayerComparison& layer : comparison.layers)
        layer.difference = layer.flip = layer.colours = {};
}

void compare_frames(DriveComparison& drive, const RunComparison& runs, const RunCompareOptions& options) {
    std::set<std::string> alone;                // another technique computes other quantities
    std::map<std::string, std::string> no_flip; // by view, why
    for (FramePair& frame : drive.frames) {
        const PicturePair pair = frame_pictures(frame, runs);
        const double density = frame_density(frame, options);
        if (frame.view.projection != Projection::map && !has_flip_at(density))
            no_flip[frame.view.name] = why_no_flip_at(density);
        frame.comparison = compare_pictures(pair, density, options.strictness);
        drop_maps(frame.comparison);
        alone.insert(pair.alone.begin(), pair.alone.end());
    }
    for (const std::string& channel : alone)
        drive.left_out.push_back(fmt::format("the channel {}, which one run's EXRs alone have", printable(channel)));
    for (const auto& [view, why] : no_flip)
        drive.left_out.push_back(fmt::format("FLIP of the view {}: {}; --ppd gives others", printable(view), why));
}

/// Of each deciding reading its largest real change, and of these the three largest.
void rank(RunComparison& runs) {
    std::vector<std::pair<std::size_t, std::size_t>> order;
    for (std::size_t d = 0; d < runs.drives.size(); ++d)
        for (std::size_t i = 0; i < runs.drives[d].changes.size(); ++i)
            if (const RunChange& c = runs.drives[d].changes[i]; c.kind == ChangeKind::real && c.decides)
                order.emplace_back(d, i);
    std::ranges::stable_sort(order, std::greater{}, [&](const auto& at) { return runs.drives[at.first].changes[at.second].size(); });
    std::set<ReadingKey> shown;
    for (const auto& at : order)
        if (runs.largest.size() < 3 && shown.insert(runs.drives[at.first].changes[at.second].reading).second)
            runs.largest.push_back(at);
}

/// A class that was asked for is kept only by pictures that were held to it.
void note_what_was_not_judged(RunComparison& runs) {
    if (runs.strictness_name.empty())
        return;
    for (const std::string& sentence : runs.left_out)
        runs.not_judged.push_back(sentence);
    for (const DriveComparison& drive : runs.drives) {
        for (const std::string& sentence : drive.left_out)
            if (!sentence.starts_with("readings") && !sentence.starts_with("all readings") && !sentence.starts_with("reach") &&
                !sentence.starts_with("the tables") && !sentence.starts_with("FLIP")) // a class that asks for FLIP says so itself
                runs.not_judged.push_back(drive.name + ": " + sentence);
        if (drive.frames.empty())
            runs.not_judged.push_back(drive.name + ": no stored frame that both runs have");
    }
}

} // namespace

PicturePair frame_pictures(const FramePair& frame, const RunComparison& runs) {
    return read_picture_pair(runs.before.folder / frame.file(frame.old_frame), runs.now.folder / frame.file(frame.new_frame), true);
}

double frame_density(const FramePair& frame, const RunCompareOptions& options) {
    if (frame.view.projection == Projection::map)
        return 0.0; // nobody looks at a map with a driver's eyes
    return options.pixels_per_degree ? *options.pixels_per_degree
                                     : pixels_per_degree_of_view(frame.view.vertical_fov_rad, frame.view.height_px);
}

bool FramePair::is_equal() const {
    return std::ranges::all_of(comparison.layers,
                               [](const LayerComparison& layer) { return layer.histogram.equal == layer.histogram.pixels(); });
}

double DriveComparison::lamp_noise() const {
    double noise = 0.0;
    for (const LampFilesDifference& lamps : lamp_files)
        noise = std::max(noise, lamps.difference.noise_relative);
    return noise;
}

std::string DriveComparison::old_label() const {
    return "A: " + before.lamp_set + (before.technique != now.technique ? ", " + before.technique : "");
}
std::string DriveComparison::new_label() const {
    return "B: " + now.lamp_set + (before.technique != now.technique ? ", " + now.technique : "");
}

bool RunComparison::passed() const {
    return strictness_name.empty() ||
           (not_judged.empty() && std::ranges::all_of(drives, [](const DriveComparison& drive) {
                return std::ranges::all_of(drive.frames, [](const FramePair& frame) { return frame.comparison.passed(); });
            }));
}

std::size_t RunComparison::count(ChangeKind kind) const {
    std::size_t found = 0;
    for (const DriveComparison& drive : drives)
        found += static_cast<std::size_t>(std::ranges::count(drive.changes, kind, &ReadingChange::kind));
    return found;
}

RunComparison compare_runs(RunFolder before, RunFolder now, const RunCompareOptions& options) {
    RunComparison runs;
    runs.before = std::move(before);
    runs.now = std::move(now);
    runs.strictness_name = options.strictness ? options.strictness->name : "";
    pair_drives(runs);
    if (runs.drives.empty())
        throw InputError({runs.now.folder, 0, 0, {}},
                         runs.left_out.empty() ? "has no drive" : "cannot be compared: " + runs.left_out.front(),
                         "a run of drives that " + runs.before.folder.string() + " has too");
    for (DriveComparison& drive : runs.drives) {
        compare_lamp_files(drive);
        compare_readings(drive);
        compare_times(drive);
        pair_frames(drive);
        compare_frames(drive, runs, options);
    }
    rank(runs);
    note_what_was_not_judged(runs);
    return runs;
}

} // namespace fernlicht
