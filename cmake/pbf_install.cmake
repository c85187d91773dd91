# pbf_install: what `cmake --install` gives: headers, the static libraries and a package that
#   find_package(pbfluids 0.1 REQUIRED)   →   pbfluids::core, pbfluids::sim, pbfluids::render
# finds. Headers lie beside their sources, so they are picked by suffix.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(PBF_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/pbfluids)
set(PBF_ROOMS core kernels neighbors boundary fluid scene)
set(PBF_LIBRARIES pbf_core pbf_sim)
if(TARGET pbf_render)
  list(APPEND PBF_ROOMS gl render)
  list(APPEND PBF_LIBRARIES pbf_render)
endif()

install(TARGETS ${PBF_LIBRARIES} EXPORT pbfluidsTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(room IN LISTS PBF_ROOMS)
  install(DIRECTORY cpp/pbf/${room} DESTINATION include/pbf
          FILES_MATCHING PATTERN "*.hpp" PATTERN "*.inl")
endforeach()
install(EXPORT pbfluidsTargets NAMESPACE pbfluids:: DESTINATION ${PBF_PACKAGE_DIR})

configure_package_config_file(cmake/pbfluidsConfig.cmake.in pbfluidsConfig.cmake
                              INSTALL_DESTINATION ${PBF_PACKAGE_DIR})
write_basic_package_version_file(pbfluidsConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pbfluidsConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/pbfluidsConfigVersion.cmake
        DESTINATION ${PBF_PACKAGE_DIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/pbfluids)
