# The editor's side: Qt, and targets that know its tools.
option(FOOTWALL_STUDIO "Build the desktop editor (needs Qt 6.4)" ON)
if(NOT FOOTWALL_STUDIO)
  return()
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
find_package(Qt6 6.4 REQUIRED COMPONENTS Core Gui Widgets OpenGL Svg Test)
# Some of our own identifiers are called signals, slots or emit.
set_property(TARGET Qt6::Core APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS QT_NO_KEYWORDS)

# Qt's headers are the better part of each file's compile time; models have no widgets.
add_library(footwall_qt_pch OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
set_target_properties(footwall_qt_pch PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_link_libraries(footwall_qt_pch PUBLIC fmt::fmt OpenMP::OpenMP_CXX Qt6::Gui)
target_precompile_headers(footwall_qt_pch PRIVATE
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string>
  <string_view> <utility> <vector> <fmt/format.h> <QtCore/QtCore> <QtGui/QtGui>)
add_library(footwall_widgets_pch OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled.cpp)
set_target_properties(footwall_widgets_pch PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_link_libraries(footwall_widgets_pch PUBLIC fmt::fmt OpenMP::OpenMP_CXX Qt6::Widgets)
target_precompile_headers(footwall_widgets_pch PRIVATE
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string>
  <string_view> <utility> <vector> <fmt/format.h> <QtCore/QtCore> <QtGui/QtGui> <QtWidgets/QtWidgets>)

# footwall_ui_library(ui/section SOURCES a.cpp HEADERS a.h PUBLIC footwall::x PRIVATE y [NO_WIDGETS])
#
# As footwall_library(). HEADERS: those that say Q_OBJECT. Linked with Qt's widgets, or with NO_WIDGETS its Gui alone.
function(footwall_ui_library FOLDER)
  cmake_parse_arguments(ARG "NO_WIDGETS" "NAME" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" target ${FOLDER})
  if(NOT ARG_NAME)
    get_filename_component(ARG_NAME ${FOLDER} NAME)
    set(ARG_NAME ui_${ARG_NAME})
  endif()
  set(links ${CMAKE_BINARY_DIR}/include/${target})
  get_filename_component(parent ${links}/${FOLDER} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${FOLDER} ${links}/${FOLDER} SYMBOLIC)
  qt6_wrap_cpp(moc ${ARG_HEADERS} TARGET ${target} OPTIONS --no-notes)
  set_source_files_properties(${moc} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  add_library(${target} STATIC ${ARG_SOURCES} ${moc})
  add_library(footwall::${ARG_NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC ${links})
  if(ARG_NO_WIDGETS)
    set(qt Qt6::Gui)
    set(pch footwall_qt_pch)
  else()
    set(qt Qt6::Widgets)
    set(pch footwall_widgets_pch)
  endif()
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} ${qt} fmt::fmt OpenMP::OpenMP_CXX PRIVATE ${ARG_PRIVATE})
  target_precompile_headers(${target} REUSE_FROM ${pch})
endfunction()

# footwall_ui_test(section SOURCES section/view_test.cpp LINKS footwall::ui_section [TIMEOUT 120])
#
# A Qt Test program, ui_<name>, with real windows on a screen of its own (tests/ui/on_a_screen.py) and software OpenGL.
# Each source has one class with Q_OBJECT and test slots, registers it (tests/ui/test_class.h), and ends with
# #include "<source>.moc".
function(footwall_ui_test NAME)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINKS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  set(target ui_${NAME}_test)
  add_executable(${target} ${CMAKE_SOURCE_DIR}/tests/ui/main.cpp ${ARG_SOURCES})
  set_target_properties(${target} PROPERTIES AUTOMOC ON POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(${target} PRIVATE ${ARG_LINKS} Qt6::Widgets Qt6::Test fmt::fmt OpenMP::OpenMP_CXX)
  target_precompile_headers(${target} REUSE_FROM footwall_widgets_pch)
  add_test(NAME ui_${NAME} COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_SOURCE_DIR}/tests/ui/on_a_screen.py $<TARGET_FILE:${target}>)
  set_tests_properties(ui_${NAME} PROPERTIES LABELS ui TIMEOUT ${ARG_TIMEOUT} SKIP_RETURN_CODE 77
    ENVIRONMENT_MODIFICATION PATH=path_list_prepend:${CMAKE_BINARY_DIR}/launcher)
endfunction()

# footwall_slow_ui_test(random_edits FACTOR 50)
#
# ui_<name> again, under the label slow, with FACTOR times the random cases (tests/rounds.h).
function(footwall_slow_ui_test NAME)
  cmake_parse_arguments(ARG "" "FACTOR" "" ${ARGN})
  set(test slow_ui_${NAME})
  add_test(NAME ${test} COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_SOURCE_DIR}/tests/ui/on_a_screen.py $<TARGET_FILE:ui_${NAME}_test>)
  set_tests_properties(${test} PROPERTIES LABELS slow TIMEOUT 3600 SKIP_RETURN_CODE 77
    ENVIRONMENT "FOOTWALL_TEST_FACTOR=${ARG_FACTOR};QTEST_FUNCTION_TIMEOUT=3600000"
    ENVIRONMENT_MODIFICATION PATH=path_list_prepend:${CMAKE_BINARY_DIR}/launcher)
endfunction()
