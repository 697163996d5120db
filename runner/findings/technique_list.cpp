#include "runner/findings/technique_list.h"

#include "runner/files/json_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

std::string lux_text(const Technique& row) {
    if (!row.illuminance)
        return "no lux image";
    return row.target ? "lux image of surfaces and of a target" : "lux image of surfaces";
}

/// For a cell of a Markdown table.
std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text)
        out += c == '|' ? std::string("\\|") : std::string(1, c);
    return out;
}

} // namespace

const char* kind_name(TechniqueKind kind) {
    switch (kind) {
    case TechniqueKind::as_published:
        return "as published";
    case TechniqueKind::as_printed:
        return "as printed";
    case TechniqueKind::known:
        return "known";
    case TechniqueKind::ours:
        break;
    }
    return "ours";
}

std::string techniques_text(std::span<const Technique> rows, ShadowMethods shadows) {
    std::string text;
    for (const Technique& row : rows) {
        text += text.empty() ? "" : "\n";
        text += fmt::format("{}  ({}; {} pass{}; {}{})\n", row.name, kind_name(row.kind), row.passes, row.passes == 1 ? "" : "es",
                            lux_text(row),
                            row.thesis_row > 0 ? fmt::format("; Table 6.1 row {}: {} frames/s", row.thesis_row, row.thesis_fps) : "");
        for (const auto& [what, words] :
             {std::pair("origin", row.origin), std::pair("computes", row.computes), std::pair("ignores", row.ignores)})
            if (!words.empty())
                text += fmt::format("    {:<8}  {}\n", what, words);
    }
    for (const ShadowMethodName& row : shadows) {
        text += fmt::format("\nshadows: {}  (of photometric)\n", row.name);
        for (const auto& [what, words] :
             {std::pair("origin", row.origin), std::pair("computes", row.computes), std::pair("ignores", row.ignores)})
            if (!words.empty())
                text += fmt::format("    {:<8}  {}\n", what, words);
    }
    return text;
}

std::string techniques_json(std::span<const Technique> rows, ShadowMethods shadows) {
    Json list = Json::array();
    for (const Technique& row : rows)
        list.push_back({{"name", row.name},
                        {"kind", kind_name(row.kind)},
                        {"thesis_row", row.thesis_row > 0 ? Json(row.thesis_row) : Json(nullptr)},
                        {"thesis_fps", row.thesis_fps.empty() ? Json(nullptr) : Json(row.thesis_fps)},
                        {"origin", row.origin},
                        {"computes", row.computes},
                        {"ignores", row.ignores},
                        {"passes", row.passes},
                        {"illuminance", row.illuminance},
                        {"target", row.target},
                        {"luminance", row.luminance}});
    Json methods = Json::array();
    for (const ShadowMethodName& row : shadows)
        methods.push_back({{"name", row.name}, {"origin", row.origin}, {"computes", row.computes}, {"ignores", row.ignores}});
    return json_text(Json{{"schema", "fernlicht techniques"}, {"schema_version", 1}, {"techniques", list}, {"shadow_methods", methods}});
}

std::string techniques_markdown(std::span<const Technique> rows, ShadowMethods shadows) {
    std::string text =
        "# Techniques\n\n"
        "The ways to light a scene that `--technique NAME` chooses from. This page is what `fernlicht techniques --markdown` prints; a "
        "test holds it to that.\n\n"
        "*As published*: a configuration of the founding thesis with its misprints repaired. *As printed*: misprints and all. *Known*: "
        "another way from the literature. *Ours*: this program's own. #: the row of the thesis's Table 6.1. Passes: how often the scene is "
        "drawn for a view, shadow maps apart. Lux: whether the technique believes in an illuminance, which it can draw as a lux image, on "
        "surfaces or also on a target. Lamps of other road users light the scene, and are seen as sources, in `photometric` and "
        "`photometric-unpruned` alone; the others draw the road users' bodies.\n\n"
        "![One moment in every technique, and the lux images of those that have one](images/techniques.png)\n\n"
        "`fernlicht bench --rounds 1` writes this picture as `contact-sheet.png`; `fernlicht run DRIVE --contact-sheet` adds it to a "
        "report.\n\n"
        "| # | name | kind | computes | ignores | passes | lux | origin |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const Technique& row : rows)
        text += fmt::format("| {} | `{}` | {} | {} | {} | {} | {} | {} |\n", row.thesis_row > 0 ? fmt::format("{}", row.thesis_row) : "",
                            row.name, kind_name(row.kind), cell(row.computes), cell(row.ignores), row.passes,
                            !row.illuminance ? "no" : (row.target ? "surfaces, target" : "surfaces"), cell(row.origin));
    text += "\n## Shadow methods\n\n"
            "How `photometric` draws the shadows of lamps, chosen by `--shadows NAME` or `shadows:` in a drive; what each is worth is in "
            "[shadows](shadows.md). The published techniques cast none.\n\n"
            "| name | computes | ignores | origin |\n"
            "|---|---|---|---|\n";
    for (const ShadowMethodName& row : shadows)
        text += fmt::format("| `{}` | {} | {} | {} |\n", row.name, cell(row.computes), cell(row.ignores), cell(row.origin));
    return text;
}

} // namespace fernlicht
