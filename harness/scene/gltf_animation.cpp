#include <algorithm>
#include <cmath>

#include "harness/scene/gltf_parts.h"

namespace ml::gltf {
namespace {

constexpr size_t max_keys = 100000;

// Spherical interpolation by halving: square roots alone, so that every machine makes the same bits (sin and
// acos do not).
glm::dvec4 turn(glm::dvec4 a, glm::dvec4 b, double t) {
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

}  // namespace

NodeMotion::NodeMotion(File& file, size_t node) {
  local_ = local_transform(file, node);
  const auto& animations = file.model.animations;
  for (size_t a = 0; a < animations.size() && channels_.empty(); ++a) {
    for (size_t i = 0; i < animations[a].channels.size(); ++i) {
      const tinygltf::AnimationChannel& source = animations[a].channels[i];
      if (source.target_node != static_cast<int>(node)) continue;
      std::string place = gltf::at("animations", a) + "." + gltf::at("channels", i);
      Channel channel{};
      if (source.target_path == "translation")
        channel.path = Channel::Path::translation;
      else if (source.target_path == "rotation")
        channel.path = Channel::Path::rotation;
      else if (source.target_path == "scale")
        channel.path = Channel::Path::scale;
      else
        continue;
      if (source.sampler < 0 || static_cast<size_t>(source.sampler) >= animations[a].samplers.size())
        file.fail(place + ".sampler", "is " + std::to_string(source.sampler) + ", but the animation has " +
                                          std::to_string(animations[a].samplers.size()) + " samplers");
      const auto& sampler = animations[a].samplers[static_cast<size_t>(source.sampler)];
      std::string where =
          gltf::at("animations", a) + "." + gltf::at("samplers", static_cast<size_t>(source.sampler));
      channel.interpolation = sampler.interpolation == "STEP"          ? Channel::Interpolation::step
                              : sampler.interpolation == "CUBICSPLINE" ? Channel::Interpolation::cubic
                                                                       : Channel::Interpolation::linear;
      channel.times = read_numbers(file, static_cast<size_t>(sampler.input), 1, where + ".input");
      int width = channel.path == Channel::Path::rotation ? 4 : 3;
      channel.values = read_numbers(file, static_cast<size_t>(sampler.output), width, where + ".output");
      if (channel.times.size() > max_keys)
        file.fail(where + ".input", "has more than " + std::to_string(max_keys) + " keys");
      for (size_t k = 1; k < channel.times.size(); ++k)
        if (!(channel.times[k] > channel.times[k - 1]))
          file.fail(where + ".input", "its times do not increase at key " + std::to_string(k));
      size_t per_key = channel.interpolation == Channel::Interpolation::cubic ? 3 : 1;
      size_t wanted = channel.times.size() * per_key * static_cast<size_t>(width);
      if (channel.values.size() != wanted)
        file.fail(where + ".output",
                  "has " + std::to_string(channel.values.size() / static_cast<size_t>(width)) +
                      " elements, expected " + std::to_string(channel.times.size() * per_key));
      channels_.push_back(std::move(channel));
    }
  }
  if (moves()) rest_ = local_pose(file, node);
}

void NodeMotion::add_times(std::vector<double>& times, bool& curved) const {
  for (const Channel& channel : channels_) {
    times.insert(times.end(), channel.times.begin(), channel.times.end());
    curved = curved || channel.interpolation == Channel::Interpolation::cubic;
  }
}

glm::dvec4 NodeMotion::value(const Channel& channel, double time) const {
  bool rotation = channel.path == Channel::Path::rotation,
       cubic = channel.interpolation == Channel::Interpolation::cubic;
  size_t width = rotation ? 4 : 3;
  // Part 0 of a cubic key is its in-tangent, 1 its value, 2 its out-tangent.
  auto element = [&](size_t key, size_t part) {
    glm::dvec4 result(0);
    for (size_t c = 0; c < width; ++c)
      result[static_cast<int>(c)] = channel.values[(cubic ? 3 * key + part : key) * width + c];
    return result;
  };
  auto direction = [&](const glm::dvec4& v) {
    double length = glm::length(v);
    return length > 1e-150 && std::isfinite(length) ? v / length : glm::dvec4(0, 0, 0, 1);
  };
  const auto& times = channel.times;
  auto after = std::upper_bound(times.begin(), times.end(), time);
  size_t next = static_cast<size_t>(after - times.begin());
  glm::dvec4 result;
  if (next == 0 || next == times.size() || channel.interpolation == Channel::Interpolation::step) {
    result = element(next == 0 ? 0 : next - 1, 1);
  } else {
    size_t key = next - 1;
    double span = times[next] - times[key], t = (time - times[key]) / span;
    if (cubic) {
      double t2 = t * t, t3 = t2 * t;
      result = (2 * t3 - 3 * t2 + 1) * element(key, 1) + span * (t3 - 2 * t2 + t) * element(key, 2) +
               (3 * t2 - 2 * t3) * element(next, 1) + span * (t3 - t2) * element(next, 0);
    } else if (rotation) {
      result = turn(direction(element(key, 1)), direction(element(next, 1)), t);
    } else {
      result = element(key, 1) + t * (element(next, 1) - element(key, 1));
    }
  }
  return rotation ? direction(result) : result;
}

glm::dmat4 NodeMotion::at(double time) const {
  if (!moves()) return local_;
  Pose pose = rest_;
  for (const Channel& channel : channels_) {
    glm::dvec4 now = value(channel, time);
    if (channel.path == Channel::Path::translation) pose.translation = glm::dvec3(now);
    if (channel.path == Channel::Path::rotation) pose.rotation = now;
    if (channel.path == Channel::Path::scale) pose.scale = glm::dvec3(now);
  }
  return matrix_of(pose);
}

}  // namespace ml::gltf
