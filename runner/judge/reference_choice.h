// The accepted results that a word of the command line means.
#pragma once

#include "runner/judge/reference_store.h"

namespace fernlicht {

/// Entries whose id begins with `word` (at least four hexadecimal digits), or those whose cell (drive/lamp set/technique) or a part of it
/// from the left is `word`: "straight", "straight/halogen". Throws InputError where there is none, naming the nearest, or no store.
std::vector<StoredReference> choose_references(const std::filesystem::path& store, const std::string& word);

/// The one entry that `word` means. Throws InputError that lists them where it means several.
StoredReference choose_reference(const std::filesystem::path& store, const std::string& word);

} // namespace fernlicht
