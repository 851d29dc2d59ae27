// "sweep" (every combination) and "zip" (lists side by side): one setup per point.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/config/keys.h"

namespace ml {

// One swept key as it was written.
struct SweptKey {
  std::string key;
  bool zipped = false;
  nlohmann::json values;
  Source source;
  std::string path;  // of the list, for messages
};

// Says which point of the sweep a setup is ("lights.count=8192, resolution=[960,540]"; "" without a sweep).
// For messages only.
using PointText = std::function<std::string()>;

class Sweeps {
 public:
  // Reads "sweep" or "zip", instead of what it held before.
  void read(const Node& node, bool zipped);
  // One list of "sweep" or "zip"; replaces the key's list, wherever that was.
  void read_list(const std::string& key, const Node& node, bool zipped);
  // `key` has been set by hand to one value: it is no longer swept. Fails at the node when the key is only a
  // part of what is swept.
  void forget(const std::string& key, const Node& node);

  // The points, in a fixed order: sweep keys in alphabetical order, the last fastest, and zip faster still.
  // Throws when a value, a length or the number of cases is impossible.
  void expand(const Draft& base, const Source& source,
              const std::function<void(const Setup& setup, const PointText& point)>& each) const;
  // Adds "sweep" and "zip" with the values as they were understood.
  void write(const Draft& base, nlohmann::json& out) const;

 private:
  std::vector<SweptKey> keys_;  // sorted by key
};

}  // namespace ml
