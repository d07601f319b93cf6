# Every compiler and optimisation level that must agree, and a build that counts lines and branches.
get_target_property(core_sources verp_core SOURCES)
list(FILTER core_sources EXCLUDE REGEX "/(protocol/.*|model/image|control/golden|control/self_test|control/boot_check|control/built_in_robot)\\.cpp$")
get_target_property(contract verp_floating_point INTERFACE_COMPILE_OPTIONS)
string(REGEX MATCHALL "-f[a-z-]+(=[a-z]+)?" contract "${contract}")
get_target_property(contract_definitions verp_floating_point INTERFACE_COMPILE_DEFINITIONS)
list(TRANSFORM contract_definitions PREPEND -D)
set(core_flags -std=c++20 -I${CMAKE_SOURCE_DIR} -isystem ${VERP_EIGEN_DIR} ${contract} ${contract_definitions})
find_program(VERP_CLANG NAMES clang++ clang++-14)
if(VERP_CLANG)
  execute_process(COMMAND ${VERP_CLANG} -print-file-name=libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.a
    OUTPUT_VARIABLE clang_asan OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
if(NOT IS_ABSOLUTE "${clang_asan}" OR NOT EXISTS "${clang_asan}")
  verp_left_out("the core by clang and its sanitizers" "clang or libclang-rt-14-dev")
  set(VERP_CLANG_RUNS OFF)
else()
  set(VERP_CLANG_RUNS ON)
endif()

# As one file: headers are read once, and calls inline across files.
set(whole_core ${CMAKE_CURRENT_BINARY_DIR}/whole_core/core.cpp)
list(TRANSFORM core_sources REPLACE "(.+)" "#include \"\\1\"\n" OUTPUT_VARIABLE whole_core_text)
list(JOIN whole_core_text "" whole_core_text)
file(CONFIGURE OUTPUT ${whole_core} CONTENT "${whole_core_text}" @ONLY)

# The object is appended to `list`.
function(compile_one list folder compiler source)
  file(RELATIVE_PATH object ${CMAKE_SOURCE_DIR} ${source})
  string(REPLACE "../" "" object ${object}) # a build tree outside the source tree
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${folder}/${object}.o)
  cmake_path(GET object PARENT_PATH parent)
  file(MAKE_DIRECTORY ${parent})
  add_custom_command(OUTPUT ${object}
    COMMAND ${CMAKE_CXX_COMPILER_LAUNCHER} ${compiler} ${core_flags} ${ARGN} -MD -MT ${object} -MF ${object}.d
      -c ${source} -o ${object}
    DEPENDS ${source} DEPFILE ${object}.d VERBATIM COMMENT "${folder}: ${source}")
  set(${list} ${${list}} ${object} PARENT_SCOPE)
endfunction()

# Links `folder`/`main` from the core's files (`core`) and tests/replay/main.cpp. Adds it to `programs`.
function(link_variant folder compiler main core link_flags)
  set(objects)
  foreach(source ${${core}})
    compile_one(objects ${folder} ${compiler} ${source} -ffreestanding -fno-exceptions -fno-rtti
      -fno-threadsafe-statics ${ARGN})
  endforeach()
  compile_one(objects ${folder} ${compiler} ${CMAKE_CURRENT_SOURCE_DIR}/${main}.cpp ${ARGN})
  compile_one(objects ${folder} ${compiler} ${CMAKE_CURRENT_SOURCE_DIR}/trace_digest.cpp ${ARGN})
  set(program ${CMAKE_CURRENT_BINARY_DIR}/${folder}/${main})
  add_custom_command(OUTPUT ${program} COMMAND ${compiler} ${ARGN} ${objects} -o ${program} ${link_flags}
    DEPENDS ${objects} VERBATIM COMMENT "Linking ${folder}/${main}")
  set(programs ${programs} ${program} PARENT_SCOPE)
endfunction()

set(programs)
# -O0 takes minutes: only replay.coverage runs it.
link_variant(gcc_O3 ${CMAKE_CXX_COMPILER} digest_main whole_core "" -O3)
link_variant(gcc_O3_native ${CMAKE_CXX_COMPILER} digest_main whole_core "" -O3 -march=native)
if(VERP_CLANG_RUNS)
  link_variant(clang_O1 ${VERP_CLANG} digest_main whole_core "" -O1)
  link_variant(clang_O2 ${VERP_CLANG} digest_main whole_core "" -O2)
  link_variant(clang_O3 ${VERP_CLANG} digest_main whole_core "" -O3)
  link_variant(clang_O3_native ${VERP_CLANG} digest_main whole_core "" -O3 -march=native)
  link_variant(clang_asan_ubsan ${VERP_CLANG} digest_main whole_core "" -O1 -g1 -fsanitize=address,undefined
    -fno-sanitize-recover=all)
endif()
add_custom_target(replay_variants ALL DEPENDS ${programs})
add_test(NAME replay.matrix
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/matrix ${VERP_LONG_TRACE} ${VERP_LONG_TRACE_GOLDEN} gcc_O2=$<TARGET_FILE:replay_digest>
    ${programs})
set_tests_properties(replay.matrix PROPERTIES LABELS replay FIXTURES_REQUIRED long_trace)

get_target_property(core_sources verp_core SOURCES)
# The linker keeps the sections that step() can call. File by file, because it cannot wrap calls within a file.
set(programs)
find_program(VERP_GCOV NAMES gcov-12 gcov)
link_variant(counted ${CMAKE_CXX_COMPILER} reach_main core_sources
  "-Wl,--gc-sections,--wrap=_ZN4verp6safety9next_modeENS0_4ModeEj" -O0 -g --coverage -ffunction-sections -fno-inline
  -fno-jump-tables)
add_custom_target(replay_counted ALL DEPENDS ${programs})
# A shorter trace reaches the same lines.
add_test(NAME replay.make_shorter COMMAND replay_make ${CMAKE_CURRENT_BINARY_DIR}/shorter_trace.bin 40000)
add_test(NAME replay.coverage
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/coverage ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/counted
    ${CMAKE_CURRENT_BINARY_DIR}/shorter_trace.bin ${VERP_GCOV} ${CMAKE_NM})
set_tests_properties(replay.make_shorter PROPERTIES LABELS replay FIXTURES_SETUP shorter_trace)
set_tests_properties(replay.coverage PROPERTIES COST 1000 LABELS replay FIXTURES_REQUIRED shorter_trace REQUIRED_FILES ${programs})

# The boot check must refuse a core whose products are not rounded. The x87 keeps them in 80 bits.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
  add_executable(replay_contracted contracted_main.cpp ${CMAKE_SOURCE_DIR}/common/math/contraction.cpp)
  target_compile_options(replay_contracted PRIVATE -O2 -mfpmath=387)
  set_target_properties(replay_contracted PROPERTIES UNITY_BUILD OFF) # in one file the compiler would know the answer
  target_link_libraries(replay_contracted PRIVATE verp_warnings)
  add_test(NAME replay.contraction_is_seen COMMAND replay_contracted)
  set_tests_properties(replay.contraction_is_seen PROPERTIES LABELS replay)
endif()
