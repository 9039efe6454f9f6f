# As Accellera's package, round the library of Debian: its target, and a mark.
set(SystemCLanguage_VERSION 3.0.1)
find_package(PkgConfig REQUIRED)
pkg_check_modules(DEBIAN REQUIRED systemc)
add_library(SystemC::systemc INTERFACE IMPORTED)
set_target_properties(SystemC::systemc PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${DEBIAN_INCLUDE_DIRS}" INTERFACE_LINK_LIBRARIES "${DEBIAN_LINK_LIBRARIES}" INTERFACE_COMPILE_DEFINITIONS THE_PLATFORMS)
