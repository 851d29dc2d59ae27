// The keys of a configuration, each known in one place: how it is read, and how it is written back.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/base/json_node.h"
#include "harness/config/config.h"

namespace ml {

// A configuration before its sweeps are expanded.
struct Draft {
  std::string name, description;
  Setup setup;
  MeasureSpec measure;
  OutputSpec outputs;
};

// A key by its dotted path ("lights.count"; "lights" is the whole object, of which a given object sets the
// keys that it has).
struct Key {
  std::string path;
  bool section = false;    // an object of further keys
  bool sweepable = false;  // part of a setup
  std::function<void(const Node&, Draft&)> read;
  std::function<nlohmann::json(const Draft&)>
      write;  // null: the key does not apply (gltf of a procedural scene)
};

// All of them, sections before their keys; parameters of algorithms, "sweep" and "zip" apart.
const std::vector<Key>& config_keys();

// The key of that path, parameters "algorithms.[INDEX.|NAME.]PARAMETER" included. Throws at the node when
// there is none, with the nearest known one.
Key find_key(const std::string& path, const Node& node);

// Fails at `node` for the unknown key `name` of the object at `section` ("" is the configuration itself).
[[noreturn]] void unknown_key(const Node& node, const std::string& section, const std::string& name);

}  // namespace ml
