// Which shape a light of a run has, and how large it is then.
//
// Every shape reaches as much space as an omni light (a wedge: as a spot) of the radius R that the
// distribution of radii gave, so that overdraw is comparable whatever the mix:
//   capsule  half_length = k r, k in [0.5, 2]; r = R / cbrt(1 + 1.5 k). Any direction.
//   wedge    a stage light like the spots, half_length = k r, k in [0.5, 2];
//            r = R / cbrt(1 + 3 k a / (pi (1 - cos a))) with the outer half-angle a.
//   box      proportions 1 : [0.5, 1.5] : [0.5, 1.5], volume 4/3 pi R^3. Any direction.
// Intensities are those of an omni light of radius r (boxes: R).
#pragma once

#include <string>

#include "harness/lights/placement.h"
#include "harness/lights/set.h"

namespace ml {

// By the light's hash: the shape in whose share of [0, 1) it falls.
LightShape shape_of(const LightNumbers& number, const LightSpec& spec);

// By the light's hash: with its share of probe lights the spec makes it one. Its irradiance is what the
// direct light of that intensity would give at its radius without the window: a soft fill, for it does not
// fall off.
void maybe_make_probe(const LightNumbers& number, const LightSpec& spec, Light& light);

// Gives an omni light of radius R another shape.
void give_shape(LightShape shape, const LightNumbers& number, Light& light);

}  // namespace ml
