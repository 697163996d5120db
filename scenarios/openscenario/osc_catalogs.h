// Catalogs: entries in other files, found by the names of catalog and entry.
#pragma once

#include "scenarios/openscenario/osc_node.h"

namespace fernlicht::osc {

/// Takes the folders that the scenario's CatalogLocations names. They are read when an entry is first asked for.
void note_catalog_folders(const OscNode& scenario);

/// The entry that a CatalogReference names, with its parameters as assigned there. Throws InputError at the reference: no such catalog, no
/// such entry (naming the nearest), a parameter that the entry does not declare.
OscNode catalog_entry(const OscNode& reference);

/// `element` as a child of `node`, or what the CatalogReference there names.
std::optional<OscNode> own_or_catalog(const OscNode& node, const char* element);

/// While it lives, the Route or Trajectory `node` is being read. The constructor refuses one that is being read already, with the names
/// that lead back to it.
class OpenEntry {
  public:
    explicit OpenEntry(const OscNode& node);
    ~OpenEntry() { reading_.open_entries.pop_back(); }
    OpenEntry(const OpenEntry&) = delete;
    OpenEntry& operator=(const OpenEntry&) = delete;

  private:
    Reading& reading_;
};

} // namespace fernlicht::osc
