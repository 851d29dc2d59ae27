// The sub-commands. Each registers its options with the parser and leaves behind what to do when it is
// called.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "harness/base/error.h"

namespace ml {

// What to do, set by the sub-command that was given.
using Action = std::function<ExitCode()>;

void add_list(CLI::App& app, Action& action);
void add_run(CLI::App& app, Action& action);
void add_verify(CLI::App& app, Action& action);
void add_render(CLI::App& app, Action& action);
void add_scene(CLI::App& app, Action& action);
void add_doctor(CLI::App& app, Action& action);

}  // namespace ml
