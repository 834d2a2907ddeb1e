# Tests of the project as a whole: the examples in the documentation, the layout of the code, what
# is installed, where the data came from.

# Blocks of code in the documentation: C blocks become programs, the shell blocks of a page one
# test.
file(GLOB pages CONFIGURE_DEPENDS README.md docs/*.md docs/*/*.md)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${pages} tools/doc_blocks.awk)
set(blocks_dir ${PROJECT_BINARY_DIR}/documentation)
file(REMOVE_RECURSE ${blocks_dir})
file(MAKE_DIRECTORY ${blocks_dir})
foreach(page IN LISTS pages)
  file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${page})
  string(REGEX REPLACE "^docs/|\\.md$" "" name ${name})
  string(REPLACE "/" "_" name ${name})
  execute_process(COMMAND awk -f ${PROJECT_SOURCE_DIR}/tools/doc_blocks.awk -v
    prefix=${blocks_dir}/${name} ${page}
    OUTPUT_VARIABLE blocks OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" blocks "${blocks}")
  set(shell_blocks ${blocks})
  list(FILTER shell_blocks INCLUDE REGEX "\\.sh$")
  list(FILTER blocks INCLUDE REGEX "\\.c$")
  foreach(block IN LISTS blocks)
    get_filename_component(program ${block} NAME_WE)
    set(program docs_${program})
    string(REGEX REPLACE "\\.c$" ".expected" expected ${block})
    # One for meshes in pieces runs on three ranks.
    file(STRINGS ${block} in_pieces REGEX "<meshwalk-mpi/")
    if(in_pieces AND NOT MW_MPI_FLAVOURS)
      continue()
    endif()
    add_executable(${program} ${block})
    set(command $<TARGET_FILE:${program}>)
    if(in_pieces)
      list(GET MW_MPI_FLAVOURS 0 flavour)
      target_link_libraries(${program} PRIVATE mpi_${flavour} m)
      set(command env MW_TEST_RANKS=3 ${PROJECT_SOURCE_DIR}/tests/mpi/run_ranks ${flavour}
        ${MPIEXEC_${flavour}} ${command})
    else()
      target_link_libraries(${program} PRIVATE meshwalk_static mw_flags m)
    endif()
    if(EXISTS ${expected})
      set(command ${PROJECT_SOURCE_DIR}/tools/expect ${expected} ${command})
    endif()
    add_test(NAME ${program} COMMAND ${command} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  endforeach()
  if(shell_blocks AND TARGET meshwalk)
    add_test(NAME docs_${name}_shell COMMAND ${PROJECT_SOURCE_DIR}/tools/run_blocks
      ${blocks_dir}/scratch_${name} $<TARGET_FILE:meshwalk> ${shell_blocks})
  endif()
endforeach()

# The rest concerns the sources and the library as installed: once, in builds without sanitizers.
if(MW_SANITIZE)
  return()
endif()
# A test that cannot run here is skipped visibly; tools/left_out lists the reasons at the end of
# ./test.
function(leave_out name reason)
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo "left out: ${reason}")
  set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "left out: ")
endfunction()
find_program(CLANG_FORMAT clang-format)
if(CLANG_FORMAT)
  add_test(NAME format COMMAND ${PROJECT_SOURCE_DIR}/tools/check_format)
else()
  leave_out(format "there is no clang-format")
endif()
add_test(NAME arrows COMMAND ${PROJECT_SOURCE_DIR}/tools/check_arrows)
add_test(NAME arrows_self_test COMMAND ${PROJECT_SOURCE_DIR}/tools/test_check_arrows)
add_test(NAME calls COMMAND ${PROJECT_SOURCE_DIR}/tools/check_calls $<TARGET_FILE:meshwalk_static>)
add_test(NAME man3 COMMAND ${PROJECT_SOURCE_DIR}/tools/check_man3 ${PROJECT_BINARY_DIR}/man3
  ${public_headers})
add_test(NAME citations COMMAND ${PROJECT_SOURCE_DIR}/tools/check_citations)
add_test(NAME links COMMAND ${PROJECT_SOURCE_DIR}/tools/check_links)
add_test(NAME columns COMMAND ${PROJECT_SOURCE_DIR}/tools/check_columns)
add_test(NAME names COMMAND ${PROJECT_SOURCE_DIR}/tools/check_names)
add_test(NAME recipes COMMAND ${PROJECT_SOURCE_DIR}/tools/check_recipes)
add_test(NAME symbols COMMAND ${PROJECT_SOURCE_DIR}/tools/check_symbols
  ${PROJECT_SOURCE_DIR}/include $<TARGET_FILE:meshwalk_shared>
  ${PROJECT_SOURCE_DIR}/packaging/debian/libmeshwalk0.symbols $<TARGET_FILE:meshwalk_static>)
if(MW_HAS_MPI)
  add_test(NAME mpi_symbols COMMAND ${PROJECT_SOURCE_DIR}/tools/check_symbols
    ${PROJECT_SOURCE_DIR}/mpi/include $<TARGET_FILE:meshwalk_mpi>
    ${PROJECT_SOURCE_DIR}/packaging/debian/libmeshwalk-mpi0.symbols)
endif()
if(MW_BUILD_CLI)
  add_test(NAME posix COMMAND ${CMAKE_COMMAND} -E env CC=${CMAKE_C_COMPILER}
    ${PROJECT_SOURCE_DIR}/tools/check_posix ${PROJECT_BINARY_DIR})
endif()
find_program(ABIDIFF abidiff)
if(ABIDIFF)
  add_test(NAME abi_self_test COMMAND ${PROJECT_SOURCE_DIR}/tools/test_check_abi)
else()
  leave_out(abi_self_test "there is no abidiff (abigail-tools)")
endif()
# Fast-math would make the predicates wrong: the sources refuse it.
add_test(NAME fast_math COMMAND ${CMAKE_C_COMPILER} -ffast-math -fsyntax-only
  -I${PROJECT_SOURCE_DIR}/include
  -I${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/src/predicates/orient2d.c)
set_tests_properties(fast_math PROPERTIES PASS_REGULAR_EXPRESSION
  "do not compile it with -ffast-math")
if(MW_BUILD_CLI)
  add_subdirectory(${PROJECT_SOURCE_DIR}/web/test ${PROJECT_BINARY_DIR}/web/test)
  add_test(NAME install COMMAND ${PROJECT_SOURCE_DIR}/tools/check_install ${PROJECT_BINARY_DIR}
    ${CMAKE_C_COMPILER})
  add_test(NAME upgrade COMMAND ${PROJECT_SOURCE_DIR}/tools/check_upgrade ${PROJECT_BINARY_DIR}
    ${CMAKE_C_COMPILER})
  add_test(NAME strangers COMMAND ${PROJECT_SOURCE_DIR}/tools/check_strangers ${PROJECT_BINARY_DIR})
endif()

# The source of the terrain is rarely at hand: NumPy and Debian's python-matplotlib-data.
set(grid /usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz)
set(no_numpy TRUE)
if(EXISTS ${grid} AND EXISTS /usr/bin/python3)
  execute_process(COMMAND /usr/bin/python3 -c "import numpy" RESULT_VARIABLE no_numpy OUTPUT_QUIET
    ERROR_QUIET)
endif()
if(no_numpy)
  leave_out(data "the source of the terrain: Debian's python-matplotlib-data and python3-numpy")
else()
  add_test(NAME data COMMAND ${PROJECT_SOURCE_DIR}/tools/check_data /usr/bin/python3 ${grid})
endif()
