#include "metrics/readings/readings.h"

namespace fernlicht {

std::string name_part(const std::string& text) {
    std::string part;
    for (const char c : text) {
        const bool upper = c >= 'A' && c <= 'Z';
        const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || upper;
        part += !plain ? '_' : upper ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return part;
}

bool is_unit_of_time(const std::string& unit) { return unit == "ms"; }

} // namespace fernlicht
