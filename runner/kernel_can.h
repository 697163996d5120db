// Does this kernel speak CAN? The one file that knows SocketCAN.
#pragma once

#include <string>
#include <vector>

namespace fernlicht {

struct KernelCan {
    bool available = false;
    std::string reason;                  ///< why not
    std::vector<std::string> interfaces; ///< names of CAN interfaces
};
KernelCan probe_kernel_can();

} // namespace fernlicht
