// SIGINT and SIGTERM become a flag that long work looks at between its steps, so that what was measured is
// kept.
#pragma once

namespace ml {

// Installs the handlers; a second signal ends the program at once.
void watch_for_interruption();
bool interrupted();
// Throws Interrupted when a signal came.
void stop_if_interrupted();

}  // namespace ml
