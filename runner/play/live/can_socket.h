// The kernel's CAN (SocketCAN): which interfaces there are, and a socket on one of them. The one file that knows it (ci/check-includes).
#pragma once

#include "scenarios/can/can_frame.h"

#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace fernlicht {

struct KernelCan {
    bool available = false;
    std::string reason;                  ///< why not
    std::vector<std::string> interfaces; ///< names of CAN interfaces, ascending
};
KernelCan probe_kernel_can();

struct CanSocketOptions {
    std::string interface; ///< "can0"
    /// What the kernel lets through: identifiers and whether they are extended; nullopt: all. Remote frames only with nullopt; error frames
    /// always.
    std::optional<std::vector<std::pair<std::uint32_t, bool>>> only;
    int receive_buffer_bytes = 0; ///< asked of the kernel (SO_RCVBUF, which doubles it); 0: a large one if it is permitted
};

/// A time during which nothing came through, by CLOCK_MONOTONIC.
struct CanOutage {
    enum class Kind { down, removed, bus_off } kind = Kind::down;
    std::int64_t from_ns = 0, until_ns = 0; ///< 0: not over yet
};

struct CanSocketFigures {
    std::uint64_t received = 0;      ///< frames handed over, error frames left out
    std::uint64_t dropped = 0;       ///< that the kernel had no room for in the socket's buffer, counted by it (SO_RXQ_OVFL)
    std::uint64_t error_frames = 0;  ///< made by the driver
    std::uint64_t bus_off = 0;       ///< of them those that say so
    std::uint64_t controller = 0;    ///< of them controller problems: warning or passive level, overflow in the controller
    std::uint64_t without_stamp = 0; ///< frames that the kernel did not stamp; they have the time of reading
    std::uint64_t sent = 0;
    std::uint64_t no_room = 0; ///< times that the sending queue was full (ENOBUFS); the frame waits
    std::uint64_t superseded =
        0; ///< frames that were never sent: a newer one of the same identifier, with a later `time_ns`, came while they waited
    std::uint64_t not_sent = 0; ///< frames that were never sent for another reason
    std::string why_not_sent;   ///< the first such reason
    std::vector<CanOutage> outages;
    int receive_buffer_bytes = 0; ///< as the kernel has it: what frames may take with all that it keeps of each
    int filters = -1;             ///< in the kernel; -1: none, all comes through
};

/// A raw socket that never waits. Loss is counted, not hidden: `dropped` is exact whenever figures() is asked. An interface that goes down
/// or away is waited for; receive() and send() go on with it when it is back, under the same name.
class CanSocket {
  public:
    /// Throws InputError where there is no such interface, DeviceError where the kernel has no CAN, forbids it, or the interface is down.
    explicit CanSocket(CanSocketOptions options);
    ~CanSocket();
    CanSocket(const CanSocket&) = delete;
    CanSocket& operator=(const CanSocket&) = delete;

    /// Appends all that has come, error frames included, in its order, with the kernel's stamps (CLOCK_REALTIME, ns). Frames that this
    /// socket sent are not among it.
    void receive(std::vector<CanFrame>& frames);
    /// Sends what waits, then this; or has it wait.
    void send(const CanFrame& frame);

    bool connected() const { return socket_ >= 0; }
    const CanSocketFigures& figures();

  private:
    struct Batch;
    void open();
    void reopen();
    void lose(CanOutage::Kind kind);
    void disconnect();
    void take(CanFrame frame, std::vector<CanFrame>& frames);
    void bus_off(bool off);
    void count_drops();
    enum class Went { out, later, never };
    Went try_to_send(const CanFrame& frame);
    void flush();

    CanSocketOptions options_;
    CanSocketFigures figures_;
    std::unique_ptr<Batch> batch_;
    int socket_ = -1;
    std::uint64_t dropped_before_ = 0; ///< of sockets before this one
    std::int64_t next_try_ns_ = 0;
    std::optional<CanOutage::Kind> losing_; ///< said by the kernel; what it had queued before is read first
    bool is_bus_off_ = false;
    std::deque<CanFrame> waiting_;
};

} // namespace fernlicht
