# Everything comes from the system's packages (packaging/packages.txt); nothing is downloaded.
set(HDF5_PREFER_PARALLEL TRUE)
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
if(NOT FOOTWALL_OPENMP)
  # GCC's OpenMP library is not built for the thread sanitizer, which takes its barriers for races. Still linked, for
  # omp_get_wtime() and its like; its parallel regions run on the calling thread.
  set_property(TARGET OpenMP::OpenMP_CXX PROPERTY INTERFACE_COMPILE_OPTIONS -Wno-unknown-pragmas)
endif()
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "The HDF5 found (${HDF5_INCLUDE_DIRS}) is not the parallel one: install libhdf5-openmpi-dev or "
    "libhdf5-mpich-dev, or name it by HDF5_ROOT (docs/cluster.md)")
endif()
find_package(SQLite3 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(CGAL REQUIRED)
find_package(LibArchive REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Freetype REQUIRED)
find_package(Protobuf REQUIRED)
find_package(gRPC CONFIG REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(Fontconfig REQUIRED)
if(FOOTWALL_TESTS)
  find_package(GTest REQUIRED)
endif()
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
find_library(SQLITECPP_LIBRARY SQLiteCpp REQUIRED)

# HDF5's variables as one target, so that only those who link it find its headers.
add_library(footwall_hdf5 INTERFACE)
target_include_directories(footwall_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(footwall_hdf5 INTERFACE ${HDF5_LIBRARIES} MPI::MPI_C)
target_compile_definitions(footwall_hdf5 INTERFACE ${HDF5_DEFINITIONS})

find_package(MPI REQUIRED COMPONENTS C CXX)
# The C++ bindings of MPI were removed from the standard; their headers only cost time.
set_property(TARGET MPI::MPI_CXX APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
set_property(TARGET MPI::MPI_C APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)

# The launcher's words beyond "-n N". Open MPI's count slots and bind ranks to them; MPICH's has neither.
execute_process(COMMAND ${MPIEXEC_EXECUTABLE} --version OUTPUT_VARIABLE launcher_words ERROR_VARIABLE launcher_words)
if(launcher_words MATCHES "Open MPI|OpenRTE")
  set(FOOTWALL_MPIEXEC_FLAGS --oversubscribe --bind-to none)
endif()
# For tests that start the ranks through the program: its launcher is the one that belongs to the library, also where
# several are installed.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/launcher)
foreach(name mpirun mpiexec)
  file(CREATE_LINK ${MPIEXEC_EXECUTABLE} ${CMAKE_BINARY_DIR}/launcher/${name} SYMBOLIC)
endforeach()
