// Whether a case's lists were built beside other work.
#pragma once

#include <string>

#include "harness/config/config.h"
#include "harness/gpu/commands.h"
#include "harness/output/result.h"

namespace ml {

// Of a case before it is measured: where its lists are built, and in `note` what stands against an overlap or
// against seeing one; empty when nothing does.
OverlapResult expected_overlap(const gpu::Device& device, const ShadingSpec& shading,
                               const AlgorithmInfo& algorithm, const MeasureSpec& measure, uint32_t frames);

// Adds a sample.
void add_overlap(OverlapResult& overlap, const gpu::SubmissionTimes& times, uint32_t repeat, uint32_t frame);

// `overlapped` and `note` by the first `repeats` laps.
void settle_overlap(OverlapResult& overlap, uint32_t repeats);

}  // namespace ml
