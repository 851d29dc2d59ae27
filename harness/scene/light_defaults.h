// What lights a scene gets where a configuration says nothing.
#pragma once

namespace ml {

// Uniform in the scene's box | over triangles | over surface area | the file's own | 60 % in 16 clumps | the
// lights of a museum in each of the scene's rooms | uniform in the scene's first room.
enum class Placement { volume, triangle, area, gltf, clumps, stage, room };

struct LightDefaults {
  Placement placement = Placement::volume;
  float radius_ratio = 32;  // largest radius / smallest; 0: by the placement's own law
  // m, s0 of the radius law at 65,536 lights, measured to give 2 to 4 lights per pixel; 0: by the overdraw
  // formula.
  double volume_size = 0, triangle_size = 0, area_size = 0;

  bool operator==(const LightDefaults&) const = default;
};

}  // namespace ml
