# Warnings are errors in the project's own code.
function(ardrone_vslam_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow -Werror)
endfunction()
