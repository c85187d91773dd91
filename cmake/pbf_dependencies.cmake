# One block per dependency: where it is looked for, and what to type when it is missing.

# Eigen: the system's, conda's or vcpkg's; else the headers that the build requirement cmeel-eigen brings, which
# lie in a prefix of their own below site-packages. No version is asked of find_package: Eigen's own version file
# would turn 5.x away for a request of 3.4.
find_package(Eigen3 NO_MODULE QUIET)
if(NOT TARGET Eigen3::Eigen)
  foreach(prefix IN LISTS CMAKE_PREFIX_PATH)
    if(NOT TARGET Eigen3::Eigen AND EXISTS "${prefix}/cmeel.prefix/share/eigen3/cmake/Eigen3Config.cmake")
      find_package(Eigen3 NO_MODULE QUIET PATHS "${prefix}/cmeel.prefix" NO_DEFAULT_PATH)
    endif()
  endforeach()
endif()
if(NOT TARGET Eigen3::Eigen)
  message(FATAL_ERROR "Eigen was not found. Any one of these brings it:\n"
                      "  apt-get install libeigen3-dev\n  conda install eigen\n  pip install cmeel-eigen")
endif()
if(Eigen3_VERSION AND Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "Eigen ${Eigen3_VERSION} in ${Eigen3_DIR} is too old: 3.4 or newer is needed.")
endif()

find_package(OpenMP COMPONENTS CXX QUIET)
if(NOT OpenMP_CXX_FOUND)
  message(FATAL_ERROR "The C++ compiler has no OpenMP (apt-get install g++, or libomp-dev for clang).")
endif()

if(PBF_BUILD_TESTS)
  find_package(doctest QUIET)
  if(NOT doctest_FOUND)
    message(FATAL_ERROR "doctest was not found: apt-get install doctest-dev, or set PBF_BUILD_TESTS=OFF.")
  endif()
endif()

if(PBF_BUILD_BENCH)
  find_package(benchmark QUIET)
  if(NOT benchmark_FOUND)
    message(FATAL_ERROR "Google Benchmark was not found: apt-get install libbenchmark-dev, or PBF_BUILD_BENCH=OFF.")
  endif()
endif()

if(PBF_BUILD_PYTHON)
  find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 3.0 CONFIG REQUIRED)
endif()
