# cpack -G DEB, in the build folder, makes four Debian packages.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME spectralwatermark)
set(CPACK_PACKAGE_CONTACT "SpectralWatermark developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development python tool)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# dpkg-shlibdeps finds what the libraries link; our own is in no package that it knows.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")

set(same_version "(= ${PROJECT_VERSION})")
# Named after the library's SOVERSION.
set(library_package libspectralwatermark${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
  "Manifold harmonics and blind watermarking of triangle meshes: the VTK filters.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libspectralwatermark-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} ${same_version}, libvtk9-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and the CMake package of ${library_package}.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-spectralwatermark)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "${library_package} ${same_version}, python3, python3-vtk9, python3-numpy")
# For spectralwatermark.report; everything else works without them.
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-jinja2, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
  "Manifold harmonics and blind watermarking of triangle meshes: the Python package.")

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME spectral-watermark)
set(CPACK_DEBIAN_TOOL_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS "python3-spectralwatermark ${same_version}, python3-tqdm")
set(CPACK_DEBIAN_TOOL_PACKAGE_RECOMMENDS "xvfb, xauth, libgl1-mesa-dri")
set(CPACK_COMPONENT_TOOL_DESCRIPTION
  "Hides a mark in 3D models, and proves later from a copy alone whose it is: the command line.")

include(CPack)
