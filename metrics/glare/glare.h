// What light in the eye does to it: veiling luminance, threshold increment, de Boer's rating. Illuminance at the eye in lx, angles between
// the line of sight and the source in degrees, luminances in cd/m2.
//
// Sources, and how well they are known here:
// [abstract] CIE 146:2002, CIE equations for disability glare: the domains of angle, from its published abstract.
// [read]     J.J. Vos, On the cause of disability glare, 2003: the age-adjusted equation and both domains.
// [others]   CIE general equation's coefficients: several independent programs print the same ones.
// [memory]   the threshold increment above 5 cd/m2, Schmidt-Clausen and Bindels' coefficients: the standard forms, not read in their
//            primary texts.
// Nothing is extrapolated: outside a domain the figure is not measured, and the reason names the angle or luminance.
//
// The lamps of a moment as an eye, a mirror or a sensor meets them, from the candela tables in double (scenarios/light/light.h), those of
// other road users in the own driver's eyes among them. Fog, rain and snow take their part once, from lamp to eye (Bouguer;
// photometry.glsl); what they scatter into the eye is left out. Images of lamps in a wet road: wet_road.h.
#pragma once

#include "metrics/readings/value.h"
#include "scenarios/drives/play/moment.h"
#include "scenarios/drives/seeing_parameters.h"
#include "scenarios/roads/route.h"

#include <string_view>
#include <vector>

namespace fernlicht {

/// A lamp as an eye sees it. A source of 0 lx counts for nothing at whatever angle.
struct GlareSource {
    double eye_lx = 0.0;    ///< on the plane of the eye, across the line of sight; >= 0
    double theta_deg = 0.0; ///< from the line of sight
};

// stiles_holladay: Lv = 10 E / theta^2, without age; 1 < theta < 30
// age_adjusted:    Lv = 10 (1 + (A/70)^4) E / theta^2; 1 < theta < 30 [read]
// cie_general:     Lv = E (10/theta^3 + (5/theta^2 + 0.1 p/theta)(1 + (A/62.5)^4) + 0.0025 p); 0.1 < theta < 100 [others]
/// "cie-general", as drives name it.
std::string_view name(VeilingEquation equation);

struct GlareEye {
    double age_years = 25.0;
    double pigmentation = 0.5; ///< 0 black, 0.5 brown, 1.0 blue-green, 1.2 very light; in the general equation alone
};

/// Sources add. The bounds of a domain belong to it. No light: 0.
Value veiling_luminance_cdm2(VeilingEquation equation, const std::vector<GlareSource>& sources, const GlareEye& eye);

/// TI in %: 65 Lv / Lav^0.8 for 0.05 < Lav <= 5, 95 Lv / Lav^1.05 above [memory]. At 5 cd/m2 the second lies 2.3 % below the first.
Value threshold_increment_percent(double veiling_cdm2, double adaptation_cdm2);

/// De Boer's rating after Schmidt-Clausen and Bindels 1974 [memory]: W = 5 - 2 lg(sum of E / (0.003 (1 + sqrt(Lu/0.04)) theta^0.46)) with
/// theta in arc minutes, which is where 0.003 lx belongs. theta is taken in degrees here and turned: with degrees the constant is
/// 0.003 * 60^0.46 = 0.01973, usually rounded to 0.02. 1 unbearable, 3 disturbing, 5 just acceptable, 7 satisfactory, 9 unnoticeable; the
/// equation knows no ends and neither has W here. Not measured without light, which no finite W is for, and with a source on the line of
/// sight.
Value de_boer_rating(const std::vector<GlareSource>& sources, double adaptation_cdm2);

/// One lamp seen from a point.
struct SeenLamp {
    std::string name;
    glm::dvec3 position_m{0.0};
    double facing_lx = 0.0; ///< I / d^2, on a plane that faces the lamp, less what the air takes
    double distance_m = 0.0;
};

/// Every lamp of the moment, also those that give nothing. A lamp at the point itself gives nothing (scenarios/light/light.h).
std::vector<SeenLamp> seen_lamps(const Moment& moment, const glm::dvec3& point_m);

/// Their sum, lx.
double facing_lx(const std::vector<SeenLamp>& lamps);

/// Across the line of sight `gaze` (unit): E = I cos(theta) / d^2, nothing from behind the eye.
GlareSource glare_source(const SeenLamp& lamp, const glm::dvec3& eye_m, const glm::dvec3& gaze);

/// The lamp in a plane mirror that is turned so that the eye sees the lamp in it: light goes on as from an image as far behind the mirror
/// as the lamp is before it. `lamp` seen from the mirror.
GlareSource mirrored_source(const SeenLamp& lamp, const glm::dvec3& mirror_m, double reflectance, const glm::dvec3& eye_m,
                            const glm::dvec3& gaze);

/// Angle between two directions in degrees, well-conditioned near 0.
double angle_between_deg(const glm::dvec3& a, const glm::dvec3& b);

/// The paved road between two distances along a route, cut every 2 m; a crest of 1000 m radius stands 0.5 mm out between two cuts. For
/// callers that ask it of several lines. The route must outlive it.
class RoadBetween {
  public:
    RoadBetween(const Route& route, double from_m, double to_m);
    /// True where it rises above the straight line from `from` to `to`: a crest that hides a lamp. Ground beside the pavement, trees and
    /// houses are not asked.
    bool hides(const glm::dvec3& from, const glm::dvec3& to) const;

  private:
    struct Cut {
        double at_m;
        Route::Cut across;
        Pose centre;
    };
    const Route& route_;
    std::vector<Cut> cuts_;
};

/// seen_lamps() of a moment on the route, those dark that a crest between them and a point so far along hides.
std::vector<SeenLamp> lamps_over_road(const Moment& moment, const Route& route, double to_m, const glm::dvec3& point_m);

/// How far along the route a point lies that is on it or beside, looked for from `near_m` on; nullopt: farther than 20 m beside it.
std::optional<double> along_route_m(const Route& route, const glm::dvec3& point_m, double near_m);

/// What stands round a body, in its frame: length along x from rear_m, width about y = 0, height from the ground.
struct BodyBox {
    glm::dvec3 size_m{0.0};
    double rear_m = 0.0;
};

/// True where the segment between two world points meets the box of a body that stands at `pose`.
bool box_hides(const BodyBox& box, const Pose& pose, const glm::dvec3& from_m, const glm::dvec3& to_m);

/// Every lamp of others that brings light to an eye that looks along `gaze` (unit), less those that the box of another visible body hides;
/// `boxes` by body. A lamp's own body hides nothing of it: its table says where it shines.
std::vector<GlareSource> traffic_glare(const Moment& moment, const glm::dvec3& eye_m, const glm::dvec3& gaze,
                                       const std::vector<BodyBox>& boxes);

} // namespace fernlicht
