// A document for programs: the JSON of experiments whose findings have none of their own.
#pragma once

#include "runner/findings/document.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

/// {"title", "sections": [{"title", "text": [paragraphs], "tables": {name: [{head: figure or words}]}}]}; what is not there is left out.
nlohmann::ordered_json document_json(const Document& document);

} // namespace fernlicht
