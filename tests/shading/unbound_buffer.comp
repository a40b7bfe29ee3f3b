// A shader that the validation layer must refuse: binding 7 is in no layout.
#version 460
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 7) buffer Unbound { float values[]; };

void main() { values[gl_GlobalInvocationID.x] = 1.0; }
