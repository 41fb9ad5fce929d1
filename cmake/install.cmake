include(CMakePackageConfigHelpers)
install(EXPORT barkridge NAMESPACE barkridge:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/barkridge
        FILE barkridge-targets.cmake)
configure_package_config_file(cmake/barkridge-config.cmake.in ${PROJECT_BINARY_DIR}/barkridge-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/barkridge)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/barkridge-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/barkridge-config.cmake ${PROJECT_BINARY_DIR}/barkridge-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/barkridge)
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/barkridge/scenes)
