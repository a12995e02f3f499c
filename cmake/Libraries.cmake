# The libraries that the floors stand on, each behind one target. All come from Debian (cmake/packages.txt).
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)

# Trilinos gives variables, no usable targets; its TPL list would drag in a second MUMPS.
find_package(Trilinos REQUIRED COMPONENTS Belos Teuchos)
add_library(trilinos INTERFACE)
target_include_directories(trilinos SYSTEM INTERFACE ${Trilinos_INCLUDE_DIRS})
target_link_libraries(trilinos INTERFACE -Wl,--as-needed ${Trilinos_LIBRARIES} lapack blas MPI::MPI_CXX)

find_path(HYPRE_INCLUDE HYPRE.h PATH_SUFFIXES hypre REQUIRED)
find_library(HYPRE_LIBRARY HYPRE REQUIRED)
add_library(hypre INTERFACE)
target_include_directories(hypre SYSTEM INTERFACE ${HYPRE_INCLUDE})
target_link_libraries(hypre INTERFACE ${HYPRE_LIBRARY} MPI::MPI_C)

# Only the _ptscotch flavour has real orderings and the real MPI.
find_path(MUMPS_INCLUDE dmumps_c.h REQUIRED)
find_library(MUMPS_LIBRARY dmumps_ptscotch REQUIRED)
find_library(MUMPS_SINGLE_LIBRARY smumps_ptscotch REQUIRED)
add_library(mumps INTERFACE)
target_include_directories(mumps SYSTEM INTERFACE ${MUMPS_INCLUDE})
target_link_libraries(mumps INTERFACE ${MUMPS_LIBRARY} ${MUMPS_SINGLE_LIBRARY} MPI::MPI_C)

# hypre is linked with it already.
find_path(SUPERLU_DIST_INCLUDE superlu_ddefs.h PATH_SUFFIXES superlu-dist REQUIRED)
find_library(SUPERLU_DIST_LIBRARY superlu_dist REQUIRED)
add_library(superlu_dist INTERFACE)
target_include_directories(superlu_dist SYSTEM INTERFACE ${SUPERLU_DIST_INCLUDE})
target_link_libraries(superlu_dist INTERFACE ${SUPERLU_DIST_LIBRARY} gomp MPI::MPI_C)  # gomp: to ask for one thread

# Its licence is the GPL, which is then the program's too: for comparisons, not for packages.
add_library(umfpack INTERFACE)
if(BULBUS_UMFPACK)
  find_path(UMFPACK_INCLUDE umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
  find_library(UMFPACK_LIBRARY umfpack REQUIRED)
  target_include_directories(umfpack SYSTEM INTERFACE ${UMFPACK_INCLUDE})
  target_link_libraries(umfpack INTERFACE ${UMFPACK_LIBRARY})
endif()

set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
add_library(hdf5_parallel INTERFACE)
target_include_directories(hdf5_parallel SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
target_link_libraries(hdf5_parallel INTERFACE ${HDF5_C_LIBRARIES} MPI::MPI_C)
