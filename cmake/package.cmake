# cpack -G DEB, cpack -G TGZ: all components in one package. dpkg-shlibdeps finds the linked libraries; packages needed to build with the libraries
# are suggested, which apt does not install by default: the programs are there in seconds.
set(DSDPV1_PACKAGE_CONTACT "the dsdpv1 authors <dsdpv1@invalid>" CACHE STRING "Who is responsible for packages: NAME <ADDRESS>")
mark_as_advanced(DSDPV1_PACKAGE_CONTACT)

set(CPACK_PACKAGE_NAME dsdpv1)
set(CPACK_PACKAGE_VENDOR "the dsdpv1 authors")
set(CPACK_PACKAGE_CONTACT ${DSDPV1_PACKAGE_CONTACT})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "cycle-accurate model of the DSDPV1 PROFIBUS-DP slave chip")
set(CPACK_PACKAGE_DESCRIPTION "Programs, libraries for C, C++ and SystemC, a C99 driver, examples and
documents: the chip with its bus, masters that read GSD files, checks of the
user CPU's handshake and bus timing, and an ARM board that runs firmware.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION electronics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS python3)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS python3-numpy)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, pkg-config, libfmt-dev, libsystemc-dev, libboost-context-dev, libpugixml-dev, libyaml-cpp-dev, zlib1g-dev, verilator, iverilog, gcc-arm-none-eabi, gdb-multiarch, gtkwave, wireshark")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# A package of a program that uses the shared libraries depends on this package; the linker's cache is updated.
set(debian ${PROJECT_BINARY_DIR}/debian)
file(WRITE ${debian}/shlibs "libdsdpv1 0 dsdpv1 (>= ${PROJECT_VERSION})\nlibdsdpv1_dpi 0 dsdpv1 (>= ${PROJECT_VERSION})\n")
file(WRITE ${debian}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${debian}/shlibs ${debian}/triggers)

# Debian's changelog only refers to CHANGELOG.md, which provides its date.
file(STRINGS ${PROJECT_SOURCE_DIR}/CHANGELOG.md entry REGEX "^## \\[${PROJECT_VERSION}\\] - ")
string(REGEX MATCH "[0-9-]+$" date "${entry}")
execute_process(COMMAND date -R -u -d "${date}" OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${debian}/changelog "dsdpv1 (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * See CHANGELOG.md.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
execute_process(COMMAND gzip -9nf ${debian}/changelog COMMAND_ERROR_IS_FATAL ANY)

install(FILES ${debian}/changelog.gz ${PROJECT_SOURCE_DIR}/cmake/debian/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME dsdpv1
        COMPONENT docs)
include(CPack)
