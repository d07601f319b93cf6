# Python, Octave and C#, where their tools are. REQUIRED_FILES are used but not named by the commands (tests/wanted).
set(library $<TARGET_FILE_DIR:verp_shared>)
set(for_python "PYTHONPATH=${CMAKE_SOURCE_DIR}/host/apps/libverp/python;PYTHONDONTWRITEBYTECODE=1;VERP_LIBRARY=$<TARGET_FILE:verp_shared>")
add_test(NAME host.libverp.install COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/install.sh ${CMAKE_COMMAND} ${CMAKE_BINARY_DIR})
set_tests_properties(host.libverp.install PROPERTIES LABELS unit REQUIRED_FILES $<TARGET_FILE:verp_shared>)

foreach(package cffi numpy)
  find_path(VERP_PYTHON_${package} ${package}/__init__.py PATHS /usr/lib/python3/dist-packages NO_DEFAULT_PATH)
endforeach()
if(VERP_PYTHON_cffi AND VERP_PYTHON_numpy)
  set(python /usr/bin/python3)
  add_test(NAME host.libverp.python COMMAND ${python} ${CMAKE_CURRENT_SOURCE_DIR}/python_test.py)
  add_test(NAME host.libverp.python_misuse COMMAND ${python} ${CMAKE_CURRENT_SOURCE_DIR}/python_misuse_test.py)
  add_test(NAME host.libverp.python_speed COMMAND ${python} ${CMAKE_SOURCE_DIR}/tests/bench/languages/rate.py 5 5000)
  set_tests_properties(host.libverp.python host.libverp.python_misuse host.libverp.python_speed
    PROPERTIES LABELS unit ENVIRONMENT "${for_python}")
else()
  verp_left_out("tests of libverp from Python" "python3-cffi or python3-numpy")
endif()

find_program(VERP_OCTAVE octave-cli)
if(TARGET verp_mex AND VERP_OCTAVE)
  add_custom_target(octave_all ALL DEPENDS verp_mex)
  set(octave ${CMAKE_CURRENT_BINARY_DIR}/octave)
  file(GENERATE OUTPUT ${octave} CONTENT "#!/bin/sh
exec '${CMAKE_CURRENT_SOURCE_DIR}/octave.sh' '${CMAKE_SOURCE_DIR}/host/apps/libverp/matlab' '$<TARGET_FILE_DIR:verp_mex>' \"$@\"
" FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  add_test(NAME host.libverp.octave COMMAND ${octave} --path ${CMAKE_CURRENT_SOURCE_DIR} --path ${CMAKE_SOURCE_DIR}/tests/bench/languages
    --eval octave_test)
  add_test(NAME host.libverp.octave_misuse COMMAND ${octave} --path ${CMAKE_CURRENT_SOURCE_DIR} --eval octave_misuse_test)
  set(octave_files $<TARGET_FILE:verp_mex>)
  set_tests_properties(host.libverp.octave host.libverp.octave_misuse PROPERTIES LABELS unit REQUIRED_FILES "${octave_files}")
else()
  verp_left_out("tests of libverp from Octave" "octave or octave-dev")
endif()

find_program(VERP_MONO mono)
if(TARGET verp_csharp AND VERP_MONO)
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/csharp)
  foreach(source ${CMAKE_CURRENT_SOURCE_DIR}/csharp_test.cs ${CMAKE_CURRENT_SOURCE_DIR}/pictures/csharp_pictures_test.cs ${examples}/walk.cs ${examples}/controller.cs ${examples}/record.cs ${examples}/tune.cs ${examples}/camera.cs ${examples}/radio.cs)
    get_filename_component(name ${source} NAME_WE)
    add_custom_command(OUTPUT csharp/${name}.exe
      COMMAND ${VERP_MCS} -unsafe -debug -warn:4 -warnaserror -r:${library}/csharp/verp.dll -out:csharp/${name}.exe ${source}
      DEPENDS verp_csharp ${source} VERBATIM)
    list(APPEND csharp_programs csharp/${name}.exe)
  endforeach()
  add_custom_target(csharp_all ALL DEPENDS ${csharp_programs} verp_csharp)
  add_dependencies(csharp_all verp_shared)
  set(csharp ${CMAKE_CURRENT_BINARY_DIR}/csharp/run)
  file(GENERATE OUTPUT ${csharp} CONTENT "#!/bin/sh
program=$1
shift
exec env 'LD_LIBRARY_PATH=${library}' 'MONO_PATH=${library}/csharp' mono --debug '${CMAKE_CURRENT_BINARY_DIR}/csharp/'\"$program\".exe \"$@\"
" FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  add_test(NAME host.libverp.csharp COMMAND ${csharp} csharp_test)
  list(TRANSFORM csharp_programs PREPEND ${CMAKE_CURRENT_BINARY_DIR}/ OUTPUT_VARIABLE csharp_files)
  set_tests_properties(host.libverp.csharp PROPERTIES LABELS unit REQUIRED_FILES "${csharp_files}")
else()
  verp_left_out("tests of libverp from C#" "mono-mcs or mono-runtime")
endif()

set(examples_test ${CMAKE_CURRENT_SOURCE_DIR}/examples.sh)
set(programs ${CMAKE_CURRENT_BINARY_DIR})
if(python AND octave AND csharp)
  set(example_files ${octave_files} ${csharp_files})
  foreach(name walk controller record tune camera radio)
    list(APPEND example_files $<TARGET_FILE:example_${name}_c> $<TARGET_FILE:example_${name}_cpp>)
  endforeach()
  add_test(NAME host.libverp.examples COMMAND ${examples_test} $<TARGET_FILE:verp> ${programs} ${examples} ${octave} ${csharp} walks)
  add_test(NAME host.libverp.other_examples COMMAND ${examples_test} $<TARGET_FILE:verp> ${programs} ${examples} ${octave} ${csharp} others)
  set_tests_properties(host.libverp.examples host.libverp.other_examples
    PROPERTIES LABELS unit ENVIRONMENT "${for_python}" REQUIRED_FILES "${example_files}")
endif()
