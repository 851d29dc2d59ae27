# GLSL to SPIR-V to C++: every module is compiled for Vulkan 1.3, checked with spirv-val, and put into the program as an array.

find_program(GLSLANG glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# ml_shader(TARGET SYMBOL SOURCE [INCLUDE folders] [DEFINES names]): makes SYMBOL available to TARGET by
# #include "spirv/SYMBOL.h", an array `SYMBOL` of uint32_t in namespace-less static storage.
function(ml_shader target symbol source)
  cmake_parse_arguments(shader "" "" "INCLUDE;DEFINES" ${ARGN})
  get_filename_component(source ${source} ABSOLUTE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated/${target})
  set(module ${folder}/spirv/${symbol}.spv)
  set(header ${folder}/spirv/${symbol}.h)
  set(includes -I${CMAKE_SOURCE_DIR})
  foreach(include ${shader_INCLUDE})
    list(APPEND includes -I${include})
  endforeach()
  list(TRANSFORM shader_DEFINES PREPEND -D)
  file(MAKE_DIRECTORY ${folder}/spirv)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${GLSLANG} --quiet --target-env vulkan1.3 ${includes} ${shader_DEFINES} --depfile ${module}.d -o ${module} ${source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout ${module}
    COMMAND ${CMAKE_COMMAND} -DMODULE=${module} -DSYMBOL=${symbol} -DHEADER=${header} -P ${CMAKE_SOURCE_DIR}/cmake/EmbedSpirv.cmake
    DEPENDS ${source} ${CMAKE_SOURCE_DIR}/cmake/EmbedSpirv.cmake
    DEPFILE ${module}.d
    COMMENT "Shader ${symbol}"
    VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
