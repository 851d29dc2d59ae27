// A glTF file on its way into a Scene: its checked description and its bytes. Private to the importer.
//
// Three steps, so that a hostile file meets a check before it meets code that trusts it:
//   1. container.cpp takes the JSON and the binary chunk out of the bytes,
//   2. schema.cpp copies what the importer knows out of the JSON, and proves types, ranges and
//   references on the way,
//   3. tinygltf turns that copy into its Model; it never sees buffers, images, extras or unknown extensions.
// After that every index in the Model is valid; byte ranges are proven by buffers.cpp and
// accessor.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace ml::gltf {

using Json = nlohmann::json;
using Bytes = std::span<const std::byte>;

// No level that the bench can draw comes near these; a file that claims more is refused before memory is
// asked for.
constexpr size_t max_vertices = size_t{1} << 24;
constexpr size_t max_indices = size_t{3} << 24;
constexpr size_t max_pixels = size_t{1} << 27;  // of all textures together
constexpr double max_coordinate = 1e9;          // m
constexpr int max_depth = 1024;                 // of the node tree

struct File {
  std::string name;              // as errors call it
  std::filesystem::path folder;  // what URIs are relative to
  std::filesystem::path root;    // external files lie in or below it, or the folder
  bool external = false;         // whether external files may be read

  Json json;  // the checked copy of the description
  tinygltf::Model model;
  std::vector<std::vector<std::byte>> owned;  // what `buffers` points into
  std::vector<Bytes> buffers;
  std::vector<std::string> notes;

  // Throws UsageError "name: where: what".
  [[noreturn]] void fail(const std::string& where, const std::string& what) const;
  // The size of all buffers.
  size_t total_bytes() const;
};

// "accessors[3]"
std::string at(const char* array, size_t index);

// container.cpp. The JSON text and, for a GLB with one, the binary chunk; both point into `bytes`.
struct Container {
  std::string_view json;
  std::optional<Bytes> binary;
};
Container open_container(const File& file, Bytes bytes);

// extensions.cpp. Throws UsageError where `raw` is no glTF 2.x or needs an extension without which the
// level would not be what it is; adds a note for each that it can do without. Types and ranges of what it
// looks at need not have been proven.
void check_version_and_extensions(File& file, const Json& raw);
// Adds a note for each extension that the file uses and the importer does not know, with how often.
void note_unknown_extensions(File& file, const Json& raw);

// schema.cpp. The parts of `raw` that the importer reads, with every type, range and reference proven;
// throws UsageError.
Json checked_description(const File& file, const Json& raw);
// Adds a note for each kind of content in `raw` that the bench does not draw.
void note_what_is_ignored(File& file, const Json& raw);

// buffers.cpp. Fills file.buffers and proves the ranges of all buffer views.
void load_buffers(File& file, std::optional<Bytes> binary);
// The bytes of a buffer view.
Bytes view_bytes(const File& file, size_t view);
// The bytes that a URI names: a data URI is decoded, anything else is a file below file.root.
std::vector<std::byte> load_uri(const File& file, const std::string& where, const std::string& uri);
// The path of a file that lies in or below file.root, seen from file.folder. Throws UsageError for absolute
// paths, schemes, paths that lead out of the root, and where external files are refused.
std::filesystem::path external_path(const File& file, const std::string& where, const std::string& uri);

// accessor.cpp. `where`: what uses the accessor, for errors.
// Elements of `components` numbers each (1 to 4, or 16: matrices, column by column), normalised integers as
// [0, 1] or [-1, 1]; all finite.
std::vector<double> read_numbers(const File& file, size_t accessor, int components, const std::string& where);
std::vector<uint32_t> read_indices(const File& file, size_t accessor, const std::string& where);

}  // namespace ml::gltf
