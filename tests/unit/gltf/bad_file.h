// A file that must be refused, and the line that says why.
#pragma once

#include <functional>
#include <ostream>
#include <string>

#include "harness/base/error.h"
#include "tests/support/gltf_test_file.h"

namespace ml {

inline std::string message_of(const std::string& bytes, int scene = -1) {
  try {
    GltfTestFile::load_bytes(bytes, scene);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

struct BadFile {
  const char* name;
  std::function<void(GltfTestFile&)> spoil;  // of triangle_file()
  std::string message;                       // after "test.glb: "
};

inline void PrintTo(const BadFile& file, std::ostream* out) {
  *out << file.name;
}

}  // namespace ml
