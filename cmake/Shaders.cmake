# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# edgecase_shaders: every variant of the shaders in shaders/, compiled by glslang at build time and
# embedded. Variants are grouped into a few commands, so that they run side by side.
find_program(EDGECASE_GLSLANG NAMES glslangValidator glslang REQUIRED)
set(EDGECASE_SHADER_DIR ${CMAKE_BINARY_DIR}/shaders)
file(MAKE_DIRECTORY ${EDGECASE_SHADER_DIR})

set(EDGECASE_SHADER_OUTPUTS "")
set(EDGECASE_SHADER_INCLUDES "")
function(edgecase_compile_shader source output variants)
    set(path ${EDGECASE_SHADER_DIR}/${output}.inc)
    add_custom_command(
        OUTPUT ${path}
        COMMAND ${CMAKE_COMMAND} -D GLSLANG=${EDGECASE_GLSLANG} -D SOURCE=${CMAKE_SOURCE_DIR}/shaders/${source}
                -D OUTPUT=${path} "-D VARIANTS=${variants}" -P ${CMAKE_SOURCE_DIR}/shaders/compile.cmake
        DEPENDS ${CMAKE_SOURCE_DIR}/shaders/${source} ${CMAKE_SOURCE_DIR}/shaders/compile.cmake
        COMMENT "Compiling ${source} (${output})"
        VERBATIM)
    set(EDGECASE_SHADER_OUTPUTS ${EDGECASE_SHADER_OUTPUTS} ${path} PARENT_SCOPE)
    set(EDGECASE_SHADER_INCLUDES "${EDGECASE_SHADER_INCLUDES}#include \"${output}.inc\"\n" PARENT_SCOPE)
endfunction()

set(variants "")
set(vertex_table "")
foreach(count RANGE 4)
    list(APPEND variants "vertex_${count}=-DATTRIBUTES=${count}")
    string(APPEND vertex_table "    vertex_${count},\n")
endforeach()
edgecase_compile_shader(capture.vert vertex "${variants}")
edgecase_compile_shader(copy_samples.comp copy "copy_color=-DDEPTH=0;copy_depth=-DDEPTH=1")

# Fragment shaders: number = (3^count - 1) / 2 + sum mode_k 3^k, first without, then with primitive id.
set(modes smooth noperspective flat)
set(fragment_table "")
foreach(primitive RANGE 1)
    set(combinations 1)
    foreach(count RANGE 4)
        set(variants "")
        math(EXPR last "${combinations} - 1")
        foreach(code RANGE ${last})
            set(defines "-DATTRIBUTES=${count},-DPRIMITIVE_ID=${primitive}")
            set(rest ${code})
            if(count GREATER 0)
                math(EXPR last_attribute "${count} - 1")
                foreach(attribute RANGE ${last_attribute})
                    math(EXPR mode "${rest} % 3")
                    math(EXPR rest "${rest} / 3")
                    list(GET modes ${mode} word)
                    string(APPEND defines ",-DMODE${attribute}=${word}")
                endforeach()
            endif()
            set(name fragment_${primitive}_${count}_${code})
            list(APPEND variants "${name}=${defines}")
            string(APPEND fragment_table "    ${name},\n")
            list(LENGTH variants group)
            if(group EQUAL 27 OR code EQUAL last)
                edgecase_compile_shader(capture.frag ${name} "${variants}")
                set(variants "")
            endif()
        endforeach()
        math(EXPR combinations "${combinations} * 3")
    endforeach()
endforeach()
file(CONFIGURE OUTPUT ${EDGECASE_SHADER_DIR}/modules.inc CONTENT
"// The modules of all variants, made by cmake/Shaders.cmake; do not edit.
${EDGECASE_SHADER_INCLUDES}
constexpr std::span<const uint32_t> kVertex[] = {
${vertex_table}};
constexpr std::span<const uint32_t> kFragment[] = {
${fragment_table}};
")

add_library(edgecase_shaders STATIC ${CMAKE_SOURCE_DIR}/shaders/shaders.cpp ${EDGECASE_SHADER_OUTPUTS})
target_include_directories(edgecase_shaders PUBLIC ${CMAKE_SOURCE_DIR} PRIVATE ${EDGECASE_SHADER_DIR})
target_link_libraries(edgecase_shaders PRIVATE edgecase_warnings)
