#include "runner/judge/baseline_key.h"

#include "scenarios/values/files.h"

#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

/// A context's cpu is "model (simd class)"; the model does not decide over a bit of the results. Nor does AVX-512 beside AVX2, other than
/// for Embree: Mesa's llvmpipe draws 256 bits wide with either, the C library takes the same functions (docs/baselines.md: measured).
std::string simd_of(const RunContext& context) {
    const std::string& cpu = context.cpu;
    const std::size_t open = cpu.rfind('(');
    if (open == std::string::npos || !cpu.ends_with(')'))
        return cpu;
    const std::string simd = cpu.substr(open + 1, cpu.size() - open - 2);
    return simd == "avx512" && context.backend != "rays" ? "avx2" : simd;
}

/// llvmpipe is the same code whether EGL or OSMesa hands out the context: the same bytes.
std::string backend_of(const RunContext& context) { return context.gl_renderer.starts_with("llvmpipe") ? "software" : context.backend; }

} // namespace

std::string hash_of_inputs(const std::vector<std::pair<std::string, std::string>>& inputs) {
    std::map<std::string, std::string> by_name(inputs.begin(), inputs.end()); // files give them in another order
    std::string hashes;
    for (const auto& [name, hash] : by_name)
        hashes += hash + "\n";
    return content_hash(hashes.data(), hashes.size());
}

BaselineKey baseline_key(const std::string& drive, const std::string& lamp_set, const std::string& technique, const RunContext& context,
                         const std::vector<std::pair<std::string, std::string>>& inputs) {
    return {drive, lamp_set, technique, backend_of(context), context.gl_renderer, simd_of(context), hash_of_inputs(inputs)};
}

bool same_but_inputs(const BaselineKey& a, const BaselineKey& b) {
    BaselineKey other = b;
    other.inputs = a.inputs;
    return a == other;
}

bool same_but_lamp_set(const BaselineKey& a, const BaselineKey& b) {
    BaselineKey other = b;
    other.inputs = a.inputs;
    other.lamp_set = a.lamp_set;
    return a == other && a.lamp_set != b.lamp_set;
}

bool same_but_device(const BaselineKey& a, const BaselineKey& b) {
    return a.drive == b.drive && a.lamp_set == b.lamp_set && a.technique == b.technique && a.inputs == b.inputs;
}

std::string key_text(const BaselineKey& key) {
    return fmt::format("{}, {}, {}; {}", key.drive, key.lamp_set, key.technique, device_text(key));
}

std::string device_text(const BaselineKey& key) { return fmt::format("{}, {}, {}", key.backend, key.gl_renderer, key.simd); }

std::string cell_text(const BaselineKey& key) { return fmt::format("{}/{}/{}", key.drive, key.lamp_set, key.technique); }

} // namespace fernlicht
