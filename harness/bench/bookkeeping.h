// What a level brings, asks for and shows, and what of it is used: `run`, `render` and `verify` tell it in
// the same words, and a result holds it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/bench/workload.h"
#include "harness/output/result.h"

namespace ml {

// Into each case of the setup: where its lights went, and the notes of its scene.
void keep_books(const Workload& workload, CaseResult& result);

// Prints to stderr, each line after the level's name: where the lights went; what the level asks for and
// does not get; and in how many of `frames` frames no surface is seen, where there are any.
void tell_books(const Setup& setup, const Workload& workload, uint32_t unseen, uint32_t frames);

// UsageError when none of the frames sees a surface: there is nothing to measure or to prove.
void require_surface(const Setup& setup, uint32_t unseen, uint32_t frames);

}  // namespace ml
