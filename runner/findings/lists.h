// What there is to choose from, as documents: techniques, readings, signals of lamp control.
#pragma once

#include "renderer/technique.h"
#include "runner/findings/document.h"
#include "scenarios/control/fmu_law.h"
#include "scenarios/drives/shadow_settings.h"

namespace fernlicht {

const char* kind_name(TechniqueKind kind); ///< "as published", "as printed", "known", "ours"

using ShadowMethods = std::span<const ShadowMethodName>;
Document techniques_document(std::span<const Technique> rows, ShadowMethods shadows);
std::string techniques_json(std::span<const Technique> rows, ShadowMethods shadows);
Document readings_document();
std::string readings_json();
/// The same as lists: docs/reference/techniques.md and quantities.md.
Document techniques_reference(std::span<const Technique> rows, ShadowMethods shadows);
Document quantities_reference();
Document signals_document();
std::string signals_json();

/// An FMU of a drive's lamp set, or one by itself.
struct ListedFmu {
    std::string title;
    std::vector<FmuTie> ties;
};
Document fmus_document(const std::vector<ListedFmu>& fmus);
std::string fmus_json(const std::vector<ListedFmu>& fmus);

} // namespace fernlicht
