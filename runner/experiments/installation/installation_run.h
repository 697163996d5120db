// A drive's low beams against UN R48, 6.2.6.1 (inclination over loads) and 6.2.6.4 (bend light's kink).
#pragma once

#include "metrics/regulation/installed_aim.h"
#include "metrics/regulation/r48.h"
#include "runner/findings/document.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

struct InstallationRequest {
    Drive drive;
    std::string lamp_set;         ///< "": the first
    std::vector<LoadState> loads; ///< none: those of R48 for a usual car of this mass, and the drive's own `load`
};

/// Where a lamp's kink crossed the car's path ahead, in bends to one side, as seen from the car's middle.
struct KinkFound {
    std::optional<double> distance_m;     ///< from the car's front, the farthest; nullopt: nowhere
    double at_s = 0.0;                    ///< when that was
    std::optional<double> median_m;       ///< over the moments in which it crosses
    double beyond_s = 0.0, bends_s = 0.0; ///< how long it crossed beyond its limit, and of how long in such bends with the lamp lit
    double moved_deg = 0.0;               ///< how far at most the lamp was turned sideways in them, from how it is aimed
    std::optional<double> from_lamp_m;    ///< the farthest from where the lamp is: reported, not judged
};

struct InstalledLamp {
    std::string lamp, file, by;
    double height_m = 0.0;
    std::optional<InclinationBand> band;
    std::vector<double> percent; ///< of the cut-off against the road, by load; empty: not found
    double moved_deg = 0.0;      ///< the same over the whole drive
    bool has_kink = false;
    KinkFound left_bends, right_bends;
    std::string why_not; ///< of what was not found

    double kink_limit_m() const { return kink_heights * height_m; }
    /// From 0.01 degrees on. A lamp that does not move is no bend light.
    bool moves() const { return moved_deg >= 0.01; }
};

enum class InstallationVerdict { within, not_met, not_measured, not_applicable };

struct InstallationFound {
    std::string drive, lamp_set;
    std::vector<LoadState> loads;
    std::vector<LoadedBody> bodies;      ///< by load
    std::optional<CarCapacity> capacity; ///< where the loads follow from it
    bool own_vehicle = true;             ///< false: the drive has none, and our middle-class car stands in
    bool levelled = false;
    std::vector<InstalledLamp> lamps;
    std::vector<std::string> warnings; ///< of lamp files that mean nothing here, as those for the other side's traffic

    InstallationVerdict inclination(const InstalledLamp& lamp, std::size_t load) const;
    InstallationVerdict inclination() const; ///< of all lamps and loads
    /// not_applicable: the lamp does not move sideways, or no such bend came.
    InstallationVerdict kink(const InstalledLamp& lamp, const KinkFound& found) const;
    InstallationVerdict kink() const; ///< of all lamps, to both sides
    bool good() const;                ///< all within or not applicable
};

/// Plays the drive by the twin. Lamps are aimed as the drive has them in the car with its driver alone, the state of R48's initial
/// inclination, whatever the loads. Throws InputError for a lamp set without a low beam, and for a load that lifts an axle off the road.
InstallationFound run_installation(const InstallationRequest& request);

const char* name_of(InstallationVerdict verdict); ///< "within", "not_met", "not_measured", "not_applicable"
Document document(const InstallationFound& found);
std::string installation_json(const InstallationFound& found);

} // namespace fernlicht
