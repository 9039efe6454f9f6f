# cpack -G DEB, cpack -G TGZ: all components in one package. What is linked is found by dpkg-shlibdeps; what is needed to build with the libraries
# is recommended, which apt installs unless told otherwise.
set(CPACK_PACKAGE_NAME dsdpv1)
set(CPACK_PACKAGE_VENDOR "the dsdpv1 authors")
set(CPACK_PACKAGE_CONTACT "the dsdpv1 authors <dsdpv1@invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "cycle-accurate model of the DSDPV1 PROFIBUS-DP slave chip")
set(CPACK_PACKAGE_DESCRIPTION "Programs, libraries for C, C++ and SystemC, a C99 driver, examples and documents:
 the chip with its bus, masters that read GSD files, checks of the user CPU's
 handshake and bus timing, and an ARM board that runs firmware.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, cmake, pkg-config, libfmt-dev, libsystemc-dev")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "verilator, gcc-arm-none-eabi, gdb-multiarch, gtkwave, wireshark")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# libdsdpv1.so.0 is in it: who is packaged on its own and links with it depends on this package; ldconfig is called.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
include(CPack)
