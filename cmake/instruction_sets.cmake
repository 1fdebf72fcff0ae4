# Only src/kernels/*_avx2.cpp, *_avx512.cpp and *_neon.cpp get instruction-set flags; which of them runs is chosen at run
# time, so that one build runs on every processor of its architecture.
function(ardrone_vslam_instruction_sets target)
  file(GLOB avx2 CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/kernels/*_avx2.cpp)
  file(GLOB avx512 CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/kernels/*_avx512.cpp)
  file(GLOB neon CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/kernels/*_neon.cpp)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(${avx2} PROPERTIES COMPILE_OPTIONS "-mavx2;-mbmi;-mbmi2;-mpopcnt")
    # Its plain loads are twice as fast as the vectors that the compiler would make of them.
    set_property(SOURCE ${CMAKE_CURRENT_SOURCE_DIR}/src/kernels/freak_avx2.cpp
      APPEND PROPERTY COMPILE_OPTIONS "-fno-tree-vectorize")
    set_source_files_properties(${avx512} PROPERTIES
      COMPILE_OPTIONS "-mavx2;-mbmi;-mbmi2;-mpopcnt;-mavx512f;-mavx512bw;-mavx512vl;-mavx512vpopcntdq")
    target_compile_definitions(${target} PRIVATE ARDRONE_VSLAM_WITH_AVX2)
    target_sources(${target} PRIVATE ${avx2} ${avx512})
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64|^arm")
    if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
      set_source_files_properties(${neon} PROPERTIES COMPILE_OPTIONS "-mfpu=neon")
    endif()
    target_compile_definitions(${target} PRIVATE ARDRONE_VSLAM_WITH_NEON)
    target_sources(${target} PRIVATE ${neon})
  endif()
endfunction()
