# What nearly every source includes, compiled once. A compiler cache needs CCACHE_SLOPPINESS=pch_defines,time_macros to take
# what uses it: without that every source is compiled as if there were no cache, so it is left out then.
set(use_precompiled ON)
if(CMAKE_CROSSCOMPILING OR (CMAKE_CXX_COMPILER_LAUNCHER MATCHES ccache AND NOT "$ENV{CCACHE_SLOPPINESS}" MATCHES pch_defines))
  set(use_precompiled OFF)
endif()

# Headers for ardrone_vslam_precompiled(TARGET OWNER). LIBRARIES: what they are of; OPTIONS: the compiler's, as their users have.
# PROGRAMS: their users are no libraries, which are compiled otherwise.
function(ardrone_vslam_precompiled_headers owner)
  cmake_parse_arguments(PARSE_ARGV 1 with "PROGRAMS" "" "HEADERS;LIBRARIES;OPTIONS")
  if(use_precompiled)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${owner}.cpp)
    file(GENERATE OUTPUT ${source} CONTENT "int main() {}\n")
    if(with_PROGRAMS)
      add_executable(${owner} EXCLUDE_FROM_ALL ${source})
    else()
      add_library(${owner} OBJECT EXCLUDE_FROM_ALL ${source})
    endif()
    target_precompile_headers(${owner} PRIVATE ${with_HEADERS})
    target_link_libraries(${owner} PRIVATE ${with_LIBRARIES})
    target_compile_options(${owner} PRIVATE ${with_OPTIONS})
    ardrone_vslam_warnings(${owner})
  endif()
endfunction()

function(ardrone_vslam_precompiled target owner)
  if(use_precompiled)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()
