// The distribution of light radii and how its size follows from the number of lights (scenes.md: bounded
// Pareto, overdraw formulas).
#pragma once

#include <cstdint>

#include "harness/lights/set.h"
#include "harness/scene/scene.h"

namespace ml {

// E[r], E[r^2] and E[r^3] of the distribution with s = 1.
struct RadiusMoments {
  double mean, square, cube;
};
RadiusMoments radius_moments(double ratio);

// s at `count` lights from s0, the size at 65,536: the power of (65536 / count) is 1/3 in a volume and 1/2 on
// surfaces.
double size_for_count(double s0, uint32_t count, Sizing sizing, Placement placement);

// s0 for a placement in a scene where the configuration names none: the procedural scene's own, or what gives
// about 3 lights per visible point by the overdraw formula.
double default_base_size(const Scene& scene, Placement placement, double ratio);

// m^2 of all triangles.
double surface_area(const Scene& scene);

// Intensity of a light of this radius whose colour has a mean of 1: the irradiance at half the radius is then
// about 1 W/m^2, whatever the radius, under the windowed falloff (1 - (d/r)^4)^2 / d^2.
double intensity_for_radius(double radius);

}  // namespace ml
