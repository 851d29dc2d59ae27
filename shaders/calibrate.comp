// Work of a known amount, for checking the timers: every thread iterates `steps` times.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { uint steps; };
layout(scalar, binding = 0) writeonly buffer Sink { uint sink[]; };

void main() {
  uint value = gl_GlobalInvocationID.x;
  for (uint i = 0u; i < steps; ++i) value = value * 1664525u + 1013904223u;
  sink[gl_GlobalInvocationID.x] = value;
}
