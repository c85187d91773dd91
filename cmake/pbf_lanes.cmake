# Contraction to FMA would give other bits on other instruction sets. The two other flags change no value: they
# let the square root be one instruction.
set(PBF_FLOAT_OPTIONS -ffp-contract=off -fno-math-errno -fno-trapping-math)

# The instruction sets of core/isa.hpp.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(PBF_ISAS x86_64 x86_64_v2 x86_64_v3 x86_64_v4)
else()
  set(PBF_ISAS baseline)
endif()

# pbf_add_lanes(TARGET SOURCE…): adds to TARGET the sources, which include core/lanes.hpp, compiled once for each
# of PBF_ISAS. The objects of one are the target TARGET_lanes_ISA.
function(pbf_add_lanes target)
  foreach(isa IN LISTS PBF_ISAS)
    set(lanes ${target}_lanes_${isa})
    add_library(${lanes} OBJECT ${ARGN})
    target_include_directories(${lanes} PRIVATE ${PROJECT_SOURCE_DIR}/cpp)
    target_compile_features(${lanes} PRIVATE cxx_std_20)
    target_compile_definitions(${lanes} PRIVATE PBF_ISA_NAMESPACE=${isa})
    # Optimized in debug builds as well: unoptimized, vectors are a hundred times slower than numbers.
    target_compile_options(${lanes} PRIVATE ${PBF_FLOAT_OPTIONS} -O3)
    if(NOT isa STREQUAL "baseline")
      string(REPLACE "_v" "-v" march ${isa})
      string(REPLACE "x86_64" "x86-64" march ${march})
      target_compile_options(${lanes} PRIVATE -march=${march})
    endif()
    target_link_libraries(${lanes} PRIVATE pbf_warnings)
    # GCC 12 warns of its own AVX-512 header (its bug 105593).
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND isa STREQUAL "x86_64_v4")
      target_compile_options(${lanes} PRIVATE -Wno-maybe-uninitialized -Wno-uninitialized)
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${lanes}>)
  endforeach()
endfunction()
