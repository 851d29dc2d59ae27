#include "algorithms/trees/tree_algorithm.h"

#include "algorithms/froxels/froxel_parameters.h"

namespace ml {

TreeAlgorithm::TreeAlgorithm(const std::string& name, const FroxelSettings& froxels,
                             const TreeSettings& trees, const Parameters& parameters)
    : trees_(name, froxels, trees),
      together_(walk_together(parameters)),
      masked_(parameters.choice("walk") == "masked"),
      narrow_(froxels.narrow) {}

ParameterInfo tree_walk_parameter() {
  ParameterInfo info = walk_parameter();
  info.choices.emplace_back("masked");
  info.help =
      "the pixels of a subgroup walk a cell together, fetching each light once (subgroup: a light is tested "
      "by those whose leaf it is in; masked: by all, as soon as one hits the leaf), or each pixel alone";
  return info;
}

AlgorithmEntry tree_entry(const std::string& name, const std::string& summary,
                          std::vector<ParameterInfo> grid) {
  AlgorithmEntry entry;
  entry.info.name = name;
  entry.info.summary = summary;
  entry.info.paper = "O'Donnell & Chajdas, Tiled Light Trees, I3D 2017";
  entry.info.cpu_stages = {"cull", "sort", "bin", "build", "upload"};
  entry.parameters = std::move(grid);
  for (ParameterInfo& info : tree_parameters()) entry.parameters.push_back(std::move(info));
  return entry;
}

}  // namespace ml
