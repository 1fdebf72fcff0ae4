# Warnings are errors in the project's own code.
function(ardrone_vslam_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow -Werror
    $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)  # of GCC's -Wconversion it is no part
endfunction()
