#include "scenes/members.h"

#include <algorithm>

#include "harness/base/error.h"

namespace ml {

Members::Members(const Node& node) : node_(node) {
  node_.object();
}

std::optional<Node> Members::find(const std::string& key) {
  asked_.push_back(key);
  if (!node_.json().contains(key)) return std::nullopt;
  return node_.member(key);
}

Node Members::get(const std::string& key) {
  std::optional<Node> found = find(key);
  if (!found) node_.fail("the key '" + key + "' is missing");
  return *found;
}

void Members::expect_no_others() const {
  for (const auto& [key, value] : node_.json().items()) {
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      node_.member(key).fail("unknown key" + suggestion(key, asked_));
  }
}

}  // namespace ml
