#include "scenarios/drives/shadow_settings.h"

#include <algorithm>

namespace fernlicht {
namespace {

constexpr ShadowMethodName names[] = {{ShadowMethod::none, "none"}, {ShadowMethod::map, "map"}};

} // namespace

std::span<const ShadowMethodName> shadow_method_names() { return names; }

std::string_view name(ShadowMethod method) { return std::ranges::find(names, method, &ShadowMethodName::method)->name; }

} // namespace fernlicht
