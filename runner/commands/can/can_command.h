// `fernlicht can`: small tools for logs and frames of a CAN bus, one file each in runner/can/.
// `fernlicht can convert`: a log in another of candump's forms.
// `fernlicht can cut`: the part of a log between two times, of some identifiers and channels.
// `fernlicht can decode`: what the frames of a log mean.
// `fernlicht can merge`: several logs of CAN buses as one, in order of time.
// `fernlicht can record`: a drive's script as the recording of a bus.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_command(CLI::App& app, std::function<int()>& chosen);

void add_can_convert(CLI::App& can, std::function<int()>& chosen);

void add_can_cut(CLI::App& can, std::function<int()>& chosen);

void add_can_decode(CLI::App& can, std::function<int()>& chosen);

void add_can_merge(CLI::App& can, std::function<int()>& chosen);

void add_can_record(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
