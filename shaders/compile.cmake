# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# cmake -D GLSLANG=... -D SOURCE=... -D OUTPUT=... -D VARIANTS=name=-DA=1,-DB=2;name2=... -P compile.cmake
# Compiles SOURCE once a variant to SPIR-V 1.3 and writes all modules to OUTPUT as C++ arrays.
get_filename_component(source_name ${SOURCE} NAME)
set(text "// Made from ${source_name} by glslang; do not edit.\n")
foreach(variant IN LISTS VARIANTS)
    string(REGEX MATCH "^([a-z0-9_]+)=(.*)$" matched "${variant}")
    set(name ${CMAKE_MATCH_1})
    string(REPLACE "," ";" defines "${CMAKE_MATCH_2}")
    set(header ${OUTPUT}.${name}.h)
    execute_process(
        COMMAND ${GLSLANG} -V --target-env vulkan1.1 -g0 ${defines} --vn ${name} -o ${header} ${SOURCE}
        OUTPUT_VARIABLE log ERROR_VARIABLE log RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "glslang rejects ${source_name} with ${defines}:\n${log}")
    endif()
    file(READ ${header} module)
    file(REMOVE ${header})
    string(REGEX REPLACE "^.*(const uint32_t)" "constexpr uint32_t" module "${module}")
    string(APPEND text "${module}\n")
endforeach()
file(WRITE ${OUTPUT} "${text}")
