# cmake -DSOURCE=FOLDER [-DOUTPUT=FILE] -P revision.cmake: writes the revision of the sources in FOLDER to OUTPUT as C++
# (untouched if equal), or else to stdout.
#   HASH            as committed
#   HASH-dirty      with uncommitted edits
#   HASH-unchecked  edits unknown: git is not installed, or refuses this folder
#   unknown         not from a repository (a tarball), or nothing is committed yet
set(revision unknown)
find_program(git git NO_CACHE)
if(git AND EXISTS ${SOURCE}/.git)
  # No locks: a commit may be running. No tags: one revision has one name.
  execute_process(
    COMMAND ${git} -C ${SOURCE} --no-optional-locks describe --always --dirty --abbrev=40 --exclude *
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(described)
    set(revision ${described})
  endif()
endif()
if(revision STREQUAL "unknown" AND EXISTS ${SOURCE}/.git/HEAD)
  file(STRINGS ${SOURCE}/.git/HEAD head LIMIT_COUNT 1)
  if(head MATCHES "^ref: (.*)$")
    set(branch ${SOURCE}/.git/${CMAKE_MATCH_1})
    set(head "")
    if(EXISTS ${branch})
      file(STRINGS ${branch} head LIMIT_COUNT 1)
    endif()
  endif()
  if(head)
    set(revision ${head}-unchecked)
  endif()
endif()

if(OUTPUT)
  file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
namespace verp::record {

extern const char* const kSourceRevision;
const char* const kSourceRevision = "@revision@";

}  // namespace verp::record
]] @ONLY)
else()
  execute_process(COMMAND ${CMAKE_COMMAND} -E echo ${revision})
endif()
