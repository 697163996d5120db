// The tools of `fernlicht can` for logs and frames of a CAN bus, a source file each.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

/// Adds a tool. When it is chosen, `chosen` becomes what does it and gives the exit code.
using AddCanTool = void(CLI::App& can, std::function<int()>& chosen);

AddCanTool add_can_merge;   // several logs of CAN buses as one, in order of time
AddCanTool add_can_cut;     // the part of a log between two times, of some identifiers and channels
AddCanTool add_can_convert; // a log in another of candump's forms
AddCanTool add_can_decode;  // what the frames of a log mean
AddCanTool add_can_record;  // a drive's script as the recording of a bus

} // namespace fernlicht
