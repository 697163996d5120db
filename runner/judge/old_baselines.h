// Baselines of version 0.1, brought to today's names and hashes.
#pragma once

#include "scenarios/drives/drive.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

/// Rewrites the store in place; results and frames stay as they were accepted. Version 0.1 hashed drives' texts: their hashes of today are
/// known where `cells`, drives with one lamp set each, have the drive. Returns "INDEX:LINE: ..." for each result that no cell has, which
/// keeps its old hash, and so is found by no run. A store of today is left alone. Throws InputError for what is no store.
std::vector<std::string> convert_baselines(const std::filesystem::path& store, const std::vector<Drive>& cells);

} // namespace fernlicht
