#include "runner/write/document_json.h"

#include "runner/write/document.h"

#include <algorithm>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json rows_of(const Table& table) {
    Json rows = Json::array();
    for (const std::vector<Cell>& cells : table.rows) {
        Json row = Json::object();
        for (std::size_t i = 0; i < std::min(cells.size(), table.columns.size()); ++i)
            row[head_of(table.columns[i])] = cells[i].value ? Json(*cells[i].value) : Json(cells[i].text);
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace

Json document_json(const Document& document) {
    Json sections = Json::array();
    for (const Section& section : document.sections) {
        Json one = Json::object(), text = Json::array(), tables = Json::object();
        if (!section.title.empty())
            one["title"] = section.title;
        for (const DocumentPart& part : section.blocks) {
            if (const auto* const paragraph = std::get_if<std::string>(&part))
                text.push_back(*paragraph);
            else if (const auto* const listing = std::get_if<Listing>(&part))
                for (const Cell& item : listing->items)
                    text.push_back(item.text);
            else if (const auto* const table = std::get_if<Table>(&part))
                tables[table->name] = rows_of(*table);
        }
        if (!text.empty())
            one["text"] = std::move(text);
        if (!tables.empty())
            one["tables"] = std::move(tables);
        if (!one.empty())
            sections.push_back(std::move(one));
    }
    return {{"title", document.title}, {"sections", std::move(sections)}};
}

} // namespace fernlicht
