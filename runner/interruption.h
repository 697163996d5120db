// Ctrl-C and SIGTERM ask a run to end after the moment at hand.
#pragma once

namespace fernlicht {

/// While it lives, SIGINT and SIGTERM set a flag; a second one ends the program at once. One within another, as a run within a study, hears
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
