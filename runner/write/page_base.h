// What every page has: sections of documents, and how its results were made.
#pragma once

#include "runner/findings/document.h"
#include "runner/findings/figures.h"
#include "runner/findings/findings.h"
#include "scenarios/values/files.h"

#include <filesystem>
#include <kainjow/mustache.hpp>

namespace fernlicht {

/// Commands, versions, machine, input files.
kainjow::mustache::data context_part(const RunContext& context);

/// What the partial `document_sections` prints; `has_script` where something sorts or slides. Pictures are read below `folder`.
kainjow::mustache::data sections_part(const std::vector<Section>& sections, const std::filesystem::path& folder = {});

/// A page by one of the embedded templates, which may use `style` and the partial. Throws std::logic_error where the template is none.
void page_of(const char* template_name, kainjow::mustache::data page, const TakePiece& take);
std::string page_of(const char* template_name, kainjow::mustache::data page);

} // namespace fernlicht
