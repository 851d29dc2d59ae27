#include "scenes/wanted.h"

#include <charconv>

#include "harness/base/error.h"
#include "harness/lights/set.h"
#include "scenes/members.h"

namespace ml {
namespace {

constexpr double kLargest = 1e9;
constexpr uint32_t kMaxSeeds = 100, kMaxLights = 1048576;
constexpr size_t kMaxItems = 1000, kMaxLetters = 100;

Range read_range(const Node& node) {
  node.list(2, 2);
  Range range;
  if (!node.item(0).json().is_null()) range.low = node.item(0).real(-kLargest, kLargest);
  if (!node.item(1).json().is_null()) range.high = node.item(1).real(-kLargest, kLargest);
  if (range.low > range.high) node.fail("the range's end lies before its begin");
  return range;
}

void read_range(Members& members, const std::string& key, Range& range) {
  if (auto node = members.find(key)) range = read_range(*node);
}

std::map<std::string, Range> read_ranges(const Node& node) {
  node.object();
  std::map<std::string, Range> ranges;
  for (const auto& [key, value] : node.json().items()) ranges[key] = read_range(node.member(key));
  return ranges;
}

uint32_t read_hash(const Node& node) {
  const std::string digits = node.text(8, 8);
  uint32_t hash = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), hash, 16);
  if (read.ec != std::errc() || read.ptr != digits.data() + digits.size())
    node.expected("8 hexadecimal digits");
  return hash;
}

WantedView read_view(const Node& node) {
  Members members(node);
  WantedView view;
  view.name = members.get("name").text(1, kMaxLetters);
  view.path = members.get("path").text(1, kMaxLetters);
  view.time = members.get("time").real(0, kLargest);
  view.depth_p95 = read_range(members.get("depth_p95"));
  members.expect_no_others();
  return view;
}

WantedFrames read_frames(const Node& node) {
  Members members(node);
  WantedFrames frames;
  frames.path = members.get("path").text(1, kMaxLetters);
  frames.depth_p95 = read_range(members.get("depth_p95"));
  frames.share = read_range(members.get("share"));
  members.expect_no_others();
  return frames;
}

WantedLights read_lights(const Node& node) {
  Members members(node);
  WantedLights lights;
  lights.count = members.get("count").unsigned_integer(1, kMaxLights);
  if (auto placement = members.find("placement"))
    lights.placement = static_cast<Placement>(placement->choice(placement_names()));
  if (auto seeds = members.find("seeds")) lights.seeds = seeds->unsigned_integer(1, kMaxSeeds);
  read_range(members, "mean", lights.mean);
  read_range(members, "most", lights.max);
  read_range(members, "base_size", lights.base_size);
  read_range(members, "radius", lights.radius);
  members.expect_no_others();
  return lights;
}

template <typename Item>
void read_list(Members& members, const std::string& key, Item (*read)(const Node&),
               std::vector<Item>& items) {
  auto node = members.find(key);
  if (!node) return;
  const size_t count = node->list(1, kMaxItems);
  for (size_t i = 0; i < count; ++i) items.push_back(read(node->item(i)));
}

}  // namespace

const Range& Wanted::number(const std::string& name) const {
  if (auto found = numbers.find(name); found != numbers.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [key, range] : numbers) known.push_back(key);
  throw UsageError("wanted numbers: '" + name + "' is not among them" + suggestion(name, known));
}

Wanted read_wanted(const Node& node) {
  Members members(node);
  Wanted wanted;
  wanted.hash = read_hash(members.get("hash"));
  if (auto differs = members.find("differs_by_seed")) wanted.differs_by_seed = differs->boolean();
  wanted.triangles = read_range(members.get("triangles"));
  read_range(members, "size_x", wanted.size_x);
  read_range(members, "size_y", wanted.size_y);
  read_range(members, "size_z", wanted.size_z);
  read_range(members, "metals", wanted.metals);
  read_range(members, "roughnesses", wanted.roughnesses);
  if (auto depths = members.find("median_depth")) wanted.median_depth = read_ranges(*depths);
  read_list(members, "views", read_view, wanted.views);
  read_list(members, "frames", read_frames, wanted.frames);
  read_list(members, "lights", read_lights, wanted.lights);
  if (auto numbers = members.find("numbers")) wanted.numbers = read_ranges(*numbers);
  members.expect_no_others();
  return wanted;
}

}  // namespace ml
