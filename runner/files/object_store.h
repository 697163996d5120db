// Contents by their hash, a file each below objects/: what baselines and cells are kept in.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

/// Where a store has the bytes of this hash (32 hexadecimal digits).
std::filesystem::path object_path(const std::filesystem::path& store, const std::string& hash);

/// True where the store has these bytes, whole. Throws DeviceError, as all below, where it cannot be read.
bool holds_object(const std::filesystem::path& store, const std::string& hash);

/// Keeps the bytes, on the disk when it returns; nothing refers to them yet. Whole ones that are there stay. Returns their hash. Any
/// number of processes may do so at once. Throws DeviceError.
std::string put_object(const std::filesystem::path& store, const std::string& content);

/// Throws InputError where they are missing or not what was stored; `what` names them: "the RESULT that was accepted".
std::string get_object(const std::filesystem::path& store, const std::string& hash, const std::string& what);

} // namespace fernlicht
