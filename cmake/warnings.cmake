# An error for developers alone: another compiler's new warning stops no user's build.
option(ARDRONE_VSLAM_WARNINGS_AS_ERRORS "Stop at a warning in the project's own code; scripts/test does" OFF)

function(ardrone_vslam_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow
    $<$<BOOL:${ARDRONE_VSLAM_WARNINGS_AS_ERRORS}>:-Werror>
    $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)  # of GCC's -Wconversion it is no part
endfunction()
