# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
# Every third-party package, in one place, as SYSTEM targets. All are Debian 12 packages
# (scripts/packages.txt).
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PkgConfig REQUIRED)

function(edgecase_header_only name header)
    find_path(EDGECASE_${name}_INCLUDE ${header} REQUIRED)
    add_library(edgecase_${name} INTERFACE)
    target_include_directories(edgecase_${name} SYSTEM INTERFACE ${EDGECASE_${name}_INCLUDE})
    add_library(edgecase::${name} ALIAS edgecase_${name})
endfunction()
edgecase_header_only(expected tl/expected.hpp)
edgecase_header_only(glm glm/glm.hpp)
edgecase_header_only(vulkan_headers vulkan/vulkan.h)
edgecase_header_only(tomlplusplus toml++/toml.h)

# Static where Debian has an archive: the program then starts faster and runs under another C library.
get_target_property(EDGECASE_FMT_INCLUDE fmt::fmt-header-only INTERFACE_INCLUDE_DIRECTORIES)
add_library(edgecase_fmt STATIC ${CMAKE_SOURCE_DIR}/cmake/fmt/fmt.cpp)
target_include_directories(edgecase_fmt SYSTEM PUBLIC ${EDGECASE_FMT_INCLUDE})
add_library(edgecase::fmt ALIAS edgecase_fmt)
find_library(EDGECASE_GMPXX libgmpxx.a REQUIRED)
find_library(EDGECASE_GMP libgmp.a REQUIRED)
add_library(edgecase_gmp INTERFACE)
target_link_libraries(edgecase_gmp INTERFACE ${EDGECASE_GMPXX} ${EDGECASE_GMP})
add_library(edgecase::gmp ALIAS edgecase_gmp)
find_library(EDGECASE_RE2 libre2.a REQUIRED)
find_path(EDGECASE_RE2_INCLUDE re2/re2.h REQUIRED)
add_library(edgecase_re2 INTERFACE)
target_include_directories(edgecase_re2 SYSTEM INTERFACE ${EDGECASE_RE2_INCLUDE})
target_link_libraries(edgecase_re2 INTERFACE ${EDGECASE_RE2} Threads::Threads)
add_library(edgecase::re2 ALIAS edgecase_re2)

add_library(edgecase::json ALIAS nlohmann_json)
if(NOT TARGET edgecase::json)
    add_library(edgecase::json ALIAS nlohmann_json::nlohmann_json)
endif()
add_library(edgecase::cli11 ALIAS CLI11::CLI11)
add_library(edgecase_vulkan INTERFACE)
target_link_libraries(edgecase_vulkan INTERFACE edgecase::vulkan_headers ${CMAKE_DL_LIBS} Threads::Threads)
add_library(edgecase::vulkan ALIAS edgecase_vulkan)

# By pkg-config: Debian's CMake package asks for programs of packages that are not installed with it.
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)
add_library(edgecase_openimageio INTERFACE)
target_link_libraries(edgecase_openimageio INTERFACE PkgConfig::OIIO)
add_library(edgecase::openimageio ALIAS edgecase_openimageio)
