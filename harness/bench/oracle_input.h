// The loaded frame as the double-precision oracle takes it: points from the g-buffer, lights as the device
// has them.
#pragma once

#include <vector>

#include "harness/accuracy/oracle.h"
#include "harness/frame/device_frame.h"

namespace ml {

class OracleFrame {
 public:
  OracleFrame(DeviceFrame& frame, const FrameInput& input);
  // The surface point of a pixel (row by row); only for lit pixels.
  SurfacePoint point(size_t pixel) const;
  const std::vector<OracleLight>& lights() const { return lights_; }

 private:
  std::vector<float> position_, normal_, albedo_, material_,
      emission_;  // four floats a pixel; the last may be empty
  std::vector<OracleLight> lights_;
  glm::dvec3 view_direction_{0};  // towards the eye; zero for perspective
};

}  // namespace ml
