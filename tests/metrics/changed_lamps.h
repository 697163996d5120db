// Lamps of ours with what was done to their tables known: noise, a dimmer zone, another aim, a raised cut-off.
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <algorithm>
#include <random>

namespace fernlicht {

inline CandelaTable shipped(const std::string& name) {
    return read_lamp(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/" + name + ".ies").table;
}

/// Each sample up to `share` more or less, all as likely.
inline CandelaTable with_noise(CandelaTable table, double share, unsigned seed) {
    std::mt19937 random(seed);
    for (double& cd : table.cd)
        cd *= 1.0 + share * (2.0 * (static_cast<double>(random()) / 4294967295.0) - 1.0);
    return table;
}

struct Zone {
    double left, right, bottom, top;
};

inline CandelaTable dimmed(CandelaTable table, const Zone& zone, double factor) {
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            if (table.h_deg[h] >= zone.left && table.h_deg[h] <= zone.right && table.v_deg[v] >= zone.bottom && table.v_deg[v] <= zone.top)
                table.at(v, h) *= factor;
    return table;
}

/// The same table with its angles shifted.
inline CandelaTable aimed(CandelaTable table, double right_deg, double up_deg) {
    for (double& h : table.h_deg)
        h += right_deg;
    for (double& v : table.v_deg)
        v += up_deg;
    return table;
}

/// The light near and above the cut-off moved up, more than 1 degree below it as it was, between both a gradual stretch.
inline CandelaTable raised_cut_off(const CandelaTable& table, double up_deg) {
    CandelaTable out = table;
    for (std::size_t v = 0; v < table.v_deg.size(); ++v) {
        const double part = std::clamp((table.v_deg[v] + 0.57 + 1.2) / 0.8, 0.0, 1.0);
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            out.at(v, h) = intensity_cd(table, table.h_deg[h], table.v_deg[v] - part * up_deg);
    }
    return out;
}

} // namespace fernlicht
