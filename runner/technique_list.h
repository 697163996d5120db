// The table of techniques for people, machines and documents. Pure functions of the rows.
#pragma once

#include "renderer/technique.h"

#include <string>

namespace fernlicht {

const char* kind_name(TechniqueKind kind); ///< "as published", "as printed", "known", "ours"

std::string techniques_text(std::span<const Technique> rows);
std::string techniques_json(std::span<const Technique> rows);
/// The whole of docs/techniques.md.
std::string techniques_markdown(std::span<const Technique> rows);

} // namespace fernlicht
