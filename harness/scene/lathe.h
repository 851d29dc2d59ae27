// Surfaces of revolution: columns, vases, balls.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "harness/scene/mesh_builder.h"

namespace ml {

// A profile of (radius, height above `foot`) points turned round the y axis: from bottom to top, its outer
// side outside. Smooth around, and with an edge at every point of the profile. Radius 0 closes an end; ends
// that are open stay open.
void build_lathe(MeshBuilder& mesh, const glm::dvec3& foot, std::span<const glm::dvec2> profile, int sides,
                 uint32_t material);

}  // namespace ml
