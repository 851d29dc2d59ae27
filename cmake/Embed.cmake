# Text files that travel inside the program.

# ml_embed_text(TARGET SYMBOL FILE): makes FILE's bytes available to TARGET by #include "embedded/SYMBOL.h", as the
# std::string_view `SYMBOL` outside any namespace. TARGET must exist and have sources of its own.
function(ml_embed_text target symbol file)
  get_filename_component(file ${file} ABSOLUTE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated/${target})
  set(header ${folder}/embedded/${symbol}.h)
  file(MAKE_DIRECTORY ${folder}/embedded)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -DTEXT=${file} -DSYMBOL=${symbol} -DHEADER=${header} -P ${CMAKE_SOURCE_DIR}/cmake/EmbedText.cmake
    DEPENDS ${file} ${CMAKE_SOURCE_DIR}/cmake/EmbedText.cmake
    COMMENT "Text ${symbol}"
    VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
