# cmake -D release=0.2.0 -D compiler=... -D libraries=NAME=VERSION;... -D out=FILE -P ProgramVersion.cmake
# Writes FILE, what each program says of itself (core/base/ProgramVersion.h), if that has changed. Without -D out the
# version is printed.
cmake_minimum_required(VERSION 3.25)
get_filename_component(tree ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)

# ask(VARIABLE ARGUMENT...): what git says of this tree, also of one that is another user's; empty if it says nothing
function(ask variable)
    execute_process(COMMAND git -c "safe.directory=${tree}" -C "${tree}" ${ARGN} RESULT_VARIABLE failed
                    OUTPUT_VARIABLE said ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(failed)
        set(said "")
    endif()
    set(${variable} "${said}" PARENT_SCOPE)
endfunction()

set(version ${release})
set(commit unknown)
set(date "")
set(dirty false)
set(ENV{TZ} UTC0)
ask(prefix rev-parse --show-prefix --verify HEAD)  # an empty line and the commit, if the tree is a repository's own
if(prefix MATCHES "^\n?([0-9a-f]+)$")
    set(commit ${CMAKE_MATCH_1})
    ask(date show --no-patch --format=%cd --date=format-local:%Y-%m-%d HEAD)
    # What is not in git counts where it may be built in, and not where a user keeps sessions.
    ask(changed status --porcelain --untracked-files=no)
    ask(added ls-files --others --exclude-standard -- app core drivers resources)
    ask(released describe --exact-match --tags --match "v${release}" HEAD)
    if(changed OR added)
        set(dirty true)
    endif()
    if(dirty OR NOT released)
        string(REPLACE "-" "" day "${date}")
        string(SUBSTRING ${commit} 0 7 short)
        string(APPEND version "+git${day}.${short}")
    endif()
    if(dirty)
        string(APPEND version ".dirty")
    endif()
endif()

if(NOT out)
    message(${version})
    return()
endif()
set(library_list "")
foreach(library ${libraries})
    string(REGEX MATCH "^([^=]+)=(.*)$" library "${library}")
    list(APPEND library_list "ProgramVersion::Library{\"${CMAKE_MATCH_1}\", \"${CMAKE_MATCH_2}\"}")
endforeach()
list(JOIN library_list ", " library_list)
configure_file(${CMAKE_CURRENT_LIST_DIR}/ProgramVersion.cpp.in ${out} @ONLY)
