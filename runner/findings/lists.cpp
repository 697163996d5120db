#include "runner/findings/lists.h"

#include "metrics/readings/reading_key.h"
#include "runner/files/json_text.h"
#include "scenarios/control/signals.h"
#include "scenarios/drives/keys/bus_keys.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

} // namespace

const char* kind_name(TechniqueKind kind) {
    static constexpr const char* names[] = {"as published", "as printed", "known", "ours"};
    return names[static_cast<std::size_t>(kind)];
}

Document techniques_document(std::span<const Technique> rows, ShadowMethods shadows) {
    Table all{
        .name = "techniques", .caption = "", .columns = columns_of("#<|name`|kind<|computes<|ignores<|passes<|lux<|origin<"), .rows = {}};
    for (const Technique& row : rows) {
        std::vector<Cell>& cells = all.rows.emplace_back(std::vector<Cell>{"", row.name, kind_name(row.kind), row.computes, row.ignores,
                                                                           fmt::format("{}", row.passes),
                                                                           !row.illuminance ? "no"
                                                                           : row.target     ? "surfaces, target"
                                                                                            : "surfaces",
                                                                           row.origin});
        if (row.thesis_row > 0)
            cells.front() = Cell(fmt::format("{}", row.thesis_row)).hinted(fmt::format("row of Table 6.1: {} frames/s", row.thesis_fps));
    }
    Table methods{.name = "shadow methods", .caption = "", .columns = columns_of("name`|computes<|ignores<|origin<"), .rows = {}};
    for (const ShadowMethodName& row : shadows)
        methods.rows.push_back({row.name, row.computes, row.ignores, row.origin});
    all.prose = methods.prose = true;
    return {"Techniques", {{"", {std::move(all)}}, {"Shadow methods", {std::move(methods)}}}};
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

Document readings_document() {
    Table all{.name = "readings", .caption = "", .columns = columns_of("reading`|unit<|better<|what it is<|equation<|source<"), .rows = {}};
    all.prose = true;
    for (const QuantityRow& row : quantities())
        all.rows.push_back({fmt::format("{}", fmt::join(forms_in_words(row), ", ")), row.unit,
                            row.better == Better::higher  ? "higher"
                            : row.better == Better::lower ? "lower"
                                                          : "",
                            row.meaning, row.equation, row.source});
    return {"Readings", {{"", {std::move(all)}}}};
}

std::string readings_json() {
    Json all = Json::array();
    for (const QuantityRow& row : quantities())
        all.push_back({{"names", forms_in_words(row)},
                       {"unit", row.unit},
                       {"better", row.better == Better::higher  ? Json("higher")
                                  : row.better == Better::lower ? Json("lower")
                                                                : Json(nullptr)},
                       {"meaning", row.meaning},
                       {"equation", row.equation},
                       {"source", row.source}});
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Document techniques_reference(std::span<const Technique> rows, ShadowMethods shadows) {
    const auto ending = [](std::string_view ignores, std::string_view origin) {
        return fmt::format("{}{}{}{}.", ignores.empty() ? "" : ". Ignores ", ignores, origin.empty() ? "" : ". ", origin);
    };
    Listing all, methods;
    for (const Technique& row : rows)
        all.items.emplace_back(
            fmt::format("`{}` ({}{}{}): {}{}", row.name, kind_name(row.kind), row.passes == 1 ? "" : fmt::format(", {} passes", row.passes),
                        !row.illuminance ? ", no lux"
                        : row.target     ? ", lux on targets too"
                                         : "",
                        row.computes, ending(row.ignores, row.thesis_row > 0 ? fmt::format("Row {}", row.thesis_row) : row.origin)));
    for (const ShadowMethodName& row : shadows)
        methods.items.emplace_back(fmt::format("`{}`: {}{}", row.name, row.computes, ending(row.ignores, row.origin)));
    return {"Techniques",
            {{"",
              {"For `--technique`; [techniques.md](../techniques.md) explains the kinds. One pass for a view, and lux on surfaces, unless "
               "something else is said. Rows are those of Table 6.1 of Knebel 2004.",
               std::move(all)}},
             {"Shadow methods", {"For `--shadows`; [shadows.md](../shadows.md) has what they cost.", std::move(methods)}}}};
}

Document quantities_reference() {
    Listing all;
    for (const QuantityRow& row : quantities()) {
        std::string source = row.equation;
        if (*row.source)
            source += (source.empty() ? "" : "; ") + std::string(row.source);
        for (std::size_t at = 0; (at = source.find("](", at)) != std::string::npos; at += 5)
            source.replace(at, 2, "](../"); // pages name one another from docs/
        all.items.emplace_back(fmt::format("`{}` ({}{}): {}{}{}", fmt::join(forms_in_words(row), "`, `"), row.unit,
                                           row.better == Better::higher  ? ", higher"
                                           : row.better == Better::lower ? ", lower"
                                                                         : "",
                                           row.meaning, source.empty() ? "" : ". ", source));
    }
    return {
        "Quantities",
        {{"",
          {"What `fernlicht readings` lists; [readings.md](../readings.md) explains how names are made. In brackets the unit and which way "
           "is better. `[_min/_p05]`: one of these or none; `(road/target)`: one of these; numbers stand for any. Meaning, equation, "
           "source.",
           std::move(all)}}}};
}

Document signals_document() {
    Table all{
        .name = "signals", .caption = "", .columns = columns_of("signal`|unit<|least|greatest|written by<|from bus<|meaning<"), .rows = {}};
    for (const SignalKind& kind : known_signals())
        all.rows.push_back({kind.name, kind.unit, Cell(fmt::format("{:g}", kind.least), kind.least),
                            Cell(fmt::format("{:g}", kind.greatest), kind.greatest), kind.writer, may_come_from_bus(kind) ? "yes" : "no",
                            kind.meaning});
    return {"Signals of lamp control", {{"", {std::move(all)}}}};
}

std::string signals_json() {
    Json all = Json::array();
    for (const SignalKind& kind : known_signals())
        all.push_back({{"name", kind.name},
                       {"unit", kind.unit},
                       {"least", kind.least},
                       {"greatest", std::isfinite(kind.greatest) ? Json(kind.greatest) : Json("inf")},
                       {"written_by", kind.writer},
                       {"from_bus", may_come_from_bus(kind)},
                       {"meaning", kind.meaning}});
    return all.dump(2) + "\n";
}

Document fmus_document(const std::vector<ListedFmu>& fmus) {
    Document document{"Variables of FMUs", {}};
    for (const ListedFmu& fmu : fmus) {
        Table all{.name = fmt::format("fmu-{}", document.sections.size() + 1),
                  .caption = "",
                  .columns = columns_of("variable`|is<|type<|unit<|tied to<"),
                  .rows = {}};
        for (const FmuTie& tie : fmu.ties)
            all.rows.push_back(
                {tie.variable.name, tie.variable.causality,
                 tie.variable.count ? fmt::format("{}, {} values", tie.variable.element, *tie.variable.count) : tie.variable.element,
                 tie.variable.unit.name, tie.tie});
        document.sections.push_back({fmu.title, {std::move(all)}});
    }
    return document;
}

std::string fmus_json(const std::vector<ListedFmu>& fmus) {
    Json all = Json::array();
    for (const ListedFmu& fmu : fmus) {
        Json variables = Json::array();
        for (const FmuTie& tie : fmu.ties)
            variables.push_back({{"name", tie.variable.name},
                                 {"causality", tie.variable.causality},
                                 {"type", tie.variable.element},
                                 {"values", tie.variable.count.value_or(1)},
                                 {"unit", tie.variable.unit.name},
                                 {"tie", tie.tie}});
        all.push_back({{"fmu", fmu.title}, {"variables", variables}});
    }
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace fernlicht
