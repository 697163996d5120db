#include "runner/kernel_can.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <linux/can.h>
#include <net/if_arp.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {

KernelCan probe_kernel_can() {
    KernelCan can;
    const int socket = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
    if (socket < 0) {
        can.reason = std::generic_category().message(errno);
        return can;
    }
    ::close(socket);
    can.available = true;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/net", error)) {
        int type = 0;
        std::ifstream(entry.path() / "type") >> type;
        if (type == ARPHRD_CAN)
            can.interfaces.push_back(entry.path().filename().string());
    }
    return can;
}

} // namespace fernlicht
