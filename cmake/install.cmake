# SPDX-License-Identifier: MIT
#
# Install rules. Without the component compiled the package is headers only, hence independent of the
# architecture.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/slant")

install(TARGETS slant EXPORT slant FILE_SET HEADERS)
install(EXPORT slant NAMESPACE slant:: FILE slant-targets.cmake DESTINATION "${package_dir}")

# One export per component: a client that does not ask for one does not need its dependency.
foreach(component IN LISTS slant_components)
  if(component STREQUAL "compiled")
    install(TARGETS slant_compiled EXPORT slant-compiled)
  else()
    install(TARGETS slant_${component} EXPORT slant-${component} FILE_SET HEADERS)
  endif()
  install(EXPORT slant-${component} NAMESPACE slant:: FILE slant-${component}-targets.cmake
          DESTINATION "${package_dir}")
endforeach()

configure_package_config_file(cmake/slantConfig.cmake.in slantConfig.cmake
                              INSTALL_DESTINATION "${package_dir}")
if(SLANT_COMPILED)
  set(any_architecture "")
else()
  set(any_architecture ARCH_INDEPENDENT)
endif()
write_basic_package_version_file(slantConfigVersion.cmake COMPATIBILITY SameMinorVersion
                                 ${any_architecture})
install(FILES "${PROJECT_BINARY_DIR}/slantConfig.cmake"
              "${PROJECT_BINARY_DIR}/slantConfigVersion.cmake" cmake/FindCHOLMOD.cmake
        DESTINATION "${package_dir}")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
