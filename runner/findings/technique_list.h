// The table of techniques for people, machines and documents. Pure functions of the rows.
#pragma once

#include "renderer/technique.h"
#include "scenarios/drives/shadow_settings.h"

#include <string>

namespace fernlicht {

const char* kind_name(TechniqueKind kind); ///< "as published", "as printed", "known", "ours"

using ShadowMethods = std::span<const ShadowMethodName>;
std::string techniques_text(std::span<const Technique> rows, ShadowMethods shadows);
std::string techniques_json(std::span<const Technique> rows, ShadowMethods shadows);
/// The whole of docs/techniques.md.
std::string techniques_markdown(std::span<const Technique> rows, ShadowMethods shadows);

} // namespace fernlicht
