# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT, a C++ file with VERSION and the state of the git checkout in SOURCE:
#   0.2.0                         the commit with the tag v0.2.0, or no checkout
#   0.2.0+12.gabc1234             12 commits behind that tag
#   0.2.0+gabc1234-modified       there is no such tag; files differ from the commit
# The file stays untouched while nothing changes, so that nothing is linked again.
cmake_minimum_required(VERSION 3.22)
set(version ${VERSION})
find_program(GIT git)
if(GIT)
  # The sources may lie in a folder of somebody else's checkout.
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-toplevel OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH ${SOURCE} source)
  if(top STREQUAL source)
    execute_process(COMMAND ${GIT} -C ${SOURCE} describe --tags --always --long --abbrev=7 --match v${VERSION} --dirty=-modified
                    OUTPUT_VARIABLE state OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(state MATCHES "^v.*-([0-9]+)-(g[0-9a-f]+)(-modified)?$")
      if(CMAKE_MATCH_1 OR CMAKE_MATCH_3)
        string(APPEND version "+${CMAKE_MATCH_1}.${CMAKE_MATCH_2}${CMAKE_MATCH_3}")
      endif()
    elseif(state)
      string(APPEND version "+g${state}")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "extern const char* const dalembert_version_and_commit;
const char* const dalembert_version_and_commit = \"@version@\";
" @ONLY)
