#include "harness/frame/own_images.h"

namespace ml {

OwnImages::OwnImages(std::vector<OwnImage> declared, const std::vector<CounterInfo>& counters,
                     std::string algorithm)
    : algorithm_(std::move(algorithm)) {
  for (OwnImage& info : declared) {
    std::string before = info.name + "Before";
    images_.push_back({std::move(info), std::move(before), {}});
  }
  for (const CounterInfo& counter : counters)
    if (counter.per_pixel) counters_.emplace_back(counter.name, nullptr);
}

void OwnImages::follow(Step step) {
  if (step == Step::next) current_ ^= 1;
  if (step == Step::first) begins_ = true;
}

void OwnImages::make(DeviceFrame& frame, bool counting) {
  const uint32_t width = frame.targets().width(), height = frame.targets().height();
  if (width != width_ || height != height_) {
    for (Kept& kept : images_) kept.two = {};
    for (auto& [name, image] : counters_) image = nullptr;
    begins_ = true;
    width_ = width;
    height_ = height;
  }
  const auto made = [&](const std::string& name, gpu::Format format) {
    return std::make_unique<gpu::Image>(frame.device(), width, height, format, gpu::ImageUse::storage,
                                        algorithm_ + ": " + name);
  };
  for (Kept& kept : images_)
    for (size_t i = 0; i < (kept.info.history ? 2u : 1u); ++i)
      if (!kept.two[i]) kept.two[i] = made(kept.info.name, kept.info.format);
  for (auto& [name, image] : counters_)
    if (counting && !image) image = made(name, gpu::Format::r32_uint);
}

void OwnImages::bind(DeviceFrame& frame, bool counting, gpu::Bindings& list) {
  make(frame, counting);
  gpu::Commands& commands = frame.commands();
  for (const Kept& kept : images_) {
    if (begins_ && kept.info.history)
      for (const auto& image : kept.two) commands.clear(*image);
    const uint32_t now = kept.info.history ? current_ : 0;
    list.emplace_back(kept.info.name, *kept.two[now]);
    if (kept.info.history) list.emplace_back(kept.before, *kept.two[now ^ 1]);
  }
  begins_ = false;
  if (!counting) return;
  for (const auto& [name, image] : counters_) {
    commands.clear(*image);
    list.emplace_back(name, *image);
  }
}

std::map<std::string, std::vector<uint32_t>> OwnImages::read_counters(DeviceFrame& frame) const {
  std::map<std::string, std::vector<uint32_t>> counts;
  for (const auto& [name, image] : counters_)
    if (image) counts[name] = frame.read_words(*image);
  return counts;
}

const gpu::Image* OwnImages::find(const std::string& name) const {
  for (const Kept& kept : images_)
    if (kept.info.name == name) return kept.two[kept.info.history ? current_ : 0].get();
  return nullptr;
}

uint64_t OwnImages::bytes() const {
  uint64_t sum = 0;
  for (const Kept& kept : images_)
    for (const auto& image : kept.two)
      if (image) sum += image->bytes();
  return sum;
}

}  // namespace ml
