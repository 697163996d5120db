// A reference half drawn, on disk: to go on with after Ctrl-C, a crash or a power cut, and end in the same bytes.
#pragma once

#include "runner/reference/reference_result.h"

#include <filesystem>
#include <string>

namespace fernlicht {

/// 32 hexadecimal digits over everything that decides the picture: fernlicht's version, the resolved drive, the content of each file it
/// came from and its path, lamp set, moment, view and settings. Not the number of threads, and not where results go.
std::string hash_of_inputs(const ReferenceResult& result, const Drive& drive);

std::filesystem::path checkpoint_file(const std::filesystem::path& folder);

/// Replaces an older one whole or not at all; on the disk when this returns. Throws DeviceError.
void write_checkpoint(const ReferenceImage& image, const std::string& inputs_hash, const std::filesystem::path& folder);

/// Throws InputError in one sentence: no checkpoint, one of other inputs, one that is cut short or not ours.
ReferenceImage read_checkpoint(const std::string& inputs_hash, const View& view, const Wanted& wanted, const std::filesystem::path& folder);

} // namespace fernlicht
