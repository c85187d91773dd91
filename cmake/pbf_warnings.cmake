# pbf_warnings: the warnings our own targets are built with. Linked privately, so users never inherit it.
add_library(pbf_warnings INTERFACE)
target_compile_options(pbf_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wcast-qual -Woverloaded-virtual
  $<$<BOOL:${PBF_WERROR}>:-Werror>)
