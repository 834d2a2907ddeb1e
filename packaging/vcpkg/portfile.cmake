# vcpkg: `vcpkg install meshwalk --overlay-ports=packaging/vcpkg` builds the library of this tree. A
# port of a release fetches its archive instead (vcpkg_download_distfile, with its SHA-512).
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../.." ABSOLUTE)

# A port has one kind of library. Those who link meshwalk::meshwalk get it.
set(unwanted STATIC)
if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")
  set(unwanted SHARED)
endif()

vcpkg_find_acquire_program(PKGCONFIG)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DMW_BUILD_CLI=OFF -DMW_BUILD_MPI=OFF -DMW_BUILD_WEB=OFF
    -DMW_INSTALL_${unwanted}=OFF "-DPKG_CONFIG_EXECUTABLE=${PKGCONFIG}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/meshwalk)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
