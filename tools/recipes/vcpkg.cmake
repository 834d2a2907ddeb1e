# What vcpkg does with a port: cmake -DPORT=DIR -DINSTALLED=DIR -DBUILDTREES=DIR
# -DLINKAGE=static|dynamic -P vcpkg.cmake. The functions of vcpkg that the port of meshwalk calls
# are replaced by stand-ins with the same effect, for Linux and one kind of build.
cmake_minimum_required(VERSION 3.25)
file(READ ${PORT}/vcpkg.json manifest)
string(JSON PORT_NAME GET "${manifest}" name)
string(JSON dependencies GET "${manifest}" dependencies)
set(CURRENT_PORT_DIR ${PORT})
set(CURRENT_PACKAGES_DIR ${INSTALLED})
set(VCPKG_LIBRARY_LINKAGE ${LINKAGE})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A helper port that the manifest forgets is not there.
function(needs helper)
  if(NOT dependencies MATCHES "\"${helper}\"")
    message(FATAL_ERROR "vcpkg.json does not name ${helper}")
  endif()
endfunction()

function(vcpkg_find_acquire_program name)
  find_program(program pkg-config REQUIRED NO_CACHE)
  set(${name} ${program} PARENT_SCOPE)
endfunction()

function(vcpkg_cmake_configure)
  needs(vcpkg-cmake)
  cmake_parse_arguments(PARSE_ARGV 0 port "" "SOURCE_PATH" "OPTIONS")
  if(port_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "vcpkg_cmake_configure does not know ${port_UNPARSED_ARGUMENTS}")
  endif()
  set(shared OFF)
  if(LINKAGE STREQUAL "dynamic")
    set(shared ON)
  endif()
  run(${CMAKE_COMMAND} -G Ninja -S ${port_SOURCE_PATH} -B ${BUILDTREES}
    -DBUILD_SHARED_LIBS=${shared} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
    -DCMAKE_INSTALL_PREFIX=${INSTALLED} -DCMAKE_INSTALL_LIBDIR=lib -UMW_* ${port_OPTIONS})
endfunction()

function(vcpkg_cmake_install)
  run(${CMAKE_COMMAND} --build ${BUILDTREES})
  run(${CMAKE_COMMAND} --install ${BUILDTREES})
endfunction()

# The files for CMake go to share/PORT, one folder less below the prefix.
function(vcpkg_cmake_config_fixup)
  needs(vcpkg-cmake-config)
  cmake_parse_arguments(PARSE_ARGV 0 fixup "" "CONFIG_PATH" "")
  file(MAKE_DIRECTORY ${INSTALLED}/share)
  file(RENAME ${INSTALLED}/${fixup_CONFIG_PATH} ${INSTALLED}/share/${PORT_NAME})
  file(GLOB files ${INSTALLED}/share/${PORT_NAME}/*.cmake)
  set(up "get_filename_component(_IMPORT_PREFIX \"\${_IMPORT_PREFIX}\" PATH)\n")
  foreach(file IN LISTS files)
    file(READ ${file} text)
    string(REPLACE "${up}${up}${up}" "${up}${up}" text "${text}")
    string(REPLACE "/../../../\"" "/../../\"" text "${text}")
    file(WRITE ${file} "${text}")
  endforeach()
endfunction()

function(vcpkg_fixup_pkgconfig)
  run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${INSTALLED}/lib/pkgconfig pkg-config --validate
    ${PORT_NAME})
endfunction()

function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 copyright "" "" "FILE_LIST")
  file(COPY_FILE ${copyright_FILE_LIST} ${INSTALLED}/share/${PORT_NAME}/copyright)
endfunction()

include(${PORT}/portfile.cmake)
