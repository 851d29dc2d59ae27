// A file's textures on their way into a Scene. Private to the importer.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "harness/gltf/parts.h"

namespace ml::gltf {

class TextureLoader {
 public:
  TextureLoader(File& file, Scene& scene) : file_(file), scene_(scene) {}

  // The index in Scene::textures of a texture of the file, -1 for one whose picture cannot be had. A picture
  // is decoded once for each sampler that it is read with.
  int get(size_t texture);
  // Says what could not be had.
  void add_notes();

 private:
  std::optional<Texture> decoded(size_t image);
  Sampler sampler_of(size_t texture);

  File& file_;
  Scene& scene_;
  std::map<std::tuple<size_t, Sampler>, int> known_;  // by image
  std::map<size_t, std::string> unreadable_;          // images, and why
  size_t pixels_left_ = max_pixels;
  size_t without_image_ = 0, strange_samplers_ = 0;
};

}  // namespace ml::gltf
