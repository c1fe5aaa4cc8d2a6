# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# Edgecase's cases as tests of CTest, in a project of your own:
#
#     enable_testing()
#     include(/usr/share/edgecase/ci/edgecase.cmake)
#     edgecase_add_tests(SELECTORS coverage/** ties/** OPTIONS --icd ${CMAKE_BINARY_DIR}/my_icd.json)
#
# One test is a folder of the suite in which the selectors choose a case (none: every folder), or with
# EACH_CASE one case, which costs a process each. Which there are is asked when CMake configures. A test
# passes if all ends as expected, is skipped if the device supports none of its cases, and leaves its
# report in the build folder, in edgecase/NAME/report.html. PREFIX (edgecase.) stands before the names,
# TIMEOUT (600) is CTest's, in seconds.
find_program(EDGECASE_PROGRAM edgecase REQUIRED)

function(edgecase_add_tests)
    cmake_parse_arguments(PARSE_ARGV 0 ARG "EACH_CASE" "PREFIX;TIMEOUT" "SELECTORS;OPTIONS")
    if(NOT DEFINED ARG_PREFIX)
        set(ARG_PREFIX edgecase.)
    endif()
    if(NOT DEFINED ARG_TIMEOUT)
        set(ARG_TIMEOUT 600)
    endif()
    execute_process(COMMAND ${EDGECASE_PROGRAM} list --ids -- ${ARG_SELECTORS}
                    OUTPUT_VARIABLE selected OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
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
                 COMMAND ${EDGECASE_PROGRAM} run ${ARG_OPTIONS} -o ${CMAKE_CURRENT_BINARY_DIR}/edgecase/${folder}
                         -- ${selector})
        set_tests_properties(${ARG_PREFIX}${name} PROPERTIES LABELS edgecase SKIP_RETURN_CODE 6 TIMEOUT ${ARG_TIMEOUT})
    endforeach()
endfunction()
