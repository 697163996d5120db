// Keys and hashes of accepted results in JSON, the same in every file that holds them.
#pragma once

#include "runner/files/checked_json.h"
#include "runner/judge/reference_key.h"

namespace fernlicht {

nlohmann::ordered_json key_json(const ReferenceKey& key);
/// Throw InputError with the place of what is missing or of another kind.
ReferenceKey read_key(const CheckedJson& json);
std::string read_hash(const CheckedJson& json);

} // namespace fernlicht
