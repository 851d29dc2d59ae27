#include "algorithms/light_bvh/sphere_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace ml {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

VolumeBox empty_box() {
  return {glm::vec3(infinity), glm::vec3(-infinity)};
}

uint32_t identity_of(const FrameLights& lights, uint32_t light) {
  return lights.identity.empty() ? light : lights.identity[light];
}

uint32_t identity_end(const FrameLights& lights) {
  const auto count = static_cast<uint32_t>(lights.count());
  return count == 0 ? 0 : identity_of(lights, count - 1) + 1;
}

// Deeper than any useful tree; beyond it ranges are halved, so that lights at one point end somewhere.
constexpr uint32_t deepest_split = 48, bins = 12;

// The light of a leaf that is about to be taken out.
constexpr uint32_t gone = SphereTree::none - 1;

}  // namespace

uint32_t SphereTree::new_node() {
  if (free_.empty()) {
    nodes_.emplace_back();
    return static_cast<uint32_t>(nodes_.size() - 1);
  }
  uint32_t node = free_.back();
  free_.pop_back();
  nodes_[node] = {};
  return node;
}

uint32_t SphereTree::build_range(const FrameLights& lights, uint32_t begin, uint32_t end, uint32_t depth) {
  const uint32_t node = new_node();
  if (end - begin == 1) {
    const uint32_t light = items_[begin];
    nodes_[node].light = light;
    nodes_[node].box = volumes_[light].box;
    leaf_of_light_[identity_of(lights, light)] = node;
    return node;
  }
  auto center = [&](uint32_t light, int axis) { return volumes_[light].center[axis]; };
  glm::vec3 low(infinity), high(-infinity);
  for (uint32_t i = begin; i < end; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], center(items_[i], axis));
      high[axis] = std::max(high[axis], center(items_[i], axis));
    }
  float best = infinity;
  int best_axis = -1;
  uint32_t best_split = 0;
  auto bin_of = [&](uint32_t light, int axis) {
    const float scale = static_cast<float>(bins) / (high[axis] - low[axis]);
    return std::min(static_cast<uint32_t>((center(light, axis) - low[axis]) * scale), bins - 1);
  };
  for (int axis = 0; depth < deepest_split && axis < 3; ++axis) {
    if (!(high[axis] - low[axis] > 1e-6f * (std::abs(high[axis]) + std::abs(low[axis])))) continue;
    std::array<VolumeBox, bins> boxes;
    std::array<uint32_t, bins> counts{};
    boxes.fill(empty_box());
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t bin = bin_of(items_[i], axis);
      boxes[bin] = around(boxes[bin], volumes_[items_[i]].box);
      ++counts[bin];
    }
    std::array<float, bins> right{};
    VolumeBox box = empty_box();
    uint32_t count = 0;
    for (uint32_t bin = bins; bin-- > 1;) {
      box = around(box, boxes[bin]);
      count += counts[bin];
      right[bin] = box.area() * static_cast<float>(count);
    }
    box = empty_box();
    count = 0;
    for (uint32_t split = 1; split < bins; ++split) {
      box = around(box, boxes[split - 1]);
      count += counts[split - 1];
      if (count == 0 || count == end - begin) continue;
      const float cost = box.area() * static_cast<float>(count) + right[split];
      if (cost < best) best = cost, best_axis = axis, best_split = split;
    }
  }
  uint32_t middle = begin + (end - begin) / 2;
  if (best_axis >= 0) {
    // In order on both sides. std::stable_partition would take memory each time.
    middle = begin;
    right_items_.clear();
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t light = items_[i];
      if (bin_of(light, best_axis) < best_split)
        items_[middle++] = light;
      else
        right_items_.push_back(light);
    }
    std::ranges::copy(right_items_, items_.begin() + middle);
  }
  const uint32_t left = build_range(lights, begin, middle, depth + 1);
  const uint32_t right = build_range(lights, middle, end, depth + 1);
  nodes_[node].children = 2;
  nodes_[node].child[0] = left;
  nodes_[node].child[1] = right;
  nodes_[left].parent = nodes_[right].parent = node;
  nodes_[node].box = around(nodes_[left].box, nodes_[right].box);
  return node;
}

// Children with the largest surface give way to their own children while those fit.
void SphereTree::collapse(uint32_t node) {
  while (true) {
    Node& n = nodes_[node];
    uint32_t widest = none;
    for (uint32_t c = 0; c < n.children; ++c) {
      const Node& child = nodes_[n.child[c]];
      if (child.light != none || n.children - 1 + child.children > branching_) continue;
      if (widest == none || child.box.area() > nodes_[n.child[widest]].box.area()) widest = c;
    }
    if (widest == none) break;
    const uint32_t opened = n.child[widest];
    const Node child = nodes_[opened];
    n.child[widest] = child.child[0];
    for (uint32_t c = 1; c < child.children; ++c) n.child[n.children++] = child.child[c];
    for (uint32_t c = 0; c < child.children; ++c) nodes_[child.child[c]].parent = node;
    free_.push_back(opened);
  }
  for (uint32_t c = 0; c < nodes_[node].children; ++c)
    if (nodes_[nodes_[node].child[c]].light == none) collapse(nodes_[node].child[c]);
}

void SphereTree::list_bottom_up() {
  order_.clear();
  if (root_ == none) return;
  stack_.assign(1, root_);
  while (!stack_.empty()) {
    const uint32_t node = stack_.back();
    stack_.pop_back();
    order_.push_back(node);
    for (uint32_t c = 0; c < nodes_[node].children; ++c) stack_.push_back(nodes_[node].child[c]);
  }
  std::reverse(order_.begin(), order_.end());
}

void SphereTree::build(const FrameLights& lights) {
  find_volumes(lights, volumes_);
  lights_ = static_cast<uint32_t>(lights.count());
  nodes_.clear();
  free_.clear();
  root_ = none;
  leaf_of_light_.assign(std::max<size_t>(leaf_of_light_.size(), identity_end(lights)), none);
  items_.resize(lights_);
  std::iota(items_.begin(), items_.end(), 0u);
  if (lights_ > 0) {
    // For those that will come, too.
    for (std::vector<uint32_t>* list : {&free_, &order_, &stack_}) list->reserve(2 * leaf_of_light_.size());
    nodes_.reserve(2 * leaf_of_light_.size());
    volumes_.reserve(leaf_of_light_.size());
    root_ = build_range(lights, 0, lights_, 0);
    if (nodes_[root_].light == none) collapse(root_);
  }
  list_bottom_up();
}

void SphereTree::fit(uint32_t node) {
  Node& n = nodes_[node];
  n.box = nodes_[n.child[0]].box;
  for (uint32_t c = 1; c < n.children; ++c) n.box = around(n.box, nodes_[n.child[c]].box);
}

void SphereTree::follow(const FrameLights& lights) {
  const auto count = static_cast<uint32_t>(lights.count());
  leaf_of_light_.resize(std::max<size_t>(leaf_of_light_.size(), identity_end(lights)), none);
  // Every leaf gets its light's new index, or none.
  uint32_t stay = 0;
  for (uint32_t leaf : leaf_of_light_)
    if (leaf != none) nodes_[leaf].light = gone;
  for (uint32_t light = 0; light < count; ++light) {
    const uint32_t leaf = leaf_of_light_[identity_of(lights, light)];
    if (leaf == none) continue;
    nodes_[leaf].light = light;
    ++stay;
  }
  const uint32_t came = count - stay, went = lights_ - stay;
  if (came + went > stay) return build(lights);
  find_volumes(lights, volumes_);
  lights_ = count;
  if (went > 0)
    for (uint32_t& leaf : leaf_of_light_) {
      if (leaf == none || nodes_[leaf].light != gone) continue;
      remove(leaf);
      free_.push_back(leaf);
      leaf = none;
    }
  if (went > 0) list_bottom_up();
  refit();
  if (came == 0) return;
  for (uint32_t light = 0; light < count; ++light) {
    uint32_t& leaf = leaf_of_light_[identity_of(lights, light)];
    if (leaf != none) continue;
    leaf = new_node();
    nodes_[leaf].light = light;
    nodes_[leaf].box = volumes_[light].box;
    insert(leaf);
  }
  list_bottom_up();
  refit();
}

void SphereTree::refit() {
  for (uint32_t node : order_) {
    if (nodes_[node].light != none)
      nodes_[node].box = volumes_[nodes_[node].light].box;
    else
      fit(node);
  }
}

void SphereTree::remove(uint32_t leaf) {
  const uint32_t parent = nodes_[leaf].parent;
  Node& p = nodes_[parent];
  const uint32_t slot =
      static_cast<uint32_t>(std::find(p.child.begin(), p.child.begin() + p.children, leaf) - p.child.begin());
  p.child[slot] = p.child[--p.children];
  uint32_t dirty = parent;
  if (p.children == 1) {
    // The one child that is left takes the parent's place.
    const uint32_t left = p.child[0], above = p.parent;
    nodes_[left].parent = above;
    if (above == none) {
      root_ = left;
    } else {
      Node& a = nodes_[above];
      *std::find(a.child.begin(), a.child.begin() + a.children, parent) = left;
    }
    free_.push_back(parent);
    dirty = above;
  }
  for (; dirty != none; dirty = nodes_[dirty].parent) fit(dirty);
}

// Down from the root: into the child whose surface grows least, until a sibling is cheaper. A node with space
// takes the light as a child, for the price of one more test; a full one, or a leaf, shares a new node with
// it.
void SphereTree::insert(uint32_t leaf) {
  const VolumeBox box = nodes_[leaf].box;
  uint32_t node = root_;
  while (true) {
    nodes_[node].box = around(nodes_[node].box, box);
    if (nodes_[node].light != none) break;
    uint32_t best = none;
    float best_cost = infinity;
    for (uint32_t c = 0; c < nodes_[node].children; ++c) {
      const VolumeBox& child = nodes_[nodes_[node].child[c]].box;
      const float cost = around(child, box).area() - child.area();
      if (best == none || cost < best_cost) best = nodes_[node].child[c], best_cost = cost;
    }
    const bool has_space = nodes_[node].children < branching_;
    // With a leaf it would take a node around both.
    const float price = nodes_[best].light != none ? around(nodes_[best].box, box).area() : best_cost;
    if (has_space && !(price < box.area())) {
      nodes_[node].child[nodes_[node].children++] = leaf;
      nodes_[leaf].parent = node;
      return;
    }
    node = best;
  }
  // `node` is a leaf: a new node stands in its place, with both below.
  const uint32_t pair = new_node(), above = nodes_[node].parent;
  nodes_[node].box = {};
  nodes_[pair].parent = above;
  nodes_[pair].children = 2;
  nodes_[pair].child[0] = node;
  nodes_[pair].child[1] = leaf;
  if (above == none) {
    root_ = pair;
  } else {
    Node& a = nodes_[above];
    *std::find(a.child.begin(), a.child.begin() + a.children, node) = pair;
  }
  nodes_[node].parent = nodes_[leaf].parent = pair;
}

void SphereTree::reinsert(uint32_t first, uint32_t stride) {
  if (lights_ < 3) return;
  for (size_t identity = first; identity < leaf_of_light_.size(); identity += stride) {
    const uint32_t leaf = leaf_of_light_[identity];
    if (leaf == none) continue;
    remove(leaf);
    insert(leaf);
  }
  list_bottom_up();
  refit();
}

}  // namespace ml
