# vcpkg: `vcpkg install meshwalk --overlay-ports=packaging/vcpkg` builds the library of this tree. A
# port of a release fetches its archive instead (vcpkg_download_distfile, with its SHA-512).
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../.." ABSOLUTE)

vcpkg_find_acquire_program(PKGCONFIG)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DMW_BUILD_CLI=OFF -DMW_BUILD_MPI=OFF -DMW_BUILD_WEB=OFF
    "-DPKG_CONFIG_EXECUTABLE=${PKGCONFIG}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/meshwalk)
vcpkg_fixup_pkgconfig()

# The build makes both kinds of library; a port has one. Those who link meshwalk::meshwalk get it.
if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")
  file(GLOB unwanted "${CURRENT_PACKAGES_DIR}/lib/libmeshwalk.so*"
    "${CURRENT_PACKAGES_DIR}/debug/lib/libmeshwalk.so*")
else()
  file(GLOB unwanted "${CURRENT_PACKAGES_DIR}/lib/libmeshwalk.a"
    "${CURRENT_PACKAGES_DIR}/debug/lib/libmeshwalk.a")
endif()
file(REMOVE ${unwanted})
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
