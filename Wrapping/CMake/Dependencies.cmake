# What the filters need beyond VTK, and the flags of our own code; for this project and for the ParaView
# plugin, which is a project of its own.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Spectra 1.0 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)
# Neither brings a CMake package of its own.
foreach(name IN ITEMS sodium metis)
  string(TOUPPER "${name}" prefix)
  find_library(${prefix}_LIBRARY ${name})
  find_path(${prefix}_INCLUDE_DIR ${name}.h)
  if(NOT ${prefix}_LIBRARY OR NOT ${prefix}_INCLUDE_DIR)
    message(FATAL_ERROR "${name} was not found: install its development package (Debian: "
      "libsodium-dev, libmetis-dev), or set ${prefix}_LIBRARY and ${prefix}_INCLUDE_DIR")
  endif()
endforeach()

# Our own code's flags; VTK's generated wrapping is not held to them.
add_library(SpectralWatermarkFlags INTERFACE)
# Our loops decide what runs at the same time; Eigen's would do so inside them, and round by it.
target_compile_definitions(SpectralWatermarkFlags INTERFACE EIGEN_DONT_PARALLELIZE)
target_compile_options(SpectralWatermarkFlags INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  # False alarms from inside Eigen's kernels, which being a system header does not silence.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  $<$<BOOL:${SPECTRALWATERMARK_WARNINGS_AS_ERRORS}>:-Werror>)
