#include "runner/reference_key.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

/// A context's cpu is "model (simd class)"; the model does not decide over a bit of the results.
std::string simd_of(const std::string& cpu) {
    const std::size_t open = cpu.rfind('(');
    if (open == std::string::npos || !cpu.ends_with(')'))
        return cpu;
    return cpu.substr(open + 1, cpu.size() - open - 2);
}

} // namespace

ReferenceKey reference_key(const std::string& drive, const std::string& variant, const std::string& technique, const RunContext& context) {
    return {drive, variant, technique, context.backend, context.gl_renderer, simd_of(context.cpu)};
}

std::string key_text(const ReferenceKey& key) {
    return fmt::format("{}, {}, {}; {}, {}, {}", key.drive, key.variant, key.technique, key.backend, key.gl_renderer, key.simd);
}

} // namespace fernlicht
