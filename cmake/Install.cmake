# SPDX-License-Identifier: Apache-2.0
# Two components: "runtime" (the program) and "development" (libraries, headers, package config).
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cslam)

install(TARGETS changing_slam RUNTIME COMPONENT runtime)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/changing-slam
        COMPONENT runtime)
install(PROGRAMS tools/convert_model.py tools/install_model.py
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/changing-slam COMPONENT runtime)
install(FILES tools/onnx_rewrite.py tools/tfjs_model.py
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/changing-slam COMPONENT runtime)

get_property(layer_targets GLOBAL PROPERTY CSLAM_LAYER_TARGETS)
install(TARGETS ${layer_targets} EXPORT cslam-targets ARCHIVE COMPONENT development)
install(DIRECTORY src/cslam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.h" PATTERN "test_*.h" EXCLUDE)
install(EXPORT cslam-targets NAMESPACE cslam:: DESTINATION ${config_dir} COMPONENT development)

configure_package_config_file(cmake/cslam-config.cmake.in cslam-config.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(cslam-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cslam-config.cmake
              ${PROJECT_BINARY_DIR}/cslam-config-version.cmake
        DESTINATION ${config_dir} COMPONENT development)

# "cpack -G DEB" in the build folder makes changing-slam_*.deb and libcslam-dev_*.deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME changing-slam)
set(CPACK_PACKAGE_VENDOR "The Changing-SLAM authors")
set(CPACK_PACKAGE_CONTACT "The Changing-SLAM authors <changing-slam@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME changing-slam)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "python3, python3-onnx, python3-numpy")  # model install
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcslam-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libopencv-dev, libeigen3-dev, libceres-dev, libfmt-dev, libspdlog-dev, libyaml-cpp-dev, \
nlohmann-json3-dev, libembree-dev, libturbojpeg0-dev, libpng-dev, zlib1g-dev, libsqlite3-dev, \
pkg-config")
include(CPack)
