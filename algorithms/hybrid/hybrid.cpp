#include "algorithms/hybrid/hybrid.h"

#include "algorithms/froxels/froxel_parameters.h"
#include "algorithms/trees/tree_algorithm.h"
#include "spirv/hybrid_forward.h"
#include "spirv/hybrid_forward_counting.h"
#include "spirv/hybrid_shade.h"
#include "spirv/hybrid_shade_counting.h"

namespace ml {
namespace {

FroxelSettings froxels(const Parameters& p) {
  FroxelSettings settings = froxel_settings(p);
  settings.chords = with_chords(p);
  return settings;
}

TreeSettings cell_tree_settings(const Parameters& p) {
  TreeSettings settings = tree_settings(p);
  settings.threshold = static_cast<float>(p.real("threshold"));
  settings.clipped = p.choice("heuristic") == "clipped";
  settings.list_lights = static_cast<uint32_t>(p.integer("list_lights"));
  return settings;
}

class Hybrid final : public TreeAlgorithm {
 public:
  explicit Hybrid(const Parameters& p)
      : TreeAlgorithm("hybrid", froxels(p), cell_tree_settings(p), p),
        list_case_(p.boolean("list_case")),
        shared_tree_(p.boolean("shared_tree")) {}
  ShadeShaders shade_shaders() const override {
    return {hybrid_shade, hybrid_shade_counting, hybrid_forward, hybrid_forward_counting};
  }
  gpu::Constants shade_constants() const override {
    gpu::Constants constants = tree_constants();
    constants.push_back({"LIST_CASE", list_case_});
    constants.push_back({"SHARED_TREE", shared_tree_});
    return constants;
  }

 private:
  bool list_case_, shared_tree_;
};

}  // namespace

AlgorithmEntry hybrid_entry() {
  AlgorithmEntry entry =
      tree_entry("hybrid", "froxels that hold a list or a tree, built on the CPU", froxel_parameters());
  entry.parameters.push_back(ParameterInfo::real(
      "threshold", 1, 0, 1e6,
      "a froxel is a tree when its lights' depth extents are on average below this part of its own "
      "(listing 2: 0.5, the text: 1)"));
  entry.parameters.push_back(ParameterInfo::choice("heuristic", "clipped", {"clipped", "unclipped"},
                                                   "the mean is of depth extents clipped to the froxel "
                                                   "(listing 2), or of whole ones, as in the authors' code "
                                                   "(with list_lights 6)"));
  entry.parameters.push_back(ParameterInfo::integer(
      "list_lights", 24, 0, 4096,
      "a froxel of no more lights is a list whatever their extents; 0: as the paper, those of one leaf"));
  entry.parameters.push_back(ParameterInfo::boolean(
      "list_case", false, "subgroups that walk nothing but lists have a loop of their own (section 3.4)"));
  entry.parameters.push_back(ParameterInfo::boolean(
      "shared_tree", false,
      "subgroups that walk one and the same tree copy it to shared memory first (section 3.4)"));
  entry.parameters.push_back(tree_walk_parameter());
  entry.check = [](const Parameters& p, uint32_t width, uint32_t height) -> std::string {
    if (walk_together(p) && (p.boolean("list_case") || p.boolean("shared_tree")))
      return "list_case and shared_tree are ways of walking alone; set walk to pixel";
    return froxel_check(p, width, height);
  };
  entry.create = [](const Parameters& parameters) { return std::make_unique<Hybrid>(parameters); };
  return entry;
}

}  // namespace ml
