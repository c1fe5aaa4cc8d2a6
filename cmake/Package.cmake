# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
# `cpack` makes of a build folder what `cmake --install` leaves, as a package of Debian and as an archive (scripts/package).
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_VENDOR "The Edgecase authors")
set(CPACK_PACKAGE_CONTACT "The Edgecase authors <edgecase@invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "exact reference checker for triangle rasterization by Vulkan drivers")
set(CPACK_PACKAGE_DESCRIPTION "Draws triangles by exact arithmetic and by a Vulkan driver, and says of every sample
whether the driver is right, by which rule, and why.")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/package)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
# What the program is linked with is found by dpkg-shlibdeps; the loader it opens at run time, and a driver may be any.
find_program(EDGECASE_SHLIBDEPS dpkg-shlibdeps)
if(EDGECASE_SHLIBDEPS)
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
else()
    set(CPACK_GENERATOR TGZ)  # a package that does not say what it needs is none
endif()
set(CPACK_DEBIAN_PACKAGE_DEPENDS libvulkan1)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
include(CPack)
