# pbf_embed_glsl(target file…): puts the files of glsl/ into the target as text, so that shaders
# need no install path. Editing one rebuilds one small source file.
function(pbf_embed_glsl target)
  set(folder "${PROJECT_SOURCE_DIR}/glsl")
  set(script "${PROJECT_SOURCE_DIR}/cmake/pbf_embed_glsl_script.cmake")
  set(output "${CMAKE_CURRENT_BINARY_DIR}/glsl_embedded.cpp")
  list(TRANSFORM ARGN PREPEND "${folder}/" OUTPUT_VARIABLE paths)
  add_custom_command(
    OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DFILES=${paths}" -P "${script}"
    DEPENDS ${paths} "${script}"
    COMMENT "Embedding the shaders" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
