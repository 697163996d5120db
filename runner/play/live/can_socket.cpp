#include "runner/play/live/can_socket.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {
namespace {

constexpr std::int64_t reopen_every_ns = 20'000'000;
constexpr std::size_t batch_frames = 64, max_waiting = 256;
constexpr int large_buffer_bytes = 4 << 20; ///< some 10000 frames: what comes within a second on a bus that is full

std::string said(int error) { return std::generic_category().message(error); }

std::int64_t nanoseconds(const timespec& time) { return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec; }
std::int64_t clock_ns(clockid_t clock) {
    timespec now{};
    ::clock_gettime(clock, &now);
    return nanoseconds(now);
}

/// Of the kernel's network device; nullopt: there is none of this name.
std::optional<int> arp_type(const std::string& interface) {
    std::ifstream file("/sys/class/net/" + interface + "/type");
    int type = 0;
    return file >> type ? std::optional(type) : std::nullopt;
}

bool is_up(int socket, const std::string& interface) {
    ifreq request{};
    interface.copy(request.ifr_name, sizeof(request.ifr_name) - 1);
    return ::ioctl(socket, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) != 0;
}

template <class Value> void set_option(int socket, int level, int name, const Value& value, const char* what) {
    if (::setsockopt(socket, level, name, &value, sizeof(value)) != 0)
        throw DeviceError(fmt::format("kernel CAN: {} cannot be set: {}", what, said(errno)));
}

std::vector<can_filter> filters_of(const std::vector<std::pair<std::uint32_t, bool>>& only) {
    std::vector<can_filter> filters;
    for (const auto& [id, extended] : only)
        filters.push_back({id | (extended ? CAN_EFF_FLAG : 0U), (extended ? CAN_EFF_MASK : CAN_SFF_MASK) | CAN_EFF_FLAG | CAN_RTR_FLAG});
    return filters;
}

CanFrame frame_of(const canfd_frame& raw, std::size_t bytes) {
    CanFrame frame;
    frame.fd = bytes == CANFD_MTU;
    frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
    frame.extended = !frame.error && (raw.can_id & CAN_EFF_FLAG) != 0;
    frame.remote = !frame.error && (raw.can_id & CAN_RTR_FLAG) != 0;
    frame.id = raw.can_id & (frame.error || frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    frame.length = std::min<std::uint8_t>(raw.len, frame.fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN);
    if (frame.fd) {
        frame.bit_rate_switch = (raw.flags & CANFD_BRS) != 0;
        frame.error_state_indicator = (raw.flags & CANFD_ESI) != 0;
    } else if (frame.length == CAN_MAX_DLEN) {
        can_frame classic{};
        std::memcpy(&classic, &raw, sizeof(classic));
        frame.raw_dlc = classic.len8_dlc > CAN_MAX_DLEN && classic.len8_dlc <= CAN_MAX_RAW_DLC ? classic.len8_dlc : std::uint8_t{0};
    }
    std::copy_n(raw.data, frame.bytes().size(), frame.data.begin());
    return frame;
}

} // namespace

KernelCan probe_kernel_can() {
    KernelCan can;
    const int socket = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
    if (socket < 0) {
        can.reason = said(errno);
        return can;
    }
    ::close(socket);
    can.available = true;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/net", error))
        if (const std::string name = entry.path().filename(); arp_type(name) == ARPHRD_CAN)
            can.interfaces.push_back(name);
    std::ranges::sort(can.interfaces);
    return can;
}

/// What recvmmsg fills: made once.
struct CanSocket::Batch {
    static constexpr std::size_t control_bytes = CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
    std::array<canfd_frame, batch_frames> raw{};
    std::array<iovec, batch_frames> places{};
    std::array<mmsghdr, batch_frames> messages{};
    alignas(cmsghdr) std::array<std::array<char, control_bytes>, batch_frames> control{};

    void prepare() {
        for (std::size_t i = 0; i < batch_frames; ++i) {
            places[i] = {&raw[i], sizeof(raw[i])};
            msghdr header{};
            header.msg_iov = &places[i];
            header.msg_iovlen = 1;
            header.msg_control = control[i].data();
            header.msg_controllen = control_bytes;
            messages[i] = {header, 0};
        }
    }
};

CanSocket::CanSocket(CanSocketOptions options) : options_(std::move(options)), batch_(std::make_unique<Batch>()) {
    const KernelCan can = probe_kernel_can();
    if (!can.available)
        throw DeviceError(fmt::format("this kernel has no CAN: {}; `modprobe can-raw vcan` loads it where it is a module", can.reason));
    const std::string there = can.interfaces.empty() ? "there is none; `ip link add dev vcan0 type vcan` makes a virtual one"
                                                     : fmt::format("there: {}", fmt::join(can.interfaces, ", "));
    const std::optional<int> type = arp_type(options_.interface);
    if (options_.interface.empty() || options_.interface.size() >= IFNAMSIZ || options_.interface.find('/') != std::string::npos || !type)
        throw InputError({{}, 0, 0, "--can"}, fmt::format("found no interface '{}'", printable(options_.interface)),
                         "a CAN interface; " + there);
    if (*type != ARPHRD_CAN)
        throw InputError({{}, 0, 0, "--can"}, fmt::format("found '{}', which is a network interface of another kind", options_.interface),
                         "a CAN interface; " + there);
    open();
}

CanSocket::~CanSocket() { disconnect(); }

/// Leaves `socket_` open and bound, or throws DeviceError.
void CanSocket::open() {
    const int socket = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
    if (socket < 0)
        throw DeviceError(fmt::format("kernel CAN: no socket: {}", said(errno)));
    socket_ = socket;
    try {
        if (!is_up(socket_, options_.interface))
            throw DeviceError(fmt::format("interface {} is down; `ip link set {} up` starts it", options_.interface, options_.interface));
        set_option(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, 1, "CAN_RAW_FD_FRAMES");
        set_option(socket_, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, 0, "CAN_RAW_RECV_OWN_MSGS");
        set_option(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, can_err_mask_t{CAN_ERR_MASK}, "CAN_RAW_ERR_FILTER");
        set_option(socket_, SOL_SOCKET, SO_RXQ_OVFL, 1, "SO_RXQ_OVFL");
        set_option(socket_, SOL_SOCKET, SO_TIMESTAMPNS, 1, "SO_TIMESTAMPNS");
        const int asked = options_.receive_buffer_bytes > 0 ? options_.receive_buffer_bytes : large_buffer_bytes;
        if (options_.receive_buffer_bytes > 0 || ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &asked, sizeof(asked)) != 0)
            set_option(socket_, SOL_SOCKET, SO_RCVBUF, asked, "SO_RCVBUF");
        socklen_t size = sizeof(figures_.receive_buffer_bytes);
        ::getsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &figures_.receive_buffer_bytes, &size);
        figures_.filters = -1;
        if (options_.only && options_.only->size() <= CAN_RAW_FILTER_MAX) {
            const std::vector<can_filter> filters = filters_of(*options_.only);
            if (::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                             static_cast<socklen_t>(filters.size() * sizeof(can_filter))) != 0)
                throw DeviceError(fmt::format("kernel CAN: {} filters cannot be set: {}", filters.size(), said(errno)));
            figures_.filters = static_cast<int>(filters.size());
        }
        sockaddr_can address{};
        address.can_family = AF_CAN;
        address.can_ifindex = static_cast<int>(::if_nametoindex(options_.interface.c_str()));
        if (address.can_ifindex == 0 || ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
            throw DeviceError(fmt::format("interface {} cannot be listened to: {}", options_.interface, said(errno)));
    } catch (...) {
        ::close(socket_);
        socket_ = -1;
        throw;
    }
}

void CanSocket::disconnect() {
    if (socket_ < 0)
        return;
    count_drops();
    dropped_before_ = figures_.dropped;
    ::close(socket_);
    socket_ = -1;
}

void CanSocket::lose(CanOutage::Kind kind) {
    disconnect();
    figures_.outages.push_back({kind, clock_ns(CLOCK_MONOTONIC), 0});
}

/// Now and then: looking costs system calls.
void CanSocket::reopen() {
    const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
    if (now_ns < next_try_ns_)
        return;
    next_try_ns_ = now_ns + reopen_every_ns;
    const std::optional<int> type = arp_type(options_.interface);
    if (!type)
        figures_.outages.back().kind = CanOutage::Kind::removed;
    if (type != ARPHRD_CAN)
        return;
    try {
        open();
        is_bus_off_ = false;
        for (CanOutage& outage : figures_.outages)
            if (outage.until_ns == 0)
                outage.until_ns = now_ns;
    } catch (const DeviceError&) { // still down
    }
}

/// The kernel's own counter; with each frame (SO_RXQ_OVFL) it comes as it was when that frame was queued, so that what was dropped after
/// the last one would be missing.
void CanSocket::count_drops() {
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t size = sizeof(memory);
    if (socket_ >= 0 && ::getsockopt(socket_, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0 &&
        size > SK_MEMINFO_DROPS * sizeof(memory[0]))
        figures_.dropped = std::max(figures_.dropped, dropped_before_ + memory[SK_MEMINFO_DROPS]);
}

const CanSocketFigures& CanSocket::figures() {
    count_drops();
    return figures_;
}

void CanSocket::bus_off(bool off) {
    if (off == is_bus_off_)
        return;
    is_bus_off_ = off;
    const std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
    if (off)
        figures_.outages.push_back({CanOutage::Kind::bus_off, now_ns, 0});
    for (CanOutage& outage : figures_.outages)
        if (!off && outage.kind == CanOutage::Kind::bus_off && outage.until_ns == 0)
            outage.until_ns = now_ns;
}

void CanSocket::take(CanFrame frame, std::vector<CanFrame>& frames) {
    if (frame.time_ns == 0) {
        ++figures_.without_stamp;
        frame.time_ns = clock_ns(CLOCK_REALTIME);
    }
    if (frame.error) {
        ++figures_.error_frames;
        figures_.controller += (frame.id & CAN_ERR_CRTL) != 0 ? 1U : 0U;
        figures_.bus_off += (frame.id & CAN_ERR_BUSOFF) != 0 ? 1U : 0U;
        if ((frame.id & (CAN_ERR_BUSOFF | CAN_ERR_RESTARTED)) != 0)
            bus_off((frame.id & CAN_ERR_RESTARTED) == 0);
    } else {
        ++figures_.received;
        bus_off(false); // what is heard says that the bus is back
    }
    frames.push_back(std::move(frame));
}

void CanSocket::receive(std::vector<CanFrame>& frames) {
    if (socket_ < 0)
        reopen();
    while (socket_ >= 0) {
        batch_->prepare();
        const int count = ::recvmmsg(socket_, batch_->messages.data(), batch_frames, MSG_DONTWAIT, nullptr);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0 && (errno == ENETDOWN || errno == ENODEV)) { // said once; what was queued before comes after it
            losing_ = errno == ENODEV ? CanOutage::Kind::removed : losing_.value_or(CanOutage::Kind::down);
            continue;
        }
        if (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK)
            throw DeviceError(fmt::format("interface {} cannot be read: {}", options_.interface, said(errno)));
        for (int i = 0; i < count; ++i) {
            mmsghdr& message = batch_->messages[static_cast<std::size_t>(i)];
            if (message.msg_len != CAN_MTU && message.msg_len != CANFD_MTU)
                continue; // no frame that the header of this build knows
            CanFrame frame = frame_of(batch_->raw[static_cast<std::size_t>(i)], message.msg_len);
            frame.channel = options_.interface;
            for (cmsghdr* part = CMSG_FIRSTHDR(&message.msg_hdr); part; part = CMSG_NXTHDR(&message.msg_hdr, part)) {
                timespec stamp{};
                std::uint32_t dropped = 0;
                if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SO_TIMESTAMPNS) {
                    std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
                    frame.time_ns = nanoseconds(stamp);
                } else if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SO_RXQ_OVFL) {
                    std::memcpy(&dropped, CMSG_DATA(part), sizeof(dropped));
                    figures_.dropped = std::max(figures_.dropped, dropped_before_ + dropped);
                }
            }
            take(std::move(frame), frames);
        }
        if (count < static_cast<int>(batch_frames))
            break;
    }
    if (losing_)
        lose(*std::exchange(losing_, std::nullopt));
}

CanSocket::Went CanSocket::try_to_send(const CanFrame& frame) {
    canfd_frame raw{};
    raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
    raw.len = frame.length;
    if (frame.fd)
        raw.flags = static_cast<std::uint8_t>((frame.bit_rate_switch ? CANFD_BRS : 0) | (frame.error_state_indicator ? CANFD_ESI : 0));
    std::ranges::copy(frame.bytes(), raw.data);
    for (;;) {
        if (::send(socket_, &raw, frame.fd ? CANFD_MTU : CAN_MTU, MSG_DONTWAIT) >= 0)
            return Went::out;
        if (errno == EINTR)
            continue;
        if (errno == ENOBUFS || errno == EAGAIN) {
            ++figures_.no_room;
            return Went::later;
        }
        if (errno == ENETDOWN || errno == ENODEV || errno == ENXIO) // the kernel says it once, here or to receive(), which waits for it
            losing_ = errno == ENETDOWN ? losing_.value_or(CanOutage::Kind::down) : CanOutage::Kind::removed;
        if (figures_.why_not_sent.empty())
            figures_.why_not_sent =
                errno == EINVAL && frame.fd ? fmt::format("interface {} is not set up for CAN FD", options_.interface) : said(errno);
        return Went::never;
    }
}

void CanSocket::flush() {
    while (!waiting_.empty()) {
        const Went went = try_to_send(waiting_.front());
        if (went == Went::later)
            return;
        ++(went == Went::out ? figures_.sent : figures_.not_sent);
        waiting_.pop_front();
    }
}

void CanSocket::send(const CanFrame& frame) {
    if (socket_ < 0) {
        ++figures_.not_sent;
        if (figures_.why_not_sent.empty())
            figures_.why_not_sent = fmt::format("interface {} was down or away", options_.interface);
        return;
    }
    const auto older = std::ranges::find_if(waiting_, [&](const CanFrame& other) {
        return other.id == frame.id && other.extended == frame.extended && other.time_ns < frame.time_ns;
    });
    if (older != waiting_.end()) {
        waiting_.erase(older);
        ++figures_.superseded;
    }
    flush();
    waiting_.push_back(frame);
    if (waiting_.size() > max_waiting) {
        waiting_.pop_front();
        ++figures_.superseded;
    }
    if (waiting_.size() == 1)
        flush();
}

} // namespace fernlicht
