// What became of the lights that a level brings, or that a placement made: nothing leaves in silence.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/scene/light.h"

namespace ml {

// total == used + dark + rejected() + left_out.
struct LightAccount {
  bool of_file = false;  // the file's own lights (placement `gltf`), else lights that a placement made
  uint32_t total = 0;    // in the file, whatever they are, or asked of the placement
  uint32_t used = 0;     // LightSet::base()
  uint32_t dark = 0;     // intensity 0 in every channel: they could light nothing, and no algorithm sees them
  Rejections rejections;
  // Lights of the file, in its order after the first `limit`, that were not looked at.
  uint32_t left_out = 0;
  uint32_t limit = 0;           // lights that were let in at most; 0: all
  bool limit_is_given = false;  // `limit` is the configuration's lights.count, else the bench's own bound

  uint32_t rejected() const;
};

// What a user is shown, one line each:
//   lights: 537 in the file, 510 used, 1 dark, 1 rejected (radius is 0: 1), 25 left out
//   25 of the file's 537 lights are left out by lights.count=512
// The second line is there where any are left out; placed lights are "made" instead of "in the file".
std::vector<std::string> account_lines(const LightAccount& account);

}  // namespace ml
