# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
# Warnings live on an INTERFACE target that is never exported. -ffp-contract=off everywhere: a fused
# multiply-add would change the reference's rounding (docs/design.md, number formats).
add_library(edgecase_warnings INTERFACE)
target_compile_options(edgecase_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion
    -Wfloat-equal -Wold-style-cast -Wundef $<$<BOOL:${EDGECASE_WERROR}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # It means double{f} and arguments, too, and comparisons that are defaulted; GCC, which means what is written in
    # arithmetic, has the word. Strings of any length are what every compiler takes that the program is built by.
    target_compile_options(edgecase_warnings INTERFACE -Wno-double-promotion -Wno-float-equal -Wno-overlength-strings)
endif()
add_compile_options(-ffp-contract=off -fno-fast-math)
# A program says nothing of the folder that it was built in, and is the same wherever that is.
add_compile_options(-ffile-prefix-map=${CMAKE_SOURCE_DIR}/=)
if(EDGECASE_SANITIZE)
    # The arithmetic is optimised, the rest compiles twice as fast without.
    foreach(room ref diff)
        set(EDGECASE_OPTIMISE_${room} -O1)
    endforeach()
    # GCC's manual: instrumentation makes this warning report false positives (12.2 does, in <regex>). Clang lacks it.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(edgecase_warnings INTERFACE -Wno-maybe-uninitialized)
    endif()
    add_compile_options(-fsanitize=${EDGECASE_SANITIZE} -fno-omit-frame-pointer)
    add_compile_definitions(EDGECASE_SANITIZED)  # the compilers' own words for it differ
    if(EDGECASE_SANITIZE MATCHES "undefined")
        # What -fsanitize=address sees anyway, as memory that is not there, costs two thirds of the compile time.
        add_compile_options(-fno-sanitize-recover=undefined -fno-sanitize=vptr,null,alignment,object-size)
    endif()
    add_link_options(-fsanitize=${EDGECASE_SANITIZE})
endif()
if(NOT EDGECASE_SANITIZE)
    # The program reads files of strangers and runs beside drivers that write anywhere.
    add_compile_options(-fstack-protector-strong)
    add_compile_definitions($<$<NOT:$<CONFIG:Debug>>:_FORTIFY_SOURCE=2>)  # it needs optimisation
    add_link_options(LINKER:-z,relro,-z,now)
endif()
find_program(EDGECASE_MOLD mold)
if(EDGECASE_MOLD)
    include(CheckLinkerFlag)
    check_linker_flag(CXX -fuse-ld=mold EDGECASE_TAKES_MOLD)  # GCC does from 12.1 on
    if(EDGECASE_TAKES_MOLD)
        add_link_options(-fuse-ld=mold)
    endif()
endif()

# Headers that most files include, compiled once for the target; only where EDGECASE_PRECOMPILE asks for it. Of one
# `kind`, with the same headers, the first target compiles them for all that have its compiler options.
function(edgecase_precompile target kind)
    if(EDGECASE_PRECOMPILE)
        get_target_property(options ${target} COMPILE_OPTIONS)
        string(MD5 options "${options}")
        set(kind "${kind}_${options}")
        get_property(first GLOBAL PROPERTY EDGECASE_PRECOMPILED_${kind})
        if(first)
            target_precompile_headers(${target} REUSE_FROM ${first})
            return()
        endif()
        set_property(GLOBAL PROPERTY EDGECASE_PRECOMPILED_${kind} ${target})
        target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <fmt/format.h> <functional>
                                  <gmpxx.h> <map> <memory> <optional> <set> <sstream> <string> <vector> ${ARGN})
    endif()
endfunction()

# Files of a target that are compiled as one, so that their headers are read once; only where EDGECASE_UNITY asks for it.
function(edgecase_unite target size)
    if(EDGECASE_UNITY)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
    endif()
endfunction()

# For code whose time is that of the rooms that it calls: it is compiled in two thirds to four fifths of the time.
function(edgecase_optimise_little target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
endfunction()
