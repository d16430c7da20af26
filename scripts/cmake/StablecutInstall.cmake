# What `cmake --install` puts where, and the Debian package that `scripts/package` makes of it:
#   bin/                       the tools, the plot scripts, import-urdf, stablecut-report
#   share/man/man1, man5, man7 their pages (of scripts their help), one of all fields of documents, and one of the whole
#   share/bash-completion, share/zsh   completion, written by the tools from their own options
#   share/stablecut/           scripts, schemas and example data in the layout of the checkout
#   include/, lib/             the rooms as a library: find_package(stablecut), pkg-config stablecut
include(CMakePackageConfigHelpers)

set(share ${CMAKE_INSTALL_DATADIR}/stablecut)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts/ DESTINATION ${share}/scripts USE_SOURCE_PERMISSIONS
  FILES_MATCHING PATTERN "plot*" PATTERN "import-urdf" PATTERN "report"
  REGEX "scripts/(reporting|plotting|studies)/" PATTERN "cmake" EXCLUDE PATTERN "derive" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/schemas DESTINATION ${share} FILES_MATCHING PATTERN "*.schema.json")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/testdata DESTINATION ${share} PATTERN fuzz EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/LICENSE
  ${PROJECT_SOURCE_DIR}/REFERENCES.md TYPE DOC)
install(FILES ${PROJECT_SOURCE_DIR}/apps/stablecut.5 DESTINATION ${CMAKE_INSTALL_MANDIR}/man5)
install(FILES ${PROJECT_SOURCE_DIR}/apps/stablecut.7 DESTINATION ${CMAKE_INSTALL_MANDIR}/man7)
file(GLOB commands CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scripts/plot-* ${PROJECT_SOURCE_DIR}/scripts/report
  ${PROJECT_SOURCE_DIR}/scripts/import-urdf)
file(GLOB parts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scripts/plotting/*.py ${PROJECT_SOURCE_DIR}/scripts/reporting/*.py)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/links)
foreach(command ${commands})
  cmake_path(GET command FILENAME name)
  # "report" alone would say too little in a folder of all programs.
  string(REGEX REPLACE "^report$" "stablecut-report" linked ${name})
  file(CREATE_LINK ../${share}/scripts/${name} ${PROJECT_BINARY_DIR}/links/${linked} SYMBOLIC)
  install(FILES ${PROJECT_BINARY_DIR}/links/${linked} TYPE BIN)
  set(page ${PROJECT_BINARY_DIR}/links/${linked}.1)
  add_custom_command(OUTPUT ${page} COMMAND ${PROJECT_SOURCE_DIR}/scripts/cmake/manual-page ${command} ${linked} > ${page}
    DEPENDS ${command} ${parts} ${PROJECT_SOURCE_DIR}/scripts/cmake/manual-page)
  list(APPEND pages ${page})
endforeach()
add_custom_target(script_pages ALL DEPENDS ${pages})
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

# The library. Its rooms are static, and need the packages that they use.
set(rooms base numerics dynamics milling modal receptance robot taps document)
list(TRANSFORM rooms PREPEND stablecut_ OUTPUT_VARIABLE targets)
install(TARGETS ${targets} stablecut_settings EXPORT stablecut-targets
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stablecut)
foreach(room ${rooms})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/lib/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stablecut
    FILES_MATCHING PATTERN "*.h" PATTERN "*_test.h" EXCLUDE PATTERN "*_benchmark.h" EXCLUDE)
endforeach()
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/stablecut)
install(EXPORT stablecut-targets NAMESPACE stablecut:: DESTINATION ${package})
configure_package_config_file(${PROJECT_SOURCE_DIR}/scripts/cmake/stablecut-config.cmake.in
  ${PROJECT_BINARY_DIR}/stablecut-config.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stablecut-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stablecut-config.cmake ${PROJECT_BINARY_DIR}/stablecut-config-version.cmake
  DESTINATION ${package})
# A room may use those before it in the list; the linker wants it the other way round.
list(REVERSE targets)
list(TRANSFORM targets PREPEND -l OUTPUT_VARIABLE STABLECUT_LIBRARIES)
list(JOIN STABLECUT_LIBRARIES " " STABLECUT_LIBRARIES)
file(RELATIVE_PATH STABLECUT_UP /any/${CMAKE_INSTALL_LIBDIR}/pkgconfig /any)
configure_file(${PROJECT_SOURCE_DIR}/scripts/cmake/stablecut.pc.in ${PROJECT_BINARY_DIR}/stablecut.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/stablecut.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stablecut)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "stiff poses and stable cuts for milling robots")
set(CPACK_PACKAGE_CONTACT "the stablecut project <stablecut@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "jq, gnuplot-nox, python3, python3-jsonschema, python3-markdown, libjs-chart.js, make, man-db, bash-completion")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "parallel, slurm-client, libeigen3-dev, libceres-dev, libboost-dev, nlohmann-json3-dev")
include(CPack)
