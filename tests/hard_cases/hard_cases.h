// Tests named after the cases that real renderers got wrong: each builds the case and expects everything that
// Exactness checks.
#pragma once

#include "tests/support/exactness.h"
#include "tests/support/hand_made_scene.h"

namespace ml::test {

class HardCases : public DeviceTest {};

}  // namespace ml::test
