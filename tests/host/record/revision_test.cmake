# cmake -DSCRIPT=revision.cmake -DFOLDER=SCRATCH -P revision_test.cmake: the source revision of traces.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})

function(expect pattern when)
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${FOLDER} -P ${SCRIPT} OUTPUT_VARIABLE revision
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT revision MATCHES "^${pattern}$")
    message(SEND_ERROR "${when}: '${revision}', expected ${pattern}")
  endif()
endfunction()

function(git)
  execute_process(COMMAND git -C ${FOLDER} -c user.name=test -c user.email=test@localhost ${ARGN}
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

string(REPEAT "[0-9a-f]" 40 hash)
file(WRITE ${FOLDER}/source.cpp "int a;\n")
expect(unknown "a tarball")
git(init -q)
expect(unknown "before the first commit")
git(add source.cpp)
git(commit -q -m first)
expect(${hash} "as committed")
git(tag -a -m release v1)
expect(${hash} "as tagged")
file(WRITE ${FOLDER}/source.cpp "int b;\n")
expect(${hash}-dirty "edited")

# Written only on a change; else every build would compile.
execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${FOLDER} -DOUTPUT=${FOLDER}/out.cpp -P ${SCRIPT})
file(TIMESTAMP ${FOLDER}/out.cpp before "%s%f")
execute_process(COMMAND ${CMAKE_COMMAND} -E sleep 0.1)
execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${FOLDER} -DOUTPUT=${FOLDER}/out.cpp -P ${SCRIPT})
file(TIMESTAMP ${FOLDER}/out.cpp after "%s%f")
file(READ ${FOLDER}/out.cpp text)
if(NOT text MATCHES "${hash}-dirty" OR NOT before STREQUAL after)
  message(SEND_ERROR "written again for nothing, or not for the compiler: ${text}")
endif()

set(ENV{PATH} /nowhere)
expect(${hash}-unchecked "without git")
file(REMOVE_RECURSE ${FOLDER})
