#include "report_files.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/lux_codes.h"
#include "runner/findings/lux_figure.h"
#include "runner/write/page_base.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"
#include "runner/write/report_texts.h"
#include "runner/write/thumbnail.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

/// Of embedded pictures. Larger pages open slowly.
constexpr std::size_t run_pictures_bytes = std::size_t{32} << 20;
constexpr std::size_t largest_picture_bytes = std::size_t{16} << 20;
constexpr int map_codes_px = 320;
constexpr int picture_px = 640, sheet_px = 1600; ///< across, of what is embedded

std::string lamp_colour(std::size_t lamp_set) { return plots::css(plots::lamp_colour(lamp_set)); }

struct PicturedMoment {
    int tick = 0;
    double time_s = 0.0;
    std::optional<double> distance_m;
};

/// Every moment that has a picture or a map in any lamp set, in order.
std::vector<PicturedMoment> pictured(const ComparedDrive& drive) {
    std::map<int, PicturedMoment> moments;
    for (const PlayedCell* const played : drive.lamp_sets) {
        for (const StoredFrame& frame : played->frames)
            moments[frame.tick] = {frame.tick, frame.time_s, {}};
        for (const LuxMap& map : played->maps)
            moments[map.tick] = {map.tick, map.time_s, {}};
    }
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const ExtentRow& row : played->extents)
            if (const auto found = moments.find(row.tick); found != moments.end())
                found->second.distance_m = row.distance_m;
    std::vector<PicturedMoment> out;
    for (const auto& [tick, moment] : moments)
        out.push_back(moment);
    return out;
}

std::vector<std::string> views_of(const ComparedDrive& drive) {
    std::vector<std::string> views;
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const StoredFrame& frame : played->frames)
            // A map view has no picture of its own: it is shown as the lux map.
            if ((!frame.png.empty() || played->maps.empty()) && std::find(views.begin(), views.end(), frame.view) == views.end())
                views.push_back(frame.view);
    return views;
}

const StoredFrame* find_frame(const PlayedCell& played, int tick, const std::string& view) {
    const auto found =
        std::ranges::find_if(played.frames, [&](const StoredFrame& frame) { return frame.tick == tick && frame.view == view; });
    return found == played.frames.end() ? nullptr : &*found;
}

data cell_of(const StoredFrame* frame, const std::filesystem::path& folder, std::size_t& budget_bytes, int most_px = picture_px) {
    data part;
    const auto missing = [&](const std::string& why) { part.set("missing", clean_text(why)); };
    if (!frame || (frame->png.empty() && frame->exr.empty())) {
        missing("not stored at this moment");
        return part;
    }
    part.set("link", relative_link(frame->png.empty() ? frame->exr : frame->png));
    if (frame->png.empty()) {
        missing("stored as EXR only");
        return part;
    }
    try {
        FilesRead opened;
        const std::string bytes = read_file(folder / frame->png, opened, largest_picture_bytes);
        const std::string picture = embedded_picture(bytes, most_px);
        if (picture.size() <= budget_bytes) {
            budget_bytes -= picture.size();
            part.set("embedded", picture);
        } else
            missing("not in this page");
    } catch (const std::exception&) {
        // Too large for what is left of the page, or gone: the link stands either way.
        missing("not in this page");
    }
    return part;
}

data picture_of(const ComparedDrive& drive, std::size_t lamp_set, const PicturedMoment& moment, const std::string& view,
                const std::filesystem::path& folder, std::size_t& budget_bytes) {
    data cell = cell_of(find_frame(*drive.lamp_sets[lamp_set], moment.tick, view), folder, budget_bytes);
    cell.set("lamp", short_text(drive.lamp_sets[lamp_set]->lamp_set, 40));
    cell.set("colour", lamp_colour(lamp_set));
    cell.set("view", short_text(view, 40));
    cell.set("time", figure(moment.time_s, 2));
    return cell;
}

/// A picture of each lamp set, but for those that the pair shows.
data views_at(const ComparedDrive& drive, const PicturedMoment& moment, const std::vector<std::string>& views,
              const std::filesystem::path& folder, std::size_t& budget_bytes) {
    data rows{List::list};
    for (std::size_t v = 0; v < views.size(); ++v) {
        data row, cells{List::list};
        for (std::size_t i = v == 0 ? 2 : 0; i < drive.lamp_sets.size(); ++i)
            cells.push_back(picture_of(drive, i, moment, views[v], folder, budget_bytes));
        row.set("pictures", cells);
        if (cells.is_non_empty_list())
            rows.push_back(row);
    }
    return rows;
}

/// The lux codes of up to three lamp sets, for what is shown under the pointer; nothing where one of them has none.
data codes_part(const std::vector<const Image<std::uint8_t>*>& codes, const ComparedDrive& drive) {
    data part;
    if (codes.empty() || std::ranges::any_of(codes, [&](const auto* one) {
            return !one || one->width() < 1 || one->height() < 1 || one->width() != codes[0]->width() ||
                   one->height() != codes[0]->height();
        }))
        return part;
    std::string names;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        std::string name = short_text(drive.lamp_sets[i]->lamp_set, 24);
        std::ranges::replace(name, '|', '/');
        names += (i == 0 ? "" : "|") + name;
    }
    part.set("codes", embedded_codes(codes));
    part.set("names", names);
    return part;
}

/// The first view with the first two lamp sets, one over the other; of one lamp set with its lux.
data pair_at(const ComparedDrive& drive, const PicturedMoment& moment, const std::string& view, const std::filesystem::path& folder,
             std::size_t& budget_bytes) {
    const std::size_t shown = std::min<std::size_t>(2, drive.lamp_sets.size());
    std::vector<const Image<std::uint8_t>*> codes;
    for (std::size_t i = 0; i < shown; ++i) {
        const auto& all = drive.lamp_sets[i]->lux_views;
        const auto found = std::ranges::find_if(all, [&](const LuxView& one) { return one.tick == moment.tick && one.view == view; });
        codes.push_back(found == all.end() || found->codes.width() < 1 || found->codes.height() < 1 ? nullptr : &found->codes);
    }
    data part = codes_part(codes, drive);
    data first = picture_of(drive, 0, moment, view, folder, budget_bytes), under = first;
    if (shown == 2) { // what lies over the other shows on the left
        under = picture_of(drive, 1, moment, view, folder, budget_bytes);
        part.set("over", first);
    }
    if (shown == 1 && codes[0]) {
        data lux;
        lux.set("lamp", "its lux");
        lux.set("view", short_text(view, 40));
        lux.set("embedded", "data:image/png;base64," + plots::base64(plots::png_of_pixels(lux_picture(*codes[0]), 9)));
        part.set("over", lux);
    }
    part.set("under", under);
    return part;
}

/// Lux from above: of one lamp set in colours, of several the lines of all.
std::optional<data> map_at(const ComparedDrive& drive, const PicturedMoment& moment) {
    std::vector<const LuxMap*> maps;
    std::vector<std::string> names;
    std::vector<Image<std::uint8_t>> codes;
    for (const PlayedCell* const played : drive.lamp_sets)
        if (const auto map = std::ranges::find(played->maps, moment.tick, &LuxMap::tick); map != played->maps.end()) {
            maps.push_back(&*map);
            names.push_back(short_text(played->lamp_set, 24));
        }
    const auto figure = maps.empty() ? std::nullopt : isolux_figure(maps, names);
    if (!figure)
        return std::nullopt;
    std::vector<const Image<std::uint8_t>*> all;
    for (std::size_t i = 0; i < maps.size() && i < 3 && maps.size() == drive.lamp_sets.size(); ++i)
        codes.push_back(lux_codes(ahead_to_the_right(maps[i]->lx), map_codes_px));
    for (const Image<std::uint8_t>& one : codes)
        all.push_back(&one);
    data part = codes_part(all, drive);
    part.set("svg", plots::svg_of(*figure));
    return part;
}

data maps_at(const ComparedDrive& drive, const PicturedMoment& moment) {
    data maps{List::list};
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const LuxMap& map : played->maps)
            if (map.tick == moment.tick)
                if (const auto figure = lux_map_figure(map, played->lamp_set))
                    maps.push_back(plots::svg_of(*figure));
    return maps;
}

/// By what differs in them, then by lamp set.
data contact_sheets(const ComparedDrive& drive, const std::filesystem::path& folder, std::size_t& budget_bytes) {
    std::vector<std::pair<std::string, data>> kinds;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const PlayedCell& played = *drive.lamp_sets[i];
        std::vector<StoredSheet> all{{"in every technique", played.contact_sheet}};
        all.insert(all.end(), played.more_sheets.begin(), played.more_sheets.end());
        for (const StoredSheet& sheet : all) {
            if (sheet.picture.png.empty())
                continue;
            data part = cell_of(&sheet.picture, folder, budget_bytes, sheet_px);
            part.set("lamp", short_text(played.lamp_set, 40));
            part.set("colour", lamp_colour(i));
            part.set("time", figure(sheet.picture.time_s, 2));
            part.set("what", sheet.what);
            auto kind = std::ranges::find(kinds, sheet.what, &std::pair<std::string, data>::first);
            if (kind == kinds.end())
                kind = kinds.insert(kinds.end(), {sheet.what, data{List::list}});
            kind->second.push_back(part);
        }
    }
    data out{List::list};
    for (const auto& [what, sheets] : kinds) {
        data kind;
        kind.set("what", what);
        kind.set("sheets", sheets);
        out.push_back(kind);
    }
    return out;
}

/// Links to the stored pictures of moments that the page does not show.
data links_of(const ComparedDrive& drive, const std::set<int>& shown) {
    data links{List::list};
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const StoredFrame& frame : played->frames)
            if (!shown.contains(frame.tick) && !frame.png.empty()) {
                data link;
                link.set("link", relative_link(frame.png));
                link.set("text", fmt::format("{} s, {}, {}", figure(frame.time_s, 2), short_text(played->lamp_set, 40),
                                             short_text(frame.view, 40)));
                links.push_back(link);
            }
    return links;
}

/// Those with lux maps, where there are any: of the others maps were not kept.
std::vector<PicturedMoment> shown_moments(const ComparedDrive& drive, const std::vector<PicturedMoment>& all) {
    std::set<int> mapped;
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const LuxMap& map : played->maps)
            mapped.insert(map.tick);
    std::vector<PicturedMoment> candidates, out;
    for (const PicturedMoment& moment : all)
        if (mapped.empty() || mapped.contains(moment.tick))
            candidates.push_back(moment);
    for (const std::size_t index : spread_over(candidates.size(), max_pictured_moments))
        out.push_back(candidates[index]);
    return out;
}

/// Moments with pictures: views and maps side by side per lamp set. Takes the bytes that it embeds from `budget_bytes`; pictures that no
/// longer fit are linked.
data moments_part(const ComparedDrive& drive, const std::filesystem::path& folder, std::size_t& budget_bytes) {
    const std::vector<PicturedMoment> all = pictured(drive);
    const std::vector<std::string> views = views_of(drive);
    data moments{List::list};
    std::set<int> shown;
    for (const PicturedMoment& moment : shown_moments(drive, all)) {
        shown.insert(moment.tick);
        data part;
        part.set("tick", fmt::format("{}", moment.tick));
        part.set("time", figure(moment.time_s, 2));
        part.set("has_distance", moment.distance_m.has_value());
        part.set("distance", moment.distance_m ? figure(*moment.distance_m, 1) : "");
        if (!views.empty())
            part.set("pair", pair_at(drive, moment, views.front(), folder, budget_bytes));
        const std::optional<data> map = map_at(drive, moment);
        const data maps = maps_at(drive, moment), rows = views_at(drive, moment, views, folder, budget_bytes);
        if (map)
            part.set("map", *map);
        part.set("maps", maps);
        part.set("views", rows);
        part.set("has_more", maps.is_non_empty_list() || rows.is_non_empty_list());
        moments.push_back(part);
    }
    data part;
    const data sheets = contact_sheets(drive, folder, budget_bytes);
    part.set("has_sheets", sheets.is_non_empty_list());
    part.set("kinds", sheets);
    part.set("has_moments", !all.empty());
    part.set("moments", moments);
    part.set("last_moment", fmt::format("{}", shown.empty() ? 0 : shown.size() - 1));
    part.set("has_links", shown.size() < all.size());
    part.set("links", links_of(drive, shown));
    return part;
}

/// What people call the drive; its name where it has no title.
const std::string& shown_name(const ComparedDrive& drive) {
    const std::string& title = drive.lamp_sets.front()->title;
    return title.empty() ? drive.name : title;
}

std::string title_of(const RunPage& page) {
    std::string title;
    for (const RunPage::OfDrive& of : page.drives)
        title += (title.empty() ? "" : ", ") + short_text(shown_name(of.drive), 90);
    return title.empty() ? "Nothing was played" : short_text(title, 160);
}

/// "halogen against xenon, played 2024-11-21T19:30:00Z"
std::string subtitle_of(const Report& report) {
    std::vector<std::string> names;
    for (const PlayedCell& played : report.played)
        if (std::find(names.begin(), names.end(), played.lamp_set) == names.end())
            names.push_back(played.lamp_set);
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : " against ") + short_text(name, 40);
    return (text.empty() ? "Played " : text + ", played ") + clean_text(report.context.started_utc);
}

data drive_part(const RunPage::OfDrive& of, const std::filesystem::path& folder, std::size_t& budget_bytes, bool several) {
    data part;
    part.set("title", several ? data(short_text(of.drive.name, 200)) : data(false));
    part.set("pictures", moments_part(of.drive, folder, budget_bytes));
    part.set("columns", fmt::format("{}", of.drive.lamp_sets.size()));
    part.set("lead", sections_part(of.lead));
    part.set("extents", sections_part(of.extents));
    part.set("others", sections_part(of.others));
    return part;
}

data verdict_part(const Report& report, Section section) {
    const VerdictKind verdict = overall(report);
    const bool none = count_verdicts(report).all() == 0 && report.complete;
    data part;
    part.set("word", std::exchange(section.title, ""));
    part.set("class", none ? "none" : verdict_name(verdict));
    part.set("mark", none                            ? ""
                     : verdict == VerdictKind::fail  ? "\u2717"
                     : verdict == VerdictKind::flaky ? "\u2260"
                     : verdict == VerdictKind::pass  ? "\u2713"
                                                     : "?");
    part.set("reasons", sections_part({section}));
    return part;
}

constexpr std::string_view found_begins = "<!-- found -->\n", found_ends = "<!-- /found -->";

std::string page_html(const Report& report, const RunPage& run, const data& drives, const data& live, const std::string& kept) {
    data page;
    page.set("title", title_of(run));
    page.set("subtitle", subtitle_of(report));
    page.set("script", std::string(report_file("document.js")) + std::string(report_file("report.js")));
    page.set("verdict", verdict_part(report, run.verdict));
    page.set("drives", drives);
    page.set("live", live);
    page.set("kept", kept);
    page.set("context", context_part(report.context));
    return page_of("report.html.mustache", std::move(page));
}

} // namespace

std::string run_page_html(const Report& report, const RunPage& run, const std::filesystem::path& folder) {
    std::size_t budget_bytes = run_pictures_bytes;
    data parts{List::list};
    for (const RunPage::OfDrive& drive : run.drives)
        parts.push_back(drive_part(drive, folder, budget_bytes, run.drives.size() > 1));
    return page_html(report, run, parts, sections_part(run.live), "");
}

std::string rejudged_page_html(const Report& report, const RunPage& page, const std::string& kept, const std::filesystem::path& file) {
    const std::size_t begin = kept.find(found_begins), end = kept.rfind(found_ends);
    if (begin == std::string::npos || end == std::string::npos || end < begin)
        throw InputError({file, 0, 0, {}}, "is no page of a run", "one that this version wrote");
    const std::size_t from = begin + found_begins.size();
    return page_html(report, page, data{List::list}, data{List::list}, kept.substr(from, end - from));
}

} // namespace fernlicht
