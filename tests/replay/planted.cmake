# The core with the microsecond that times steps changed by one unit in the last place. Its own
# namespace lets one program hold both cores.
set(planted_header ${CMAKE_SOURCE_DIR}/common/gait/types.hpp)
set(planted_from "static_cast<float>(duration_us()) * 1e-6F")
set(planted_to "static_cast<float>(duration_us()) * 0x1.0c6f7cp-20F")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${planted_header})
file(READ ${planted_header} planted_text)
string(FIND "${planted_text}" "${planted_from}" planted_at)
if(planted_at EQUAL -1)
  message(FATAL_ERROR "${planted_header}: no `${planted_from}`: give tests/replay/planted.cmake another constant to change")
endif()
string(REPLACE "${planted_from}" "${planted_to}" planted_text "${planted_text}")
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/planted_core/common/gait/types.hpp CONTENT "${planted_text}" @ONLY)

get_target_property(planted_sources verp_core SOURCES)
list(FILTER planted_sources EXCLUDE REGEX "/common/protocol/")
add_library(verp_planted_core STATIC ${planted_sources} planted_step.cpp)
# BEFORE: the changed header goes first.
target_include_directories(verp_planted_core BEFORE PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/planted_core)
target_include_directories(verp_planted_core SYSTEM PRIVATE ${VERP_EIGEN_DIR})
target_compile_definitions(verp_planted_core PRIVATE verp=verp_planted)
target_compile_options(verp_planted_core PRIVATE -fno-exceptions -fno-rtti -fno-threadsafe-statics)
target_link_libraries(verp_planted_core PRIVATE verp_floating_point verp_warnings)

add_executable(replay_planted planted_test.cpp)
target_link_libraries(replay_planted PRIVATE
  verp_planted_core verp_long_trace verp_host_record verp_host_model verp_warnings GTest::gtest_main)
gtest_discover_tests(replay_planted TEST_PREFIX replay. PROPERTIES LABELS replay)
