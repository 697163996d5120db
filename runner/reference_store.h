// Accepted results on disk: a folder with index.json, which names one folder for each key. That file is replaced in one rename, so a
// reader sees all of an acceptance or nothing of it.
#pragma once

#include "runner/reference_key.h"

#include <filesystem>
#include <optional>

namespace fernlicht {

struct ReferenceFrame {
    int tick = 0;
    std::string view;
    std::filesystem::path exr; ///< where the file lies
};

struct AcceptedReference {
    ReferenceKey key;
    Readings readings;
    std::vector<ReferenceFrame> frames;
};

/// nullopt when nothing was accepted for this key, or the folder is not there. Throws InputError when index, reference or frames are
/// damaged: stored hashes must agree.
std::optional<AcceptedReference> find_reference(const std::filesystem::path& store, const ReferenceKey& key);

/// Takes all of these (their frames are copied) in place of what was there under the same keys; other keys stay. Interrupted at any
/// moment, the store holds either everything from before or everything new. Waits while another process stores.
/// Throws DeviceError when the folder cannot be written, InputError when a frame cannot be read or the store is damaged.
void store_references(const std::filesystem::path& store, const std::vector<AcceptedReference>& references);

} // namespace fernlicht
