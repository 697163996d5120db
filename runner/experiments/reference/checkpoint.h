// A half-finished reference on disk, to resume after Ctrl-C, a crash or a power cut and end with the same bytes.
#pragma once

#include "runner/experiments/reference/reference_result.h"

#include <filesystem>
#include <string>

namespace fernlicht {

/// Everything that decides the picture, one `name<tab>value` a line: fernlicht's version, the resolved drive, the content of each file it
/// came from and its path, lamp set, moment, view and settings; names are those of flags where there is one. Not the number of threads,
/// and not where results go.
std::string checkpoint_inputs(const ReferenceResult& result, const Drive& drive);

/// What two of these have different, for a sentence: "--seed 1, now 2; other content of lamps/a.ies". At most three things are named.
std::string differing_inputs(const std::string& then, const std::string& now);

std::filesystem::path checkpoint_file(const std::filesystem::path& folder);

/// Replaces an older one whole or not at all; on the disk when this returns. Throws DeviceError.
void write_checkpoint(const ReferenceImage& image, const std::string& inputs, const std::filesystem::path& folder);

/// Throws InputError in one sentence: no checkpoint, a picture that is finished, one of other inputs and which they are, one that is cut
/// short or not ours.
ReferenceImage read_checkpoint(const std::string& inputs, const View& view, const FrameOutputs& outputs,
                               const std::filesystem::path& folder);

} // namespace fernlicht
