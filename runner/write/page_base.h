// What every page has: sections of documents, figures for people, and what its results were made with.
#pragma once

#include "runner/findings/document.h"
#include "runner/findings/figures.h"
#include "runner/findings/findings.h"

#include <kainjow/mustache.hpp>

namespace fernlicht {

/// Commands, versions, machine, input files.
kainjow::mustache::data context_part(const RunContext& context);

/// What the partial `document_sections` prints.
kainjow::mustache::data sections_part(const std::vector<Section>& sections);

/// A page by one of the embedded templates, which may use `style` and the partial. Throws std::logic_error where the template is none.
std::string page_of(const char* template_name, kainjow::mustache::data page);

} // namespace fernlicht
