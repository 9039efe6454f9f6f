# dsdpv1_precompiled_libraries(FOLDER...): precompiles the third-party headers that most sources include, once for all C++ libraries of these rooms;
# this saves at least half of a source's compile time. Only for the preset edit: a source still includes what it needs.
function(dsdpv1_precompile_below folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(sources ${target} SOURCES)
    get_target_property(links ${target} LINK_LIBRARIES)
    if(type STREQUAL STATIC_LIBRARY AND links MATCHES "fmt::fmt" AND NOT sources MATCHES "\\.c(;|$)")  # fmt has a macro of its own
      target_precompile_headers(${target} REUSE_FROM dsdpv1_precompiled)
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below ${folders})
    dsdpv1_precompile_below(${below})
  endforeach()
endfunction()

function(dsdpv1_precompiled_libraries)
  file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cpp "")
  add_library(dsdpv1_precompiled OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_precompile_headers(dsdpv1_precompiled PRIVATE <fmt/format.h> <nlohmann/json.hpp> <yaml-cpp/yaml.h> <algorithm> <array> <deque> <filesystem> <fstream> <functional>
                            <map> <memory> <optional> <set> <sstream> <string> <string_view> <tuple> <utility> <variant> <vector>)
  target_link_libraries(dsdpv1_precompiled PRIVATE fmt::fmt nlohmann_json::nlohmann_json yaml-cpp dsdpv1_warnings)
  foreach(room ${ARGN})
    dsdpv1_precompile_below(${PROJECT_SOURCE_DIR}/${room})
  endforeach()
endfunction()
