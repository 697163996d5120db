// Where on the earth a road is, for its sky.
#pragma once

#include "scenarios/openscenario/reader/storyboard_source.h"
#include "scenarios/values/pose.h"

#include <string_view>

namespace fernlicht {

/// From the projection that OpenDRIVE's geoReference names (PROJ's text: +lat_0 and +lon_0, else +proj=utm with +zone, or EPSG codes of UTM
/// zones 326zz, 327zz, 258zz) and a place in it: along the meridian by the arc of the WGS 84 ellipsoid, across it by the parallel's circle.
/// Within some 0.1 degrees where the place lies within 300 km of the projection's meridian, which moves the sun by as much. nullopt: it
/// names neither, or the place is not on the earth.
std::optional<SkySite> sky_site_of(std::string_view geo_reference, const glm::dvec3& position_m);

} // namespace fernlicht
