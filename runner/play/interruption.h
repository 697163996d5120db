// Ctrl-C and SIGTERM ask a run to end after the moment at hand.
#pragma once

namespace fernlicht {

/// While it lives, SIGINT and SIGTERM set a flag; one that comes half a second after the first or later ends the program at once; what
/// comes sooner is the same wish, as `timeout` sends it to a process and to its group. One within another, as a run within a study, hears
/// what the outer one heard.
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    static bool asked();
};

} // namespace fernlicht
