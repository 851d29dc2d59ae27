// What lights a scene gets where a configuration says nothing.
#pragma once

namespace ml {

// Uniform in the scene's box | over triangles | over surface area | the file's own | 60 % in 16 clumps | the
// lights of a museum in each of the scene's rooms | uniform in the scene's first room.
enum class Placement { volume, triangle, area, gltf, clumps, stage, room };

// What lights do over time. The configuration's name of `none` is "static".
enum class LightScript { none, drift, spawn, orbit };

struct LightDefaults {
  Placement placement = Placement::volume;
  // The lights stand so whatever a configuration asks for; `gltf` is the one exception.
  bool fixed_placement = false;
  float radius_ratio = 32;  // largest radius / smallest; 0: the placement's own
  // m, s0 of the radius distribution at 65,536 lights, measured to give 2 to 4 lights per pixel; 0: by the
  // overdraw formula.
  double volume_size = 0, triangle_size = 0, area_size = 0;
  // m, of every light where a configuration names neither a radius nor a base size; 0: by the radius
  // distribution.
  float radius = 0;
  float height = 0;  // m, LightSpec::height where a configuration names none
  LightScript script = LightScript::none;

  bool operator==(const LightDefaults&) const = default;
};

}  // namespace ml
