#include "harness/bench/counting.h"

#include <fmt/format.h>

#include <stdexcept>

namespace ml {

PixelCounts read_counts(DeviceFrame& frame) {
  const CounterTargets& targets = frame.counters();
  return {frame.read_words(targets.listed),       frame.read_words(targets.tested),
          frame.read_words(targets.contributing), frame.read_words(targets.nodes),
          frame.read_words(targets.hash),         frame.read_words(targets.traversal)};
}

std::vector<uint8_t> lit_pixels(DeviceFrame& frame) {
  std::vector<float> depth = frame.read_floats(frame.targets().depth);
  std::vector<uint8_t> lit(depth.size());
  for (size_t i = 0; i < depth.size(); ++i) lit[i] = depth[i] > 0;
  return lit;
}

std::string miscounted(const AlgorithmInfo& info, const PixelCounts& counts, const ContributingLights& truth,
                       const std::vector<uint8_t>& lit, size_t lights, LightLists walk) {
  uint64_t wrong = 0, lit_pixels = 0;
  std::string first;
  for (size_t i = 0; i < lit.size(); ++i) {
    lit_pixels += lit[i];
    const uint32_t listed = counts.listed[i], tested = counts.tested[i], reached = counts.contributing[i];
    const bool fixed = !lit[i] || info.reference_only || info.needs_contributing_lists;
    // Where `ideal` walks by groups, what is lit forward walks alone.
    const bool of_group =
        info.needs_contributing_lists && walk == LightLists::groups && lit[i] && listed != truth.count[i];
    const size_t whole = !lit[i]               ? 0
                         : info.reference_only ? lights
                         : of_group            ? truth.group.at(i)
                                               : truth.count[i];
    if (fixed ? listed == whole && tested == whole : listed <= lights && reached <= listed) continue;
    if (wrong++ == 0)
      first =
          fixed ? fmt::format("pixel {} lists {} and tests {} of {} lights", i, listed, tested, whole)
                : fmt::format("pixel {} lists {} of {} lights and evaluates {}", i, listed, lights, reached);
  }
  return wrong == 0 ? "" : fmt::format("{} of {} pixels are miscounted: {}", wrong, lit_pixels, first);
}

ViewDepths view_depths(DeviceFrame& frame, const gpu_data::ViewData& view) {
  // shaders/surface.glsl: depth_from_reversed(). Devices divide within 2.5 units of the last place.
  ViewDepths depths{frame.read_floats(frame.targets().depth), frame.targets().width()};
  if (view.orthographic != 0) depths.absolute = 1e-6f * view.far;
  for (float& depth : depths.depth)
    if (depth > 0)
      depth = view.orthographic != 0 ? view.far - depth * (view.far - view.near) : view.near / depth;
  return depths;
}

std::string mislisted(const PixelCounts& counts, const ViewDepths& depths, const ListLength& list) {
  uint64_t wrong = 0, surfaces = 0;
  std::string first;
  for (size_t i = 0; i < depths.depth.size(); ++i) {
    const float depth = depths.depth[i];
    if (!(depth > 0)) continue;
    ++surfaces;
    const glm::uvec2 pixel(i % depths.width, i / depths.width);
    const auto right = [&](float at) {
      const std::optional<uint32_t> lights = list(pixel, at);
      return !lights || *lights == counts.listed[i];
    };
    const float rounding = depths.absolute + depths.relative * depth;
    if (right(depth) || right(depth - rounding) || right(depth + rounding)) continue;
    if (wrong++ == 0)
      first = fmt::format("pixel {} lists {} lights of the {} in its list", i, counts.listed[i],
                          list(pixel, depth).value_or(0));
  }
  return wrong == 0 ? "" : fmt::format("{} of {} pixels are miscounted: {}", wrong, surfaces, first);
}

FrameCounters summarize(const PixelCounts& counts, const ContributingLights& truth,
                        const std::vector<uint8_t>& lit, const PrepareCounters& prepare) {
  FrameCounters frame;
  frame.prepare = prepare;
  uint64_t listed = 0, tested = 0, contributing = 0, nodes = 0;
  for (size_t i = 0; i < lit.size(); ++i) {
    frame.lit_pixels += lit[i];
    listed += counts.listed[i];
    tested += counts.tested[i];
    contributing += counts.contributing[i];
    nodes += counts.nodes[i];
    if (prepare.list_cells + prepare.tree_cells > 0) {
      frame.tree_pixels += lit[i] && counts.traversal[i] == 1;
      frame.list_pixels += lit[i] && counts.traversal[i] == 0;
    }
    if (truth.count[i] > counts.contributing[i]) frame.lost += truth.count[i] - counts.contributing[i];
    if (truth.count[i] != counts.contributing[i] || truth.hash[i] != counts.hash[i]) {
      ++frame.mismatched_pixels;
      // As many as there should be, but not the same ones: at least one was lost and another is too much.
      if (truth.count[i] > 0 && truth.hash[i] != counts.hash[i] && truth.count[i] == counts.contributing[i])
        ++frame.lost;
    }
  }
  double pixels = frame.lit_pixels ? static_cast<double>(frame.lit_pixels) : 1;
  frame.listed = static_cast<double>(listed) / pixels;
  frame.tested = static_cast<double>(tested) / pixels;
  frame.contributing = static_cast<double>(contributing) / pixels;
  frame.nodes = static_cast<double>(nodes) / pixels;
  return frame;
}

std::map<std::string, double> own_counters(const AlgorithmInfo& info, const CounterValues& of_frame,
                                           const std::map<std::string, std::vector<uint32_t>>& of_pixels,
                                           const std::vector<uint8_t>& lit) {
  std::map<std::string, double> values = of_frame;
  double pixels = 0;
  for (uint8_t is_lit : lit) pixels += is_lit;
  for (const auto& [name, counts] : of_pixels) {
    double sum = 0;
    for (size_t i = 0; i < lit.size(); ++i) sum += lit[i] ? counts[i] : 0;
    values[name] = pixels > 0 ? sum / pixels : 0;
  }
  const std::map<std::string, double> built_in = FrameCounters{}.named();
  for (const CounterInfo& counter : info.counters) {
    if (built_in.contains(counter.name))
      throw std::logic_error(
          fmt::format("{}: the counter {} is one of the harness's; its own need other names (`list metrics`)",
                      info.name, counter.name));
    if (!values.contains(counter.name))
      throw std::logic_error(
          fmt::format("{}: the counter {} is declared and not given", info.name, counter.name));
  }
  if (values.size() != info.counters.size())
    throw std::logic_error(fmt::format("{}: it gives {} counters and declares {}", info.name, values.size(),
                                       info.counters.size()));
  return values;
}

std::map<std::string, double> FrameCounters::named() const {
  auto exact = [](uint64_t value) { return static_cast<double>(value); };
  return {{"in_frustum", exact(prepare.in_frustum)},
          {"listed", listed},
          {"tested", tested},
          {"contributing", contributing},
          {"nodes", nodes},
          {"lost", exact(lost)},
          {"mismatched_pixels", exact(mismatched_pixels)},
          {"lit_pixels", exact(lit_pixels)},
          {"list_bytes", exact(prepare.list_bytes)},
          {"list_cells", exact(prepare.list_cells)},
          {"tree_cells", exact(prepare.tree_cells)},
          {"list_pixels", exact(list_pixels)},
          {"tree_pixels", exact(tree_pixels)},
          {"overflow_tiles", exact(prepare.overflow_tiles)},
          {"overflow_lights", exact(prepare.overflow_lights)},
          {"coarse_lights", prepare.coarse_lights},
          {"fine_lights", prepare.fine_lights}};
}

}  // namespace ml
