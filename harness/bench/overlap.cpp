#include "harness/bench/overlap.h"

#include "harness/measure/statistics.h"

namespace ml {
namespace {

constexpr const char* never_together = "list building and shadow maps were not seen to run at the same time";

std::string obstacle(const gpu::Device& device, const ShadingSpec& shading, const AlgorithmInfo& algorithm,
                     const MeasureSpec& measure) {
  if (shading.list_queue == ListQueue::graphics) return "shading.list_queue is graphics";
  if (!algorithm.builds_on_gpu()) return algorithm.name + " builds no lists on the device";
  if (device.info().second_queue == gpu::SecondQueue::none)
    return "the device has one queue: the same submissions went to it, one after the other";
  if (shading.shadow_maps == 0) return "shading.shadow_maps is 0: there is no other work";
  if (measure.mode == TimingMode::whole) return "measure.mode is whole: passes are not timed";
  if (device.limits().timestamp_valid_bits == 0) return "the device's queue has no timestamps";
  if (device.limits().second_timestamp_valid_bits == 0) return "the device's second queue has no timestamps";
  return "";
}

}  // namespace

OverlapResult expected_overlap(const gpu::Device& device, const ShadingSpec& shading,
                               const AlgorithmInfo& algorithm, const MeasureSpec& measure, uint32_t frames) {
  OverlapResult overlap;
  if (shading.list_queue == ListQueue::compute) overlap.list_queue = "compute";
  overlap.note = obstacle(device, shading, algorithm, measure);
  overlap.ms = SampleTable(measure.repeats, frames);
  return overlap;
}

void add_overlap(OverlapResult& overlap, const gpu::SubmissionTimes& times, uint32_t repeat, uint32_t frame) {
  bool both = false;
  for (const gpu::SubmissionTimes::Interval& interval : times.intervals) both |= interval.second_queue;
  if (both) overlap.ms.set("both", repeat, frame, times.both_queues);
}

void settle_overlap(OverlapResult& overlap, uint32_t repeats) {
  if (!overlap.note.empty() && overlap.note != never_together) return;
  const std::vector<double> samples = overlap.ms.first(repeats).all("both");
  // A single sample above 0 may be a hiccup; what the case is about happens in most of them.
  overlap.overlapped = !samples.empty() && median(samples) > 0;
  overlap.note = overlap.overlapped ? "" : never_together;
}

}  // namespace ml
