# What `cmake --install` puts down for find_package(elastolab): the libraries below the viewer, their headers and targets
# (docs/library.md). Component "development".
include(CMakePackageConfigHelpers)
set(library_layers base mesh elasticity deform fem bem findings methods scene)
set(library_packages eigen lapack openmp xsimd cholmod json)
list(TRANSFORM library_layers PREPEND elastolab_ OUTPUT_VARIABLE layer_targets)
list(TRANSFORM library_packages PREPEND third_party_ OUTPUT_VARIABLE package_targets)

foreach(layer IN LISTS library_layers)
  set_target_properties(elastolab_${layer} PROPERTIES EXPORT_NAME ${layer})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/${layer} DESTINATION include/elastolab COMPONENT development
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
set_target_properties(elastolab_options PROPERTIES EXPORT_NAME options)
install(TARGETS elastolab_options ${layer_targets} ${package_targets} EXPORT elastolab
        ARCHIVE DESTINATION lib COMPONENT development)
install(EXPORT elastolab NAMESPACE elastolab:: FILE elastolab-targets.cmake DESTINATION lib/cmake/elastolab
        COMPONENT development)

write_basic_package_version_file(${PROJECT_BINARY_DIR}/elastolab-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/elastolab-config.cmake ${PROJECT_BINARY_DIR}/elastolab-config-version.cmake
        DESTINATION lib/cmake/elastolab COMPONENT development)
