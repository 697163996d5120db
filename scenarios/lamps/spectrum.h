// Spectra: what a lamp sends out per wavelength, and what an eye makes of it.
#pragma once

#include "scenarios/lamps/mounted_lamp.h"

#include <vector>

namespace fernlicht {

/// Relative spectral power, linear between its samples, 0 outside them.
struct Spectrum {
    std::vector<double> wavelength_nm; ///< strictly ascending
    std::vector<double> power;         ///< as many; finite, >= 0, in any unit per nm
};

/// Planck's law from 380 to 780 nm, relative to 560 nm. kelvin > 0.
Spectrum planck_spectrum(double kelvin);

/// CIE 1931 tristimulus values and the scotopic integral, each over 380 to 780 nm in steps of 1 nm, in units of power times nm.
struct VisualIntegrals {
    double x = 0.0, y = 0.0, z = 0.0, scotopic = 0.0;
};
VisualIntegrals visual_integrals(const Spectrum& spectrum);

/// Colour, S/P ratio and correlated colour temperature (nearest point of Planck's locus in CIE 1960 u, v, 1000 to 25 000 K).
/// cct_k is 0 where none is defined: farther than 0.05 from the locus (CIE 15). Throws std::invalid_argument for a spectrum without visible
/// light.
LampColour colour_of_spectrum(const Spectrum& spectrum);

} // namespace fernlicht
