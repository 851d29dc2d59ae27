// The one place that compiles tinygltf. It reads only what checked_description() let through, so that its own
// leniency (unchecked indices, recursion over extras, network-sized data URIs) never meets the file.
#include <fstream>

#define TINYGLTF_IMPLEMENTATION
#include "harness/gltf/parts.h"

namespace ml::gltf {

tinygltf::Model parse_model(const File& file) {
  Json description = file.json;
  // The bytes stay ours.
  description.erase("buffers");
  description.erase("images");
  std::string text = description.dump();
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                  static_cast<unsigned int>(text.size()), "", 0))
    file.fail("JSON", error.empty() ? "tinygltf cannot read it" : error);
  return model;
}

}  // namespace ml::gltf
