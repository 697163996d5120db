#include "scenarios/drives/play/sent_log.h"

#include "scenarios/can/candump_log.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/drives/play/motion.h"

namespace fernlicht {

std::string sent_log(const Drive& drive, const Variant& variant) {
    std::string text;
    if (!variant.motion)
        return text;
    for (CanFrame frame : variant.motion->sent) {
        frame.time_ns += drive.bus ? drive.bus->start_ns : 0;
        text += candump_line(frame) + '\n';
    }
    return text;
}

} // namespace fernlicht
