# Read by ctest: gtest_discover_tests takes one label only. Tests that start the verp program.
foreach(tests IN ITEMS tool_tests flash_tests setup_tests)
  if(${tests})
    set_tests_properties(${${tests}} PROPERTIES LABELS "unit;program")
  endif()
endforeach()
if(robot_tests)
  set_tests_properties(${robot_tests} PROPERTIES LABELS "hil;program")
endif()
