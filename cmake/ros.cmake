# Finds ROS, generates the messages and declares the catkin package. Sets ARDRONE_VSLAM_WITH_ROS.
set(ARDRONE_VSLAM_ROS_COMPONENTS
  roscpp nodelet pluginlib message_generation std_msgs std_srvs sensor_msgs geometry_msgs nav_msgs visualization_msgs
  cv_bridge image_transport camera_info_manager tf2 tf2_ros tf2_msgs diagnostic_updater dynamic_reconfigure rosbag)
find_package(catkin QUIET OPTIONAL_COMPONENTS ${ARDRONE_VSLAM_ROS_COMPONENTS})  # so that all that miss are named at once

set(ARDRONE_VSLAM_WITH_ROS FALSE)
if(NOT catkin_FOUND)
  message(STATUS "ardrone_vslam: catkin not found, building without ROS")
  return()
endif()
# catkin_FOUND stays 1 when a component is missing.
set(missing "")
foreach(component ${ARDRONE_VSLAM_ROS_COMPONENTS})
  if(NOT ${component}_FOUND)
    list(APPEND missing ${component})
  endif()
endforeach()
if(missing)
  message(FATAL_ERROR "ardrone_vslam: ROS packages missing: ${missing}. Run scripts/install_dependencies, or build without "
    "ROS by -DCMAKE_DISABLE_FIND_PACKAGE_catkin=1.")
endif()
set(ARDRONE_VSLAM_WITH_ROS TRUE)
find_package(catkin REQUIRED COMPONENTS ${ARDRONE_VSLAM_ROS_COMPONENTS})

file(GLOB message_files RELATIVE ${PROJECT_SOURCE_DIR}/msg CONFIGURE_DEPENDS msg/*.msg)
add_message_files(DIRECTORY msg FILES ${message_files})
file(GLOB service_files RELATIVE ${PROJECT_SOURCE_DIR}/srv CONFIGURE_DEPENDS srv/*.srv)
add_service_files(DIRECTORY srv FILES ${service_files})
generate_messages(DEPENDENCIES std_msgs geometry_msgs)
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${PROJECT_NAME}
  CATKIN_DEPENDS message_runtime roscpp nodelet std_msgs std_srvs geometry_msgs sensor_msgs nav_msgs visualization_msgs
  DEPENDS EIGEN3)
