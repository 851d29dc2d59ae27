// How far the factors of a light's contribution may be off when they are evaluated in single precision from
// the same g-buffer and the same lights. Ranges, not derivatives: at the edge of a window or of a cone, where
// a value leaves 0, a first derivative says nothing.
//
// Every step is given what Vulkan allows it (Vulkan 1.3, "Precision and Operation of SPIR-V Instructions": a
// division 2.5 ulp, an inverse square root 2 ulp) and not what one driver does.
#pragma once

#include "harness/accuracy/oracle.h"
#include "harness/accuracy/range.h"

namespace ml {

// Relative error of the length of a direction: a square root, a division and products.
inline constexpr double stretch = 6 * 0x1p-24;

// Half an ulp of 1 in single precision: a correctly rounded operation is off by at most this part of its
// value.
inline constexpr double rounding_unit = 0x1p-24;

// What a surface point sees of a light's source, and how well single precision knows it.
struct SourceSight {
  glm::dvec3 to_light;    // unit, to the nearest point of the source
  double distance;        // m
  double distance_error;  // m
  // rad, by which the direction may be off: lengths that are off, by `stretch`, do not rotate it. 2: it may
  // be any.
  double rotation;
};

// `from_centre`: the point as the light's centre sees it; `along`: m, from the centre to the nearest point of
// the segment.
SourceSight see_source(const SurfacePoint& point, const OracleLight& light, const glm::dvec3& from_centre,
                       double along);

// Of the window: (1 - (d/r)^4) or a box's product of such, not squared.
Range window_range(const SourceSight& sight, const OracleLight& light, const glm::dvec3& from_centre);
// 1 / max(d^2, 1e-4 m^2).
Range inverse_square_range(const SourceSight& sight);
// Of the cone factor before it is squared; `off_axis`: 1 - cos of the angle off the spot's axis.
Range cone_range(const SourceSight& sight, const OracleLight& light, double off_axis);
// Of N.L; `cosine` its value.
Range facing_range(const SourceSight& sight, double cosine);
// Of the reflection without its diffuse part, as far as it is the same for all colours, and of Schlick's
// weight of a full mirror. `facing`: of N.L.
struct HighlightRange {
  Range lobe, grazing;
};
HighlightRange highlight_range(const SurfacePoint& point, const SourceSight& sight,
                               const glm::dvec3& to_viewer, const Range& facing);

}  // namespace ml
