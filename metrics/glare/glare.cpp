#include "metrics/glare/glare.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double arc_minutes = 60.0; // in a degree

struct Domain {
    double least_deg, greatest_deg;
};

Domain domain_of(VeilingEquation equation) { return equation == VeilingEquation::cie_general ? Domain{0.1, 100.0} : Domain{1.0, 30.0}; }

double fourth_power(double x) { return x * x * x * x; }

/// Lv / E, in cd/(m2 lx).
double veil_per_lx(VeilingEquation equation, double theta, const GlareEye& eye) {
    const double square = theta * theta;
    switch (equation) {
    case VeilingEquation::stiles_holladay:
        return 10.0 / square;
    case VeilingEquation::age_adjusted:
        return 10.0 * (1.0 + fourth_power(eye.age_years / 70.0)) / square;
    case VeilingEquation::cie_general:
        break;
    }
    return 10.0 / (square * theta) + (5.0 / square + 0.1 * eye.pigmentation / theta) * (1.0 + fourth_power(eye.age_years / 62.5)) +
           0.0025 * eye.pigmentation;
}

void check(const std::vector<GlareSource>& sources) {
    for (const GlareSource& source : sources)
        if (!(source.eye_lx >= 0.0) || !std::isfinite(source.eye_lx) || !(source.theta_deg >= 0.0 && source.theta_deg <= 180.0))
            throw std::invalid_argument(fmt::format("a glare source of {} lx at {} degrees", source.eye_lx, source.theta_deg));
}

} // namespace

std::string_view name(VeilingEquation equation) {
    return equation == VeilingEquation::stiles_holladay ? "stiles-holladay"
           : equation == VeilingEquation::age_adjusted  ? "age-adjusted"
                                                        : "cie-general";
}

Value veiling_luminance_cdm2(VeilingEquation equation, const std::vector<GlareSource>& sources, const GlareEye& eye) {
    check(sources);
    const Domain domain = domain_of(equation);
    double veil = 0.0;
    for (const GlareSource& source : sources) {
        if (source.eye_lx == 0.0)
            continue;
        if (source.theta_deg < domain.least_deg || source.theta_deg > domain.greatest_deg)
            return Value::not_measured(fmt::format("a source {:.3g} degrees from the line of sight: {} holds from {} to {} degrees",
                                                   source.theta_deg, name(equation), domain.least_deg, domain.greatest_deg));
        veil += source.eye_lx * veil_per_lx(equation, source.theta_deg, eye);
    }
    return veil;
}

Value threshold_increment_percent(double veiling_cdm2, double adaptation_cdm2) {
    if (!(adaptation_cdm2 > 0.05))
        return Value::not_measured(
            fmt::format("an adaptation luminance of {:.3g} cd/m2: the threshold increment is defined above 0.05", adaptation_cdm2));
    return adaptation_cdm2 <= 5.0 ? 65.0 * veiling_cdm2 / std::pow(adaptation_cdm2, 0.8)
                                  : 95.0 * veiling_cdm2 / std::pow(adaptation_cdm2, 1.05);
}

Value de_boer_rating(const std::vector<GlareSource>& sources, double adaptation_cdm2) {
    check(sources);
    const double surround = 0.003 * (1.0 + std::sqrt(adaptation_cdm2 / 0.04));
    double glare = 0.0;
    for (const GlareSource& source : sources) {
        if (source.eye_lx == 0.0)
            continue;
        if (source.theta_deg == 0.0)
            return Value::not_measured("a source on the line of sight, where de Boer's rating has no value");
        glare += source.eye_lx / (surround * std::pow(arc_minutes * source.theta_deg, 0.46));
    }
    if (glare == 0.0)
        return Value::not_measured("no light reaches the eye");
    return 5.0 - 2.0 * std::log10(glare);
}

} // namespace fernlicht
