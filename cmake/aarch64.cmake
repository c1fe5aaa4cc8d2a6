# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# Toolchain: aarch64 Linux by Debian's cross compiler and the arm64 packages of scripts/packages-aarch64.txt. What the
# build itself runs, and the tests, run under qemu; shaders are compiled by a compile_shader of this machine
# (scripts/test-aarch64 builds it and hands it over).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
