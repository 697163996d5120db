// The DBC files that a tool was given, and what they know about a frame.
#pragma once

#include "scenarios/can/can_database.h"
#include "scenarios/can/can_frame.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

struct DatabaseFlags {
    std::vector<std::string> files;
    std::string id_mask; ///< "": all bits count
};

/// --dbc, --frame-id-mask
void add_database_flags(CLI::App& command, DatabaseFlags& flags);

class Databases {
  public:
    /// Reads all files. Throws InputError for what cannot be read, none given, or a mask that is no number.
    explicit Databases(const DatabaseFlags& flags);

    /// Of data frames; the first file that describes it counts. nullptr: none does.
    const CanMessage* message(const CanFrame& frame) const;
    const std::vector<CanDatabase>& all() const { return databases_; }

  private:
    std::vector<CanDatabase> databases_;
    std::uint32_t mask_ = 0x1FFFFFFF;
    std::unordered_map<std::uint64_t, const CanMessage*> by_id_;
};

/// Messages and signals that shall stay: "Message", "Message.Signal" (or with / in place of the point), or "Signal" of any message.
class Selection {
  public:
    Selection() = default;
    /// Throws InputError for a name that nothing in the databases has.
    Selection(const std::vector<std::string>& names, const Databases& databases);
    bool everything() const { return messages_.empty(); }
    bool takes(const CanMessage& message) const;
    bool takes(const CanSignal& signal) const;

  private:
    std::unordered_set<const CanMessage*> messages_;
    std::unordered_set<const CanSignal*> signals_;
};

} // namespace fernlicht
