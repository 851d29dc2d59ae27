#include "harness/scene/node_motion.h"

#include <algorithm>
#include <cmath>

#include "harness/base/check.h"

namespace ml {
namespace {

constexpr size_t max_sample_times = 4096;

// Spherical interpolation by halving: square roots alone, so that every machine makes the same bits (sin and
// acos do not).
glm::dvec4 between_rotations(glm::dvec4 a, glm::dvec4 b, double t) {
  if (glm::dot(a, b) < 0) b = -b;
  double low = 0, high = 1;
  for (int step = 0; step < 10; ++step) {
    glm::dvec4 middle = glm::normalize(a + b);
    double half = 0.5 * (low + high);
    if (t < half)
      b = middle, high = half;
    else
      a = middle, low = half;
  }
  return glm::normalize(a + (b - a) * ((t - low) / (high - low)));
}

glm::dvec4 unit_rotation(const glm::dvec4& v) {
  double length = glm::length(v);
  return length > 1e-150 && std::isfinite(length) ? v / length : glm::dvec4(0, 0, 0, 1);
}

// The value of a key; part 0 of a cubic one is its in-tangent, 1 its value, 2 its out-tangent.
glm::dvec4 element(const MotionChannel& channel, size_t key, size_t part) {
  const size_t width = channel.target == MotionChannel::Target::rotation ? 4 : 3;
  const bool cubic = channel.interpolation == MotionChannel::Interpolation::cubic;
  glm::dvec4 result(0);
  for (size_t c = 0; c < width; ++c)
    result[static_cast<int>(c)] = channel.values[(cubic ? 3 * key + part : key) * width + c];
  return result;
}

}  // namespace

glm::dmat4 matrix_of(const Pose& pose) {
  double x = pose.rotation.x, y = pose.rotation.y, z = pose.rotation.z, w = pose.rotation.w;
  glm::dmat4 m(1);
  m[0] = glm::dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0) * pose.scale.x;
  m[1] = glm::dvec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0) * pose.scale.y;
  m[2] = glm::dvec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0) * pose.scale.z;
  m[3] = glm::dvec4(pose.translation, 1);
  return m;
}

glm::dvec4 MotionChannel::at(double time) const {
  const auto next = static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  glm::dvec4 result;
  if (next == 0 || next == times.size() || interpolation == Interpolation::step) {
    result = element(*this, next == 0 ? 0 : next - 1, 1);
  } else {
    const size_t key = next - 1;
    const double span = times[next] - times[key], t = (time - times[key]) / span;
    const glm::dvec4 from = element(*this, key, 1), to = element(*this, next, 1);
    if (interpolation == Interpolation::cubic) {
      const double t2 = t * t, t3 = t2 * t;
      result = (2 * t3 - 3 * t2 + 1) * from + span * (t3 - 2 * t2 + t) * element(*this, key, 2) +
               (3 * t2 - 2 * t3) * to + span * (t3 - t2) * element(*this, next, 0);
    } else if (target == Target::rotation) {
      result = between_rotations(unit_rotation(from), unit_rotation(to), t);
    } else {
      result = from + t * (to - from);
    }
  }
  return target == Target::rotation ? unit_rotation(result) : result;
}

size_t NodeMotions::add(MotionNode node) {
  ML_CHECK_LT(node.parent, static_cast<int>(nodes_.size()));
  Entry entry;
  entry.moves = !node.channels.empty() || (node.parent >= 0 && moves(static_cast<size_t>(node.parent)));
  for (const MotionChannel& channel : node.channels) {
    begin_ = timed_ ? std::min(begin_, channel.times.front()) : channel.times.front();
    end_ = timed_ ? std::max(end_, channel.times.back()) : channel.times.back();
    timed_ = true;
  }
  entry.node = std::move(node);
  nodes_.push_back(std::move(entry));
  return nodes_.size() - 1;
}

double NodeMotions::time_of(uint32_t frame, uint32_t frames) const {
  if (frames <= 1 || frame == 0) return begin_;
  if (frame + 1 >= frames) return end_;
  // Key times are floats: the product is exact, and one division rounds.
  return begin_ + duration() * static_cast<double>(frame) / static_cast<double>(frames - 1);
}

glm::dmat4 NodeMotions::world(size_t index, double time) const {
  glm::dmat4 world(1);
  for (int up = static_cast<int>(index); up >= 0; up = nodes_[static_cast<size_t>(up)].node.parent) {
    const MotionNode& node = nodes_[static_cast<size_t>(up)].node;
    if (node.channels.empty()) {
      world = node.local * world;
      continue;
    }
    Pose pose = node.rest;
    for (const MotionChannel& channel : node.channels) {
      const glm::dvec4 now = channel.at(time);
      if (channel.target == MotionChannel::Target::translation) pose.translation = glm::dvec3(now);
      if (channel.target == MotionChannel::Target::rotation) pose.rotation = now;
      if (channel.target == MotionChannel::Target::scale) pose.scale = glm::dvec3(now);
    }
    world = matrix_of(pose) * world;
  }
  return world;
}

bool NodeMotions::jumps(size_t index, double after, double until) const {
  for (int up = static_cast<int>(index); up >= 0; up = nodes_[static_cast<size_t>(up)].node.parent)
    for (const MotionChannel& channel : nodes_[static_cast<size_t>(up)].node.channels)
      if (channel.interpolation == MotionChannel::Interpolation::step &&
          channel.at(after) != channel.at(until))
        return true;
  return false;
}

void NodeMotions::add_times(size_t index, std::vector<double>& times) const {
  for (int up = static_cast<int>(index); up >= 0; up = nodes_[static_cast<size_t>(up)].node.parent)
    for (const MotionChannel& channel : nodes_[static_cast<size_t>(up)].node.channels)
      times.insert(times.end(), channel.times.begin(), channel.times.end());
}

std::vector<double> sample_times(const NodeMotions& motions, size_t node, uint32_t between) {
  std::vector<double> keys;
  motions.add_times(node, keys);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  if (keys.empty()) return {motions.begin()};
  const size_t stride = (keys.size() + max_sample_times - 1) / max_sample_times;
  const auto parts = static_cast<uint32_t>(
      std::clamp<size_t>(max_sample_times / keys.size(), 1, static_cast<size_t>(between) + 1));
  std::vector<double> times;
  for (size_t i = 0; i < keys.size(); i += stride) {
    times.push_back(keys[i]);
    for (uint32_t k = 1; k < parts && i + 1 < keys.size(); ++k)
      times.push_back(keys[i] + (keys[i + 1] - keys[i]) * k / parts);
  }
  if (times.back() != keys.back()) times.push_back(keys.back());
  return times;
}

}  // namespace ml
