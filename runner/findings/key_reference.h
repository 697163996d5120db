// The keys of all files that people write, as a document: docs/reference/keys.md.
#pragma once

#include "runner/findings/document.h"
#include "scenarios/fields/key_list.h"

namespace fernlicht {

/// Of drives, studies, ratings, recipes and pixel lamps.
Document keys_document();

/// A section each. Lists that say the same stand once, and keys that stand in full elsewhere are named with a link to there.
std::vector<Section> key_sections(std::vector<KeyList> lists);

} // namespace fernlicht
