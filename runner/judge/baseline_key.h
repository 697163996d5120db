// What must agree before two runs can be expected to give the same pictures.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

struct BaselineKey {
    std::string drive, lamp_set, technique;
    /// Device class. Pictures of one class are the same bytes; llvmpipe's depend on how wide it draws, which its name tells, the twin's
    /// last digits on the C library's choice by the CPU's SIMD. backend: "software" for llvmpipe.
    std::string backend, gl_renderer, simd;
    std::string inputs; ///< XXH3-128 over the hashes of what decides the results (input_hashes.h)
    bool operator==(const BaselineKey&) const = default;
};

std::string hash_of_inputs(const std::vector<std::pair<std::string, std::string>>& inputs);
BaselineKey baseline_key(const std::string& drive, const std::string& lamp_set, const std::string& technique, const RunContext& context,
                         const std::vector<std::pair<std::string, std::string>>& inputs);

/// The same drive, lamp set and technique on the same device class, whatever the inputs.
bool same_but_inputs(const BaselineKey& a, const BaselineKey& b);
/// The same drive and technique on the same device class, another lamp set.
bool same_but_lamp_set(const BaselineKey& a, const BaselineKey& b);
/// The same drive, lamp set, technique and inputs, whatever the device.
bool same_but_device(const BaselineKey& a, const BaselineKey& b);

/// "straight, halogen, photometric; software, llvmpipe (LLVM 15.0.6, 256 bits), avx2".
std::string key_text(const BaselineKey& key);
/// "software, llvmpipe (LLVM 15.0.6, 256 bits), avx2".
std::string device_text(const BaselineKey& key);
/// "straight/halogen/photometric".
std::string cell_text(const BaselineKey& key);

} // namespace fernlicht
