// What a run was made with: versions, machine, command. For the report, so that a stranger can repeat it.
#pragma once

#include "renderer/device.h"
#include "runner/findings/report.h"

namespace fernlicht {

RunContext make_context(const DeviceInfo& device, const std::vector<std::string>& command, std::uint64_t seed);

/// A command line that a POSIX shell splits back into these words.
std::string shell_quoted(const std::vector<std::string>& words);

/// How to repeat a part of a call: its words without `others`, without the folder that is taken by now (--out, --resume) and, where there
/// is a choice, without an earlier one (--only), then the choice; quoted. "" for no call.
std::string repeat_command(const std::vector<std::string>& call, const std::vector<std::string>& choice = {},
                           const std::vector<std::string>& others = {});

/// Now as ISO 8601: 2026-01-31T22:15:00Z.
std::string utc_now();

std::string cpu_name();
/// The widest SIMD that Mesa's llvmpipe would use here: its pictures depend on it. "avx512", "avx2", "avx", "sse4.1", "other".
std::string simd_class();
std::string os_name();

} // namespace fernlicht
