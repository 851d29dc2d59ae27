#include <algorithm>
#include <cmath>

#include "harness/gltf/parts.h"

namespace ml::gltf {
namespace {

constexpr size_t max_keys = 100000;        // of a channel
constexpr size_t max_all_keys = 10000000;  // of all channels: many may share one accessor

// A channel of the file that the bench can play.
struct PlayedChannel {
  size_t animation = 0, channel = 0;
  MotionChannel::Target target = MotionChannel::Target::translation;
};

class MovementLoader {
 public:
  MovementLoader(File& file, const std::vector<PlacedNode>& nodes)
      : file_(file), nodes_(nodes), parents_(check_tree(file)), channels_(file.model.nodes.size()) {}

  Movement load() {
    find_channels();
    Movement movement;
    movement.index.assign(file_.model.nodes.size(), -1);
    if (!anything_moves()) {
      note_what_carries_nothing(movement);
      return movement;
    }
    auto motions = std::make_shared<NodeMotions>();
    for (const PlacedNode& placed : nodes_) {
      // A camera that stands still among what moves runs by the same clock.
      const bool camera = file_.model.nodes[placed.node].camera >= 0;
      if (camera || (moves_[placed.node] && has_content(placed.node)))
        add_chain(placed.node, *motions, movement.index);
    }
    movement.motions = std::move(motions);
    note_what_carries_nothing(movement);
    return movement;
  }

 private:
  // By node; of several animations that move a node the first one counts.
  void find_channels() {
    size_t weights = 0, others = 0, later = 0;
    // From the description: tinygltf drops channels without a node (KHR_animation_pointer) in silence.
    const Json& animations = file_.json.value("animations", Json::array());
    for (size_t a = 0; a < animations.size(); ++a) {
      const Json& channels = animations[a]["channels"];
      for (size_t i = 0; i < channels.size(); ++i) {
        const Json& target = channels[i]["target"];
        const std::string path = target["path"];
        PlayedChannel played{a, i};
        if (path == "rotation") {
          played.target = MotionChannel::Target::rotation;
        } else if (path == "scale") {
          played.target = MotionChannel::Target::scale;
        } else if (path != "translation") {
          ++(path == "weights" ? weights : others);
          continue;
        }
        if (!target.contains("node")) {
          ++others;
          continue;
        }
        auto& known = channels_[target["node"].get<size_t>()];
        if (known.empty() || known.front().animation == a)
          known.push_back(played);
        else
          ++later;
      }
    }
    auto note = [&](size_t count, const char* what) {
      if (count) file_.notes.push_back(std::to_string(count) + what);
    };
    note(weights, " animation channels move the weights of morph targets, which is ignored");
    note(others,
         " animation channels move something else than a node's translation, rotation or scale, and are "
         "ignored");
    note(later, " animation channels move nodes that an earlier animation moves, and are not played");
  }

  // Joints, above all: skins stand at rest.
  void note_what_carries_nothing(const Movement& movement) {
    size_t count = 0;
    for (size_t node = 0; node < channels_.size(); ++node)
      if (movement.index[node] < 0) count += channels_[node].size();
    if (count)
      file_.notes.push_back(std::to_string(count) +
                            " animation channels move nodes that carry no mesh, light or camera, and are not "
                            "played: skins stand in their rest pose");
  }

  bool has_content(size_t node) const {
    const tinygltf::Node& source = file_.model.nodes[node];
    return source.mesh >= 0 || source.camera >= 0 ||
           file_.json["nodes"][node].contains("/extensions/KHR_lights_punctual"_json_pointer);
  }

  // Fills moves_; whether it moves anything that can be seen, seen by or that shines.
  bool anything_moves() {
    moves_.assign(file_.model.nodes.size(), 0);
    bool any = false;
    for (const PlacedNode& placed : nodes_) {
      const int parent = parents_[placed.node];
      moves_[placed.node] =
          !channels_[placed.node].empty() || (parent >= 0 && moves_[static_cast<size_t>(parent)]);
      any = any || (moves_[placed.node] && has_content(placed.node));
    }
    return any;
  }

  void add_chain(size_t node, NodeMotions& motions, std::vector<int>& index) {
    std::vector<size_t> chain;  // from the node up to what is there already
    for (int up = static_cast<int>(node); up >= 0 && index[static_cast<size_t>(up)] < 0;
         up = parents_[static_cast<size_t>(up)])
      chain.push_back(static_cast<size_t>(up));
    for (auto next = chain.rbegin(); next != chain.rend(); ++next) {
      MotionNode motion;
      if (const int parent = parents_[*next]; parent >= 0) motion.parent = index[static_cast<size_t>(parent)];
      for (const PlayedChannel& played : channels_[*next]) motion.channels.push_back(read_channel(played));
      if (motion.channels.empty())
        motion.local = local_transform(file_, *next);
      else
        motion.rest = local_pose(file_, *next);
      index[*next] = static_cast<int>(motions.add(std::move(motion)));
    }
  }

  MotionChannel read_channel(const PlayedChannel& from) {
    const Json& animation = file_.json["animations"][from.animation];
    const auto index = animation["channels"][from.channel]["sampler"].get<size_t>();
    const std::string where = gltf::at("animations", from.animation);
    if (index >= animation["samplers"].size())
      file_.fail(where + "." + gltf::at("channels", from.channel) + ".sampler",
                 "is " + std::to_string(index) + ", but the animation has " +
                     std::to_string(animation["samplers"].size()) + " samplers");
    const Json& sampler = animation["samplers"][index];
    const std::string of_sampler = where + "." + gltf::at("samplers", index),
                      interpolation = sampler.value("interpolation", "LINEAR");
    MotionChannel channel;
    channel.target = from.target;
    channel.interpolation = interpolation == "STEP"          ? MotionChannel::Interpolation::step
                            : interpolation == "CUBICSPLINE" ? MotionChannel::Interpolation::cubic
                                                             : MotionChannel::Interpolation::linear;
    channel.times = read_numbers(file_, sampler["input"].get<size_t>(), 1, of_sampler + ".input");
    const int width = channel.target == MotionChannel::Target::rotation ? 4 : 3;
    channel.values = read_numbers(file_, sampler["output"].get<size_t>(), width, of_sampler + ".output");
    keys_ += channel.times.size();
    if (channel.times.size() > max_keys || keys_ > max_all_keys)
      file_.fail(of_sampler + ".input", "has more than " + std::to_string(max_keys) +
                                            " keys, or all channels together more than " +
                                            std::to_string(max_all_keys));
    for (size_t k = 1; k < channel.times.size(); ++k)
      if (!(channel.times[k] > channel.times[k - 1]))
        file_.fail(of_sampler + ".input", "its times do not increase at key " + std::to_string(k));
    const size_t per_key = channel.interpolation == MotionChannel::Interpolation::cubic ? 3 : 1;
    const size_t wanted = channel.times.size() * per_key * static_cast<size_t>(width);
    if (channel.times.empty() || channel.values.size() != wanted)
      file_.fail(of_sampler + ".output",
                 "has " + std::to_string(channel.values.size() / static_cast<size_t>(width)) +
                     " elements, expected " + std::to_string(channel.times.size() * per_key));
    return channel;
  }

  File& file_;
  const std::vector<PlacedNode>& nodes_;
  std::vector<int> parents_;
  std::vector<std::vector<PlayedChannel>> channels_;  // by node
  size_t keys_ = 0;                                   // read so far
  std::vector<char> moves_;                           // by node: it, or one above it
};

bool has_volume(const glm::dmat4& world) {
  const double volume = glm::determinant(glm::dmat3(world));
  return volume != 0 && std::isfinite(volume);
}

// Where the node is when the motion begins, or when it first has a volume.
glm::dmat4 first_transform(const NodeMotions& motions, size_t node) {
  const glm::dmat4 begin = motions.world(node, motions.begin());
  if (has_volume(begin)) return begin;
  for (double time : sample_times(motions, node, 7))
    if (const glm::dmat4 world = motions.world(node, time); has_volume(world)) return world;
  return begin;
}

}  // namespace

Movement load_movement(File& file, std::vector<PlacedNode>& nodes) {
  Movement movement = MovementLoader(file, nodes).load();
  if (!movement.motions) return movement;
  for (PlacedNode& placed : nodes)
    if (const int index = movement.of(placed.node);
        index >= 0 && movement.motions->moves(static_cast<size_t>(index)))
      placed.world = first_transform(*movement.motions, static_cast<size_t>(index));
  return movement;
}

}  // namespace ml::gltf
