# Settings of the build as a whole; if this project is a part of another, the parent makes them.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()

set(CMAKE_EXPORT_COMPILE_COMMANDS ON)  # for clang-tidy and editors

find_program(DSDPV1_CCACHE ccache)
mark_as_advanced(DSDPV1_CCACHE)
if(DSDPV1_CCACHE)
  foreach(language C CXX)
    if(NOT CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER ${DSDPV1_CCACHE})
    endif()
  endforeach()
endif()

# Used if present: it links in a tenth of the time of GNU's linker.
find_program(DSDPV1_MOLD mold)
mark_as_advanced(DSDPV1_MOLD)
if(DSDPV1_MOLD)
  add_link_options(-fuse-ld=mold)
endif()

# Programs do not contain the path of their build folder: builds in different folders are equal (./run reproducible).
add_compile_options(-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
