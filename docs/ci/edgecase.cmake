# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# Edgecase's cases as tests of CTest, in a project of your own:
#
#     enable_testing()
#     include(/usr/share/edgecase/ci/edgecase.cmake)
#     edgecase_add_tests(SELECTORS coverage/** ties/** OPTIONS --icd ${CMAKE_BINARY_DIR}/my_icd.json)
#     edgecase_add_tests(SUITE my-cases PREFIX mine. OPTIONS --icd ${CMAKE_BINARY_DIR}/my_icd.json)
#
# One test is a folder of the suite in which the selectors choose a case (none: every folder), or with
# EACH_CASE one case, which costs a process each. Which there are is asked when CMake configures. A test
# passes if all ends as expected, is skipped if the device supports none of its cases, and leaves its
# report in the build folder, in edgecase/NAME/report.html. PREFIX (edgecase.) stands before the names,
# TIMEOUT (600) is CTest's, in seconds. Cases of your own are a suite of their own: SUITE is their folder,
# counted from the source folder; selectors are then about its cases.
find_program(EDGECASE_PROGRAM edgecase REQUIRED)

function(edgecase_add_tests)
    cmake_parse_arguments(PARSE_ARGV 0 ARG "EACH_CASE" "SUITE;PREFIX;TIMEOUT" "SELECTORS;OPTIONS")
    if(NOT DEFINED ARG_PREFIX)
        set(ARG_PREFIX edgecase.)
    endif()
    if(NOT DEFINED ARG_TIMEOUT)
        set(ARG_TIMEOUT 600)
    endif()
    set(suite)
    if(DEFINED ARG_SUITE)
        get_filename_component(folder ${ARG_SUITE} ABSOLUTE)
        set(suite --suite ${folder})
    endif()
    set(list ${CMAKE_CURRENT_BINARY_DIR}/edgecase-ids.txt)
    execute_process(COMMAND ${EDGECASE_PROGRAM} list --ids ${suite} -- ${ARG_SELECTORS}
                    OUTPUT_FILE ${list} COMMAND_ERROR_IS_FATAL ANY)
    # What the tests will be given has to be known there, too: a case of a file or folder outside the suite is not.
    execute_process(COMMAND ${EDGECASE_PROGRAM} list --ids ${suite} -
                    INPUT_FILE ${list} OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE unknown)
    if(unknown)
        message(FATAL_ERROR "edgecase_add_tests: SELECTORS choose cases outside the suite; make a call of its own "
                            "for them, with SUITE and the folder that they are in")
    endif()
    file(READ ${list} selected)
    string(STRIP "${selected}" selected)
    string(REPLACE "\n" ";" selected "${selected}")
    if(NOT ARG_EACH_CASE)
        # The folder of "a/b:x=1/2" is a: what follows ':' may hold '/', too.
        list(TRANSFORM selected REPLACE "/[^/:]*(:.*)?$" "/*")
        list(REMOVE_DUPLICATES selected)
    endif()
    foreach(selector IN LISTS selected)
        string(REGEX REPLACE "/\\*$" "" name ${selector})
        string(REGEX REPLACE "[^A-Za-z0-9_.=-]" "_" folder ${name})
        add_test(NAME ${ARG_PREFIX}${name}
                 COMMAND ${EDGECASE_PROGRAM} run ${suite} ${ARG_OPTIONS} -o ${CMAKE_CURRENT_BINARY_DIR}/edgecase/${folder}
                         -- ${selector})
        set_tests_properties(${ARG_PREFIX}${name} PROPERTIES LABELS edgecase SKIP_RETURN_CODE 6 TIMEOUT ${ARG_TIMEOUT})
    endforeach()
endfunction()
