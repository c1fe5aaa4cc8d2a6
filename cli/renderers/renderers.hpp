// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of renderers, the one place that knows all of them. A new one is a row here and a file
// that implements capture::Renderer.
#pragma once

#include "capture/renderer.hpp"

namespace cli {

// The driver first, which draws where no renderer is named.
capture::RendererKinds all_renderers();

// Of --renderer, whose words the command line has checked.
const capture::RendererKind& renderer_of(const capture::RendererOptions& options);

// The drivers that the options leave; none for a renderer that needs none.
capture::Installed find_drivers(const capture::RendererOptions& options);

}  // namespace cli
