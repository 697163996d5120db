// What every page has: colours, and what its results were made with.
#pragma once

#include "runner/findings/figures.h"
#include "runner/findings/report.h"

#include <filesystem>
#include <kainjow/mustache.hpp>

namespace fernlicht {

/// Colours of the variants in every table and plot (after Okabe and Ito: told apart by colour-blind readers too); starts again after six.
const char* variant_colour(std::size_t index);

/// Commands, versions, machine, input files.
kainjow::mustache::data context_part(const RunContext& context);

/// What the partial `document_sections` prints; `has_script` where something sorts or slides. Pictures are read below `folder`.
kainjow::mustache::data sections_part(const std::vector<Section>& sections, const std::filesystem::path& folder = {});

/// A page by one of the embedded templates, which may use `style` and the partial. Throws std::logic_error where the template is none.
std::string page_of(const char* template_name, kainjow::mustache::data page);

} // namespace fernlicht
