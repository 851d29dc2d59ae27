// How the nodes of a level move: the animation of a file, evaluated where a frame needs it.
//
// One clock for everything that moves, cameras too: it runs from the first key of any node to the last one,
// and the frames of a run are spread over it evenly, the first at its begin and the last at its end. Before
// its first key and after its last one a node stands as in that key (glTF 2.0, section 3.11).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace ml {

struct Pose {
  glm::dvec3 translation{0};
  glm::dvec4 rotation{0, 0, 0, 1};  // unit quaternion x, y, z, w
  glm::dvec3 scale{1};
};
glm::dmat4 matrix_of(const Pose& pose);

struct MotionChannel {
  enum class Target { translation, rotation, scale };
  enum class Interpolation { linear, step, cubic };
  Target target = Target::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times;  // s, increasing, at least one
  // 3 numbers a key, 4 of a rotation; a cubic key has its in-tangent, its value and its out-tangent.
  std::vector<double> values;

  // The value, in the first 3 components but for rotations; those have unit length.
  glm::dvec4 at(double time) const;
};

struct MotionNode {
  int parent = -1;      // of a smaller index, or -1
  glm::dmat4 local{1};  // where nothing moves the node itself
  Pose rest;            // what channels replace parts of
  std::vector<MotionChannel> channels;
};

class NodeMotions {
 public:
  // Parents come before their children. Returns the node's index.
  size_t add(MotionNode node);

  double begin() const { return begin_; }  // s
  double end() const { return end_; }
  double duration() const { return end_ - begin_; }
  // Of frame `frame` of `frames`; exactly a key's time where that falls on a frame.
  double time_of(uint32_t frame, uint32_t frames) const;

  // Whether the node or one above it is animated.
  bool moves(size_t node) const { return nodes_[node].moves; }
  glm::dmat4 world(size_t node, double time) const;
  // Whether a key of STEP interpolation in (after, until] moves the node all at once.
  bool jumps(size_t node, double after, double until) const;
  // Adds the times of all keys of the node and those above it; not sorted.
  void add_times(size_t node, std::vector<double>& times) const;

 private:
  struct Entry {
    MotionNode node;
    bool moves = false;
  };
  std::vector<Entry> nodes_;
  bool timed_ = false;  // whether there is any key
  double begin_ = 0, end_ = 0;
};

// Times over a node's motion, for what has to hold all along it (bounds, the reach of a camera): all keys,
// and `between` times between each two, at most a few thousand. Ascending.
std::vector<double> sample_times(const NodeMotions& motions, size_t node, uint32_t between);

}  // namespace ml
