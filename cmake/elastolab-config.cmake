# find_package(elastolab): targets elastolab::scene, elastolab::methods, elastolab::deform ... (docs/library.md).
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(OpenMP COMPONENTS CXX)
include("${CMAKE_CURRENT_LIST_DIR}/elastolab-targets.cmake")
