// The effects: what the content of a setup may call for beyond omni lights on opaque surfaces. One table
// names them all; configuration, result, `list effects` and specialization constants are made from it.
// docs/adding_an_effect.md says what one more takes.
#pragma once

#include <array>
#include <span>

#include "harness/scene/camera.h"
#include "harness/scene/light.h"
#include "harness/scene/scene.h"

namespace ml {

// Which are on.
struct Effects {
  bool spots = false;
  bool capsules = false;
  bool wedges = false;
  bool boxes = false;
  bool probes = false;
  bool specular = true;
  bool alpha_mask = false;
  bool forward = false;          // materials that are lit in a pass of their own
  bool clip_far = false;         // the camera has a far plane that cuts the level
  bool motion = false;           // nodes carry meshes
  bool material_detail = false;  // vertex colours, metallic-roughness textures, normal maps
  bool emission = false;         // surfaces that give light by themselves, on top of all lights
  bool operator==(const Effects&) const = default;
  // As FrameLightStorage::fill takes them: shapes that are off shine like omni lights, probe lights like
  // direct ones.
  uint32_t shapes() const {
    return 1u | (spots ? 2u : 0u) | (capsules ? 4u : 0u) | (wedges ? 8u : 0u) | (boxes ? 16u : 0u) |
           (probes ? 32u : 0u);
  }
};

// What effects are found from.
struct Content {
  const Scene& scene;
  std::span<const Light> lights;
  const CameraPath& path;
};

bool has_normal_map(const Material& material);

struct EffectInfo {
  const char* name;      // as a result lists it
  const char* key;       // of `effects` in a configuration: auto | off; null: it cannot be switched off
  const char* constant;  // in shaders/constants.glsl; null: it is chosen by other means
  const char* help;      // what it is; what calls for it
  bool Effects::*on;
  bool (*called_for)(const Content&);
};

namespace content {
bool has_spots(const Content&);
bool has_capsules(const Content&);
bool has_wedges(const Content&);
bool has_boxes(const Content&);
bool has_probes(const Content&);
bool has_surfaces(const Content&);
bool has_masked_materials(const Content&);
bool has_forward_materials(const Content&);
bool has_material_detail(const Content&);
bool has_emission(const Content&);
bool has_far_plane(const Content&);
bool has_moving_meshes(const Content&);
}  // namespace content

inline constexpr auto effect_table = std::to_array<EffectInfo>({
    {"spot", "spots", "EFFECT_SPOTS", "cones; compiled in when a light of the scene is a spot",
     &Effects::spots, content::has_spots},
    {"capsule", "capsules", "EFFECT_CAPSULES", "omni lights with a length; when the scene has one",
     &Effects::capsules, content::has_capsules},
    {"wedge", "wedges", "EFFECT_WEDGES", "spots with a length; when the scene has one", &Effects::wedges,
     content::has_wedges},
    {"box", "boxes", "EFFECT_BOXES", "windows with six faces; when the scene has one", &Effects::boxes,
     content::has_boxes},
    {"probe", "probes", "EFFECT_PROBES", "ambient light in a light's volume; when the scene has such lights",
     &Effects::probes, content::has_probes},
    {"specular", "specular", "EFFECT_SPECULAR", "GGX highlights", &Effects::specular, content::has_surfaces},
    {"alpha_mask", "alpha_mask", "EFFECT_ALPHA_MASK",
     "cut-out materials; when a material of the scene has a mask", &Effects::alpha_mask,
     content::has_masked_materials},
    {"forward", "forward", "EFFECT_FORWARD",
     "materials lit in a forward pass; when a material of the scene is one", &Effects::forward,
     content::has_forward_materials},
    {"clip_far", nullptr, "EFFECT_CLIP_FAR",
     "surfaces beyond the camera's far plane are not seen; when a file's zfar cuts its level",
     &Effects::clip_far, content::has_far_plane},
    {"motion", nullptr, nullptr, "meshes are drawn where animated nodes carry them; when the file has some",
     &Effects::motion, content::has_moving_meshes},
    {"material_detail", "material_detail", nullptr,
     "vertex colours, metallic-roughness textures and normal maps; when a mesh of the scene has some",
     &Effects::material_detail, content::has_material_detail},
    {"emission", "emission", "EFFECT_EMISSION",
     "surfaces that give light by themselves, added once a pixel; when a material of the scene does",
     &Effects::emission, content::has_emission},
});

// Those that the content calls for and `allowed` does not switch off.
Effects effects_of(const Content& content, const Effects& allowed);
// All that there are: what a configuration allows unless it says otherwise.
Effects all_effects();

}  // namespace ml
