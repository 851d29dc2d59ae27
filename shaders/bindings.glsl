// Binding numbers of the shared resources. The C++ side binds by name, found by reflection; algorithms use 16 to 23.
#ifndef ML_BINDINGS_GLSL
#define ML_BINDINGS_GLSL
#extension GL_EXT_scalar_block_layout : require

#define BIND_VIEW 0
#define BIND_DEPTH 1
#define BIND_SURFACE 2
#define BIND_LIGHTS 3
#define BIND_EXTRAS 4
#define BIND_RESULT 5
#define BIND_BLOCKS 6
#define BIND_LISTED 7
#define BIND_TESTED 8
#define BIND_CONTRIBUTING 9
#define BIND_NODES 10
#define BIND_HASH 11
#define BIND_TRAVERSAL 12
#define BIND_FORWARD 13
#define BIND_BASE_COLOR 14
#define BIND_SPECULAR 15
#define BIND_EMISSION 24            // light that surfaces give by themselves
#define BIND_DETAILS 25             // of vertices
#define BIND_METALLIC_ROUGHNESS 26  // textures of the mesh that is drawn
#define BIND_NORMAL_MAP 27
#define BIND_EMISSION_MAP 28
// Added to a buffer's number: the same buffer as texels of four words, bound by its name with "Quads" appended.
#define BIND_QUADS 32
#define BIND_DIFFUSE 16  // of a pass that has no algorithm in it

#endif
