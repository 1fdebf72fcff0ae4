# Parrot AR.Drone 2.0: TI OMAP3630, Cortex-A8 with NEON, Linux 2.6.32. One static executable, so that nothing of the drone's
# old libraries is used: Debian's clang with the musl, libc++ and compiler-rt that scripts/cross_sysroot builds.
# ARDRONE_VSLAM_SYSROOT (-D or environment): the folder that it has filled.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR armv7-a)

if(NOT ARDRONE_VSLAM_SYSROOT)
  set(ARDRONE_VSLAM_SYSROOT "$ENV{ARDRONE_VSLAM_SYSROOT}")
endif()
set(ARDRONE_VSLAM_SYSROOT "${ARDRONE_VSLAM_SYSROOT}" CACHE PATH "filled by scripts/cross_sysroot")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ARDRONE_VSLAM_SYSROOT)
if(NOT EXISTS "${ARDRONE_VSLAM_SYSROOT}/float_abi")
  message(FATAL_ERROR "ARDRONE_VSLAM_SYSROOT ('${ARDRONE_VSLAM_SYSROOT}') holds no sysroot: run scripts/cross_build, which "
    "makes one, or scripts/cross_sysroot FOLDER")
endif()
file(STRINGS "${ARDRONE_VSLAM_SYSROOT}/float_abi" float_abi)  # softfp: the drone's own; hard
if(float_abi STREQUAL "hard")
  set(triple arm-linux-musleabihf)
else()
  set(triple arm-linux-musleabi)
endif()

set(llvm /usr/lib/llvm-14/bin)
set(CMAKE_C_COMPILER ${llvm}/clang)
set(CMAKE_CXX_COMPILER ${llvm}/clang++)
set(CMAKE_AR ${llvm}/llvm-ar CACHE FILEPATH "")
set(CMAKE_RANLIB ${llvm}/llvm-ranlib CACHE FILEPATH "")
set(CMAKE_SYSROOT "${ARDRONE_VSLAM_SYSROOT}/root")
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET ${triple})
  set(CMAKE_${language}_FLAGS_INIT
    "-mcpu=cortex-a8 -mfpu=neon -mfloat-abi=${float_abi} -resource-dir ${ARDRONE_VSLAM_SYSROOT}/resource -ffunction-sections -fdata-sections")
endforeach()
string(APPEND CMAKE_CXX_FLAGS_INIT " -stdlib=libc++")
# musl gives a thread the stack that the executable's header asks for, else 128 KiB.
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "-static -fuse-ld=lld -rtlib=compiler-rt -unwindlib=libunwind -Wl,--gc-sections -Wl,-z,stack-size=1048576")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR "qemu-arm-static;-cpu;cortex-a8;-r;2.6.32.9")
