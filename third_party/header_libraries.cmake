# Header-only libraries of tools, benchmarks and tests: the system's, or the copy here where it has none or an old one.

# library: as find_package knows it, a name and the least version; folder: here; target: what is linked.
function(ardrone_vslam_header_library library version folder target)
  find_package(${library} ${version} QUIET)
  if(${library}_FOUND)
    return()
  endif()
  message(STATUS "${library} ${version}: not found, the copy in third_party/ is taken")
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR}/third_party/${folder})
endfunction()

ardrone_vslam_header_library(CLI11 2 CLI11 CLI11::CLI11)  # set_version_flag; Debian 11 and Ubuntu 20.04 have none
ardrone_vslam_header_library(nlohmann_json 3.9 nlohmann_json nlohmann_json::nlohmann_json)  # ordered_json; Ubuntu 20.04 has 3.7
