// What lights a scene gets where a configuration says nothing.
#pragma once

namespace ml {

// Uniform in the scene's box | over triangles | over surface area | the file's own.
enum class Placement { volume, triangle, area, gltf };

struct LightDefaults {
  Placement placement = Placement::volume;
  float radius_ratio = 32;  // largest radius / smallest
  // m, s0 of the radius law at 65,536 lights, measured to give 2 to 4 lights per pixel; 0: by the overdraw
  // formula.
  double volume_size = 0, triangle_size = 0, area_size = 0;

  bool operator==(const LightDefaults&) const = default;
};

}  // namespace ml
