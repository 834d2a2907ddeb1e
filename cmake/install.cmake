# What `cmake --install` lays down: libraries, headers, package files for CMake and pkg-config. The
# program and its manual pages are installed by cli/. Only a top-level build installs.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/meshwalk)

# Two export sets: users of the shared library need the development files of neither zlib nor
# Jansson.
install(TARGETS meshwalk_static EXPORT meshwalkStaticTargets)
install(EXPORT meshwalkStaticTargets NAMESPACE meshwalk:: DESTINATION ${package_dir})
if(TARGET meshwalk_shared)
  set_target_properties(meshwalk_shared PROPERTIES EXPORT_NAME meshwalk)
  install(TARGETS meshwalk_shared EXPORT meshwalkSharedTargets)
  install(EXPORT meshwalkSharedTargets NAMESPACE meshwalk:: DESTINATION ${package_dir})
endif()
install(DIRECTORY include/meshwalk DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h" PATTERN "*.def")

if(MW_HAS_MPI)
  install(TARGETS meshwalk_mpi EXPORT meshwalkMpiTargets)
  install(EXPORT meshwalkMpiTargets NAMESPACE meshwalk:: DESTINATION ${package_dir})
  install(DIRECTORY mpi/include/meshwalk-mpi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()

# Manual pages of section 3 come from the comments of the headers: man3/ and man3-mpi/ of the build.
function(add_man3 directory first)
  set(pages ${PROJECT_BINARY_DIR}/${directory})
  add_custom_command(OUTPUT ${pages}/${first}.3
    COMMAND ${PROJECT_SOURCE_DIR}/tools/make_man3 ${pages} ${ARGN}
    DEPENDS ${ARGN} tools/make_man3 tools/man3.awk docs/man/meshwalk.1)
  add_custom_target(${directory} ALL DEPENDS ${pages}/${first}.3)
  install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man3)
endfunction()
file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/meshwalk/*.h)
add_man3(man3 meshwalk-base ${headers})
if(MW_HAS_MPI)
  add_man3(man3-mpi meshwalk-mpi ${PROJECT_SOURCE_DIR}/mpi/include/meshwalk-mpi/meshwalk-mpi.h)
endif()

set(needs_threads ON)
if(MW_WASI)
  set(needs_threads OFF)
endif()
set(needs_jansson OFF)
if(TARGET PkgConfig::JANSSON)
  set(needs_jansson ON)
endif()
configure_package_config_file(cmake/meshwalkConfig.cmake.in
  ${PROJECT_BINARY_DIR}/meshwalkConfig.cmake
  INSTALL_DESTINATION ${package_dir})
# Until 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/meshwalkConfigVersion.cmake COMPATIBILITY
  SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/meshwalkConfig.cmake
  ${PROJECT_BINARY_DIR}/meshwalkConfigVersion.cmake
  DESTINATION ${package_dir})

# pkg-config: the static library's own needs stand in Libs.private. The prefix is found from the
# place of the file.
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(pc_private "-lm")
if(MW_WITH_ZLIB)
  string(PREPEND pc_private "-lz ")
endif()
foreach(library ${CMAKE_DL_LIBS})
  string(APPEND pc_private " -l${library}")
endforeach()
if(needs_jansson)
  string(APPEND pc_private " -ljansson")
endif()
configure_file(cmake/meshwalk.pc.in ${PROJECT_BINARY_DIR}/meshwalk.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/meshwalk.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(MW_HAS_MPI) # for mpicc, which knows where MPI is
  configure_file(cmake/meshwalk-mpi.pc.in ${PROJECT_BINARY_DIR}/meshwalk-mpi.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/meshwalk-mpi.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
