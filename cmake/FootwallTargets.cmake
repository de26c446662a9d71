# footwall_library(storage/base SOURCES a.cpp PUBLIC footwall::x PRIVATE y)
#
# One target per folder, called footwall::<last folder>. A folder's headers are reached as
# "storage/base/error.h" through a folder of links made for this target alone, so that including
# the header of a folder that is not linked does not compile. PUBLIC names the folders whose types
# stand in this folder's headers; all else is PRIVATE.
add_library(footwall_pch OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
target_link_libraries(footwall_pch PUBLIC fmt::fmt OpenMP::OpenMP_CXX)
target_precompile_headers(footwall_pch PRIVATE
  <algorithm> <array> <cmath> <cstdint> <cstdlib> <cstring> <filesystem> <functional> <map> <memory>
  <optional> <span> <string> <string_view> <utility> <vector> <fmt/format.h>)

function(footwall_library FOLDER)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" target ${FOLDER})
  if(NOT ARG_NAME)
    get_filename_component(ARG_NAME ${FOLDER} NAME)
  endif()
  if(TARGET ${target})  # a second library of the same folder
    string(APPEND target _${ARG_NAME})
  endif()
  set(links ${CMAKE_BINARY_DIR}/include/${target})
  get_filename_component(parent ${links}/${FOLDER} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${FOLDER} ${links}/${FOLDER} SYMBOLIC)
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(footwall::${ARG_NAME} ALIAS ${target})
  target_include_directories(${target} PUBLIC ${links})
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} fmt::fmt OpenMP::OpenMP_CXX PRIVATE ${ARG_PRIVATE})
  target_precompile_headers(${target} REUSE_FROM footwall_pch)
endfunction()

# footwall_program(footwall SOURCES main.cpp LINKS footwall::base)
function(footwall_program NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE ${ARG_LINKS} fmt::fmt OpenMP::OpenMP_CXX)
  target_precompile_headers(${NAME} REUSE_FROM footwall_pch)
endfunction()

# Everything that the sanitizers run.
add_custom_target(unit_tests)

# footwall_unit_test(base SOURCES base/error_test.cpp LINKS footwall::base [LABEL unit] [TIMEOUT 120])
# One executable per tested folder, unit_<name>; one file per tested source.
function(footwall_unit_test NAME)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LINKS" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set(target ${ARG_LABEL}_${NAME})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(${target} PRIVATE ${ARG_LINKS} GTest::gtest GTest::gtest_main fmt::fmt OpenMP::OpenMP_CXX)
  target_precompile_headers(${target} REUSE_FROM footwall_pch)
  add_test(NAME ${target} COMMAND ${target})
  if(ARG_LABEL STREQUAL "unit")
    add_dependencies(unit_tests ${target})
  endif()
  set_tests_properties(${target} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT}
    ENVIRONMENT_MODIFICATION PATH=path_list_prepend:${CMAKE_BINARY_DIR}/launcher)
endfunction()

# footwall_slow_test(mesh FACTOR 40 TEST Mesh.StaysSoundUnderRandomOperations)
# One test of unit_<name> again, under the label slow, with FACTOR times the random cases (tests/rounds.h).
function(footwall_slow_test NAME)
  cmake_parse_arguments(ARG "" "FACTOR;TEST" "" ${ARGN})
  set(test slow_${NAME}.${ARG_TEST})
  add_test(NAME ${test} COMMAND unit_${NAME} --gtest_filter=${ARG_TEST})
  set_tests_properties(${test} PROPERTIES LABELS slow TIMEOUT 900 ENVIRONMENT FOOTWALL_TEST_FACTOR=${ARG_FACTOR}
    FAIL_REGULAR_EXPRESSION "Running 0 tests")
endfunction()

# footwall_fuzz_test(segy SOURCES segy_fuzz.cpp LINKS footwall::formats)
# A fuzz target, fuzz_<name>, with the driver of tests/fuzz; a short run of it is a unit test, so that the sanitizers
# see it at every change. `packaging/dev fuzz` runs it long.
function(footwall_fuzz_test NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  set(target fuzz_${NAME})
  add_executable(${target} ${CMAKE_SOURCE_DIR}/tests/fuzz/driver.cpp ${CMAKE_SOURCE_DIR}/tests/fuzz/mutate.cpp
    ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE FOOTWALL_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE ${ARG_LINKS} footwall::base fmt::fmt OpenMP::OpenMP_CXX)
  target_precompile_headers(${target} REUSE_FROM footwall_pch)
  add_dependencies(unit_tests ${target})
  add_test(NAME ${target} COMMAND ${target} --rounds 2000)
  set_tests_properties(${target} PROPERTIES LABELS unit TIMEOUT 300)
endfunction()

# footwall_mpi_test(extract SOURCES extract/reduce_test.cpp LINKS footwall::extract [RANKS 1 2 3 4 7])
# Runs one executable under each rank count: mpi_<name>.np7. main() is tests/mpi/main.cpp.
function(footwall_mpi_test NAME)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINKS;RANKS" ${ARGN})
  if(NOT ARG_RANKS)
    set(ARG_RANKS 1 2 3 4 7)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  set(target mpi_${NAME})
  add_executable(${target} ${CMAKE_SOURCE_DIR}/tests/mpi/main.cpp ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(${target} PRIVATE ${ARG_LINKS} GTest::gtest MPI::MPI_CXX fmt::fmt OpenMP::OpenMP_CXX)
  target_precompile_headers(${target} REUSE_FROM footwall_pch)
  foreach(ranks IN LISTS ARG_RANKS)
    add_test(NAME ${target}.np${ranks}
      COMMAND ${MPIEXEC_EXECUTABLE} ${FOOTWALL_MPIEXEC_FLAGS} ${MPIEXEC_NUMPROC_FLAG} ${ranks} $<TARGET_FILE:${target}>)
    set_tests_properties(${target}.np${ranks} PROPERTIES LABELS mpi TIMEOUT ${ARG_TIMEOUT}
      ENVIRONMENT "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMP_NUM_THREADS=1;OMPI_MCA_mpi_yield_when_idle=1;OMPI_MCA_rmaps_base_oversubscribe=1")
  endforeach()
endfunction()

# footwall_slow_mpi_test(extract FACTOR 50 TEST Exchanges/RandomEdits.* RANKS 1 2 3 4)
# Tests of mpi_<name> again, under the label slow, with FACTOR times the random cases (tests/rounds.h).
function(footwall_slow_mpi_test NAME)
  cmake_parse_arguments(ARG "" "FACTOR;TEST" "RANKS" ${ARGN})
  foreach(ranks IN LISTS ARG_RANKS)
    set(test slow_mpi_${NAME}.${ARG_TEST}.np${ranks})
    add_test(NAME ${test} COMMAND ${MPIEXEC_EXECUTABLE} ${FOOTWALL_MPIEXEC_FLAGS} ${MPIEXEC_NUMPROC_FLAG} ${ranks}
      $<TARGET_FILE:mpi_${NAME}> --gtest_filter=${ARG_TEST})
    set_tests_properties(${test} PROPERTIES LABELS slow TIMEOUT 900
      ENVIRONMENT "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMP_NUM_THREADS=1;OMPI_MCA_mpi_yield_when_idle=1;OMPI_MCA_rmaps_base_oversubscribe=1;FOOTWALL_TEST_FACTOR=${ARG_FACTOR}")
  endforeach()
endfunction()
