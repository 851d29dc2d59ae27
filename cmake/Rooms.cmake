# One static library per room (folder), with the project's warnings; sources are found, so that a new file needs no line here.

add_library(ml_flags INTERFACE)
target_include_directories(ml_flags INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(ml_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(MANYLIGHTS_WERROR)
  target_compile_options(ml_flags INTERFACE -Werror)
endif()
# GCC 12 warns of overlapping copies inside its own std::string (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(ml_flags INTERFACE -Wno-restrict)
endif()
# The same bits on every machine: no contraction of a*b+c that the source does not ask for.
target_compile_options(ml_flags INTERFACE -ffp-contract=off)
target_compile_definitions(ml_flags INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL)
if(MANYLIGHTS_SANITIZE)
  target_compile_options(ml_flags INTERFACE -fsanitize=${MANYLIGHTS_SANITIZE} -fno-omit-frame-pointer
                                            -fno-sanitize-recover=all)
  target_link_options(ml_flags INTERFACE -fsanitize=${MANYLIGHTS_SANITIZE})
endif()
# The fuzzers see into the libraries, not only into themselves.
if(MANYLIGHTS_FUZZ)
  target_compile_options(ml_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(ml_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Headers of Debian's packages are system headers: their warnings are not ours.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)

# ml_room(NAME [DEPENDS rooms and libraries]): library ml_NAME of every .cpp in the calling folder.
function(ml_room name)
  cmake_parse_arguments(room "" "" "DEPENDS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(sources)
    add_library(ml_${name} STATIC ${sources})
    target_link_libraries(ml_${name} PUBLIC ml_flags ${room_DEPENDS})
  else()
    add_library(ml_${name} INTERFACE)
    target_link_libraries(ml_${name} INTERFACE ml_flags ${room_DEPENDS})
  endif()
endfunction()
