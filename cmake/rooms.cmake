# A room: a folder of sources that is a library of its own, ardrone_vslam_FOLDER_ROOM. A header of onboard/input is included
# as "input/header.hpp".
#   ardrone_vslam_room(onboard/input USES common/protocol LIBRARIES Threads::Threads)
# ROS: it needs the messages and catkin's libraries.
function(ardrone_vslam_rooms_of output)
  list(TRANSFORM ARGN REPLACE / _ OUTPUT_VARIABLE targets)
  list(TRANSFORM targets PREPEND ${PROJECT_NAME}_)
  set(${output} ${targets} PARENT_SCOPE)
endfunction()

function(ardrone_vslam_room room)
  cmake_parse_arguments(PARSE_ARGV 1 with "ROS" "" "USES;LIBRARIES")
  ardrone_vslam_rooms_of(target ${room})
  ardrone_vslam_rooms_of(uses ${with_USES})
  string(REGEX REPLACE "/.*" "" wing ${room})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${room}/*.cpp)
  if(NOT sources)  # headers alone
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR}/${wing})
    return()
  endif()
  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/${wing})
  target_link_libraries(${target} PUBLIC ${PROJECT_NAME} ${uses} ${with_LIBRARIES})
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  ardrone_vslam_warnings(${target})
  ardrone_vslam_precompiled(${target} precompiled)
  ardrone_vslam_unity(${target} ${sources})
  if(with_ROS)
    ardrone_vslam_uses_ros(${target})
  endif()
endfunction()

# The headers and templates of Eigen, ROS and OpenCV cost more than what includes them: each folder's are read once.
# Before 3.18 CMake knows no groups, and would mix the folders.
function(ardrone_vslam_unity target)
  if(ARDRONE_VSLAM_UNITY_BUILD AND NOT CMAKE_VERSION VERSION_LESS 3.18)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source ${ARGN})
      get_filename_component(folder ${source} DIRECTORY)
      file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})  # the names of what is compiled are so the same in every checkout
      string(MAKE_C_IDENTIFIER "${folder}" group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
    # GCC takes a source in another one for a header, where unnamed namespaces would be a fault.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

function(ardrone_vslam_uses_ros target)
  target_include_directories(${target} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
  target_link_libraries(${target} PUBLIC ${catkin_LIBRARIES})
  add_dependencies(${target} ${${PROJECT_NAME}_EXPORTED_TARGETS})
endfunction()
