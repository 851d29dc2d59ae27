// Every algorithm of the bench, in the order of tables. Adding one: its folder, its line here.
#include <algorithm>

#include "algorithms/algorithm.h"
#include "algorithms/brute_force/brute_force.h"
#include "algorithms/clustered/clustered.h"
#include "algorithms/fine_pruned/fine_pruned.h"
#include "algorithms/hybrid/hybrid.h"
#include "algorithms/ideal/ideal.h"
#include "algorithms/light_bvh/light_bvh.h"
#include "algorithms/light_tree/light_tree.h"
#include "harness/base/error.h"

namespace ml {

const std::vector<AlgorithmEntry>& algorithm_registry() {
  static const std::vector<AlgorithmEntry> entries{
      brute_force_entry(), ideal_entry(),       clustered_entry(), light_tree_entry(),
      hybrid_entry(),      fine_pruned_entry(), light_bvh_entry(),
  };
  return entries;
}

const AlgorithmEntry& find_algorithm(const std::string& name, const std::string& where) {
  std::vector<std::string> known;
  for (const AlgorithmEntry& entry : algorithm_registry()) {
    if (entry.info.name == name) return entry;
    known.push_back(entry.info.name);
  }
  throw UsageError(where + ": unknown algorithm '" + name + "'" + suggestion(name, known));
}

}  // namespace ml
