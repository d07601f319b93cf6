# verp_compile_together(TARGET SOURCES...): compiles one folder's sources as one file, for the PC and for the boards.
# So names in one folder must differ, or the file is listed here and compiled alone.
set(VERP_COMPILED_ALONE
  balance/gravity_test.cpp can_app/canopen_servos_test.cpp can_app/controller_actions_test.cpp can_app/controller_objects_test.cpp canopen/nmt_test.cpp
  control/step_test.cpp gait/gait_test.cpp gait/preview_test.cpp math/elementary_test.cpp math/linear_test.cpp
  math/scalar_test.cpp protocol/parser_test.cpp store/power_cut_test.cpp store/program_bytes_test.cpp store/shared_page_test.cpp)

function(verp_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    cmake_path(GET source FILENAME name)
    if(NOT ${folder}/${name} IN_LIST VERP_COMPILED_ALONE)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
    endif()
  endforeach()
endfunction()
