// The members of a JSON object, each asked for by name: what nobody asked for is an unknown key.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/base/json_node.h"

namespace ml {

class Members {
 public:
  // Throws UsageError where the node is no object. The node must outlive what is asked of it.
  explicit Members(const Node& node);

  std::optional<Node> find(const std::string& key);
  // Throws UsageError where the key is missing.
  Node get(const std::string& key);
  // Throws UsageError for the first key that was not asked for, with the nearest that was.
  void expect_no_others() const;

 private:
  Node node_;
  std::vector<std::string> asked_;
};

}  // namespace ml
