// Other road users at an instant.
#pragma once

#include "scenarios/drives/play/moment.h"

namespace fernlicht {

/// Fills the moment's bodies, and adds the lamps of those that are there and lit, from the drive's traffic at the moment's time.
void add_traffic(const Drive& drive, Moment& moment);

} // namespace fernlicht
