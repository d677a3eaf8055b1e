# `core` and `planner` for other projects: find_package(nanomap), link nanomap::core.
include(CMakePackageConfigHelpers)
install(TARGETS nanomap_core nanomap_planner EXPORT nanomapTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY "${PROJECT_SOURCE_DIR}/core" "${PROJECT_SOURCE_DIR}/planner"
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nanomap FILES_MATCHING PATTERN "*.h")
install(EXPORT nanomapTargets NAMESPACE nanomap:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nanomap)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/nanomapConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/nanomapConfig.cmake" INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nanomap)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/nanomapConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/nanomapConfig.cmake" "${PROJECT_BINARY_DIR}/nanomapConfigVersion.cmake"
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/nanomap)
