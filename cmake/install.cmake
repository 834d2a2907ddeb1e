# What `cmake --install` lays down: libraries, headers, package files for CMake and pkg-config. The
# program and its manual pages are installed by cli/. Only a top-level build installs.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/meshwalk)

# Packages that bring one kind of library switch the other one off.
option(MW_INSTALL_STATIC "Install the static library" ON)
option(MW_INSTALL_SHARED "Install the shared library" ON)
if(NOT MW_INSTALL_SHARED AND (MW_HAS_MPI OR (MW_BUILD_CLI AND BUILD_SHARED_LIBS)))
  message(FATAL_ERROR "MW_INSTALL_SHARED=OFF needs MW_BUILD_MPI=OFF and BUILD_SHARED_LIBS=OFF: what "
    "else is installed is linked with the shared library")
endif()

# Two export sets: users of the shared library need the development files of neither zlib nor
# Jansson.
if(MW_INSTALL_STATIC)
  install(TARGETS meshwalk_static EXPORT meshwalkStaticTargets)
  install(EXPORT meshwalkStaticTargets NAMESPACE meshwalk:: DESTINATION ${package_dir})
endif()
if(TARGET meshwalk_shared AND MW_INSTALL_SHARED)
  set_target_properties(meshwalk_shared PROPERTIES EXPORT_NAME meshwalk)
  install(TARGETS meshwalk_shared EXPORT meshwalkSharedTargets)
  install(EXPORT meshwalkSharedTargets NAMESPACE meshwalk:: DESTINATION ${package_dir})
endif()
install(DIRECTORY include/meshwalk DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h" PATTERN "*.def")

set(public_headers include)
if(MW_HAS_MPI)
  list(APPEND public_headers mpi/include)
  install(TARGETS meshwalk_mpi EXPORT meshwalkMpiTargets)
  install(EXPORT meshwalkMpiTargets NAMESPACE meshwalk:: DESTINATION ${package_dir})
  install(DIRECTORY mpi/include/meshwalk-mpi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()

# Manual pages of section 3 come from the comments of the headers.
list(TRANSFORM public_headers PREPEND ${PROJECT_SOURCE_DIR}/)
list(TRANSFORM public_headers APPEND /*/*.h OUTPUT_VARIABLE headers)
file(GLOB headers CONFIGURE_DEPENDS ${headers})
set(man3_dir ${PROJECT_BINARY_DIR}/man3)
add_custom_command(OUTPUT ${man3_dir}/meshwalk-base.3
  COMMAND ${PROJECT_SOURCE_DIR}/tools/make_man3 ${man3_dir} ${public_headers}
  DEPENDS ${headers} tools/make_man3 tools/man3.awk docs/man/meshwalk.1)
add_custom_target(man3 ALL DEPENDS ${man3_dir}/meshwalk-base.3)
install(DIRECTORY ${man3_dir}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man3)

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
# place of the file. The folders may be given relative to it, or as whole paths.
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH pc_libdir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH pc_includedir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
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
set(pc_static "") # without a shared library everybody needs these
if(NOT MW_INSTALL_SHARED OR NOT TARGET meshwalk_shared)
  set(pc_static "${pc_private} ${CMAKE_THREAD_LIBS_INIT}")
endif()
configure_file(cmake/meshwalk.pc.in ${PROJECT_BINARY_DIR}/meshwalk.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/meshwalk.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(MW_HAS_MPI) # for mpicc, which knows where MPI is
  configure_file(cmake/meshwalk-mpi.pc.in ${PROJECT_BINARY_DIR}/meshwalk-mpi.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/meshwalk-mpi.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
