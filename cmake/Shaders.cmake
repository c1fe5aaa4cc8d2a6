# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
# Placeholder target until shaders/ is compiled; vk_harness links it.
add_library(edgecase_shaders INTERFACE)
