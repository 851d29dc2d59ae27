# GLSL to SPIR-V to C++: every module is compiled for Vulkan 1.3, checked with spirv-val, and put into the program as an array.

find_program(GLSLANG glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# ml_shader(TARGET SYMBOL SOURCE [STAGE stage] [INCLUDE folders] [DEFINES names]): makes SYMBOL available to TARGET by
# #include "spirv/SYMBOL.h", an array `SYMBOL` of uint32_t in namespace-less static storage. STAGE where the
# file's ending is not the stage (comp, frag).
function(ml_shader target symbol source)
  cmake_parse_arguments(shader "" "STAGE" "INCLUDE;DEFINES" ${ARGN})
  if(shader_STAGE)
    set(stage -S ${shader_STAGE})
  endif()
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
    # The depfile speaks of the module: without it among the outputs every build would make everything anew.
    OUTPUT ${module} ${header}
    COMMAND ${GLSLANG} --quiet --target-env vulkan1.3 ${stage} ${includes} ${shader_DEFINES} --depfile ${module}.d -o ${module} ${source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout ${module}
    COMMAND ${CMAKE_COMMAND} -DMODULE=${module} -DSYMBOL=${symbol} -DHEADER=${header} -P ${CMAKE_SOURCE_DIR}/cmake/EmbedSpirv.cmake
    DEPENDS ${source} ${CMAKE_SOURCE_DIR}/cmake/EmbedSpirv.cmake
    DEPFILE ${module}.d
    COMMENT "Shader ${symbol}"
    VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${folder})
endfunction()

# ml_shading_programs(TARGET NAME FOLDER [SUFFIX suffix] [DEFINES names]): the shading loop with the light cursor of FOLDER: arrays NAME_shade and
# NAME_forward (the forward pass), and the same with _counting, for TARGET.
function(ml_shading_programs target name folder)
  cmake_parse_arguments(loop "" "SUFFIX" "DEFINES" ${ARGN})
  set(source ${CMAKE_SOURCE_DIR}/shaders/shade.comp)
  set(shade ${name}_shade${loop_SUFFIX})
  set(forward ${name}_forward${loop_SUFFIX})
  ml_shader(${target} ${shade} ${source} INCLUDE ${folder} DEFINES ${loop_DEFINES})
  ml_shader(${target} ${shade}_counting ${source} INCLUDE ${folder} DEFINES COUNTING ${loop_DEFINES})
  ml_shader(${target} ${forward} ${source} STAGE frag INCLUDE ${folder} DEFINES FORWARD ${loop_DEFINES})
  ml_shader(${target} ${forward}_counting ${source} STAGE frag INCLUDE ${folder} DEFINES FORWARD COUNTING ${loop_DEFINES})
endfunction()
