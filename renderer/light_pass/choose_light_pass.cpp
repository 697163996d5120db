#include "renderer/renderer.h"

#include <array>
#include <utility>

namespace fernlicht {
namespace {

constexpr std::array names{std::pair(LightPass::automatic, std::string_view("auto")),
                           std::pair(LightPass::shader, std::string_view("shader")), std::pair(LightPass::cpu, std::string_view("cpu"))};

/// By class of device, never by a clock: the same machine always draws the same bytes. Measured (docs/benchmarks.md): with AVX-512 the
/// CPU's light takes a quarter less than llvmpipe's shader, with AVX2 as much, and then draws the same bytes as with AVX-512; narrower it
/// takes more.
struct OfClass {
    bool software;       ///< GL runs on the CPU
    packs::Level widest; ///< of the CPU's packs
    LightPass pass;
};
constexpr std::array classes{OfClass{true, packs::Level::avx512, LightPass::cpu}, OfClass{true, packs::Level::avx2, LightPass::cpu},
                             OfClass{true, packs::Level::plain, LightPass::shader}};

} // namespace

LightPass light_pass_named(std::string_view name) {
    for (const auto& [pass, known] : names)
        if (known == name)
            return pass;
    throw InputError({{}, 0, 0, "--light-pass"}, "found '" + printable(std::string(name)) + "'", light_pass_names);
}

std::string_view light_pass_name(LightPass pass) {
    for (const auto& [known, name] : names)
        if (known == pass)
            return name;
    return "";
}

LightPass light_pass_for(const DeviceInfo& device, LightPass wish) {
    if (wish != LightPass::automatic)
        return wish;
    for (const OfClass& of : classes)
        if (of.software == device.software && of.widest == packs::widest_level())
            return of.pass;
    return LightPass::shader;
}

} // namespace fernlicht
