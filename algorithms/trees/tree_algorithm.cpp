#include "algorithms/trees/tree_algorithm.h"

namespace ml {

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
