// What must agree before two runs can be expected to give the same pictures.
#pragma once

#include "runner/report/report.h"

namespace fernlicht {

struct ReferenceKey {
    std::string drive, variant, technique;
    /// Class of device. Pictures of one class are the same bytes; llvmpipe's depend on the SIMD it finds, the twin's last digits on the
    /// C library's choice by it.
    std::string backend, gl_renderer, simd;
    bool operator==(const ReferenceKey&) const = default;
};

ReferenceKey reference_key(const std::string& drive, const std::string& variant, const std::string& technique, const RunContext& context);

/// "straight, halogen, photometric; egl, llvmpipe (LLVM 15.0.6, 256 bits), avx2".
std::string key_text(const ReferenceKey& key);

} // namespace fernlicht
