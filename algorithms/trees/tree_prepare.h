// prepare() of the algorithms that walk trees: lists in the order of depth, trees over them, upload.
#pragma once

#include "algorithms/algorithm.h"
#include "algorithms/trees/cell_trees.h"

namespace ml {

class TreePrepare {
 public:
  // `owner`: the algorithm's name for messages.
  TreePrepare(const std::string& owner, const FroxelSettings& froxels, const TreeSettings& trees);

  // Spans cull, sort, bin, build, upload.
  void prepare(const FrameInput& frame, UploadMemory& memory, Spans& spans);
  const PrepareCounters& counters() const { return counters_; }
  // The upload slots, as tree_walk.glsl names them.
  static std::vector<std::string> buffers() { return {"Grid", "TreeCells", "TreeNodes", "Indices"}; }

  // Of the frame that was prepared last (Algorithm). `masked`: subgroups merge leaves (masked_walk.glsl).
  LongestWalk longest_walk(bool masked) const;
  TileClasses tile_classes() const;

  const FroxelLists& lists() const { return lists_; }
  const CellTrees& cell_trees() const { return cell_trees_; }

 private:
  void classify_tiles();

  std::string owner_;
  FroxelSettings froxels_;
  TreeSettings trees_;
  FroxelLists lists_;
  CellTrees cell_trees_;
  std::vector<uint8_t> class_of_tile_;
  PrepareCounters counters_;
};

// The parameters that both have.
std::vector<ParameterInfo> tree_parameters();
TreeSettings tree_settings(const Parameters& parameters);
// Whether nodes hold chords (FroxelSettings::chords).
bool with_chords(const Parameters& parameters);

}  // namespace ml
