// Keys, producers and hashes of accepted results in JSON, the same in every file that holds them.
#pragma once

#include "runner/files/described_json.h"
#include "runner/judge/baseline_store.h"

namespace fernlicht {

JsonMembers key_members(BaselineKey& key);
JsonMembers producer_members(Producer& producer);
JsonMembers stored_members(StoredBaseline& entry);
/// Refuses what is no hash.
JsonPart hash_part(std::string& hash);

} // namespace fernlicht
